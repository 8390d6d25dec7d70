// whittle edit FILE.csg --set LINE:COLUMN.PARAMETER=VALUE: a value in a text, all else left as it
// is.
#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands.h"
#include "console.h"
#include "csg/argument_places.h"
#include "csg/lexer.h"
#include "edit/parameters.h"
#include "edit/source_document.h"
#include "host/input_file.h"
#include "option_group.h"
#include "whittle/output.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle edit", "Changes values in a .csg file and leaves every other byte as it is.",
    "FILE --set PLACE=VALUE [options]",
    "PLACE is LINE:COLUMN.PARAMETER, where the statement's name stands in FILE (as\n"
    "whittle pick says) and what it is of it; r, size[0], m[1][3], $fn.\n"
    "VALUE is a number, or any value that stands in a .csg; of an element a number.\n\n"
    "Examples:\n"
    "  whittle edit part.csg --set 3:5.r=2.5 -o part.csg\n"
    "  whittle edit part.csg --set '7:2.size[2]=10' --set '7:2.center=true' | whittle - -o a.png\n"
    "\n"
    "Exit codes: 0 done, 1 bad input or no such place, 2 bad usage, 3 refused by the\n"
    "machine."};

struct Setting {
  std::string written;
  SourceLocation where;
  NumberPlace place;
  std::string value;
};

/// A number at the start of the text, which is taken away.
template <class T>
bool take_number(std::string_view& text, T& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(size_t(end - text.data()));
  return true;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

bool take_place(std::string_view& text, Setting& setting) {
  if (!take_number(text, setting.where.line) || !take(text, ':') ||
      !take_number(text, setting.where.column) || !take(text, '.')) {
    return false;
  }
  setting.place.parameter = CsgLexer(text).identifier();
  text.remove_prefix(setting.place.parameter.size());
  while (take(text, '[')) {
    if (!take_number(text, setting.place.indices.emplace_back()) || !take(text, ']')) return false;
  }
  return !setting.place.parameter.empty() && take(text, '=');
}

Setting parse_setting(const std::string& text) {
  Setting setting{.written = text, .where = {}, .place = {}, .value = {}};
  std::string_view rest = text;
  if (!take_place(rest, setting)) {
    refuse("--set", fmt::format("wants LINE:COLUMN.PARAMETER=VALUE, not {}", text));
  }
  if (!is_value(rest)) refuse("--set", fmt::format("{} is not a value", rest));
  setting.value = rest;
  if (!setting.place.indices.empty()) {
    setting.value = number_text(parse_number("--set", setting.value));
  }
  return setting;
}

Error at(const std::string& file, SourceLocation where, const std::string& message) {
  return {ErrorKind::kInput, message_at(file, where, "error: " + message)};
}

/// Applies the settings, whose places are all those of the text as it was read.
Status apply(const std::vector<Setting>& settings, const std::string& file,
             SourceDocument& document) {
  std::vector<uint32_t> nodes;
  for (const Setting& setting : settings) {
    const std::optional<uint32_t> node = document.find(setting.where);
    if (!node) return at(file, setting.where, "no statement begins here");
    nodes.push_back(*node);
  }
  for (size_t i = 0; i < settings.size(); ++i) {
    const Setting& setting = settings[i];
    const Result<uint32_t> done =
        setting.place.indices.empty()
            ? set_value(document, nodes[i], setting.place.parameter, setting.value)
            : set_number(document, nodes[i], setting.place, parse_number("--set", setting.value));
    if (!done) return at(file, setting.where, done.error().message);
  }
  return Done{};
}

}  // namespace

int edit_command(Arguments arguments) {
  CommandLine line(kHelp);
  std::string file, output = "-";
  std::vector<Setting> settings;
  line.add_required("FILE", file);
  OptionGroup group(line.app(), "Edits");
  group.add_each("--set", "PLACE=VALUE", "gives a parameter a value; and --set again for more",
                 [&](const std::string& text) { settings.push_back(parse_setting(text)); });
  group.add_text("-o", "OUT", "a file, which may be FILE; else standard output",
                 [&](const std::string& path) { output = path; });
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  if (settings.empty()) return report({ErrorKind::kUsage, "edit needs --set PLACE=VALUE"});

  Result<std::string> text = read_text(file);
  if (!text) return report(text.error());
  Result<SourceDocument> document = SourceDocument::open(std::move(*text), file);
  if (!document) return report(document.error());
  if (Status done = apply(settings, file, *document); !done) return report(done.error());
  const Status written = write_output(output, document->text());
  return written ? kExitDone : report(written.error());
}

}  // namespace whittle
