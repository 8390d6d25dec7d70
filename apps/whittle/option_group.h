// Options under one heading of a command's help, with values checked and refused in one way.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "whittle/choices.h"

namespace CLI {  // NOLINT(readability-identifier-naming): CLI11 has named it
class App;
}

namespace whittle {

/// Ends the reading of the command line: the value of `option` is not one.
[[noreturn]] void refuse(const char* option, const std::string& why);

/// `count` finite numbers separated by commas, or refuses.
std::vector<double> parse_numbers(const char* option, std::string_view text, size_t count);
/// One finite number.
double parse_number(const char* option, std::string_view text);
/// One whole number in an interval.
int64_t parse_count(const char* option, std::string_view text, int64_t least, int64_t most);

class OptionGroup {
 public:
  /// Both must outlive this object; the heading, the app too.
  OptionGroup(CLI::App& app, const char* heading) : app_(app), heading_(heading) {}

  void add_flag(const char* names, bool& given, const char* description);

  /// An option whose value `set` reads, and refuses if it must. If it is given more than once, the
  /// last value counts, so that scripts can add to the options that they are given.
  void add_text(const char* name, const char* value, const std::string& description,
                const std::function<void(const std::string&)>& set);

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
