// Solves one leaf along one ray, once it is known how each literal behaves there.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "subdivide/cells.h"

namespace whittle {

/// A ray in local coordinates; t counts from its origin.
struct LocalRay {
  Vec3 origin, direction;
};

/// Whether a ray is in the solid, as far as it has come.
enum class Inside : int8_t { kNo, kYes, kUnknown };

/// Where the solid changes along a ray.
struct Change {
  double t;
  uint32_t id;          ///< owner primitive
  uint32_t half_space;  ///< whose surface is there
  bool turned;          ///< the solid is on the other side of it than the half-space
  bool enters;          ///< beyond it is the solid
};

/// How a half-space's sign behaves on the way from t0 to t1 of several rays, one bit a ray. It is
/// one word because it is written and read as a whole: a load wider than the stores before it would
/// wait for them (a store-forwarding stall).
class LaneSigns {
 public:
  LaneSigns() = default;
  LaneSigns(uint32_t inside, uint32_t changes, uint32_t bends)
      : word_(inside | changes << 8 | bends << 16) {}

  /// The ray is inside the half-space at t0.
  uint32_t inside() const { return word_ & 0xff; }
  /// And not at t1, or the reverse: one crossing between.
  uint32_t changes() const { return word_ >> 8 & 0xff; }
  /// It leaves and comes back (or enters and leaves): two crossings.
  uint32_t bends() const { return word_ >> 16; }

 private:
  uint32_t word_ = 0;
};

/// The same for one ray.
struct LiteralOnRay {
  Kernels<double>::AlongRay along;
  bool inside, changes, bends;
};

inline bool literal_value(const LeafLiteral& literal, bool is_inside) {
  return is_inside != bool(literal.literal & 1);
}

/// All leaves it is given must outlive it: it remembers some by their address.
class LeafSolver {
 public:
  explicit LeafSolver(const Scene& scene);

  /// Takes up a leaf, and the way of a ray through it: what each literal does on the way from t0 to
  /// t1. `on_ray(i)` gives a LiteralOnRay; its polynomial is needed only where it crosses.
  template <class OnRay>
  void take(CellKind kind, const Leaf& leaf, double t0, double t1, const OnRay& on_ray) {
    kind_ = kind;
    leaf_ = &leaf;
    crossings_.clear();
    is_inside_.resize(leaf.literal_count);
    for (uint32_t i = 0; i < leaf.literal_count; ++i) {
      const LiteralOnRay literal = on_ray(i);
      is_inside_[i] = literal.inside;
      if (literal.changes || literal.bends) add_crossings(i, literal, t0, t1);
    }
    sort_crossings();
    start();
  }

  /// Whether the leaf taken differs at t0 from what its neighbour said. Then the literal whose
  /// surface is nearest brought the ray here: that is the change.
  bool differs(Inside inside) const;
  Change change_at_start(const LocalRay& ray, double t0, uint32_t nearest);

  /// Finds the next t in (t0, t1] at which the solid in the leaf taken changes. If there is none,
  /// or none any more, false, and `inside` tells the value at t1. Crossings at equal t, or nearly
  /// so (ray_tolerance()), coincide.
  bool next_change(const LocalRay& ray, Inside& inside, Change& change);

  /// The owner (id) of a change by the crossing of one literal alone, in a leaf with a truth table;
  /// kSharedOwner if it depends on more than `state`, bit i of which says "inside literal i" after
  /// the crossing.
  uint32_t owner_of(const Leaf& leaf, uint64_t state, uint32_t literal);

  /// Times that a leaf differed at t0 from what its neighbour had said.
  uint64_t disagreements = 0;

 private:
  struct Crossing {
    double t;
    uint32_t literal;
  };
  void add_crossings(uint32_t number, const LiteralOnRay& literal, double t0, double t1);
  void sort_crossings();
  void start();
  void flip(uint32_t literal);
  bool value();
  bool program_value();
  /// Of a group of coincident crossings that changed the solid, the number of the decisive one: the
  /// first without which the solid would not have changed, or which alone would have changed it.
  /// (Surfaces that are no part of the solid here may be in the group.) 0 if there is none.
  size_t decisive(std::span<const Crossing> group);
  /// The first crossing of the group tells the owner, unless it has several.
  Change describe(const LocalRay& ray, double t, std::span<const Crossing> group,
                  bool solid_after) const;
  /// The face that owns a change which several primitives share (docs/conventions.md, tie rules).
  const Face& owner(const Leaf& leaf, std::span<const LeafLiteral> literals, Vec3 point,
                    std::span<const Crossing> group) const;

  /// What owner_of() has found out; leaves are asked the same again and again. A leaf's address
  /// names it: leaves never move (cells.h).
  struct KnownOwner {
    const Leaf* leaf = nullptr;
    uint64_t state = 0;
    uint32_t literal = 0, id = 0;
  };
  static constexpr size_t kKnownOwners = 256;

  const Scene& scene_;
  std::array<KnownOwner, kKnownOwners> known_owners_;
  const double ray_tolerance_;  ///< crossings closer than this coincide
  CellKind kind_ = CellKind::kTable;
  const Leaf* leaf_ = nullptr;
  std::vector<uint8_t> is_inside_;   ///< by literal: inside the half-space itself, at this point
  std::vector<Crossing> crossings_;  ///< in (t0, t1], sorted
  size_t next_ = 0;                  ///< of the crossings, the first that is yet to come
  bool solid_ = false;               ///< before it
  uint64_t state_ = 0;               ///< kTable: the bits of is_inside_
  uint32_t count_ = 0;               ///< conjunction, disjunction: literals that are true
  // kProgram: the answer depends on the literals on the path to it alone. When one of them flips,
  // the program runs again from the first step that looks at it.
  std::vector<uint32_t> path_;     ///< the steps on the way
  std::vector<uint32_t> on_path_;  ///< by literal: where it stands there first, if it does
  size_t known_ = 0;               ///< steps that are right
  bool answer_ = false;
};

}  // namespace whittle
