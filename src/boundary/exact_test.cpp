#include <gtest/gtest.h>

#include <random>

#include "boundary/exact_line.h"
#include "boundary/point_table.h"

namespace whittle {
namespace {

using Wide = WideInt<4>;

int sign_of(double value) {
  return value < 0 ? -1 : value > 0 ? 1 : 0;
}

HalfSpace half_space(Vec3 n, Vec3 through) {
  HalfSpace h;
  h.center = through;
  h.f = {{}, {}, normalize(n) * 0.5, 0};
  h.kind = SurfaceKind::kPlane;
  return h;
}

struct Planes {
  ExactGrid grid{Box{{-10, -10, -10}, {10, 10, 10}}};
  PlaneTable table;
  ExactGeometry geometry{table};

  uint32_t add(Vec3 n, Vec3 through) {
    PlaneSide inside;
    return table.add(grid.plane(half_space(n, through), inside));
  }
};

TEST(WideInt, CountsAsSmallNumbersDo) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto a = int64_t(random()) >> (random() % 40), b = int64_t(random()) >> (random() % 40);
    const Int128 product = Int128(a) * b;
    EXPECT_EQ(Wide(a) * Wide(b), Wide(product));
    EXPECT_EQ(Wide(a).times(b), Wide(product));
    EXPECT_EQ(Wide(whittle::product(product / 2, a / 2)), Wide(product / 2) * Wide(a / 2));
    EXPECT_EQ(Wide(a) - Wide(b), Wide(Int128(a) - b));
    EXPECT_EQ(Wide(a).shifted(70), Wide(a) * Wide(Int128(1) << 70));
    EXPECT_DOUBLE_EQ(double(Wide(product).rounded()), double(product));
    EXPECT_EQ((Wide(a) - Wide(b)).sign(), a < b ? -1 : a > b ? 1 : 0);
  }
}

TEST(WideInt, QuotientIsRoundedDown) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Wide divisor = Wide(Int128(random() | 1)) * Wide(Int128(random() | 1)).shifted(20);
    const auto quotient = int64_t(random()) >> (3 + random() % 60);
    const Wide rest = divisor - Wide(Int128(1 + random() % 1000));
    bool is_whole;
    EXPECT_EQ(floor_of_quotient(divisor.times(quotient), divisor, is_whole), quotient);
    EXPECT_TRUE(is_whole);
    EXPECT_EQ(floor_of_quotient(divisor.times(quotient) + rest, divisor, is_whole), quotient);
    EXPECT_FALSE(is_whole);
    EXPECT_EQ(floor_of_quotient(divisor.times(quotient) - Wide(1), divisor, is_whole),
              quotient - 1);
  }
}

TEST(ExactPlane, OneDirectionHasOneNormal) {
  const ExactGrid grid({{-1, -1, -1}, {1, 1, 1}});
  PlaneSide above, below;
  EXPECT_EQ(grid.plane(half_space({1, 1, 0}, {0.5, 0.5, 0}), above),
            grid.plane(half_space({-7, -7, 0}, {0.25, 0.75, 3}), below));
  EXPECT_EQ(above, -1);
  EXPECT_EQ(below, 1);
  // A unit vector that is one unit of the last place too short is still square to the axis.
  HalfSpace h = half_space({0, 0, 1}, {0, 0, 0.3});
  h.f.b.z = std::nextafter(0.5, 0.0);
  EXPECT_EQ(grid.plane(h, above).n, grid.square_plane(2, 0.3).n);
}

TEST(ExactPoint, LiesOnItsPlanesAndBesideOthers) {
  Planes planes;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-5, 5);
  const auto vector = [&] { return Vec3{any(random), any(random), any(random)}; };
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = vector();
    std::array<Vec3, 3> n{};
    do {
      for (Vec3& v : n) v = normalize(vector());
    } while (std::fabs(dot(n[0], cross(n[1], n[2]))) < 0.1);
    const ExactPoint point =
        planes.geometry.meet(planes.add(n[0], p), planes.add(n[1], p), planes.add(n[2], p));
    for (const uint32_t plane : point.planes) {
      EXPECT_EQ(planes.geometry.side(point, plane), 0);
      // The same without the help of names.
      const HomogeneousPoint exact = planes.geometry.homogeneous(point.planes);
      Wide sum = -(Wide(planes.geometry.plane(plane).d) * Wide(exact.w));
      for (size_t k = 0; k < 3; ++k)
        sum += Wide(exact.x[k]).times(planes.geometry.plane(plane).n[k]);
      EXPECT_EQ(sum.sign(), 0);
    }
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(std::ldexp(double(point.floor[size_t(k)]), -34) / planes.grid.per_unit(), p[k],
                  1e-13);
    const Vec3 m = normalize(vector());
    for (const double off : {1e-13, -1e-13, 1.0}) {
      PlaneSide inside;
      const uint32_t other =
          planes.table.add(planes.grid.plane(half_space(m, p - m * off), inside));
      EXPECT_EQ(planes.geometry.side(point, other), -inside * sign_of(off));
      const auto& [a, b, c] = point.planes;
      EXPECT_EQ(planes.geometry.side(planes.geometry.about(a, b, c), other),
                -inside * sign_of(off));
    }
  }
}

TEST(ExactPoint, EqualPointsOfDifferentPlanesAreOne) {
  Planes planes;
  // Planes through the origin, and such through the middle of a cube: of the first no number is
  // rounded that matters, of the second all are whole.
  std::vector<ExactPoint> points;
  std::mt19937_64 random(4);
  const auto component = [&] { return double(int(random() % 9) - 4); };
  std::vector<uint32_t> numbers;
  for (int i = 0; i < 12; ++i) numbers.push_back(planes.add({component(), component(), 5}, {}));
  for (size_t a = 0; a < numbers.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      for (size_t c = 0; c < b; ++c) {
        const auto& n = planes.geometry;
        Wide w;
        const auto bc = direction(n.plane(numbers[b]), n.plane(numbers[c]));
        for (size_t k = 0; k < 3; ++k) w += Wide(Int128(n.plane(numbers[a]).n[k])) * Wide(bc[k]);
        if (w.sign() != 0) points.push_back(n.meet(numbers[a], numbers[b], numbers[c]));
      }
  ASSERT_GT(points.size(), 50u);
  std::vector<uint32_t> of_each;
  EXPECT_EQ(unify(points, planes.geometry, Workers(2), of_each).size(), 1u);
}

TEST(ExactPoint, TurnAndOrderAreExactWhereNumbersAreRounded) {
  Planes planes;
  // Three points of one line in the plane z = 0, none of them a number of few digits.
  const uint32_t ground = planes.add({0, 0, 1}, {}), line = planes.add({1, 3, 0}, {0.1, 0.2, 0});
  std::vector<ExactPoint> on_line;
  for (const double at : {0.3, 0.7, 1.9})
    on_line.push_back(planes.geometry.meet(ground, line, planes.add({3, 0.7, 0.1}, {at, 0, 0})));
  EXPECT_EQ(planes.geometry.turn(on_line[0], on_line[1], on_line[2], 0, 1), 0);
  EXPECT_EQ(planes.geometry.compare(on_line[0], on_line[1], 0), -1);
  EXPECT_EQ(planes.geometry.compare(on_line[1], on_line[0], 0), 1);
  EXPECT_EQ(planes.geometry.compare(on_line[1], on_line[1], 0), 0);
  const uint32_t beside = planes.add({1, 3, 0}, {0.1, 0.2 + 1e-15, 0});
  const ExactPoint off = planes.geometry.meet(ground, beside, planes.add({1, 0, 0}, {1, 0, 0}));
  EXPECT_EQ(planes.geometry.turn(on_line[0], on_line[2], off, 0, 1), 1);
  EXPECT_EQ(planes.geometry.turn(on_line[0], on_line[2], off, 1, 0), -1);
}

TEST(NumberLines, OneLineHasOneNumber) {
  Planes planes;
  // Planes about the z axis.
  const uint32_t a = planes.add({1, 2, 0}, {}), b = planes.add({-5, 3, 0}, {}),
                 c = planes.add({1, 1, 0}, {}), d = planes.add({1, 1, 0}, {0.1, 0, 0});
  const std::vector<std::array<uint32_t, 2>> pairs = {{a, b}, {b, a}, {c, a},
                                                      {b, c}, {a, d}, {d, a}};
  const NumberedLines lines = number_lines(
      pairs.size(), [&](size_t i) { return pairs[i]; }, planes.geometry, Workers(2));
  EXPECT_EQ(lines.numbers, (std::vector<uint32_t>{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(lines.axes, (std::vector<uint8_t>{2, 2}));
}

}  // namespace
}  // namespace whittle
