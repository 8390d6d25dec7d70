// Flat shapes as polygons, with OpenSCAD's number of fragments.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/affine.h"
#include "evaluate/budget.h"
#include "evaluate/files.h"
#include "flat/polygons.h"
#include "flat/text.h"
#include "model/document.h"
#include "model/warnings.h"

namespace whittle {

/// A map of the plane z = 0 as it is left of one of space: rows and columns x, y and 1 count.
Affine flat_map(const Affine& map);

Polygons transformed(const Affine& map, Polygons polygons);

/// True if they are not empty, and no corner is so far away that areas cannot be told.
bool is_measurable(const Polygons& polygons);

/// The corners of all contours.
uint64_t corner_count(const Polygons& polygons);
uint64_t corner_count(std::span<const Polygons> polygons);

/// The outline, if it is convex, strictly but for collinear corners: one contour,
/// counter-clockwise, without equal neighbours.
std::optional<Contour> convex_outline(const Polygons& polygons);

/// How many fragments OpenSCAD gives a curve of this radius; as it does in the version that is
/// chosen.
int fragment_count(double r, FragmentSettings settings, Curves curves);

/// A leaf that is flat. Spends the budget where it is large before it is made.
class FlatLeaves {
 public:
  FlatLeaves(Curves curves, Budget& budget, Files& files, Warnings& warnings)
      : curves_(curves), budget_(budget), files_(files), warnings_(warnings) {}

  Polygons polygons(const Leaf& leaf, SourceLocation where);

 private:
  Polygons operator()(const Square& square) const;
  Polygons operator()(const Circle& circle) const;
  Polygons operator()(const Polygon& polygon) const;
  Polygons text(const Text& text, SourceLocation where);

  Curves curves_;
  Budget& budget_;
  Files& files_;
  Warnings& warnings_;
  FontLibrary fonts_;
};

/// offset() of polygons. Spends the budget first.
Polygons offset_of(const Polygons& polygons, const Offset& how, Curves curves, Budget& budget);

/// The map of a resize() by the box of what it holds, sizes along x, y and z (0: flat).
Affine resize_map(const Resize& how, Vec3 size);

}  // namespace whittle
