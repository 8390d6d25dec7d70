// whittle params FILE.scad: the variables that a program offers to be set.
#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "base/printable.h"
#include "commands.h"
#include "console.h"
#include "edit/customizer.h"
#include "host/input_file.h"
#include "option_group.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;

constexpr CommandHelp kHelp = {
    "whittle params",
    "Lists the variables that a .scad file offers to be set, with their values and\n"
    "ranges, as OpenSCAD's customizer has them.",
    "FILE [options]",
    "What the comments in FILE may say is in OpenSCAD's manual, under Customizer.\n"
    "-D sets a variable when a picture is made.\n\n"
    "Examples:\n"
    "  whittle params box.scad\n"
    "  whittle params box.scad --json | jq -r '.variables[].name'\n"
    "  whittle box.scad -D width=20 -o box.png\n\n"
    "Exit codes: 0 done, 1 FILE cannot be read, 2 bad usage."};

/// What the values of a variable can be, in words; empty if they can be any.
std::string range_text(const CustomizerVariable& variable) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (variable.least) {
    add(fmt::format("{} to {}", customizer_text(*variable.least), customizer_text(*variable.most)));
  }
  if (variable.step) add("in steps of " + customizer_text(*variable.step));
  if (variable.most_characters)
    add(fmt::format("at most {} characters", *variable.most_characters));
  for (const CustomizerChoice& choice : variable.choices) {
    const std::string value = customizer_text(choice.value);
    const bool has_label = choice.label != value && '"' + choice.label + '"' != value;
    add(has_label ? fmt::format("{} ({})", value, choice.label) : value);
  }
  return text;
}

std::string describe_text(const std::vector<CustomizerVariable>& variables) {
  std::string text;
  const std::string* group = nullptr;
  for (const CustomizerVariable& variable : variables) {
    if (!group || *group != variable.group) {
      text += fmt::format("{}[{}]\n", group ? "\n" : "", printable(variable.group));
      group = &variable.group;
    }
    std::string line = fmt::format("{} = {}", variable.name, customizer_text(variable.value));
    if (const std::string range = range_text(variable); !range.empty()) {
      line += fmt::format("  [{}]", range);
    }
    if (!variable.description.empty()) line += "  " + variable.description;
    text += printable(line) + "\n";
  }
  return text;
}

Json json_of(const CustomizerValue& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

const char* type_of(const CustomizerValue& value) {
  constexpr const char* kNames[] = {"boolean", "number", "text", "vector"};
  static_assert(std::size(kNames) == std::variant_size_v<CustomizerValue>);
  return kNames[value.index()];
}

std::string describe_json(const std::vector<CustomizerVariable>& variables) {
  Json all = Json::array();
  for (const CustomizerVariable& variable : variables) {
    Json json = {{"name", variable.name},
                 {"group", variable.group},
                 {"description", variable.description},
                 {"line", variable.line},
                 {"type", type_of(variable.value)},
                 {"value", json_of(variable.value)}};
    if (variable.least) json["min"] = *variable.least;
    if (variable.most) json["max"] = *variable.most;
    if (variable.step) json["step"] = *variable.step;
    if (variable.most_characters) json["max_length"] = *variable.most_characters;
    for (const CustomizerChoice& choice : variable.choices) {
      json["choices"].push_back({{"value", json_of(choice.value)}, {"label", choice.label}});
    }
    all.push_back(std::move(json));
  }
  const Json root = {{"variables", std::move(all)}};
  return root.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

int params_command(Arguments arguments) {
  CommandLine line(kHelp);
  std::string file;
  bool wants_json = false;
  line.add_required("FILE", file);
  OptionGroup(line.app(), "Output").add_flag("--json", wants_json, "as JSON, one line");
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  const Result<std::string> text = read_text(file);
  if (!text) return report(text.error());
  const std::vector<CustomizerVariable> variables = read_customizer(*text);
  return print(wants_json ? describe_json(variables) : describe_text(variables));
}

}  // namespace whittle
