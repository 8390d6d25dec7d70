// Measures and random shapes for the tests of flat shapes.
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "flat/polygons.h"
#include "shape/triangle_mesh.h"

namespace whittle {

inline double area(const Contour& contour) {
  double twice = 0;
  for (size_t i = 0; i < contour.size(); ++i)
    twice += cross(contour[i] - contour[0], contour[(i + 1) % contour.size()] - contour[0]);
  return twice / 2;
}

inline double area(const Polygons& polygons) {
  double total = 0;
  for (const Contour& contour : polygons.contours) total += area(contour);
  return total;
}

inline Polygons box(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}};
}

/// Whether every edge is run through as often one way as the other.
inline bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangle.corners[k], b = triangle.corners[(k + 1) % 3];
      if (a == b || a >= mesh.points.size() || b >= mesh.points.size()) return false;
      if (a < b)
        ++balance[{a, b}];
      else
        --balance[{b, a}];
    }
  }
  for (const auto& [edge, count] : balance)
    if (count != 0) return false;
  return true;
}

/// A closed line of random corners, which as a rule crosses itself. On a grid corners meet and
/// edges lie on one another.
inline rc::Gen<Contour> random_contour(int most_corners, int extent, double step) {
  return rc::gen::map(rc::gen::mapcat(rc::gen::inRange(3, most_corners + 1),
                                      [=](int n) {
                                        return rc::gen::container<std::vector<std::pair<int, int>>>(
                                            size_t(n),
                                            rc::gen::pair(rc::gen::inRange(-extent, extent + 1),
                                                          rc::gen::inRange(-extent, extent + 1)));
                                      }),
                      [=](const std::vector<std::pair<int, int>>& corners) {
                        Contour contour;
                        for (const auto& [x, y] : corners) contour.push_back({x * step, y * step});
                        return contour;
                      });
}

}  // namespace whittle
