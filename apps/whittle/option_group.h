// What a command can be told: its command line, and options under the headings of its help, with
// values checked and refused in one way. Only option_group.cpp sees CLI11, which takes the compiler
// ten times as long as a command itself.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "whittle/choices.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has named it
class App;
}

namespace whittle {

/// A command's name and what its --help says besides the options.
struct CommandHelp {
  const char* name;         ///< as in "whittle info"
  const char* description;  ///< first of all
  const char* usage;        ///< after the name
  const char* footer;       ///< examples and exit codes
};

/// What is added must outlive the command line.
class CommandLine {
 public:
  explicit CommandLine(const CommandHelp& help);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// For option groups.
  CLI::App& app() { return *app_; }

  /// A word that has no option's name before it, or several; words are taken in the order in which
  /// they are added.
  void add_required(const char* name, std::string& word);
  void add_required(const char* name, std::vector<std::string>& words);
  /// The same, of which there need be none.
  void add_words(const char* name, std::vector<std::string>& words);
  void add_optional(const char* name, const std::function<void(const std::string&)>& set);
  /// -v and --version.
  void add_version(const char* version);

  /// A flag whose value may also be the next word, as in openscad, if that is neither an option nor
  /// possibly a file.
  void add_loose_flag(const char* name, const std::function<void(const std::string&)>& set);

  /// Reads the command line. If that is the end of it (--help, or a mistake, which is then said),
  /// the exit code.
  std::optional<int> parse(Arguments arguments);

 private:
  std::unique_ptr<CLI::App> app_;
  std::vector<std::string> loose_flags_;
};

/// A to Z become a to z.
std::string to_lower(std::string text);

/// Ends the reading of the command line: the value of `option` is not one.
[[noreturn]] void refuse(const char* option, const std::string& why);

/// Ends the reading of the command line: this is what it asked for, and the answer is printed.
[[noreturn]] void answer(const std::string& text);

/// `count` finite numbers separated by commas, or refuses.
std::vector<double> parse_numbers(const char* option, std::string_view text, size_t count);
/// One finite number.
double parse_number(const char* option, std::string_view text);
/// One whole number in an interval.
int64_t parse_count(const char* option, std::string_view text, int64_t least, int64_t most);

class OptionGroup {
 public:
  /// Both must outlive this object; the heading, the app too. An empty heading keeps its options
  /// out of the help.
  OptionGroup(CLI::App& app, const char* heading);

  void add_flag(const char* names, bool& given, const char* description);
  void add_flag(const char* names, const std::function<void()>& given, const char* description);
  /// An option whose value `set` reads, and refuses if it must. If it is given more than once, the
  /// last value counts, so that scripts can add to the options that they are given.
  void add_text(const char* name, const char* value, const std::string& description,
                const std::function<void(const std::string&)>& set);

  /// An option that may be given several times; each value is read.
  void add_each(const char* name, const char* value, const std::string& description,
                const std::function<void(const std::string&)>& take);

  /// A number in an interval.
  void add_number(const char* name, const char* value, double& number, double least, double most,
                  const std::string& description);

  /// A whole number in an interval.
  template <class T>
  void add_count(const char* name, const char* value, T& count, T least, T most,
                 const std::string& description) {
    add_text(name, value, description, [=, &count](const std::string& text) {
      count = T(parse_count(name, text, int64_t(least), int64_t(most)));
    });
  }

  /// A value chosen by name; `{}` in the description stands for the names.
  template <class T, class Set>
  void add_choice(const char* name, Choices<T> choices, const char* what,
                  const std::string& description, const Set& set) {
    std::string shown = description;
    if (const size_t at = shown.find("{}"); at != std::string::npos) {
      shown.replace(at, 2, names_of(choices));
    }
    add_text(name, "NAME", shown, [=](const std::string& text) {
      const Result<T> chosen = choose(choices, what, text);
      if (!chosen) refuse(name, chosen.error().message);
      set(*chosen);
    });
  }

 private:
  CLI::App& app_;
  const char* heading_;
};

}  // namespace whittle
