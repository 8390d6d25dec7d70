// What reading takes from the stages behind it.
#pragma once

#include <functional>

#include "base/box.h"
#include "base/result.h"
#include "image/style.h"
#include "model/model.h"
#include "shape/fragments.h"
#include "shape/triangle_mesh.h"

namespace whittle {

/// The tight box of a solid (subdivide/solid_bounds.h); of one without end, or too large to be
/// lowered, its bounds. On so many threads (0: all).
Box tight_box(const Model& model, int threads);

/// tight_box() on so many threads, for ReadOptions::solid_box.
std::function<Box(const Model&)> box_maker(int threads);

/// The boundaries of solids (boundary/closed_mesh.h), for ReadOptions::closed_mesh, on so many
/// threads (0: all), which are started when the first is asked for. For one reader at a time.
std::function<Result<TriangleMesh>(const Model&, size_t& pieces)> mesh_maker(int threads);

/// The curves for pictures of that style, where these were chosen.
constexpr Curves curves_in_style(Style style, Curves chosen) {
  const bool is_openscads = style == Style::kOpenscad && chosen != Curves::kSmooth;
  return is_openscads ? Curves::kOpenscad2021 : chosen;
}

/// Whether drawings need their outlines for pictures with these curves.
constexpr bool has_outlines(Curves in_style) {
  return in_style == Curves::kOpenscad2021;
}

/// By id, where its statement stands in the text; nowhere for those that are not in the model.
std::vector<SourceLocation> statement_places(const Model& model);

}  // namespace whittle
