#include "scad_options.h"

#include <fmt/format.h>

#include "host/input_kinds.h"

namespace whittle {
namespace {

/// The program sees that it is rendered where --render is given and --preview is not, in whatever
/// order they come.
void add_preview_options(CommandLine& line, ScadArguments& scad) {
  line.add_loose_flag("--preview", [&scad](const std::string& value) {
    scad.previews = true;
    scad.thrown_together = value == "throwntogether";
    scad.flatten.renders = false;
  });
  line.add_loose_flag("--render",
                      [&scad](const std::string&) { scad.flatten.renders = !scad.previews; });
}

}  // namespace

void add_scad_options(CommandLine& line, ScadArguments& scad) {
  OptionGroup group(line.app(), "For .scad files: what openscad, which evaluates them, is told");
  group.add_each("-D", "NAME=VALUE", "sets a variable; and -D again for more",
                 [&](const std::string& text) {
                   scad.flatten.definitions.push_back(text);
                   scad.set_variables = "-D";
                 });
  group.add_text("-p", "FILE", "the customizer's file of parameter sets",
                 [&](const std::string& text) {
                   scad.flatten.parameter_file = text;
                   scad.set_variables = "-p";
                 });
  group.add_text("-P", "SET", "the set in it", [&](const std::string& text) {
    scad.flatten.parameter_set = text;
    scad.set_variables = "-P";
  });
  group.add_text("-m", "COMMAND", "what it runs for a file that is missing",
                 [&](const std::string& text) {
                   scad.flatten.arguments.push_back("-m" + text);
                   scad.set_variables = "-m";
                 });
  group.add_text("--openscad", "PATH", "the program ($OPENSCAD, else openscad)",
                 [&](const std::string& text) { scad.flatten.program = text; });
  group.add_each("--enable", "FEATURE", "one of its experiments", [&](const std::string& text) {
    scad.flatten.arguments.push_back("--enable=" + text);
  });
  group.add_flag(
      "--hardwarnings",
      [&] {
        if (scad.hard_warnings) return;
        scad.hard_warnings = true;
        scad.flatten.arguments.emplace_back("--hardwarnings");
      },
      "the first warning is an error, whittle's too");
  for (const char* name : {"--check-parameters", "--check-parameter-ranges"}) {
    // They change what is said, and are not in the help.
    OptionGroup(line.app(), "").add_text(name, "VALUE", "", [&scad, name](const std::string& text) {
      scad.flatten.arguments.push_back(fmt::format("{}={}", name, text));
    });
  }
  add_preview_options(line, scad);
}

Status check_scad(const std::string& file, const ScadArguments& scad) {
  if (scad.set_variables.empty() || kind_of_input(file) == InputKind::kScad) return Done{};
  return Error{ErrorKind::kUsage, fmt::format("{} is for a .scad file, which openscad evaluates; "
                                              "nothing is left to be set in {}",
                                              scad.set_variables, file)};
}

}  // namespace whittle
