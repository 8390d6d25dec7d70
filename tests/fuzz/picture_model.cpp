#include "fuzz/picture_model.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/affine.h"
#include "base/degrees.h"

// The first three bytes say how to look and where the model stands as a whole. Then follow
// statements: a byte that says what comes, and what it needs, until the bytes or the primitives are
// used up. What is missing at the end is 0. Every number is taken modulo what there is to choose
// from, so a byte that changes changes one thing.

namespace whittle {
namespace {

class Bytes {
 public:
  explicit Bytes(std::span<const uint8_t> bytes) : left_(bytes) {}
  bool empty() const { return left_.empty(); }
  unsigned next() {
    if (left_.empty()) return 0;
    const uint8_t byte = left_.front();
    left_ = left_.subspan(1);
    return byte;
  }
  /// 0 to n - 1.
  int below(int n) { return int(next()) % n; }

 private:
  std::span<const uint8_t> left_;
};

Affine rotation(int axis, double degrees) {
  const double c = cos_degrees(degrees), s = sin_degrees(degrees);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Affine turn;
  turn.row[u][u] = c, turn.row[u][v] = -s, turn.row[v][u] = s, turn.row[v][v] = c;
  return turn;
}

/// Turns and distortions, the same few everywhere, so that what is turned twice coincides too.
Affine distortion(unsigned byte) {
  static constexpr std::array kOddAngles = {45.0, 30.0, 17.0, 60.0, 12.34};
  static constexpr std::array kScales = {Vec3{2, 2, 2}, Vec3{0.5, 1, 1}, Vec3{1, 1, 3},
                                         Vec3{1, 1, 0.01}, Vec3{0.1, 0.1, 0.1}};
  const int choice = int(byte & 7), which = int(byte >> 3), axis = which % 3;
  Affine map;
  switch (choice) {
    case 0:
    case 1:
      return rotation(axis, 90.0 * (1 + which / 3 % 3));
    case 2:
      return rotation(axis, kOddAngles[size_t(which / 3) % kOddAngles.size()]);
    case 3:
      return rotation(0, kOddAngles[size_t(which) % kOddAngles.size()]) *
             rotation(2, kOddAngles[size_t(which / 5) % kOddAngles.size()]);
    case 4:
      map.row[axis][axis] = -1;
      return map;
    case 5:
      return scaling(kScales[size_t(which) % kScales.size()]);
    case 6:
      map.row[axis][(axis + 1) % 3] = which & 1 ? 0.5 : -0.25;
      return map;
    default:
      return map;
  }
}

/// Sides of a polyhedron that is a prism or a pyramid over a polygon; corners on whole numbers.
struct Solid {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
};

Solid prism(const std::vector<Vec3>& base, Vec3 to) {
  const int n = int(base.size());
  Solid solid{base, {{}, {}}};
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    solid.points.push_back(base[size_t(k)] + to);
    solid.faces[0].push_back(k);
    solid.faces[1].push_back(2 * n - 1 - k);
    solid.faces.push_back({k, k + n, next + n, next});
  }
  return solid;
}

Solid pyramid(const std::vector<Vec3>& base, Vec3 apex) {
  const int n = int(base.size());
  Solid solid{base, {{}}};
  solid.points.push_back(apex);
  for (int k = 0; k < n; ++k) {
    solid.faces[0].push_back(k);
    solid.faces.push_back({k, n, (k + 1) % n});
  }
  return solid;
}

void append(Solid& to, const Solid& part, Vec3 move, bool inside_out) {
  const int first = int(to.points.size());
  for (const Vec3 p : part.points) to.points.push_back(p + move);
  for (std::vector<int> face : part.faces) {
    for (int& corner : face) corner += first;
    if (inside_out) std::ranges::reverse(face);
    to.faces.push_back(std::move(face));
  }
}

const std::vector<Vec3>& unit_square() {
  static const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  return corners;
}

class Decoder {
 public:
  Decoder(std::span<const uint8_t> bytes, double nearly) : bytes_(bytes), nearly_(nearly) {}

  PictureInput decode() {
    header();
    do statement();
    while (!bytes_.empty() && result_.primitives < kMostPrimitives);
    if (result_.primitives == 0) primitive();
    while (open_ > 0) close();
    result_.text += "}\n";
    return std::move(result_);
  }

 private:
  // Numbers as OpenSCAD writes them, six digits, or all there are.
  std::string number(double x) const {
    return six_digits_ ? fmt::format("{:.6g}", x) : fmt::format("{}", x);
  }
  std::string vector(Vec3 v) const {
    return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
  }
  std::string matrix(const Affine& m) const {
    std::string rows;
    for (int i = 0; i < 3; ++i)
      rows += fmt::format("[{}, {}, {}, {}], ", number(m.row[i].x), number(m.row[i].y),
                          number(m.row[i].z), number(m.translation[i]));
    return fmt::format("multmatrix([{}[0, 0, 0, 1]]) ", rows);
  }

  void header() {
    static constexpr std::array<uint32_t, 4> kLeafSizes = {6, 2, 4, 16};
    // Mostly as few cells as so few pixels need, for they take half the time.
    static constexpr std::array kLeastUses = {1.0 / 128, 1.0 / 32, 1.0 / 2048, 1.0 / 4};
    static constexpr std::array kFar = {Vec3{}, Vec3{}, Vec3{1000, -300, 20}, Vec3{1e6, 0, -1e6}};
    static constexpr std::array kSizes = {1.0, 1.0, 0.001, 1000.0};
    const unsigned how = bytes_.next(), where = bytes_.next(), turn = bytes_.next();
    result_.leaf_size = kLeafSizes[how % 4];
    result_.view = int(how >> 2) % kViews;
    result_.least_use = kLeastUses[(how >> 2) / kViews % kLeastUses.size()];
    whole_size_ = kSizes[where >> 2 & 3];
    Affine whole = scaling(Vec3{1, 1, 1} * whole_size_);
    if (turn & 1) whole = distortion(turn >> 1) * whole;
    whole.translation = kFar[where & 3];
    result_.text = matrix(whole) + "{\n";
    six_digits_ = where & 16;
  }

  void statement() {
    const unsigned byte = bytes_.next();
    const unsigned modifier = byte >> 4;
    if (modifier == 15) result_.text += "%";
    if (modifier == 14) result_.text += "#";
    switch (byte & 15) {
      case 7:
      case 8:
        copy();
        break;
      case 9:
      case 10:
        open("difference() ");
        break;
      case 11:
        open("union() ");
        break;
      case 12:
        open("intersection() ");
        break;
      case 13:
        open(placement() + "group() ");
        break;
      case 14:
      case 15:
        if (open_ > 0 && modifier < 14)
          close();
        else
          primitive();
        break;
      default:
        primitive();
    }
  }

  void open(const std::string& head) {
    constexpr int kDeepest = 8;
    if (open_ == kDeepest) {
      primitive();
      return;
    }
    result_.text += head + "{\n";
    ++open_;
  }
  void close() {
    result_.text += "}\n";
    --open_;
  }

  void primitive() {
    shapes_.push_back(shape());
    place(shapes_.back());
  }

  /// One of the shapes that there are already, at a place of its own.
  void copy() {
    if (shapes_.empty()) {
      primitive();
      return;
    }
    place(shapes_[size_t(bytes_.below(int(shapes_.size())))]);
  }

  void place(const std::string& shape) {
    const std::string where = placement();
    result_.text += where + near_placement() + shape + "\n";
    ++result_.primitives;
  }

  /// A place on a grid, turned or distorted about that place or not.
  std::string placement() {
    Affine map;
    const unsigned turn = bytes_.next();
    if ((turn & 3) == 3) map = distortion(turn >> 2);
    for (int axis = 0; axis < 3; ++axis) map.translation[axis] = bytes_.below(7) - 3;
    return map == Affine{} ? "" : matrix(map);
  }

  /// Mostly nothing; else a step, growth or turn by some tolerances, in full precision.
  std::string near_placement() {
    const unsigned byte = bytes_.next();
    const size_t which = byte & 15;
    if (which < 16 - std::size(kNearly)) return "";
    result_.uses_nearly = true;
    const double step = kNearly[which - (16 - std::size(kNearly))] * nearly_ / whole_size_;
    const int how = int(byte >> 4);
    Affine map;
    if (how < 12) {
      map.translation[how % 3] = how % 6 < 3 ? step : -step;
      if (how >= 9) map.translation = Vec3{step, step, -step} * 0.577;
    } else if (how < 14) {
      map = scaling(Vec3{1, 1, 1} * (how == 12 ? 1 + step / 2 : 1 - step / 2));
    } else {
      constexpr double kDegrees = 57.29577951308232;
      map = rotation(how - 14, step / 3 * kDegrees);
    }
    const bool six_digits = std::exchange(six_digits_, false);
    const std::string text = matrix(map);
    six_digits_ = six_digits;
    return text;
  }

  std::string shape() {
    const unsigned byte = bytes_.next();
    const char* const center = byte & 16 ? "true" : "false";
    const int facets = byte & 32 ? std::array{4, 3, 5, 6, 8, 12}[size_t(byte >> 6 & 3)] : 0;
    const std::string fragments = fmt::format("$fn = {}, $fa = 12, $fs = 2", facets);
    switch (byte & 15) {
      case 5:
      case 6:
      case 7:
        return fmt::format("sphere({}, r = {});", fragments, 1 + bytes_.below(3));
      case 8:
      case 9:
      case 10: {
        const int h = 1 + bytes_.below(6), r = 1 + bytes_.below(3);
        return fmt::format("cylinder({}, h = {}, r1 = {}, r2 = {}, center = {});", fragments, h, r,
                           r, center);
      }
      case 11:
      case 12: {
        const int h = 1 + bytes_.below(6), r = bytes_.below(12);
        return fmt::format("cylinder({}, h = {}, r1 = {}, r2 = {}, center = {});", fragments, h,
                           r / 4, r / 4 == 0 ? 1 + r % 3 : r % 4, center);
      }
      case 13:
      case 14:
        return polyhedron();
      case 15:
        return halfspace();
      default: {
        // Bits that mean nothing to a cube.
        if ((byte & 15) >= 3 && (byte & 32)) return body();
        const Vec3 size = {1.0 + bytes_.below(6), 1.0 + bytes_.below(6), 1.0 + bytes_.below(6)};
        return fmt::format("cube(size = {}, center = {});", vector(size), center);
      }
    }
  }

  std::string halfspace() {
    static constexpr std::array kNormals = {Vec3{0, 0, 1},  Vec3{0, 0, -1}, Vec3{1, 0, 0},
                                            Vec3{0, -2, 0}, Vec3{3, 4, 0},  Vec3{1, 1, 1},
                                            Vec3{-1, 0, 0}, Vec3{1, -2, 3}};
    const unsigned byte = bytes_.next();
    return fmt::format("halfspace(n = {}, d = {});", vector(kNormals[byte & 7]),
                       int(byte >> 3) % 9 - 3);
  }

  /// The corners of a polygon, counter-clockwise or not, all x and y from -3 to 3.
  std::vector<Vec3> outline() {
    static const std::vector<std::vector<Vec3>> outlines = {
        {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
        {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},
        // Touches itself in a corner; in a corner of another side.
        {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}},
        {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}},
    };
    const size_t which = size_t(bytes_.below(12));
    if (which < outlines.size()) return outlines[which];
    const int n = int(which) - 1;
    std::vector<Vec3> corners;
    for (int k = 0; k < n; ++k) {
      const double r = 1 + bytes_.below(3), degrees = 360.0 * k / n;
      corners.push_back({r * cos_degrees(degrees), r * sin_degrees(degrees), 0});
    }
    return corners;
  }

  /// Steps and ramps over a square of n x n fields.
  Solid terrain(int n) {
    Solid solid;
    const auto at = [n](int x, int y, int level) { return (level * (n + 1) + y) * (n + 1) + x; };
    for (int level = 0; level < 2; ++level)
      for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
          solid.points.push_back({double(x), double(y), level == 0 ? 0.0 : 1.0 + bytes_.below(3)});
    const auto facet = [&](int a, int b, int c) { solid.faces.push_back({a, b, c}); };
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        facet(at(x, y, 1), at(x, y + 1, 1), at(x + 1, y, 1));
        facet(at(x + 1, y, 1), at(x, y + 1, 1), at(x + 1, y + 1, 1));
        facet(at(x, y, 0), at(x + 1, y, 0), at(x, y + 1, 0));
        facet(at(x + 1, y, 0), at(x + 1, y + 1, 0), at(x, y + 1, 0));
      }
    const auto wall = [&](int x, int y, int u, int v) {
      solid.faces.push_back({at(x, y, 0), at(x, y, 1), at(u, v, 1), at(u, v, 0)});
    };
    for (int k = 0; k < n; ++k) {
      wall(k, 0, k + 1, 0);
      wall(k + 1, n, k, n);
      wall(0, k + 1, 0, k);
      wall(n, k, n, k + 1);
    }
    return solid;
  }

  /// Two shells: beside one another, touching, overlapping, or one a hollow in the other.
  Solid shells(double h) {
    const unsigned byte = bytes_.next();
    Solid solid = prism({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, {0, 0, h});
    const Vec3 move = {double(byte & 3), double(byte >> 2 & 3), (byte >> 4 & 3) * 0.5};
    const Solid part =
        byte & 64 ? pyramid(unit_square(), {0.5, 0.5, 2}) : prism(unit_square(), {0, 0, 1});
    append(solid, part, move, byte & 128);
    return solid;
  }

  /// A body that is not convex, or so it is written: a mesh, an extrusion or a revolution.
  std::string body() {
    const unsigned byte = bytes_.next();
    const double h = 1 + int(byte >> 3 & 3);
    const unsigned more = byte >> 5;
    Solid solid;
    switch (byte & 7) {
      case 0:
      case 1:
        solid = prism(outline(), {more & 1 ? 1.0 : 0.0, 0, h});
        break;
      case 2:
        solid = pyramid(outline(), {more & 1 ? 1.0 : 0.0, more & 2 ? 3.0 : 0.0, h});
        break;
      case 3:
        solid = terrain(1 + int(more & 3));
        break;
      case 4:
        solid = shells(h);
        break;
      case 5:
        return extrusion(h, more);
      default:
        return revolution(more);
    }
    // Each face may be turned as it likes, or all of them.
    const unsigned turned = bytes_.next();
    if ((turned & 3) == 3) {
      std::ranges::reverse(solid.faces[(turned >> 2) % solid.faces.size()]);
    } else if (turned & 1) {
      for (auto& face : solid.faces) std::ranges::reverse(face);
    }
    return polyhedron(solid);
  }

  std::string polygon(const std::vector<Vec3>& corners, double right) const {
    std::string points;
    for (const Vec3 p : corners)
      points +=
          fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", number(p.x + right), number(p.y));
    return fmt::format("polygon(points = [{}], paths = undef, convexity = 1);", points);
  }

  std::string extrusion(double h, unsigned more) {
    static constexpr std::array kKinds = {"scale = [1, 1]",     "scale = [0, 0]",
                                          "scale = [0.5, 2]",   "twist = 90, slices = 2",
                                          "scale = [0.5, 0.5]", "twist = -40, slices = 3"};
    const size_t kind = size_t(bytes_.below(12));
    const std::string head =
        fmt::format("linear_extrude(height = {}, center = {}, {}) ", number(h),
                    more & 1 ? "true" : "false", kKinds[kind < kKinds.size() ? kind : 0]);
    if (kind % 2 == 0 || !(more & 2)) return head + polygon(outline(), 0);
    return fmt::format("{}difference() {{ circle($fn = {}, $fa = 12, $fs = 2, r = 2); {} }}", head,
                       more & 4 ? 5 : 0, polygon(outline(), 1));
  }

  std::string revolution(unsigned more) {
    static constexpr std::array kTurns = {"", "angle = 90, ", "angle = -135, ", "angle = 270, "};
    const unsigned byte = bytes_.next();
    return fmt::format("rotate_extrude({}$fn = {}, $fa = 12, $fs = 2) {}", kTurns[byte & 3],
                       more & 1 ? 0 : 3 + int(byte >> 2 & 7), polygon(outline(), 3 + (more >> 1)));
  }

  std::string polyhedron() {
    const unsigned byte = bytes_.next();
    if (byte & 128) return body();
    const double r = 1 + int(byte >> 4 & 1), h = 1 + int(byte >> 5 & 3);
    const std::vector<Vec3> square = {{0, 0, 0}, {r, 0, 0}, {r, r, 0}, {0, r, 0}};
    const std::vector<Vec3> corner = {{0, 0, 0}, {r, 0, 0}, {0, r, 0}};
    const std::vector<Vec3> house = {{-r, -r, 0}, {r, -r, 0}, {r, r, 0}, {0, 2 * r, 0}, {-r, r, 0}};
    std::vector<Vec3> hexagon;
    for (int k = 0; k < 6; ++k)
      hexagon.push_back({r * cos_degrees(60 * k), r * sin_degrees(60 * k), 0});
    Solid solid;
    switch (byte & 7) {
      case 0:
        solid = prism(square, {0, 0, h});
        break;
      case 1:
        solid = prism(corner, {0, 0, h});
        break;
      case 2:
        solid = pyramid(corner, {0, 0, h});
        break;
      case 3:
        solid = pyramid(square, {r / 2, r / 2, h});
        break;
      case 4:
        solid = prism(house, {0, 0, h});
        break;
      case 5:
        solid = prism(hexagon, {1, 0, h});
        break;
      case 6:
        solid = prism(square, {1, 1, h});
        break;
      default:
        solid = pyramid(house, {0, 0, h});
    }
    if (byte & 8)
      for (auto& face : solid.faces) std::ranges::reverse(face);
    return polyhedron(solid);
  }

  std::string polyhedron(const Solid& solid) const {
    std::string points, faces;
    for (const Vec3 p : solid.points) points += (points.empty() ? "" : ", ") + vector(p);
    for (const auto& face : solid.faces)
      faces += fmt::format("{}[{}]", faces.empty() ? "" : ", ", fmt::join(face, ", "));
    return fmt::format("polyhedron(points = [{}], faces = [{}], convexity = 1);", points, faces);
  }

  Bytes bytes_;
  const double nearly_;
  double whole_size_ = 1;
  bool six_digits_ = false;
  int open_ = 0;
  std::vector<std::string> shapes_;
  PictureInput result_;
};

}  // namespace

PictureInput decode_picture(std::span<const uint8_t> bytes, double nearly) {
  return Decoder(bytes, nearly).decode();
}

}  // namespace whittle
