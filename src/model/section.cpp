#include "model/section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/affine.h"

namespace whittle {
namespace {

/// Whether the material of a subtree is to be cut: bits, so that they can be joined.
constexpr uint8_t kNothing = 0, kStays = 1, kIsCut = 2, kMixed = kStays | kIsCut;

bool is_same(const Rgba& a, const Rgba& b) {
  constexpr float kStep = 0.6f / 255;
  return std::fabs(a.r - b.r) <= kStep && std::fabs(a.g - b.g) <= kStep &&
         std::fabs(a.b - b.b) <= kStep;
}

/// Only the first operand of a difference or an intersection gives material.
bool takes_first_alone(NodeKind kind) {
  return kind == NodeKind::kDifference || kind == NodeKind::kIntersection;
}

/// For each node, what its material asks for.
std::vector<uint8_t> find_shares(const Model& model, std::span<const Rgba> kept) {
  struct Scope {
    uint32_t node = 0;
    bool has_operand = false;
    std::optional<uint8_t> by_color;  ///< what the outermost colour says
  };
  std::vector<uint8_t> shares(model.nodes.size(), kNothing);
  std::vector<Scope> open;
  const auto give = [&](uint32_t node) {
    if (open.empty() || model.nodes[node].background) return;
    Scope& parent = open.back();
    if (!parent.has_operand || !takes_first_alone(model.nodes[parent.node].kind))
      shares[parent.node] |= shares[node];
    parent.has_operand = true;
  };
  const auto close_before = [&](uint32_t i) {
    while (!open.empty() && model.nodes[open.back().node].end <= i) {
      const uint32_t node = open.back().node;
      open.pop_back();
      give(node);
    }
  };
  for (uint32_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    close_before(i);
    std::optional<uint8_t> by_color = open.empty() ? std::nullopt : open.back().by_color;
    if (node.kind == NodeKind::kColor && !by_color && model.colors[node.payload].is_valid()) {
      const Rgba& color = model.colors[node.payload];
      const bool stays =
          std::ranges::any_of(kept, [&](const Rgba& k) { return is_same(k, color); });
      by_color = stays ? kStays : kIsCut;
    }
    if (node.kind == NodeKind::kPrimitive) {
      shares[i] = by_color.value_or(kIsCut);
      give(i);
    } else {
      open.push_back({i, false, by_color});
    }
  }
  close_before(uint32_t(model.nodes.size()));
  return shares;
}

/// Writes the nodes again, with what takes away beside what is to be cut.
class Cutter {
 public:
  Cutter(const Model& model, std::span<const Section> sections, std::vector<uint8_t> shares)
      : in_(model), sections_(sections), shares_(std::move(shares)) {
    out_.file = in_.file;
    out_.transforms = in_.transforms;
    out_.colors = in_.colors;
    out_.primitives = in_.primitives;
    out_.statement_count = in_.statement_count;
    out_.view = in_.view;
    out_.cut = in_.cut;
    if (!out_.cut)
      out_.cut = Cut{uint32_t(in_.primitives.size()), in_.statement_count + 1, in_.statement_count};
    out_.nodes.reserve(in_.nodes.size() + 8);
  }

  Model run() {
    // The root stays a union of all statements.
    enter(0, {});
    uint32_t i = 1;
    while (i < in_.nodes.size()) {
      leave_before(i);
      i = divide(i);
    }
    leave_before(uint32_t(in_.nodes.size()));
    out_.cut->last_plane = out_.statement_count;
    return std::move(out_);
  }

 private:
  /// A node whose operands are looked at one by one.
  struct Scope {
    uint32_t node = 0, written = 0;
    bool has_operand = false;
    Affine world_from_inside;
  };

  void enter(uint32_t node, const Affine& world_from_inside) {
    open_.push_back({node, uint32_t(out_.nodes.size()), false, world_from_inside});
    out_.nodes.push_back(in_.nodes[node]);
  }
  void leave_before(uint32_t i) {
    while (!open_.empty() && in_.nodes[open_.back().node].end <= i) {
      close(open_.back().written);
      open_.pop_back();
    }
  }
  uint32_t begin(NodeKind kind) {
    Node node;
    node.kind = kind;
    out_.nodes.push_back(node);
    return uint32_t(out_.nodes.size() - 1);
  }
  void close(uint32_t written) { out_.nodes[written].end = uint32_t(out_.nodes.size()); }

  void copy(uint32_t first, uint32_t last) {
    const uint32_t moved = uint32_t(out_.nodes.size()) - first;
    for (uint32_t i = first; i < last; ++i) {
      Node node = in_.nodes[i];
      node.end += moved;
      out_.nodes.push_back(node);
    }
  }

  /// An operand of the innermost scope; returns where the next one that is to be looked at is.
  uint32_t divide(uint32_t i) {
    const Node& node = in_.nodes[i];
    Scope& scope = open_.back();
    const bool first_alone = takes_first_alone(in_.nodes[scope.node].kind);
    const uint8_t share =
        node.background || (first_alone && scope.has_operand) ? kNothing : shares_[i];
    scope.has_operand |= !node.background;
    if (share == kMixed) {
      Affine world_from_inside = scope.world_from_inside;
      if (node.kind == NodeKind::kTransform)
        world_from_inside = world_from_inside * in_.transforms[node.payload];
      enter(i, world_from_inside);
      return i + 1;
    }
    uint32_t last = node.end;
    if (share != kIsCut) {
      copy(i, last);
      return last;
    }
    // Neighbours that are cut share what cuts them.
    const uint32_t end = in_.nodes[scope.node].end;
    const auto joins = [&](uint32_t next) {
      return in_.nodes[next].background || shares_[next] == kIsCut || shares_[next] == kNothing;
    };
    while (!first_alone && last < end && joins(last)) last = in_.nodes[last].end;
    cut(i, last, scope.world_from_inside);
    return last;
  }

  void cut(uint32_t first, uint32_t last, const Affine& world_from_inside) {
    const uint32_t difference = begin(NodeKind::kDifference);
    const uint32_t all = begin(NodeKind::kUnion);
    copy(first, last);
    close(all);
    for (const Section& section : sections_) {
      if (section.planes.empty()) continue;
      const uint32_t corner = begin(NodeKind::kIntersection);
      for (const Plane& plane : section.planes) take_away(plane, world_from_inside);
      close(corner);
    }
    close(difference);
  }

  void take_away(const Plane& plane, const Affine& world_from_inside) {
    // n.(A p + t) >= d is (-A'n).p <= n.t - d.
    const Vec3 n = world_from_inside.transposed_vector(plane.n);
    const double d = plane.d - dot(plane.n, world_from_inside.translation);
    const uint32_t written = begin(NodeKind::kPrimitive);
    out_.nodes[written].payload = uint32_t(out_.primitives.size());
    close(written);
    out_.primitives.push_back({Halfspace{-n, -d}, ++out_.statement_count});
  }

  const Model& in_;
  std::span<const Section> sections_;
  const std::vector<uint8_t> shares_;
  std::vector<Scope> open_;
  Model out_;
};

}  // namespace

Result<Plane> cutting_plane(Vec3 n, double d) {
  const auto refused = [](std::string why) { return Error{ErrorKind::kUsage, std::move(why)}; };
  if (!is_finite(n) || !std::isfinite(d)) return refused("a plane that cuts has finite numbers");
  // Divided first, so that no square overflows or vanishes.
  const double largest = max_component(abs(n));
  if (!(largest > 0)) return refused("the direction n has no length");
  const Vec3 scaled = n / largest;
  const double l = length(scaled);
  const Plane plane{scaled / l, d / largest / l};
  if (std::fabs(plane.d) <= kFarthestSection) return plane;
  return refused(fmt::format("the plane is farther out than {:g}", kFarthestSection));
}

Result<Model> cut_open(const Model& model, std::span<const Section> sections,
                       std::span<const Rgba> kept) {
  if (model.drawing) {
    return Error{ErrorKind::kUsage,
                 model.file + ": error: is flat; only a solid can be cut open (--section)"};
  }
  return Cutter(model, sections, find_shares(model, kept)).run();
}

Model uncut(const Model& model) {
  Model whole = model;
  if (!whole.cut) return whole;
  for (uint32_t i = 0; i < whole.nodes.size(); ++i) {
    Node& node = whole.nodes[i];
    if (node.kind != NodeKind::kPrimitive || node.payload < whole.cut->first_primitive) continue;
    // A union of nothing takes nothing away.
    node.kind = NodeKind::kUnion;
    node.payload = 0;
  }
  whole.primitives.resize(whole.cut->first_primitive);
  whole.statement_count = written_statements(model);
  whole.cut.reset();
  return whole;
}

uint32_t written_statements(const Model& model) {
  return model.cut ? model.cut->first_plane - 1 : model.statement_count;
}

}  // namespace whittle
