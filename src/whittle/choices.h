// What can be chosen by name: one list of each, for the command line, its help, its messages, and
// the public API alike.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "image/draw_cells.h"
#include "image/shade.h"
#include "shape/fragments.h"
#include "subdivide/subdivide.h"
#include "trace/named_view.h"
#include "whittle/options.h"

namespace whittle {

/// What a PNG shows.
enum class Pass { kColor, kDepth, kNormal, kId };

enum class FileFormat { kPng, kExr };

/// Of several pictures.
enum class FilmFormat { kGif, kApng, kMp4, kWebm };

template <class T>
struct Choice {
  const char* name;
  T value;
};

template <class T>
using Choices = std::span<const Choice<T>>;

Choices<Backend> backend_choices();
Choices<Pass> pass_choices();
Choices<FileFormat> format_choices();
Choices<Style> style_choices();
Choices<Quality> quality_choices();
Choices<Curves> curves_choices();
/// What becomes of rotations printed with six digits; true: they are polished.
Choices<bool> matrices_choices();
Choices<SplitRule> split_choices();
Choices<ShaderCases> shaders_choices();
/// Whether cells behind others are left out.
Choices<bool> culling_choices();
/// OpenSCAD's words for --projection; true: orthographic.
Choices<bool> projection_choices();
/// Views by their names, for --from.
Choices<NamedView> named_view_choices();
/// What becomes of cells too small to split; true: they are ignored.
Choices<bool> small_cells_choices();
Choices<CellView> cell_view_choices();

/// The names of the choices, with `separator` between them.
template <class T>
std::string names_of(Choices<T> choices, std::string_view separator = ", ") {
  std::string names;
  for (const Choice<T>& choice : choices) {
    if (!names.empty()) names += separator;
    names += choice.name;
  }
  return names;
}

/// The value of that name; else a kUsage error that says what there is. `what` is what is chosen,
/// as in "style".
template <class T>
Result<T> choose(Choices<T> choices, std::string_view what, std::string_view name) {
  for (const Choice<T>& choice : choices) {
    if (name == choice.name) return choice.value;
  }
  return Error{ErrorKind::kUsage, "unknown " + std::string(what) + " '" + std::string(name) +
                                      "'; there are: " + names_of(choices)};
}

/// The name of a value that is among the choices.
template <class T>
const char* name_of(Choices<T> choices, T value) {
  for (const Choice<T>& choice : choices) {
    if (value == choice.value) return choice.name;
  }
  return "";
}

}  // namespace whittle
