#include "shape/build_planes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "base/degrees.h"
#include "shape/shape.h"

namespace whittle {
namespace {

/// A box of the given size, faces clockwise from outside.
Polyhedron box(Vec3 s) {
  return {
      .points = {{0, 0, 0},
                 {s.x, 0, 0},
                 {s.x, s.y, 0},
                 {0, s.y, 0},
                 {0, 0, s.z},
                 {s.x, 0, s.z},
                 {s.x, s.y, s.z},
                 {0, s.y, s.z}},
      .faces = {{0, 1, 2, 3}, {4, 5, 1, 0}, {7, 6, 5, 4}, {5, 6, 2, 1}, {6, 7, 3, 2}, {7, 4, 0, 3}},
      .planes = {}};
}

Polyhedron triangulated(const Polyhedron& p) {
  Polyhedron r{.points = p.points, .faces = {}, .planes = {}};
  for (const auto& f : p.faces)
    for (size_t i = 2; i < f.size(); ++i) r.faces.push_back({f[0], f[i - 1], f[i]});
  return r;
}

void reverse_faces(Polyhedron& p) {
  for (auto& f : p.faces) std::ranges::reverse(f);
}

std::string refusal(Polyhedron& p) {
  return build_planes(p).refusal;
}

double farthest_outside(const std::vector<Plane>& planes, Vec3 p) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes) most = std::max(most, dot(plane.n, p) - plane.d);
  return most;
}

double six_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return std::strtod(text, nullptr);
}

TEST(BuildPlanes, BoxGetsItsSixExactPlanes) {
  Polyhedron p = box({1, 2, 3});
  EXPECT_EQ(refusal(p), "");
  EXPECT_EQ(p.planes.size(), 6u);
  EXPECT_EQ(farthest_outside(p.planes, {0.5, 1, 1.5}), -0.5);
  EXPECT_EQ(farthest_outside(p.planes, {1, 2, 3}), 0);
  EXPECT_EQ(farthest_outside(p.planes, {0.5, 1, 3.25}), 0.25);
}

TEST(BuildPlanes, InsideOutIsTurned) {
  Polyhedron p = box({1, 2, 3});
  reverse_faces(p);
  EXPECT_EQ(refusal(p), "");
  EXPECT_EQ(farthest_outside(p.planes, {0.5, 1, 1.5}), -0.5);
}

TEST(BuildPlanes, TrianglesOfOneFaceAreOnePlane) {
  Polyhedron p = triangulated(box({1, 2, 3}));
  EXPECT_EQ(refusal(p), "");
  EXPECT_EQ(p.planes.size(), 6u);
}

TEST(BuildPlanes, EqualPointsAreOne) {
  Polyhedron p = triangulated(box({1, 2, 3}));
  Polyhedron soup;
  for (const auto& f : p.faces) {
    soup.faces.emplace_back();
    for (const uint32_t i : f) {
      soup.faces.back().push_back(uint32_t(soup.points.size()));
      soup.points.push_back(p.points[i]);
    }
  }
  EXPECT_EQ(refusal(soup), "");
  EXPECT_EQ(soup.planes.size(), 6u);
}

TEST(BuildPlanes, ShortFacesAreDropped) {
  Polyhedron p = box({1, 1, 1});
  p.faces.push_back({0, 1});
  p.faces.push_back({});
  EXPECT_EQ(refusal(p), "");
  EXPECT_EQ(p.planes.size(), 6u);
}

TEST(BuildPlanes, NothingAndFlatAreEmptyWithoutComplaint) {
  Polyhedron nothing;
  EXPECT_EQ(refusal(nothing), "");
  EXPECT_TRUE(nothing.planes.empty());
  Polyhedron flat = box({1, 1, 0});
  EXPECT_EQ(refusal(flat), "");
  EXPECT_TRUE(flat.planes.empty());
  Polyhedron broken = box({1, 1, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(refusal(broken), "");
  EXPECT_TRUE(broken.planes.empty());
}

TEST(BuildPlanes, SaysWhatIsWrong) {
  const auto reason = [](Polyhedron p) {
    const std::string text = refusal(p);
    EXPECT_TRUE(p.planes.empty());
    return text;
  };
  Polyhedron far = box({1, 1, 1});
  far.faces[2][1] = 8;
  EXPECT_EQ(reason(far), "face 2 uses point 8, but the points are 0 to 7");

  Polyhedron open = box({1, 1, 1});
  open.faces.pop_back();
  EXPECT_NE(reason(open).find("not closed"), std::string::npos);

  Polyhedron mixed = box({1, 1, 1});
  std::ranges::reverse(mixed.faces[0]);
  EXPECT_NE(reason(mixed).find("not turned the same way"), std::string::npos);

  Polyhedron dented = triangulated(box({1, 1, 1}));
  dented.points[0] = {0.9, 0.9, 0.9};
  EXPECT_NE(reason(dented).find("not convex"), std::string::npos);
}

// A cube with a corner pulled up has two faces that are not flat. Cut along the diagonals to that
// corner they would leave dents, cut along the others they do not.
TEST(BuildPlanes, FacesThatAreNotFlatAreCutSoThatTheSolidIsConvex) {
  for (const bool inside_out : {false, true}) {
    Polyhedron bent = box({1, 1, 1});
    bent.points[6].z = 1.3;
    if (inside_out) reverse_faces(bent);
    const Verdict verdict = build_planes(bent);
    EXPECT_EQ(verdict.refusal, "");
    EXPECT_TRUE(verdict.remark.starts_with("face 2 is not flat: point ")) << verdict.remark;
    EXPECT_EQ(bent.planes.size(), 7u);
    for (const Vec3 p : bent.points) EXPECT_LE(farthest_outside(bent.planes, p), 0);
    // In the middle of the top the diagonal from 5 to 7 stands at 1, that to 6 at 1.15.
    EXPECT_NEAR(farthest_outside(bent.planes, {0.5, 0.5, 1.15}), 0, 1e-12);
    EXPECT_GT(farthest_outside(bent.planes, {0.5, 0.5, 1.16}), 0);
    for (const auto& face : bent.faces)
      for (const uint32_t i : face) EXPECT_LT(i, 8u);
    EXPECT_EQ(bent.faces.size(), 7u);
  }
  // A hopper typed by hand.
  Polyhedron hopper = box({10, 10, 8});
  for (uint32_t i = 0; i < 4; ++i) hopper.points[i] = hopper.points[i] * 0.5 + Vec3{2.5, 2.5, 0};
  hopper.points[6].z = 8.01;
  const Verdict verdict = build_planes(hopper);
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_NE(verdict.remark, "");
  for (const Vec3 p : hopper.points) EXPECT_NEAR(farthest_outside(hopper.planes, p), 0, 1e-12);
}

TEST(BuildPlanes, BentFacesOfManyCornersAreCutToo) {
  // A prism of 20 sides whose top is bent up along its middle, as a roof is.
  constexpr uint32_t kSides = 20;
  Polyhedron p;
  p.faces.resize(2);
  for (uint32_t k = 0; k < kSides; ++k) {
    const double x = cos_degrees(360.0 * k / kSides + 9), y = sin_degrees(360.0 * k / kSides + 9);
    p.points.push_back({x, y, 0});
    p.points.push_back({x, y, 1 - 0.3 * y * y});
    p.faces[0].push_back(2 * k);
    p.faces[1].push_back(2 * (kSides - k) - 1);
    const uint32_t next = 2 * ((k + 1) % kSides);
    p.faces.push_back({2 * k, 2 * k + 1, next + 1, next});
  }
  const Verdict verdict = build_planes(p);
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_NE(verdict.remark, "");
  EXPECT_EQ(p.faces.size(), 1u + (kSides - 2) + kSides);
  for (const Vec3 q : p.points) EXPECT_NEAR(farthest_outside(p.planes, q), 0, 1e-12);
}

TEST(BuildPlanes, TwoSeparateBoxesAreNotConvex) {
  Polyhedron p = box({1, 1, 1});
  const Polyhedron other = box({1, 1, 1});
  for (const Vec3 q : other.points) p.points.push_back(q + Vec3{3, 0, 0});
  for (auto f : other.faces) {
    for (uint32_t& i : f) i += 8;
    p.faces.push_back(f);
  }
  EXPECT_NE(refusal(p).find("not convex"), std::string::npos);
}

TEST(BuildPlanes, SixDigitCornersAreAccepted) {
  // Facetted spheres as OpenSCAD would dump them: four-cornered faces, slivers next to the caps.
  EXPECT_TRUE(rc::check([] {
    const int n = *rc::gen::inRange(3, 40), rings = (n + 1) / 2;
    const double r = *rc::gen::inRange(100, 100000) / 777.0;
    const Vec3 shift = Vec3{1, 0.7, -0.3} * (*rc::gen::inRange(-1000, 1000) / 999.0 * r);
    Polyhedron p;
    for (const Vec3 v : outline(Sphere{.r = r, .facets = n})) {
      const Vec3 q = v + shift;
      p.points.push_back({six_digits(q.x), six_digits(q.y), six_digits(q.z)});
    }
    const auto at = [n](int ring, int k) { return uint32_t(ring * n + k % n); };
    p.faces.resize(2);
    for (int k = 0; k < n; ++k) {
      p.faces[0].push_back(at(0, n - k));
      p.faces[1].push_back(at(rings - 1, k));
      for (int i = 0; i + 1 < rings; ++i)
        p.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
    RC_ASSERT(refusal(p) == "");
    for (const Vec3 q : p.points) {
      RC_ASSERT(farthest_outside(p.planes, q) <= 0);
      RC_ASSERT(farthest_outside(p.planes, q) > -1e-4 * r);
    }
    RC_ASSERT(farthest_outside(p.planes, shift + Vec3{1.01, 0, 0} * r) > 0);
  }));
}

Vec3 six_digits(Vec3 p) {
  return {six_digits(p.x), six_digits(p.y), six_digits(p.z)};
}

/// Half a unit of the sixth digit, by printing rather than by logarithms.
double half_a_digit(double largest) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5e", largest);
  return 0.5 * std::pow(10, std::atoi(std::strchr(text, 'e') + 1) - 5);
}

double some(double lo, double hi) {
  return lo + (hi - lo) * (*rc::gen::inRange(0, 1'000'001)) * 1e-6;
}

/// A frustum of n sides, or an octahedron-like solid of triangles; convex, of size 10 or so.
Polyhedron some_convex_solid() {
  const uint32_t n = *rc::gen::inRange(3u, 9u);
  const bool is_frustum = *rc::gen::arbitrary<bool>();
  const double start = some(0, 360), squeeze = some(0.3, 1), top = some(0.3, 1.5);
  Polyhedron p;
  for (const int level : {0, 1}) {
    if (!is_frustum && level == 1) break;
    for (uint32_t k = 0; k < n; ++k) {
      const double a = start + 360 * (k + some(-0.15, 0.15)) / n;
      p.points.push_back(Vec3{cos_degrees(a) * 6, sin_degrees(a) * 6 * squeeze, 0});
    }
    if (level == 1)
      for (uint32_t k = 0; k < n; ++k) p.points[n + k] = p.points[k] * top + Vec3{2, 1, 9};
  }
  if (is_frustum) {
    p.faces.resize(2);
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t next = (k + 1) % n;
      p.faces[0].push_back(k);
      p.faces[1].push_back(2 * n - 1 - k);
      p.faces.push_back({k, n + k, n + next, next});
    }
  } else {
    p.points.push_back({some(-0.2, 0.2), some(-0.2, 0.2) * squeeze, some(3, 8)});
    p.points.push_back({some(-0.2, 0.2), some(-0.2, 0.2) * squeeze, some(-8, -3)});
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t next = (k + 1) % n;
      p.faces.push_back({k, n, next});
      p.faces.push_back({next, n + 1, k});
    }
  }
  return p;
}

Affine some_place() {
  constexpr double kOffsets[] = {0, 0, 7, 101, 150, 300, 812, 2500, 10000};
  Affine map;
  for (const int axis : {0, 1, 2}) {
    const double c = cos_degrees(some(0, 360)), s = sin_degrees(some(0, 360)),
                 l = std::hypot(c, s) + 1e-9;
    Affine turn;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    turn.row[u] = turn.row[v] = {};
    turn.row[u][u] = turn.row[v][v] = c / l;
    turn.row[u][v] = -s / l;
    turn.row[v][u] = s / l;
    map = turn * map;
  }
  const double offset = kOffsets[*rc::gen::inRange(0, 9)];
  map.translation = Vec3{some(-1, 1), some(-1, 1), some(-1, 1)} * offset;
  return map;
}

TEST(BuildPlanes, ConvexSolidsAreAcceptedWhereverTheyStand) {
  EXPECT_TRUE(rc::check([] {
    const Polyhedron exact = some_convex_solid();
    const Affine map = some_place();
    Polyhedron p = exact;
    Vec3 largest;
    for (Vec3& q : p.points) {
      q = six_digits(map.point(q));
      for (int i = 0; i < 3; ++i) largest[i] = std::max(largest[i], std::fabs(q[i]));
    }
    Box box;
    for (const Vec3 q : p.points) box.include(q);
    const double e = std::max(
        5e-6 * box.diagonal(),
        length(Vec3{half_a_digit(largest.x), half_a_digit(largest.y), half_a_digit(largest.z)}));
    const std::vector<std::vector<uint32_t>> faces = p.faces;
    const Verdict verdict = build_planes(p);
    RC_ASSERT(verdict.refusal == "");
    RC_ASSERT(p.faces == faces);
    for (size_t i = 0; i < p.points.size(); ++i) {
      RC_ASSERT(farthest_outside(p.planes, p.points[i]) <= 0);
      RC_ASSERT(farthest_outside(p.planes, map.point(exact.points[i])) <= e);
    }
    // Every face lies at some plane, no farther off than its corners' error can have turned it.
    for (const auto& face : faces) {
      Vec3 area;
      double across = 0;
      const size_t n = face.size();
      for (size_t k = 0; k < n; ++k) {
        const Vec3 a = p.points[face[k]], b = p.points[face[(k + 1) % n]];
        area += cross(a - box.center(), b - box.center());
        across += length(p.points[face[(k + 2) % n]] - a);
      }
      const double most = e * (6 + across / length(area) * box.diagonal());
      double nearest = kInfinity;
      for (const Plane& plane : p.planes) {
        double depth = 0;
        for (const uint32_t i : face) depth = std::max(depth, plane.d - dot(plane.n, p.points[i]));
        nearest = std::min(nearest, depth);
      }
      RC_ASSERT(nearest <= most);
    }
  }));
}

// What six digits leave of a frustum of 12 mm that stands near 100.
TEST(BuildPlanes, AFrustumAHundredAwayIsAccepted) {
  Polyhedron p{
      .points = {{96.6236, 105.206, 107.562},
                 {96.3801, 99.138, 98.9385},
                 {106.369, 98.7461, 98.3815},
                 {106.495, 104.243, 106.193},
                 {98.593, 100.905, 107.532},
                 {98.4591, 97.568, 102.789},
                 {103.953, 97.3525, 102.483},
                 {104.022, 100.376, 106.779}},
      .faces = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}},
      .planes = {}};
  const Verdict verdict = build_planes(p);
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_EQ(verdict.remark, "");
  EXPECT_EQ(p.planes.size(), 6u);
  for (const Vec3 q : p.points) EXPECT_NEAR(farthest_outside(p.planes, q), 0, 3e-3);
}

TEST(BuildPlanes, ADentThatSixDigitsCannotHideIsFoundFarAwayToo) {
  for (const double offset : {0.0, 100.0, 1000.0}) {
    Polyhedron p = box({10, 10, 10});
    p.points.push_back({5, 5, 9.5});
    p.faces[2] = {7, 6, 8};
    p.faces.push_back({6, 5, 8});
    p.faces.push_back({5, 4, 8});
    p.faces.push_back({4, 7, 8});
    for (Vec3& q : p.points) q += Vec3{1, 1, 1} * offset;
    EXPECT_NE(refusal(p).find("not convex"), std::string::npos) << offset;
  }
}

// Where six digits are coarse, a solid that they may have dented is taken as convex, and that is
// said; one whose faces are flat is exact, and nothing is said.
TEST(BuildPlanes, WhatSixDigitsLeaveUncertainIsSaid) {
  Polyhedron p = box({10, 10, 10});
  for (Vec3& q : p.points) q += Vec3{1e4, 1e4, 1e4};
  Polyhedron dented = triangulated(p);
  EXPECT_EQ(build_planes(p).remark, "");
  EXPECT_EQ(p.rise, 0);
  dented.points[6] -= Vec3{0.1, 0.1, 0.1};
  const Verdict verdict = build_planes(dented);
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_TRUE(verdict.remark.starts_with("six digits so far")) << verdict.remark;
  EXPECT_GT(dented.rise, 0.05);
}

/// A solid of revolution, cut into triangles as programs that export meshes do: `profile` holds
/// radii and heights from the top down.
Polyhedron turned(const std::vector<std::pair<double, double>>& profile, uint32_t n) {
  Polyhedron p;
  for (const auto& [r, z] : profile)
    for (uint32_t k = 0; k < n; ++k)
      p.points.push_back({six_digits(r * cos_degrees(360.0 * k / n)),
                          six_digits(r * sin_degrees(360.0 * k / n)), six_digits(z)});
  const auto at = [n](size_t ring, uint32_t k) { return uint32_t(ring * n + k % n); };
  for (uint32_t k = 0; k < n; ++k)
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
      p.faces.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      p.faces.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  for (uint32_t k = 1; k + 1 < n; ++k) {
    p.faces.push_back({at(0, 0), at(0, k + 1), at(0, k)});
    p.faces.push_back(
        {at(profile.size() - 1, 0), at(profile.size() - 1, k), at(profile.size() - 1, k + 1)});
  }
  return p;
}

std::vector<std::pair<double, double>> ball_profile(int rings) {
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i < rings; ++i)
    profile.emplace_back(10 * sin_degrees(180 * (i + 0.5) / rings),
                         10 * cos_degrees(180 * (i + 0.5) / rings));
  return profile;
}

TEST(BuildPlanes, EveryPlaneSupportsTheCornersOfALargeMesh) {
  Polyhedron p = turned(ball_profile(50), 100);
  ASSERT_EQ(refusal(p), "");
  // Two caps, and 49 bands of 100 flat quadrangles.
  EXPECT_EQ(p.planes.size(), 2u + 49 * 100);
  for (const Plane& plane : p.planes) {
    double support = -std::numeric_limits<double>::infinity();
    for (const Vec3 q : p.points) support = std::max(support, dot(plane.n, q));
    ASSERT_EQ(plane.d, support);
  }
}

TEST(BuildPlanes, AHundredThousandFacesAreNoTrouble) {
  Polyhedron p = turned(ball_profile(159), 318);
  ASSERT_GT(p.faces.size(), 100'000u);
  ASSERT_EQ(refusal(p), "");
  EXPECT_NEAR(farthest_outside(p.planes, {0, 0, 0}), -10, 1e-2);
  EXPECT_GT(farthest_outside(p.planes, {10.01, 0, 0}), 0);
}

TEST(BuildPlanes, ADentInALargeMeshIsFoundWhereverItIs) {
  const std::vector<std::pair<double, double>> profile = ball_profile(20);
  for (size_t ring = 1; ring + 1 < profile.size(); ring += 3) {
    auto dented = profile;
    dented[ring].first *= 0.98;
    dented[ring].second *= 0.98;
    Polyhedron p = turned(dented, 60);
    EXPECT_NE(refusal(p).find("not convex"), std::string::npos) << ring;
    EXPECT_TRUE(p.planes.empty());
  }
  // Convex where its faces meet, but not as a whole: it goes round twice.
  std::vector<std::pair<double, double>> twice;
  for (const int z : {1, -1}) twice.emplace_back(10, z);
  Polyhedron star = turned(twice, 7);
  for (uint32_t ring = 0; ring < 2; ++ring)
    for (uint32_t k = 0; k < 7; ++k) {
      star.points[ring * 7 + k].x = 10 * cos_degrees(720.0 * k / 7);
      star.points[ring * 7 + k].y = 10 * sin_degrees(720.0 * k / 7);
    }
  EXPECT_NE(refusal(star).find("not convex"), std::string::npos);
}

TEST(BuildPlanes, DentsAllOverAreToldBeforeEdgesAreLookedAt) {
  // A waist, and a face is missing.
  Polyhedron p = turned({{10, 10}, {5, 0}, {10, -10}}, 100);
  p.faces.pop_back();
  EXPECT_NE(refusal(p).find("not convex"), std::string::npos);
  Polyhedron barrel = turned({{5, 10}, {10, 0}, {5, -10}}, 100);
  barrel.faces.pop_back();
  EXPECT_NE(refusal(barrel).find("not closed"), std::string::npos);
}

/// The top of a large box cut into triangles that meet in a point close to one edge of it.
Polyhedron box_with_sliver(double height_of_point) {
  Polyhedron p = box({100, 100, 10});
  p.points.push_back({50, 99.99, height_of_point});
  p.faces[2] = {7, 6, 8};
  p.faces.push_back({6, 5, 8});
  p.faces.push_back({5, 4, 8});
  p.faces.push_back({4, 7, 8});
  return p;
}

TEST(BuildPlanes, ANeedleKeepsItsSides) {
  // They are nearer to one another than the sixth digit of its length.
  Polyhedron needle{.points = {{1, 4, 1e6}, {6, 0, 0}, {0, -2, 0}, {0, 0, 7}},
                    .faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}},
                    .planes = {}};
  EXPECT_EQ(refusal(needle), "");
  EXPECT_EQ(needle.planes.size(), 4u);
}

TEST(BuildPlanes, SliverInALargeFaceGoesWithIt) {
  Polyhedron p = box_with_sliver(10.0001);
  EXPECT_EQ(refusal(p), "");
  EXPECT_EQ(p.planes.size(), 6u);
}

TEST(BuildPlanes, SliverOfUncertainDirectionDoesNotCut) {
  // A dent of seven in the sixth digit, less than what is forgiven, tilts the sliver by four
  // degrees; taken at its word it would cut seven units off the other side.
  Polyhedron p = box_with_sliver(9.9993);
  EXPECT_EQ(refusal(p), "");
  for (const Vec3 corner : p.points) EXPECT_LE(farthest_outside(p.planes, corner), 0);
  EXPECT_NEAR(farthest_outside(p.planes, {50, 50, 10.5}), 0.5, 2e-3);
}

}  // namespace
}  // namespace whittle
