#include "trace/vulkan/flatten.h"

#include <array>
#include <span>

#include "lower/along_kind.h"
#include "subdivide/refine.h"
#include "trace/vulkan/words.h"

namespace whittle {
namespace {

using shader::kCellWords;
using shader::kHalfSpaceWords;
using shader::OwningStep;
using shader::ShaderLeaf;

/// Where a cell's words say what its leaf is.
constexpr uint32_t kRuleWord = 12;

// Steps of programs are sent as they are, and leaves that have a shader of their own are told apart
// by its case alone.
static_assert(shader::kProgramTrue == kAnswerTrue && shader::kProgramFalse == kAnswerFalse);
static_assert(uint32_t(FormulaCase::kPrograms) - uint32_t(FormulaCase::kConjunctions) ==
              uint32_t(ShaderLeaf::kProgram) - uint32_t(ShaderLeaf::kConjunction));

void add_number(std::vector<uint32_t>& to, double value, bool doubles) {
  const auto words = words_of(value, doubles);
  to.insert(to.end(), words.begin(), words.end());
}

void add_vector(std::vector<uint32_t>& to, Vec3 v, bool doubles) {
  for (int axis = 0; axis < 3; ++axis) add_number(to, v[axis], doubles);
}

class Flattener {
 public:
  Flattener(const Scene& scene, const Wanted& wanted, Refiner& refiner, bool doubles,
            FlatPart& part)
      : scene_(scene), wanted_(wanted), refiner_(refiner), doubles_(doubles), part_(part) {}

  /// Goes down from the cell. Of two children, the one that rays meet first comes first, and
  /// parents come before their children.
  Status run(const Cell& cell, const Box& box) {
    struct Item {
      const Cell* cell;
      Box box;
      TreePlace place;
    };
    std::vector<Item> items{{&cell, box, {}}};
    while (!items.empty()) {
      const Item now = items.back();
      items.pop_back();
      CellLink link = now.cell->link();
      // What has no surface need not be looked at.
      if (link.kind() == CellKind::kEmpty || link.kind() == CellKind::kFull) continue;
      const BoxSight sight = wanted_.sight ? wanted_.sight->look(now.box) : BoxSight::kSome;
      if (sight == BoxSight::kNone || is_hidden(now.box, sight)) {
        part_.at(now.place) = kOpenPlace;
        continue;
      }
      if (link.kind() == CellKind::kOpen) link = refiner_.refined(*now.cell);
      if (link.kind() == CellKind::kNode) {
        const double split = now.cell->split;
        const int axis = link.axis();
        const auto node = uint32_t(part_.nodes.size());
        part_.nodes.push_back({.split = split, .cells = link.children(), .axis = uint8_t(axis)});
        part_.at(now.place) = node;
        const uint32_t first = wanted_.sight && wanted_.sight->starts_above(axis, split) ? 1 : 0;
        for (const uint32_t side : {1 - first, first}) {
          Box half = now.box;
          (side == 0 ? half.hi : half.lo)[axis] = split;
          items.push_back({link.children() + side, half, {node, side}});
        }
      } else if (is_leaf(link.kind())) {
        const auto number = uint32_t(part_.cells.size() / kCellWords);
        part_.at(now.place) = kCellBit | number;
        add_cell(now.box, link.kind(), link.leaf());
        if (wanted_.sight)
          part_.visible.push_back({number, part_.cases.back(), sight == BoxSight::kWide});
      }
    }
    prune();
    if (too_large_) {
      return Error{ErrorKind::kMachine,
                   "a cell has more half-spaces than the vulkan backends take in one"};
    }
    if (too_nested_) {
      return Error{ErrorKind::kMachine,
                   "faces that coincide are nested too deeply for the vulkan backends"};
    }
    return Done{};
  }

 private:
  bool is_hidden(const Box& box, BoxSight sight) const {
    return wanted_.solved && sight == BoxSight::kSome &&
           wanted_.solved->holds(wanted_.sight->pixels(box));
  }

  /// Nodes without anything below them are nothing. Children stand after their parents.
  void prune() {
    const auto is_bare = [&](uint32_t what) {
      return is_node(what) && part_.nodes[what].child[0] == kNoChild &&
             part_.nodes[what].child[1] == kNoChild;
    };
    for (size_t i = part_.nodes.size(); i-- > 0;)
      for (uint32_t& child : part_.nodes[i].child)
        if (is_bare(child)) child = kNoChild;
    if (is_bare(part_.root)) part_.root = kNoChild;
  }

  void add_cell(const Box& box, CellKind kind, const Leaf& leaf) {
    if (leaf.literal_count > shader::kMostLiterals) too_large_ = true;
    const auto first_literal = uint32_t(part_.words.size());
    for (const LeafLiteral& literal : leaf.literals())
      part_.words.insert(part_.words.end(), {literal.literal, literal.owner});
    add_owning_steps(leaf);
    std::array<uint32_t, 2> rule{};
    ShaderLeaf shader_kind = ShaderLeaf::kConjunction;
    switch (kind) {
      case CellKind::kConjunction:
        break;
      case CellKind::kDisjunction:
        shader_kind = ShaderLeaf::kDisjunction;
        break;
      case CellKind::kTable:
        shader_kind = ShaderLeaf::kTable;
        rule = {uint32_t(leaf.table), uint32_t(leaf.table >> 32)};
        break;
      default:
        shader_kind = ShaderLeaf::kProgram;
        rule[0] = uint32_t(part_.words.size());
        for (const Step& step : leaf.steps())
          part_.words.insert(part_.words.end(), {step.literal, step.on_true, step.on_false});
    }
    part_.cases.push_back(leaf_case(scene_, kind, leaf));
    part_.leaves.push_back(&leaf);
    add_vector(part_.cells, box.lo, doubles_);
    add_vector(part_.cells, box.hi, doubles_);
    part_.cells.insert(
        part_.cells.end(),
        {first_literal, uint32_t(shader_kind) | leaf.literal_count << shader::kLeafBits, rule[0],
         rule[1]});
  }

  /// The leaf's formula with group ends written out, so that no shader needs a stack of them.
  void add_owning_steps(const Leaf& leaf) {
    std::vector<uint32_t>& to = part_.words;
    const size_t count = to.size();
    to.push_back(0);
    size_t depth = 0;
    const auto add = [&](OwningStep kind, uint32_t operand, uint32_t owner) {
      to.insert(to.end(), {uint32_t(kind) | operand << shader::kStepBits, owner});
      ++to[count];
    };
    const auto enter = [&](const Operand& group) {
      add(group.token().kind() == TokenKind::kAnd ? OwningStep::kBeginAnd : OwningStep::kBeginOr, 0,
          0);
      // The outermost group is one level, the conjunction around it another.
      if (++depth >= shader::kMostNested) too_nested_ = true;
    };
    const auto leave = [&] {
      add(OwningStep::kEnd, 0, 0);
      --depth;
    };
    const auto add_literal = [&](const Operand& operand) {
      const Token token = operand.token();
      const Face& face = scene_.faces[token.payload()];
      const bool complement = bool(face.literal & 1) != token.negated();
      const uint32_t half_space = face.literal >> 1, owner = scene_.units[face.unit].id;
      const std::span<const LeafLiteral> literals = leaf.literals();
      uint32_t at = 0;
      while (at < literals.size() && literals[at].literal >> 1 != half_space) ++at;
      // A literal may itself stand for the complement.
      if (at < literals.size())
        add(complement != bool(literals[at].literal & 1) ? OwningStep::kNotLiteral
                                                         : OwningStep::kLiteral,
            at, owner);
      else
        add(complement ? OwningStep::kNotElsewhere : OwningStep::kElsewhere, half_space, owner);
    };
    walk(leaf.tokens(), enter, add_literal, leave);
  }

  const Scene& scene_;
  const Wanted& wanted_;
  Refiner& refiner_;
  bool doubles_;
  bool too_nested_ = false, too_large_ = false;
  FlatPart& part_;
};

}  // namespace

std::vector<uint32_t> flatten_half_spaces(const Scene& scene, bool doubles) {
  std::vector<uint32_t> to;
  to.reserve(scene.half_spaces.size() * kHalfSpaceWords);
  const double edge = max_component(scene.region.size());
  for (const HalfSpace& h : scene.half_spaces) {
    const size_t first = to.size();
    add_vector(to, h.has_tip() ? scene.tips[h.tip] : h.center, doubles);
    to.insert(to.end(), {uint32_t(along_kind(h, edge)), 0});
    if (h.is_plane()) {
      add_vector(to, h.f.b, doubles);
    } else if (h.kind == SurfaceKind::kSphere) {
      add_number(to, h.f.diag.x, doubles);
      add_number(to, h.f.c, doubles);
    } else {
      add_vector(to, h.f.diag, doubles);
      add_vector(to, h.f.off, doubles);
      if (!h.has_tip()) {
        add_vector(to, h.f.b, doubles);
        add_number(to, h.f.c, doubles);
      }
    }
    to.resize(first + kHalfSpaceWords);
  }
  return to;
}

Status flatten(const Scene& scene, const Cell& cell, const Box& box, const Wanted& wanted,
               Refiner& refiner, bool doubles, FlatPart& part) {
  return Flattener(scene, wanted, refiner, doubles, part).run(cell, box);
}

void append(FlatPart& part, TreePlace place, uint32_t cells, uint32_t words, FlatCells& whole) {
  const auto first_node = uint32_t(whole.nodes.size());
  const uint32_t first_cell = cells + uint32_t(whole.cells.size() / kCellWords);
  const uint32_t first_word = words + uint32_t(whole.words.size());
  const auto moved = [&](uint32_t what) {
    return is_cell(what) ? what + first_cell : is_node(what) ? what + first_node : what;
  };
  for (size_t at = 0; at < part.cells.size(); at += kCellWords) {
    uint32_t* const rule = &part.cells[at + kRuleWord];
    rule[0] += first_word;
    constexpr uint32_t kKindMask = (1u << shader::kLeafBits) - 1;
    if ((rule[1] & kKindMask) == uint32_t(ShaderLeaf::kProgram)) rule[2] += first_word;
  }
  for (FlatNode& node : part.nodes)
    for (uint32_t& child : node.child) child = moved(child);
  for (VisibleCell& visible : part.visible) visible.cell += first_cell;
  whole.at(place) = moved(part.root);
  whole.nodes.insert(whole.nodes.end(), part.nodes.begin(), part.nodes.end());
  whole.cases.insert(whole.cases.end(), part.cases.begin(), part.cases.end());
  whole.leaves.insert(whole.leaves.end(), part.leaves.begin(), part.leaves.end());
  whole.cells.insert(whole.cells.end(), part.cells.begin(), part.cells.end());
  whole.words.insert(whole.words.end(), part.words.begin(), part.words.end());
}

}  // namespace whittle
