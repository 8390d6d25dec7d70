// How many facets OpenSCAD gives a curve, and where their corners are.
//
// The facts are OpenSCAD's (CurveDiscretizer, primitives.cc, degree_trig.cc), re-described.
#pragma once

#include <vector>

#include "base/vec.h"
#include "whittle/options.h"

namespace whittle {

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

/// The corners of OpenSCAD's circle of radius 1 and n fragments, the first on +x.
std::vector<Vec3> unit_circle(int n);

/// The directions of the middles of that circle's sides, the first between the first two corners.
std::vector<Vec3> side_middles(int n);

}  // namespace whittle
