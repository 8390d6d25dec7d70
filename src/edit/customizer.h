// The variables that a .scad file offers to be set, as OpenSCAD's customizer shows them: literals
// assigned at its top, and the comments beside them.
//
//     /* [Size] */
//     // of the hole
//     r = 5; // [1:0.5:20]
//
// The facts are those of OpenSCAD's manual ("Customizer"): only the lines before the first `{`
// count, and of each variable the last assignment; a description is the line above, from its first
// column on; what is under [Hidden] is not offered. A comment that says nothing that is understood
// says nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace whittle {

/// A value of a variable: a check box, a number, a text, or numbers.
using CustomizerValue = std::variant<bool, double, std::string, std::vector<double>>;

struct CustomizerChoice {
  CustomizerValue value;  ///< a number or a text
  std::string label;      ///< what is shown; the value itself if nothing is written
};

struct CustomizerVariable {
  std::string name;
  std::string description;  ///< may be empty
  std::string group;        ///< "Parameters" before the first heading; "Global" is for all
  CustomizerValue value;    ///< the one in the file
  std::optional<double> least, most, step;  ///< of a number, or each of several; step above 0
  std::optional<size_t> most_characters;    ///< of a text
  std::vector<CustomizerChoice> choices;    ///< empty: any value
  uint32_t line = 0;                        ///< from 1
};

/// The variables in the order of the file. Any text is understood: what is no assignment of a
/// literal is passed over. Linear in the text.
std::vector<CustomizerVariable> read_customizer(std::string_view scad);

/// A value in OpenSCAD's language.
std::string customizer_text(const CustomizerValue& value);

/// What openscad is told by `-D` so that the variable has the value: `name=value`.
std::string definition(const CustomizerVariable& variable, const CustomizerValue& value);

/// The same of all variables whose value is another than in the file. `values` are as many as
/// `variables`.
std::vector<std::string> definitions(const std::vector<CustomizerVariable>& variables,
                                     const std::vector<CustomizerValue>& values);

}  // namespace whittle
