// Sections of a solid across z.
#pragma once

#include <cstdint>
#include <vector>

#include "boundary/solid_mesh.h"
#include "flat/polygons.h"

namespace whittle {

/// Cuts a mesh at any height, from any number of threads. A cut takes time for the triangles that
/// it meets, and little for the others.
class Slicer {
 public:
  /// The mesh must be closed (solid_mesh.h) and outlive this object.
  explicit Slicer(const SolidMesh& mesh);

  /// The loops around the material just above z: what ends in that plane is not in the section,
  /// what begins in it is. Corners that are off it by no more than rounding, 10^-12 of the largest
  /// coordinate, are in it. Seen from above, loops are counter-clockwise and holes clockwise. They
  /// are joined by edges of the mesh, whatever the coordinates, and each has three corners or more.
  /// A face gives one side wherever it is in one part.
  std::vector<Contour> at(double z) const;

 private:
  /// Those with corners up to that height and above it.
  std::vector<uint32_t> crossed(double z) const;
  bool is_below(uint32_t corner, double z) const { return mesh_.corners[corner].z <= z; }

  const SolidMesh& mesh_;
  double rounding_ = 0;              ///< how far a corner may be from where it is meant
  std::vector<uint32_t> triangles_;  ///< by their lowest corner; without those that are level
  std::vector<double> lowest_;       ///< z, of every block of triangles
  std::vector<double> highest_;      ///< a tree of maxima over blocks: 1 is its root, 2i and 2i+1
                                     ///< are below i
};

}  // namespace whittle
