// What must hold for every text: models survive printing and reading, simplifying changes nothing,
// and no damage to a text can do harm.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "csg/read_csg.h"
#include "csg/test_support.h"

namespace whittle {
namespace {

using Random = std::mt19937_64;

int pick(Random& random, int below) {
  return static_cast<int>(random() % static_cast<unsigned>(below));
}
double random_number(Random& random) {
  return (pick(random, 41) - 20) / 4.0;
}

/// A tree as a person might write it, before anybody simplifies it.
struct Written {
  enum class Kind {
    kUnion,
    kDifference,
    kIntersection,
    kTranslate,
    kColor,
    kCube,
    kSphere,
    kHalfspace
  };
  Kind kind = Kind::kUnion;
  bool background = false, highlight = false, disabled = false;
  std::string spelling;  ///< of a union
  Vec3 vector;           ///< translation, size, normal
  double scalar = 0;     ///< radius, distance
  std::vector<Written> children;

  bool is_primitive() const { return kind >= Kind::kCube; }
};

/// `fewest` children at least, and nothing disabled unless it is 0.
Written random_tree(Random& random, int depth, int fewest = 0) {
  using Kind = Written::Kind;
  Written tree;
  tree.kind = static_cast<Kind>(depth > 0 ? pick(random, 8) : 5 + pick(random, 3));
  tree.background = pick(random, 12) == 0;
  tree.highlight = pick(random, 12) == 0;
  tree.disabled = pick(random, 12) == 0 && fewest == 0;
  constexpr const char* kUnions[] = {"union()", "group()", "render(convexity = 2)",
                                     "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]])",
                                     "color([-1, -1, -1, -1])"};
  tree.spelling = kUnions[pick(random, 5)];
  tree.vector = {random_number(random), random_number(random), random_number(random)};
  tree.scalar = random_number(random);
  if (!tree.is_primitive()) {
    for (int n = fewest + pick(random, 4 - fewest); n > 0; --n) {
      tree.children.push_back(random_tree(random, depth - 1, fewest));
    }
  }
  return tree;
}

std::string blank(Random& random) {
  constexpr const char* kBlanks[] = {"", "", " ", "\n\t", "\r\n", "/* } */", "// ;\n"};
  return kBlanks[pick(random, 7)];
}

void print(const Written& tree, Random& random, std::string& text) {
  using Kind = Written::Kind;
  if (tree.background) text += "%" + blank(random);
  if (tree.highlight) text += "#" + blank(random);
  if (tree.disabled) text += "*" + blank(random);
  const Vec3 v = tree.vector;
  switch (tree.kind) {
    case Kind::kUnion:
      text += tree.spelling;
      break;
    case Kind::kDifference:
      text += "difference()";
      break;
    case Kind::kIntersection:
      text += "intersection()";
      break;
    case Kind::kTranslate:
      text += fmt::format("translate([{}, {},{}{}])", v.x, v.y, blank(random), v.z);
      break;
    case Kind::kColor:
      text += "color([1, 0.5, 0, 1])";
      break;
    case Kind::kCube:
      text += fmt::format("cube(size = [{}, {}, {}], center = true)", v.x, v.y, v.z);
      break;
    case Kind::kSphere:
      text += fmt::format("sphere({}r ={}{})", blank(random), blank(random), tree.scalar);
      break;
    case Kind::kHalfspace:
      text += fmt::format("halfspace(n = [{}, {}, {}], d = {})", v.x, v.y, v.z, tree.scalar);
      break;
  }
  text += blank(random);
  if (tree.children.empty()) {
    text += ";";
  } else if (tree.children.size() == 1 && pick(random, 2) == 0) {
    print(tree.children[0], random, text);
  } else {
    text += "{";
    for (const Written& child : tree.children) print(child, random, text += blank(random));
    text += "}";
  }
  text += blank(random);
}

bool contains(const Shape& shape, Vec3 p) {
  if (is_empty(shape)) return false;
  if (const auto* const cube = std::get_if<Cube>(&shape)) {
    const Vec3 a = abs(p) * 2.0;
    return a.x <= cube->size.x && a.y <= cube->size.y && a.z <= cube->size.z;
  }
  if (const auto* const sphere = std::get_if<Sphere>(&shape)) return length(p) <= sphere->r;
  const auto& half = std::get<Halfspace>(shape);
  return dot(half.n, p) <= half.d;
}

/// The value of a set operation from those of its operands.
bool combine(NodeKind kind, const std::vector<bool>& operands) {
  if (kind == NodeKind::kDifference || kind == NodeKind::kIntersection) {
    bool inside = !operands.empty() && operands[0];
    for (size_t i = 1; i < operands.size(); ++i) {
      inside = inside && operands[i] == (kind == NodeKind::kIntersection);
    }
    return inside;
  }
  for (const bool operand : operands) {
    if (operand) return true;
  }
  return false;
}

bool contains(const Written& tree, Vec3 p) {
  using Kind = Written::Kind;
  if (tree.kind == Kind::kCube) return contains(Shape(Cube{tree.vector, true}), p);
  if (tree.kind == Kind::kSphere) return contains(Shape(Sphere{tree.scalar}), p);
  if (tree.kind == Kind::kHalfspace) return contains(Shape(Halfspace{tree.vector, tree.scalar}), p);
  std::vector<bool> operands;
  if (tree.kind == Kind::kTranslate) p = p - tree.vector;
  for (const Written& child : tree.children) {
    if (!child.background && !child.disabled) operands.push_back(contains(child, p));
  }
  return combine(tree.kind == Kind::kDifference     ? NodeKind::kDifference
                 : tree.kind == Kind::kIntersection ? NodeKind::kIntersection
                                                    : NodeKind::kUnion,
                 operands);
}

bool contains(const Model& model, uint32_t index, Vec3 p) {
  const Node& node = model.nodes[index];
  if (node.kind == NodeKind::kPrimitive) return contains(model.primitives[node.payload].shape, p);
  if (node.kind == NodeKind::kTransform) {
    p = inverse(model.transforms[node.payload]).point(p);
  }
  std::vector<bool> operands;
  for (uint32_t child = index + 1; child < node.end; child = model.nodes[child].end) {
    if (!model.nodes[child].background) operands.push_back(contains(model, child, p));
  }
  return combine(node.kind, operands);
}

void collect_ids(const Written& tree, bool disabled, uint32_t& count, std::vector<uint32_t>& ids) {
  disabled |= tree.disabled;
  if (tree.is_primitive()) {
    ++count;
    if (!disabled) ids.push_back(count);
  }
  for (const Written& child : tree.children) collect_ids(child, disabled, count, ids);
}

/// The text of a model, so exact that reading it gives the same model.
std::string print(const Model& model) {
  std::string text;
  std::vector<uint32_t> ends;
  for (uint32_t i = 1; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    for (; !ends.empty() && ends.back() <= i; ends.pop_back()) text += "}";
    if (node.background) text += "%";
    if (node.highlight) text += "#";
    if (node.kind == NodeKind::kTransform) {
      const Affine& map = model.transforms[node.payload];
      text += "multmatrix([";
      for (int r = 0; r < 3; ++r) {
        text += fmt::format("[{}, {}, {}, {}],", map.row[r].x, map.row[r].y, map.row[r].z,
                            map.translation[r]);
      }
      text += "])";
    } else if (node.kind == NodeKind::kColor) {
      const Rgba& c = model.colors[node.payload];
      text += fmt::format("color([{}, {}, {}, {}])", c.r, c.g, c.b, c.a);
    } else if (node.kind == NodeKind::kPrimitive) {
      const Shape& shape = model.primitives[node.payload].shape;
      if (const auto* const cube = std::get_if<Cube>(&shape)) {
        text += fmt::format("cube([{}, {}, {}], center = {});", cube->size.x, cube->size.y,
                            cube->size.z, cube->center);
      } else if (const auto* const sphere = std::get_if<Sphere>(&shape)) {
        text += fmt::format("sphere({});", sphere->r);
      } else {
        const auto& half = std::get<Halfspace>(shape);
        text += fmt::format("halfspace([{}, {}, {}], {});", half.n.x, half.n.y, half.n.z, half.d);
      }
      continue;
    } else {
      constexpr const char* kNames[] = {"union()", "difference()", "intersection()"};
      text += kNames[static_cast<int>(node.kind)];
    }
    text += "{";
    ends.push_back(node.end);
  }
  return text + std::string(ends.size(), '}');
}

TEST(CsgProperties, TheModelIsTheSolidThatWasWritten) {
  EXPECT_TRUE(rc::check([](uint64_t seed) {
    Random random(seed);
    Written file;
    for (int n = pick(random, 4); n > 0; --n) file.children.push_back(random_tree(random, 5));
    std::string text;
    for (const Written& statement : file.children) print(statement, random, text);
    const Result<Read> read = read_csg(text, "t.csg");
    RC_ASSERT(static_cast<bool>(read));
    const Model& model = read->model;

    uint32_t count = 0;
    std::vector<uint32_t> ids;
    collect_ids(file, false, count, ids);
    std::vector<uint32_t> read_ids;
    for (const Primitive& primitive : model.primitives) read_ids.push_back(primitive.id);
    RC_ASSERT(read_ids == ids);
    RC_ASSERT(model.statement_count == count);

    for (int i = 0; i < 50; ++i) {
      // Off the grid of the faces, so that no rounding can decide.
      const Vec3 p = Vec3{random_number(random), random_number(random), random_number(random)} +
                     Vec3{0.01, 0.02, 0.03};
      RC_ASSERT(contains(model, 0, p) == contains(file, p));
    }
  }));
}

TEST(CsgProperties, AModelPrintedAndReadIsTheSame) {
  // Without empty operands: where one is the only child of a difference it takes a second reading
  // to see that the difference is empty.
  EXPECT_TRUE(rc::check([](uint64_t seed) {
    Random random(seed);
    std::string text;
    for (int n = pick(random, 4); n > 0; --n) print(random_tree(random, 5, 1), random, text);
    const Model once = read_good(text).model;
    const Model twice = read_good(print(once)).model;
    RC_ASSERT(twice.transforms == once.transforms);
    RC_ASSERT(twice.colors == once.colors);
    RC_ASSERT(twice.nodes.size() == once.nodes.size());
    for (size_t i = 0; i < once.nodes.size(); ++i) {
      const Node &a = once.nodes[i], &b = twice.nodes[i];
      RC_ASSERT(a.kind == b.kind);
      RC_ASSERT(a.end == b.end);
      RC_ASSERT(a.payload == b.payload);
      RC_ASSERT(a.background == b.background);
      RC_ASSERT(a.highlight == b.highlight);
    }
  }));
}

TEST(CsgProperties, NoDamageDoesHarm) {
  // To be run with sanitizers too. A text that is still read gives a tree that is well formed.
  EXPECT_TRUE(rc::check([](uint64_t seed) {
    Random random(seed);
    std::string text =
        "$fn = 5; x = [1, 2]; !text(text = \"a\"b\", size = 1);"
        "polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "
        "faces = [[0,1,2],[0,3,1],[1,3,2],[2,3,0]]);";
    print(random_tree(random, 4), random, text);
    constexpr std::string_view kNasty = "[](){};,=\"\\%#!*/-.0e\n\xc2\xff$x";
    for (int n = 1 + pick(random, 8); n > 0 && !text.empty(); --n) {
      const auto at = static_cast<size_t>(pick(random, static_cast<int>(text.size())));
      const auto length = static_cast<size_t>(pick(random, 20));
      const char c = kNasty[static_cast<size_t>(pick(random, static_cast<int>(kNasty.size())))];
      switch (pick(random, 4)) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        case 2:
          text.erase(at, length);
          break;
        default:
          text.insert(at, text.substr(text.size() / 2, length));
      }
    }
    const Result<Read> read = read_csg(text, "t.csg");
    if (!read) {
      RC_ASSERT(read.error().message.starts_with("t.csg:"));
      return;
    }
    const Model& model = read->model;
    RC_ASSERT(model.nodes[0].end == model.nodes.size());
    for (uint32_t i = 0; i < model.nodes.size(); ++i) {
      const Node& node = model.nodes[i];
      RC_ASSERT(node.end > i);
      const size_t table = node.kind == NodeKind::kTransform   ? model.transforms.size()
                           : node.kind == NodeKind::kColor     ? model.colors.size()
                           : node.kind == NodeKind::kPrimitive ? model.primitives.size()
                                                               : 1;
      RC_ASSERT(node.payload < table);
      uint32_t child = i + 1;
      while (child < node.end) child = model.nodes[child].end;
      RC_ASSERT(child == node.end);
    }
  }));
}

}  // namespace
}  // namespace whittle
