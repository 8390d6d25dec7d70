// From a model to the boundary of its solid, and to the files that hold one.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "boundary/evaluate_solid.h"
#include "boundary/write_solid.h"
#include "model/model.h"
#include "shape/fragments.h"
#include "whittle/choices.h"

namespace whittle {

/// By OpenSCAD's names for --export-format.
Choices<SolidFormat> solid_format_choices();

/// The format that a file name asks for by its ending (upper and lower case count alike), if it is
/// one of these.
std::optional<SolidFormat> solid_format_of(std::string_view path);

/// The curves of a solid's files, where these were chosen: OpenSCAD's facets, unless true curves
/// were asked for, which no such file can hold.
constexpr Curves curves_of_solid(Curves chosen) {
  return chosen == Curves::kSmooth ? chosen : Curves::kOpenscad2021;
}

/// The boundary of a model's solid, on so many threads (0: all). A kInput error, with the file's
/// name, if there is none: the model is flat, empty, without end, or has true curves.
Result<SolidMesh> solid_of(const Model& model, int threads, BoundaryStats* stats = nullptr);

}  // namespace whittle
