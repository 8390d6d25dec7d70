#include "option_group.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include "console.h"

namespace whittle {
namespace {

/// The group of options that the help does not list. (An option without any group has no name in
/// CLI11's messages.)
constexpr const char* kUnlisted = "unlisted";

/// CLI11's help with our usage line.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) { column_width(33); }

  std::string make_usage(const CLI::App*, std::string) const override {
    return "\nUsage: " + usage_ + "\n";
  }
  std::string make_positionals(const CLI::App*) const override { return {}; }
  /// One empty line between groups, not two.
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    std::string help = CLI::Formatter::make_help(app, std::move(name), mode);
    while (help.find("\n\n\n") != std::string::npos) {
      help = CLI::detail::find_and_replace(std::move(help), "\n\n\n", "\n\n");
    }
    return help;
  }
  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group == kUnlisted) return {};
    return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
  }
  /// Without what CLI11 says about types and multiplicity: our descriptions do.
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0) return {};
    return " " + option->get_type_name();
  }

 private:
  std::string usage_;
};

/// `--flag value` as `--flag=value`, and `--flag` alone as `--flag=true`.
std::vector<std::string> join_loose_flags(Arguments arguments,
                                          const std::vector<std::string>& flags) {
  std::vector<std::string> words(arguments.begin(), arguments.end());
  for (size_t i = 0; i < words.size(); ++i) {
    if (std::ranges::find(flags, words[i]) == flags.end()) continue;
    const std::string next = i + 1 < words.size() ? words[i + 1] : "";
    const bool is_value = !next.empty() && !next.starts_with('-') &&
                          next.find_first_of("./") == std::string::npos &&
                          ::access(next.c_str(), F_OK) != 0;
    words[i] += '=' + (is_value ? next : "true");
    if (!is_value) continue;
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  }
  return words;
}

}  // namespace

CommandLine::CommandLine(const CommandHelp& help) : app_(std::make_unique<CLI::App>()) {
  app_->name(help.name);
  app_->description(help.description);
  app_->footer(help.footer);
  app_->formatter(std::make_shared<HelpFormatter>(std::string(help.name) + " " + help.usage));
}

CommandLine::~CommandLine() = default;

void CommandLine::add_required(const char* name, std::string& word) {
  app_->add_option(name, word)->required();
}

void CommandLine::add_required(const char* name, std::vector<std::string>& words) {
  app_->add_option(name, words)->required();
}

void CommandLine::add_words(const char* name, std::vector<std::string>& words) {
  app_->add_option(name, words);
}

void CommandLine::add_optional(const char* name,
                               const std::function<void(const std::string&)>& set) {
  app_->add_option_function<std::string>(name, set);
}

void CommandLine::add_version(const char* version) {
  app_->set_version_flag("-v,--version", version, "say the version and stop")->group("Other");
}

void CommandLine::add_loose_flag(const char* name,
                                 const std::function<void(const std::string&)>& set) {
  loose_flags_.emplace_back(name);
  app_->add_option_function<std::string>(name, set)
      ->type_name("VALUE")
      ->group(kUnlisted)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

std::optional<int> CommandLine::parse(Arguments arguments) {
  // Added last, so that it comes last in the help.
  app_->set_help_flag("-h,--help", "say this and stop")->group("Other");
  // CLI11 takes them last first.
  std::vector<std::string> words = join_loose_flags(arguments, loose_flags_);
  std::ranges::reverse(words);
  try {
    app_->parse(std::move(words));
    return std::nullopt;
  } catch (const CLI::CallForHelp&) {
    return print(app_->help());
  } catch (const CLI::CallForVersion& version) {
    return print(std::string(version.what()) + "\n");
  } catch (const CLI::ParseError& mistake) {
    const int code = report({ErrorKind::kUsage, mistake.what()});
    say(fmt::format("Try '{} --help'.", app_->get_name()));
    return code;
  }
}

std::string to_lower(std::string text) {
  return CLI::detail::to_lower(std::move(text));
}

void answer(const std::string& text) {
  throw CLI::CallForVersion(text, 0);
}

void refuse(const char* option, const std::string& why) {
  throw CLI::ValidationError(option, why);
}

std::vector<double> parse_numbers(const char* option, std::string_view text, size_t count) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const size_t comma = rest.find(',');
    std::string_view word = rest.substr(0, comma);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      refuse(option, fmt::format("'{}' is not a number", word));
    }
    numbers.push_back(value);
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (numbers.size() != count) {
    refuse(option, fmt::format("wants {} number{}, not {} ('{}')", count, count == 1 ? "" : "s",
                               numbers.size(), text));
  }
  return numbers;
}

double parse_number(const char* option, std::string_view text) {
  return parse_numbers(option, text, 1)[0];
}

int64_t parse_count(const char* option, std::string_view text, int64_t least, int64_t most) {
  const double number = parse_number(option, text);
  if (number != std::floor(number) || number < double(least) || number > double(most)) {
    refuse(option, fmt::format("wants a whole number, {} to {}, not {}", least, most, text));
  }
  return int64_t(number);
}

OptionGroup::OptionGroup(CLI::App& app, const char* heading)
    : app_(app), heading_(*heading == '\0' ? kUnlisted : heading) {}

void OptionGroup::add_flag(const char* names, bool& given, const char* description) {
  app_.add_flag(names, given, description)->group(heading_);
}

void OptionGroup::add_flag(const char* names, const std::function<void()>& given,
                           const char* description) {
  app_.add_flag_callback(names, given, description)->group(heading_);
}

void OptionGroup::add_text(const char* name, const char* value, const std::string& description,
                           const std::function<void(const std::string&)>& set) {
  app_.add_option_function<std::string>(name, set, description)
      ->type_name(value)
      ->group(heading_)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void OptionGroup::add_each(const char* name, const char* value, const std::string& description,
                           const std::function<void(const std::string&)>& take) {
  app_.add_option_function<std::vector<std::string>>(
          name,
          [take](const std::vector<std::string>& all) {
            for (const std::string& one : all) take(one);
          },
          description)
      ->allow_extra_args(false)
      ->type_name(value)
      ->group(heading_);
}

void OptionGroup::add_number(const char* name, const char* value, double& number, double least,
                             double most, const std::string& description) {
  add_text(name, value, description, [=, &number](const std::string& text) {
    number = parse_number(name, text);
    if (number < least || number > most) {
      refuse(name, std::isinf(most)
                       ? fmt::format("wants a number from {} on, not {}", least, text)
                       : fmt::format("wants a number, {} to {}, not {}", least, most, text));
    }
  });
}

}  // namespace whittle
