#include "support/random_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/affine.h"
#include "base/degrees.h"

namespace whittle {

namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the standard library's distributions differ by platform.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  uint64_t bits() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }
  double real(double lo, double hi) { return lo + (hi - lo) * double(bits() >> 11) * 0x1p-53; }
  int whole(int lo, int hi) { return lo + int(bits() % uint64_t(hi - lo + 1)); }
  bool chance(double p) { return real(0, 1) < p; }

 private:
  uint64_t state_;
};

class Writer {
 public:
  Writer(uint64_t seed, const RandomTreeOptions& options) : random_(seed), options_(options) {}

  std::string write() {
    const int statements = random_.whole(1, 3);
    for (int i = 0; i < statements; ++i) statement(std::max(1, options_.primitives / statements));
    return std::move(text_);
  }

 private:
  std::string number(double x) const { return fmt::format("{:.{}g}", x, options_.nearly ? 10 : 6); }
  std::string vector(Vec3 v) const {
    return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
  }

  /// How far something is from where it would coincide.
  double slip() {
    if (!options_.nearly || random_.chance(0.5)) return 0;
    return (random_.chance(0.5) ? 1 : -1) * std::pow(10, random_.real(-6.5, -2.5));
  }
  /// A length or coordinate: on the grid, nearly on it, or off it.
  double coordinate(double lo, double hi) {
    return options_.coincident ? random_.whole(int(lo), int(hi)) + slip() : random_.real(lo, hi);
  }
  Vec3 point(double reach) {
    return {coordinate(-reach, reach), coordinate(-reach, reach), coordinate(-reach, reach)};
  }
  double angle() {
    if (!options_.coincident) return random_.real(0, 360);
    const double degrees = 90 * random_.whole(0, 3);
    return options_.nearly && random_.chance(0.1) ? degrees + slip() : degrees;
  }

  void line(const std::string& s) {
    text_.append(size_t(depth_), '\t');
    text_ += s;
    text_ += '\n';
  }
  void open(const std::string& head) {
    line(head + " {");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}");
  }

  std::string modifier() {
    if (!options_.modifiers) return "";
    return random_.chance(0.04) ? "%" : random_.chance(0.04) ? "#" : "";
  }

  /// A statement that holds about `budget` primitives.
  void statement(int budget) {
    if (budget <= 1) {
      leaf();
      return;
    }
    const int choice = random_.whole(0, 11);
    if (choice == 0) {
      open(modifier() + fmt::format("color([{}, {}, {}, {}])", number(random_.real(0, 1)),
                                    number(random_.real(0, 1)), number(random_.real(0, 1)),
                                    random_.chance(0.2) ? "-1" : "1"));
      statement(budget);
      close();
      return;
    }
    if (choice == 1) {
      open(modifier() + matrix(2));
      statement(budget);
      close();
      return;
    }
    static constexpr std::array kOperators = {"union()", "difference()", "difference()",
                                              "intersection()", "group()"};
    open(modifier() + kOperators[size_t(random_.whole(0, 4))]);
    int left = budget;
    while (left > 0) {
      const int share = std::min(left, random_.whole(1, std::max(1, budget / 2)));
      statement(share);
      left -= share;
      if (options_.modifiers && random_.chance(0.02))
        line(random_.chance(0.5) ? "group();" : "cube(size = [0, 1, 1], center = false);");
    }
    close();
  }

  /// A random transform that moves by up to `reach`.
  std::string matrix(double reach) {
    Affine m = translation(point(reach));
    if (random_.chance(0.6)) m = m * rotation();
    if (random_.chance(0.15)) m = m * scaling({1, -1, 1});
    if (!options_.coincident && random_.chance(0.3))
      m = m * scaling({random_.real(0.5, 2), random_.real(0.5, 2), random_.real(0.5, 2)});
    if (!options_.coincident && random_.chance(0.15))
      m = m * Affine{.row = {{1, random_.real(-0.7, 0.7), random_.real(-0.7, 0.7)},
                             {0, 1, random_.real(-0.7, 0.7)},
                             {0, 0, 1}},
                     .translation = {}};
    std::string rows;
    for (int i = 0; i < 3; ++i)
      rows += fmt::format("[{}, {}, {}, {}], ", number(m.row[i].x), number(m.row[i].y),
                          number(m.row[i].z), number(m.translation[i]));
    return fmt::format("multmatrix([{}[0, 0, 0, 1]])", rows);
  }

  Affine rotation() {
    Affine m;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = angle(), c = cos_degrees(a), s = sin_degrees(a);
      Affine turn;
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      turn.row[u][u] = c, turn.row[u][v] = -s, turn.row[v][u] = s, turn.row[v][v] = c;
      m = turn * m;
    }
    return m;
  }

  void leaf() {
    open(modifier() + matrix(4));
    primitive();
    close();
  }

  std::string fragments() {
    const int fn = random_.chance(0.5)   ? 0
                   : options_.coincident ? 4 * random_.whole(1, 3)
                                         : random_.whole(3, 12);
    return fmt::format("$fn = {}, $fa = 12, $fs = 2", fn);
  }

  void primitive() {
    const int choice = random_.whole(0, options_.halfspaces ? 11 : 9);
    const std::string center = random_.chance(0.5) ? "true" : "false";
    if (choice < 4) {
      const Vec3 size = {coordinate(1, 6), coordinate(1, 6), coordinate(1, 6)};
      line(fmt::format("cube(size = {}, center = {});", vector(size), center));
    } else if (choice < 6) {
      line(fmt::format("sphere({}, r = {});", fragments(), number(coordinate(1, 4))));
    } else if (choice < 9) {
      const double r1 = random_.chance(0.2) ? 0 : coordinate(1, 3);
      const double r2 = random_.chance(0.5) && r1 > 0   ? r1
                        : random_.chance(0.2) && r1 > 0 ? 0
                                                        : coordinate(1, 3);
      line(fmt::format("cylinder({}, h = {}, r1 = {}, r2 = {}, center = {});", fragments(),
                       number(coordinate(1, 7)), number(r1), number(r2), center));
    } else if (choice < 10) {
      polyhedron();
    } else {
      const Vec3 n = options_.coincident ? Vec3{random_.chance(0.5) ? 1.0 : -1.0, 0, 0} : point(2);
      line(fmt::format("halfspace(n = {}, d = {});", vector(n), number(coordinate(-3, 5))));
    }
  }

  /// A bipyramid, or a prism that leans, over a polygon on a circle; faces clockwise from outside,
  /// or now and then all of them the other way.
  void polyhedron() {
    const int n = random_.whole(3, 7);
    const bool prism = random_.chance(0.5);
    const double r = coordinate(1, 3), h = coordinate(1, 4);
    const Vec3 lean = {coordinate(-1, 1), coordinate(-1, 1), h};
    std::vector<Vec3> points;
    std::vector<std::vector<int>> faces;
    for (int k = 0; k < n; ++k) {
      const double a = 360.0 * k / n;
      points.push_back({r * cos_degrees(a), r * sin_degrees(a), 0});
    }
    if (prism) {
      faces.resize(2);
      for (int k = 0; k < n; ++k) {
        points.push_back(points[size_t(k)] + lean);
        faces[0].push_back(k);
        faces[1].push_back(2 * n - 1 - k);
        const int next = (k + 1) % n;
        faces.push_back({k, k + n, next + n, next});
      }
    } else {
      points.push_back(Vec3{0, 0, h});
      points.push_back(Vec3{0, 0, -coordinate(1, 4)});
      for (int k = 0; k < n; ++k) {
        const int next = (k + 1) % n;
        faces.push_back({k, n, next});
        faces.push_back({next, n + 1, k});
      }
    }
    if (random_.chance(0.2))
      for (auto& face : faces) std::ranges::reverse(face);
    std::string point_text, face_text;
    for (const Vec3 p : points) point_text += (point_text.empty() ? "" : ", ") + vector(p);
    for (const auto& face : faces)
      face_text += fmt::format("{}[{}]", face_text.empty() ? "" : ", ", fmt::join(face, ", "));
    line(fmt::format("polyhedron(points = [{}], faces = [{}], convexity = 1);", point_text,
                     face_text));
  }

  Random random_;
  RandomTreeOptions options_;
  std::string text_;
  int depth_ = 0;
};

}  // namespace

std::string random_tree(uint64_t seed, const RandomTreeOptions& options) {
  return Writer(seed, options).write();
}

}  // namespace whittle
