// What kind of input a file is.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace whittle {

enum class InputKind {
  kCsg,    ///< the text is read as .csg
  kScad,   ///< openscad evaluates it
  kShape,  ///< a mesh or a drawing, read as by import()
};

/// The kind that a file's name asks for by its ending; upper and lower case count alike.
InputKind kind_of_input(std::string_view path);

/// If these bytes are neither .csg nor .scad text but something else that is known: what they are,
/// and what to do.
std::optional<std::string> describe_foreign(std::string_view bytes);

/// If these bytes are compressed, so that any file may be in them: likewise.
std::optional<std::string> describe_compressed(std::string_view bytes);

/// A string as it is written in .csg text, with its quotation marks.
std::string quoted_string(std::string_view text);

}  // namespace whittle
