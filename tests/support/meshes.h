// Closed meshes whose shape is known, for tests.
#pragma once

#include <cstdint>
#include <vector>

#include "base/box.h"
#include "model/model.h"

namespace whittle {

/// A box, each side cut into n * n squares of two triangles.
TriangleMesh box_mesh(const Box& box, int n);

/// A prism from z = 0 to h over a star with that many points, radii alternating.
TriangleMesh star_mesh(int points, double inner, double outer, double h);

/// A torus about the z axis, n times m quads, each of two triangles that lie in no common plane.
TriangleMesh torus_mesh(double major, double minor, int n, int m);

/// A ball whose points stray by up to `bump` of the radius, the same for the same seed.
TriangleMesh bumpy_mesh(double r, double bump, int n, uint32_t seed);

/// Every coordinate replaced, and the facets found anew.
TriangleMesh changed(const TriangleMesh& mesh, double (*coordinate)(double));

/// All of them, without cutting one by another.
TriangleMesh together(const std::vector<TriangleMesh>& meshes);

/// Turned inside out: with a larger one around it, it is a cavity.
TriangleMesh inside_out(TriangleMesh mesh);

/// The model of a text in which cubes of size n = 1, 2, ... stand for the meshes.
Model with_meshes(const char* text, const std::vector<TriangleMesh>& meshes);

}  // namespace whittle
