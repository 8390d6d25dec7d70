#include "output_template.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

namespace whittle {
namespace {

/// Calls text(part) and word(name) for what a template is made of. False if a brace stays open.
template <class Text, class Word>
bool for_parts(std::string_view pattern, const Text& text, const Word& word) {
  while (!pattern.empty()) {
    const size_t brace = pattern.find('{');
    text(pattern.substr(0, brace));
    if (brace == std::string_view::npos) return true;
    pattern.remove_prefix(brace + 1);
    if (pattern.starts_with('{')) {
      text(pattern.substr(0, 1));
      pattern.remove_prefix(1);
      continue;
    }
    const size_t end = pattern.find('}');
    if (end == std::string_view::npos) return false;
    word(pattern.substr(0, end));
    pattern.remove_prefix(end + 1);
  }
  return true;
}

using FileNumber = std::pair<dev_t, ino_t>;

/// What names the same file, whatever the path; none if there is no such plain file.
std::optional<FileNumber> number_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileNumber{status.st_dev, status.st_ino};
}

/// The path without detours.
std::string whole_path(const std::string& path) {
  std::error_code unknown;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(path, unknown);
  return unknown ? path : whole.string();
}

}  // namespace

Result<std::string> fill_template(std::string_view pattern, const TemplateWords& words) {
  std::string filled, mistake;
  const auto blame = [&](const std::string& why) {
    if (mistake.empty()) mistake = why;
  };
  const bool is_closed = for_parts(
      pattern, [&](std::string_view text) { filled += text; },
      [&](std::string_view word) {
        if (word == "name") {
          filled += words.name;
        } else if (word == "n" || word == "view") {
          const std::optional<std::string>& value = word == "n" ? words.n : words.view;
          if (value) {
            filled += *value;
          } else {
            blame(word == "n"
                      ? "{n} is the number of a frame, and here is no frame of --animate or "
                        "--turntable"
                      : "{view} is the name of a view, and here is none of --from or --views");
          }
        } else {
          blame(fmt::format("there is no {{{}}}; there are {{name}}{}, and {{{{ is a brace", word,
                            words.n ? " and {n}"
                                    : ", with --animate or --turntable {n}, with --from or --views "
                                      "{view}"));
        }
      });
  if (!is_closed) blame("a brace is not closed; {{ is one that stands for itself");
  if (!mistake.empty()) return Error{ErrorKind::kUsage, fmt::format("'{}': {}", pattern, mistake)};
  return filled;
}

bool has_word(std::string_view pattern, std::string_view word) {
  bool found = false;
  for_parts(
      pattern, [](std::string_view) {}, [&](std::string_view w) { found |= w == word; });
  return found;
}

std::string template_name(const std::string& input) {
  return input == "-" ? "stdin" : std::filesystem::path(input).stem().string();
}

Status check_templates(const std::vector<std::string>& files,
                       const std::vector<OutputTemplate>& templates, bool moves, bool has_views) {
  const auto fill = [&](const OutputTemplate& output, const std::string& file) {
    TemplateWords words{template_name(file)};
    if (moves && output.has_frames) words.n = "00000";
    if (has_views && output.has_views) words.view = "front";
    return fill_template(output.pattern, words);
  };
  for (const OutputTemplate& output : templates) {
    const Result<std::string> path = fill(output, files[0]);
    if (!path) {
      return Error{ErrorKind::kUsage, fmt::format("{} {}", output.option, path.error().message)};
    }
    if (files.size() > 1 && !has_word(output.pattern, "name")) {
      return Error{ErrorKind::kUsage,
                   fmt::format("there are {} files and one {} {}; with {{name}} in it, as in "
                               "'{{name}}.png', each has its own",
                               files.size(), output.option, output.pattern)};
    }
  }
  if (files.size() == 1) return Done{};
  std::map<FileNumber, size_t> inputs;
  for (size_t i = 0; i < files.size(); ++i)
    if (const std::optional<FileNumber> number = number_of(files[i])) inputs.emplace(*number, i);
  std::map<std::string, size_t> taken;  ///< by an output's path the input that has it
  for (const OutputTemplate& output : templates) {
    for (size_t i = 0; i < files.size(); ++i) {
      const std::string path = *fill(output, files[i]);
      const auto [at, is_new] = taken.emplace(whole_path(path), i);
      if (!is_new && at->second != i) {
        return Error{ErrorKind::kUsage, fmt::format("{} and {} would both be written to {}",
                                                    files[at->second], files[i], path)};
      }
      const std::optional<FileNumber> number = number_of(path);
      const auto read = number ? inputs.find(*number) : inputs.end();
      if (read != inputs.end()) {
        return Error{ErrorKind::kUsage,
                     fmt::format("{} {} is a file that is read, {}, which would be lost",
                                 output.option, path, files[read->second])};
      }
    }
  }
  return Done{};
}

}  // namespace whittle
