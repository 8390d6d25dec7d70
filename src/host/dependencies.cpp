#include "host/dependencies.h"

#include <algorithm>

namespace whittle {
namespace {

std::string escaped(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (c == ' ' || c == '#') text += '\\';
    if (c == '$') text += '$';
    text += c;
  }
  return text;
}

}  // namespace

std::vector<std::string> read_dependencies(std::string_view text) {
  std::vector<std::string> files;
  while (!text.empty()) {
    const size_t newline = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, newline);
    text.remove_prefix(std::min(newline + 1, text.size()));
    if (!line.starts_with('\t')) continue;
    line.remove_prefix(1);
    if (line.ends_with(" \\")) line.remove_suffix(2);
    std::string file;
    for (size_t i = 0; i < line.size(); ++i) {
      // openscad escapes blanks, and nothing else.
      if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == ' ') continue;
      file += line[i];
    }
    if (!file.empty()) files.push_back(std::move(file));
  }
  return files;
}

std::string write_dependencies(std::span<const std::string> targets,
                               std::span<const std::string> files) {
  std::string text;
  for (const std::string& target : targets) {
    if (!text.empty()) text += ' ';
    text += escaped(target);
  }
  text += ':';
  for (const std::string& file : files) text += " \\\n\t" + escaped(file);
  return text + '\n';
}

}  // namespace whittle
