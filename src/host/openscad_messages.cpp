#include "host/openscad_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace whittle {
namespace {

/// The place that a message of openscad's ends with, ` in file NAME, line NUMBER`, as `file:line`,
/// and the message before it; the file's own name where it names none.
struct Said {
  std::string place;
  std::string_view what;
};

Said split_place(std::string_view message, const std::string& path, const std::string& source,
                 size_t last_line) {
  constexpr std::string_view kFile = " in file ", kLine = ", line ";
  const size_t file = message.rfind(kFile), line = message.rfind(kLine);
  if (file == std::string_view::npos || line == std::string_view::npos ||
      line < file + kFile.size()) {
    return {path, message};
  }
  const std::string_view digits = message.substr(line + kLine.size());
  size_t number = 0;
  const char* const end = digits.data() + digits.size();
  if (const auto [rest, code] = std::from_chars(digits.data(), end, number);
      code != std::errc() || rest != end) {
    return {path, message};
  }
  const size_t name_start = file + kFile.size();
  const std::string_view name = message.substr(name_start, line - name_start);
  // openscad calls files as they are seen from the source's folder, and by where links lead.
  const bool is_source = name.empty() || name == source.substr(source.rfind('/') + 1);
  const std::string folder = name.starts_with('/') ? "" : path.substr(0, path.rfind('/') + 1);
  if (is_source) number = std::min(number, last_line);
  return {fmt::format("{}:{}", is_source ? path : fmt::format("{}{}", folder, name), number),
          message.substr(0, file)};
}

}  // namespace

std::string in_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c != '\n') {
      line += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    } else if (!line.empty() && !line.ends_with("; ")) {
      line += "; ";
    }
  }
  if (line.ends_with("; ")) line.resize(line.size() - 2);
  return line;
}

std::optional<Error> first_error(std::string_view messages, const std::string& path,
                                 const std::string& source, std::string_view source_text) {
  const size_t last_line = static_cast<size_t>(std::ranges::count(source_text, '\n')) +
                           size_t(!source_text.ends_with('\n'));
  constexpr std::string_view kMark = "ERROR: ";
  for (size_t start = 0; start < messages.size();) {
    const size_t end = std::min(messages.find('\n', start), messages.size());
    const std::string_view line = messages.substr(start, end - start);
    start = end + 1;
    if (!line.starts_with(kMark)) continue;
    const Said said = split_place(line.substr(kMark.size()), path, source, last_line);
    return Error{ErrorKind::kInput,
                 fmt::format("{}: error: openscad: {}", said.place, in_one_line(said.what))};
  }
  return std::nullopt;
}

std::string why_it_ended(std::string_view messages) {
  // A command line that it does not know is answered with all that it does know.
  return in_one_line(messages.substr(0, messages.find("\nUsage: ")));
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const size_t newline = std::min(text.find('\n'), text.size());
    if (newline > 0) lines.emplace_back(text.substr(0, newline));
    text.remove_prefix(std::min(newline + 1, text.size()));
  }
  return lines;
}

}  // namespace whittle
