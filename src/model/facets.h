// Curves as OpenSCAD's polyhedra: how many facets, and exactly which.
//
// The facts are OpenSCAD's (CurveDiscretizer, primitives.cc, degree_trig.cc), re-described.
#pragma once

#include <vector>

#include "base/box.h"
#include "model/model.h"

namespace whittle {

/// What `--curves` and the style choose.
enum class Curves {
  kAuto,          ///< $fn > 0 asks for facets and gets them; $fn = 0 is a true curve
  kFacets,        ///< OpenSCAD's polyhedra everywhere
  kSmooth,        ///< true curves everywhere
  kOpenscad2021,  ///< kFacets as OpenSCAD 2021.01 has them: the fraction of $fn is cut off
};

/// OpenSCAD's special variables that rule the number of facets.
struct FragmentSettings {
  double fn = 0, fa = 12, fs = 2;  ///< $fn; $fa in degrees; $fs in model units
};

/// OpenSCAD's number of fragments of a full circle of radius r (>= 3), saturated at INT_MAX.
int fragments(double r, FragmentSettings settings);

/// The `facets` field for a curve of radius r: 0 for a true curve. More than kMaxFacets facets are
/// a true curve too: it lies closer to them than kRelativeTolerance, and no file can ask for
/// billions.
inline constexpr int kMaxFacets = 2048;
int choose_facets(double r, FragmentSettings settings, Curves curves);

/// cos and sin of an angle in degrees, exact at the multiples of 30 and 45 where they are known.
double cos_degrees(double degrees);
double sin_degrees(double degrees);

/// The facets of a facetted sphere or cylinder (facets >= 3), of a cube or of a polyhedron, as
/// outward planes in the shape's own coordinates. Precondition: not empty, and flat-faced.
std::vector<Plane> facet_planes(const Shape& shape);

/// The box of every facet under a map, in the order of facet_planes.
std::vector<Box> facet_boxes(const Shape& shape, const Affine& map);

/// The vertices of the same solids, for bounds.
std::vector<Vec3> facet_vertices(const Shape& shape);

/// True if the shape has only flat faces (so facet_planes applies); a half-space has one.
bool is_flat(const Shape& shape);

}  // namespace whittle
