#include "trace/vulkan/flatten.h"

#include <array>
#include <bit>
#include <span>

namespace whittle {
namespace {

/// What shaders/scene.glsl calls them.
enum ShaderLeaf : uint32_t { kShaderConjunction, kShaderDisjunction, kShaderTable, kShaderProgram };
/// And what shaders/resolve.comp calls the steps to an owner.
enum OwningStep : uint32_t {
  kBeginAnd,
  kBeginOr,
  kEnd,
  kLiteral,
  kNotLiteral,
  kElsewhere,
  kNotElsewhere
};

class Flattener {
 public:
  Flattener(const Scene& scene, const CellTree& tree, bool doubles)
      : scene_(scene), tree_(tree), doubles_(doubles) {}

  Result<FlatCells> run() {
    flat_.region = tree_.region;
    for (const HalfSpace& h : scene_.half_spaces) add_half_space(h);
    if (tree_.root != nullptr) add_cells();
    if (too_large_) {
      return Error{ErrorKind::kMachine,
                   "a cell has more half-spaces than the vulkan backends take in one"};
    }
    if (too_nested_) {
      return Error{ErrorKind::kMachine,
                   "faces that coincide are nested too deeply for the vulkan backends"};
    }
    return std::move(flat_);
  }

 private:
  void add_number(std::vector<uint32_t>& to, double value) const {
    if (doubles_) {
      const auto bits = std::bit_cast<uint64_t>(value);
      to.insert(to.end(), {uint32_t(bits), uint32_t(bits >> 32)});
    } else {
      to.insert(to.end(), {std::bit_cast<uint32_t>(float(value)), 0});
    }
  }
  void add_vector(std::vector<uint32_t>& to, Vec3 v) const {
    for (int axis = 0; axis < 3; ++axis) add_number(to, v[axis]);
  }

  void add_half_space(const HalfSpace& h) {
    std::vector<uint32_t>& to = flat_.half_spaces;
    const size_t first = to.size();
    const ShaderSurface kind = shader_surface(scene_, h);
    add_vector(to, h.center);
    to.insert(to.end(), {uint32_t(kind), 0});
    if (kind == ShaderSurface::kPlane) {
      add_vector(to, h.f.b);
    } else if (kind == ShaderSurface::kSphere) {
      add_number(to, h.f.diag.x);
      add_number(to, h.f.c);
    } else {
      add_vector(to, h.f.diag);
      add_vector(to, h.f.off);
      add_vector(to, h.f.b);
      add_number(to, h.f.c);
    }
    to.resize(first + kHalfSpaceWords);
  }

  /// Walks the tree from the root down, so parents come before children.
  void add_cells() {
    struct Open {
      const Cell* cell;
      Box box;
      uint32_t parent, side;  ///< whose child this becomes
    };
    std::vector<Open> open{{tree_.root, tree_.region, kNoChild, 0}};
    const auto attach = [&](const Open& to, uint32_t child) {
      (to.parent == kNoChild ? flat_.root : flat_.nodes[to.parent].child[to.side]) = child;
    };
    while (!open.empty()) {
      const Open now = open.back();
      open.pop_back();
      const CellLink link = now.cell->link();
      WHITTLE_CHECK(link.kind() != CellKind::kOpen);
      if (link.kind() == CellKind::kNode) {
        const double split = now.cell->split;
        const auto node = uint32_t(flat_.nodes.size());
        flat_.nodes.push_back({split, {kNoChild, kNoChild}, uint8_t(link.axis())});
        attach(now, node);
        for (uint32_t side = 0; side < 2; ++side) {
          Box box = now.box;
          (side == 0 ? box.hi : box.lo)[link.axis()] = split;
          open.push_back({link.children() + side, box, node, side});
        }
      } else if (link.kind() >= CellKind::kConjunction) {
        attach(now, kCellBit | flat_.cell_count());
        add_cell(now.box, link.kind(), link.leaf());
      }
    }
    prune();
  }

  /// Nodes without anything below them are nothing. Children stand after their parents.
  void prune() {
    const auto is_bare = [&](uint32_t child) {
      return child < kCellBit && flat_.nodes[child].child[0] == kNoChild &&
             flat_.nodes[child].child[1] == kNoChild;
    };
    for (size_t i = flat_.nodes.size(); i-- > 0;)
      for (uint32_t& child : flat_.nodes[i].child)
        if (is_bare(child)) child = kNoChild;
    if (is_bare(flat_.root)) flat_.root = kNoChild;
  }

  void add_cell(const Box& box, CellKind kind, const Leaf& leaf) {
    if (leaf.literal_count > kMostLiterals) too_large_ = true;
    const auto first_literal = uint32_t(flat_.words.size());
    for (const LeafLiteral& literal : leaf.literals())
      flat_.words.insert(flat_.words.end(), {literal.literal, literal.owner});
    add_owning_steps(leaf);
    std::array<uint32_t, 2> rule{};
    ShaderLeaf shader_kind = kShaderConjunction;
    switch (kind) {
      case CellKind::kConjunction:
        break;
      case CellKind::kDisjunction:
        shader_kind = kShaderDisjunction;
        break;
      case CellKind::kTable:
        shader_kind = kShaderTable;
        rule = {uint32_t(leaf.table), uint32_t(leaf.table >> 32)};
        break;
      default:
        shader_kind = kShaderProgram;
        rule[0] = uint32_t(flat_.words.size());
        for (const Step& step : leaf.steps())
          flat_.words.insert(flat_.words.end(), {step.literal, step.on_true, step.on_false});
    }
    flat_.cases.push_back(leaf_case(scene_, kind, leaf));
    add_vector(flat_.cells, box.lo);
    add_vector(flat_.cells, box.hi);
    flat_.cells.insert(flat_.cells.end(),
                       {first_literal, shader_kind | leaf.literal_count << 2, rule[0], rule[1]});
  }

  /// The leaf's formula with group ends written out, so that no shader needs a stack of them.
  void add_owning_steps(const Leaf& leaf) {
    std::vector<uint32_t>& to = flat_.words;
    const size_t count = to.size();
    to.push_back(0);
    std::vector<uint32_t> ends;
    const auto add = [&](OwningStep kind, uint32_t operand, uint32_t owner) {
      to.insert(to.end(), {kind | operand << 3, owner});
      ++to[count];
    };
    for (uint32_t i = 0; i <= leaf.token_count; ++i) {
      for (; !ends.empty() && ends.back() == i; ends.pop_back()) add(kEnd, 0, 0);
      if (i == leaf.token_count) break;
      const Token token = leaf.tokens()[i];
      if (token.is_pass()) continue;
      if (token.is_group()) {
        add(token.kind() == TokenKind::kAnd ? kBeginAnd : kBeginOr, 0, 0);
        ends.push_back(i + token.payload());
        // The outermost group is one level, the conjunction around it another.
        if (ends.size() >= kMostNested) too_nested_ = true;
        continue;
      }
      const Face& face = scene_.faces[token.payload()];
      const bool complement = bool(face.literal & 1) != token.negated();
      const uint32_t half_space = face.literal >> 1, owner = scene_.units[face.unit].id;
      const std::span<const LeafLiteral> literals = leaf.literals();
      uint32_t at = 0;
      while (at < literals.size() && literals[at].literal >> 1 != half_space) ++at;
      // A literal may itself stand for the complement.
      if (at < literals.size())
        add(complement != bool(literals[at].literal & 1) ? kNotLiteral : kLiteral, at, owner);
      else
        add(complement ? kNotElsewhere : kElsewhere, half_space, owner);
    }
  }

  const Scene& scene_;
  const CellTree& tree_;
  bool doubles_;
  bool too_nested_ = false, too_large_ = false;
  FlatCells flat_;
};

}  // namespace

Result<FlatCells> flatten(const Scene& scene, const CellTree& tree, bool doubles) {
  return Flattener(scene, tree, doubles).run();
}

}  // namespace whittle
