// The table finds what looking at every earlier surface finds, in order and by the written rule
// (docs/conventions.md, Coincidence).
#include "lower/half_space_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "lower/primitive_faces.h"

namespace whittle {
namespace {

constexpr double kTolerance = 1e-6;

struct Random {
  std::mt19937_64 bits;
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(bits); }
  Vec3 vector() { return {unit(), unit(), unit()}; }
  /// Mostly little, sometimes much: 10 to the power of -most to 0.
  double small(double most) { return std::pow(10, -most * std::fabs(unit())); }
};

struct Surface {
  HalfSpace half_space;
  Reach reach;
  std::vector<Vec3> outline;
};

/// 0: different; 1: the same; -1: the complement.
int compare(const Surface& known, const Surface& later) {
  const double tolerance = std::min(known.reach.tolerance, later.reach.tolerance);
  const HalfSpace &a = known.half_space, &b = later.half_space;
  if (a.is_plane() != b.is_plane() || (known.reach.ball_reach > 0) != (later.reach.ball_reach > 0))
    return 0;
  if (a.is_plane()) {
    const Vec3 n = a.f.b * 2.0, m = b.f.b * 2.0;
    const Vec3 foot = later.reach.center - m * dot(m, later.reach.center - b.center);
    for (const int sign : {1, -1}) {
      const double parting = length(n - m * double(sign));
      if (parting < 1 &&
          std::fabs(dot(n, foot - a.center)) + parting * later.reach.radius <= tolerance)
        return sign;
    }
    return 0;
  }
  using K = Kernels<double>;
  for (const Vec3& p : later.outline) {
    const double gradient = 2 * length(K::quadric_half_gradient(a.f, p - a.center));
    if (!(std::fabs(K::quadric_value(a.f, p - a.center)) <= tolerance * gradient)) return 0;
  }
  return 1;
}

/// Adds them all to a table in which only very near ones are equal: all others that the tolerance
/// would take for equal must be known to be near.
void check_crowds(const std::vector<Surface>& surfaces) {
  HalfSpaceTable table(1, kTolerance);
  std::vector<Surface> known;  // with the tolerance that the table has for them
  std::vector<bool> has_near;
  for (const Surface& s : surfaces) {
    Surface fine = s;
    fine.reach.tolerance *= 1e-3;
    size_t expected = known.size();
    for (size_t i = known.size(); i-- > 0;)
      if (compare(known[i], fine) != 0) expected = i;
    const Literal found = table.add(s.half_space, s.reach, fine.reach,
                                    [&](const auto& test) { return test(s.outline); });
    ASSERT_EQ(found >> 1, expected);
    if (expected == known.size()) {
      known.push_back(fine);
      has_near.push_back(false);
    }
    Surface loose;
    for (size_t i = 0; i < known.size(); ++i) {
      loose = known[i];
      loose.reach.tolerance = s.reach.tolerance;
      if (i != expected && compare(loose, s) != 0) has_near[i] = has_near[expected] = true;
    }
  }
  size_t lonely = 0;
  for (uint32_t i = 0; i < known.size(); ++i) {
    if (has_near[i]) {
      ASSERT_TRUE(table.is_crowded(i));
    }
    lonely += !table.is_crowded(i);
  }
  EXPECT_GT(lonely, known.size() / 100);
  EXPECT_LT(lonely, known.size());
}

/// Adds them all to a table and compares each with all before it. Returns how many are not new.
size_t check_all(std::vector<Surface>& surfaces) {
  check_crowds(surfaces);
  HalfSpaceTable table(1, kTolerance);
  std::vector<const Surface*> known;
  for (Surface& s : surfaces) {
    Literal expected = Literal(2 * known.size());
    for (size_t i = 0; i < known.size(); ++i) {
      if (const int same = compare(*known[i], s); same != 0) {
        expected = Literal(2 * i + (same < 0));
        break;
      }
    }
    const Literal found =
        table.add(s.half_space, s.reach, [&](const auto& test) { return test(s.outline); });
    EXPECT_EQ(found, expected) << &s - surfaces.data();
    if (expected / 2 == known.size()) known.push_back(&s);
  }
  return surfaces.size() - known.size();
}

TEST(HalfSpaceTable, FindsThePlanesThatLookingAtAllFinds) {
  Random random;
  // Few normals and offsets, so that many planes are one, or nearly.
  std::vector<Vec3> normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, normalize(Vec3{1, 2, 3})};
  std::vector<Surface> surfaces;
  for (int i = 0; i < 4000; ++i) {
    const double radius = random.small(4);
    Vec3 n = normals[random.bits() % normals.size()];
    if (random.bits() % 2) n = -n;
    if (random.bits() % 2) n = normalize(n + random.vector() * (2 * kTolerance / radius));
    if (random.bits() % 4 == 0) n = normalize(n + random.vector() * 1e-15);
    const double offset = double(random.bits() % 20) / 20 + 1.5 * kTolerance * random.unit();
    const Vec3 place = random.vector(), across = place - n * dot(n, place);
    Surface s;
    s.half_space = {across + n * offset, {{}, {}, n * 0.5, 0}, SurfaceKind::kPlane};
    s.reach = {s.half_space.center + random.vector() * radius, radius, radius,
               std::min(kTolerance, 1e-3 * radius), 0};
    surfaces.push_back(s);
  }
  const size_t merged = check_all(surfaces);
  EXPECT_GT(merged, surfaces.size() / 4);
  EXPECT_LT(merged, surfaces.size() * 3 / 4);
}

TEST(HalfSpaceTable, FindsTheCurvesThatLookingAtAllFinds) {
  Random random;
  std::vector<Surface> surfaces;
  for (int family = 0; family < 300; ++family) {
    // Some parts are squashed a thousandfold, some reach out of the region.
    Affine map;
    const bool is_round = random.bits() % 2;
    if (!is_round)
      for (Vec3& row : map.row) row = random.vector();
    const Vec3 squash = is_round ? Vec3{1, 1, 1} : Vec3{random.small(3), random.small(3), 1};
    const double size = random.small(2);
    for (Vec3& row : map.row)
      row = Vec3{row.x * squash.x, row.y * squash.y, row.z * squash.z} * size;
    map.translation = random.vector() * (random.bits() % 8 ? 1.0 : family % 3 == 0 ? 30.0 : 3.0);
    const Shape shapes[] = {Sphere{1}, Cylinder{1, 1, 1, true}, Cylinder{2, 1, 0.5, false}};
    const Shape& shape = shapes[family % 3];
    for (int i = 0; i < (family % 5 == 0 ? 1 : 12); ++i) {
      const double tolerance = own_tolerance(kTolerance, extent(shape, map), 0);
      Affine moved = map;
      for (Vec3& row : moved.row) row += random.vector() * (random.small(2) * tolerance);
      moved.translation += random.vector() * (2 * random.small(2) * tolerance);
      LoweredPrimitive lowered;
      lower_primitive(shape, moved, lowered);
      const Extent e = within(lowered.extent, Box{{-1, -1, -1}, {1, 1, 1}});
      surfaces.push_back({lowered.half_spaces.front(),
                          {e.center, e.radius, e.width, own_tolerance(kTolerance, e, 0),
                           lowered.is_ball ? lowered.extent.radius : 0},
                          wall_outline(shape, moved)});
    }
  }
  const size_t merged = check_all(surfaces);
  EXPECT_GT(merged, surfaces.size() / 4);
  EXPECT_LT(merged, surfaces.size() * 9 / 10);
}

TEST(PointIndex, FindsWhatIsInTheBox) {
  Random random;
  PointIndex index;
  std::vector<PointIndex::Point> points;
  for (uint32_t i = 0; i < 2000; ++i) {
    const double scale = i % 50 == 0 ? 1e17 : 10;
    points.push_back({scale * random.unit(), scale * random.unit(), double(i % 3)});
    index.add(points.back(), i);
  }
  for (int k = 0; k < 500; ++k) {
    const PointIndex::Point& middle = points[random.bits() % points.size()];
    const double reach = k % 3 == 0 ? 1e9 : 3 * random.small(3);
    PointIndex::Point low, high;
    for (size_t i = 0; i < 3; ++i) low[i] = middle[i] - reach, high[i] = middle[i] + reach;
    std::vector<uint32_t> expected, found;
    for (uint32_t i = 0; i < points.size(); ++i) {
      bool inside = true;
      for (size_t j = 0; j < 3; ++j)
        inside = inside && low[j] <= points[i][j] && points[i][j] <= high[j];
      if (inside) expected.push_back(i);
    }
    index.visit(low, high, [&](uint32_t number) {
      found.push_back(number);
      return true;
    });
    const size_t calls_to_end = found.size();
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    ASSERT_EQ(found, expected);
    size_t calls = 0;
    index.visit(low, high, [&](uint32_t) { return ++calls < 3; });
    ASSERT_EQ(calls, std::min<size_t>(3, calls_to_end));
  }
}

}  // namespace
}  // namespace whittle
