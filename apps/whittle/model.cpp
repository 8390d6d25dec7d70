// whittle model NAME [N]: models made to measure, as .csg or for POV-Ray.
#include <fmt/format.h>

#include <charconv>
#include <climits>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>

#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "generate/generate.h"
#include "image/pov.h"
#include "option_group.h"
#include "whittle/output.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle model", "Writes a model made to measure: the paper's, and more.",
    "NAME [N] [options]\n       whittle model --list",
    "The .csg is OpenSCAD's, with comments. As .pov it is the same model for POV-Ray,\n"
    "seen and lit as by 'whittle model.csg --style blinn'; view and look count then.\n\n"
    "Examples:\n"
    "  whittle model cheese 1000 -o cheese1000.csg\n"
    "  whittle model tube -o tube.pov --imgsize 800,600\n"
    "  whittle model random 50 --seed 7 | whittle - -o random.png\n\n"
    "Exit codes: 0 done, 2 bad usage, 3 refused by the machine."};

struct ModelArguments {
  std::string name;
  std::optional<int> n;
  uint64_t seed = kDefaultSeed;
  std::string output = "-";
  bool wants_list = false;
  ViewOptions view;
  ShadeSettings shading;
};

std::string list() {
  std::string text;
  for (const Generator& g : generators()) {
    const std::string sizes =
        g.max_n == 0 ? std::string()
                     : fmt::format(" (N {} to {}, {} unless given)", g.min_n, g.max_n, g.default_n);
    fmt::format_to(std::back_inserter(text), "{:<9} {}{}\n", g.name, g.summary, sizes);
  }
  return text;
}

bool has_ending(const std::string& path, const char* ending) {
  return to_lower(path).ends_with(ending);
}

Result<std::string> make_text(const ModelArguments& a) {
  Result<std::string> csg = generate_model(a.name, a.n, a.seed);
  if (!csg || a.output == "-" || has_ending(a.output, ".csg")) return csg;
  if (!has_ending(a.output, ".pov")) {
    return Error{ErrorKind::kUsage, fmt::format("'{}' does not end in .csg or .pov, so its format "
                                                "is not known",
                                                a.output)};
  }
  const Result<Read> read = read_csg(*csg, a.name + ".csg");
  if (!read) return read.error();
  Result<Renderer> renderer = Renderer::make(read->model, {});
  if (!renderer) return renderer.error();
  return write_pov(read->model, renderer->camera(a.view), a.shading);
}

}  // namespace

int model_command(Arguments arguments) {
  CommandLine line(kHelp);
  CLI::App& app = line.app();
  ModelArguments a;
  a.shading.style = Style::kBlinn;
  line.add_optional("NAME", [&](const std::string& name) { a.name = name; });
  line.add_optional(
      "N", [&](const std::string& text) { a.n = int(parse_count("N", text, 0, INT_MAX)); });
  OptionGroup output(app, "Model");
  output.add_flag("--list", a.wants_list, "say which models there are, and stop");
  // As text: a double does not hold every seed.
  output.add_text("--seed", "S", fmt::format("for models with chance in them ({})", kDefaultSeed),
                  [&](const std::string& text) {
                    const char* end = text.data() + text.size();
                    const auto [rest, code] = std::from_chars(text.data(), end, a.seed);
                    if (code != std::errc() || rest != end) {
                      refuse("--seed", fmt::format("wants a whole number from 0, not {}", text));
                    }
                  });
  output.add_text("-o", "OUT", "a .csg or .pov file; else standard output",
                  [&](const std::string& path) { a.output = path; });
  add_view_options(app, a.view);
  add_color_options(app, a.shading);
  if (const std::optional<int> code = line.parse(arguments)) return *code;

  if (a.wants_list) return print(list());
  if (a.name.empty()) {
    return report({ErrorKind::kUsage, "NAME is required; 'whittle model --list' says which"});
  }
  if (Status possible = check_view(a.view); !possible) return report(possible.error());
  const Result<std::string> text = make_text(a);
  if (!text) return report(text.error());
  const Status written = write_output(a.output, *text);
  return written ? kExitDone : report(written.error());
}

}  // namespace whittle
