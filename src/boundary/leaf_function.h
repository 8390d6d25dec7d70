// What a cell's leaf says where only some of its planes' sides are known.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "boundary/exact_plane.h"
#include "subdivide/cells.h"
#include "subdivide/truth_table.h"

namespace whittle {

/// Where the half-spaces of a scene lie: the plane, and on which side of it the half-space is.
struct PlacedHalfSpace {
  uint32_t plane = 0;
  PlaneSide inside = 0;
};

/// Planes that a few leaves share, by short numbers.
class LocalPlanes {
 public:
  /// There are so many planes in all.
  explicit LocalPlanes(size_t planes) : numbers_(planes, kNone) {}

  void clear();
  uint32_t add(uint32_t plane);
  /// The number of a plane that is among them.
  uint32_t number(uint32_t plane) const { return numbers_[plane]; }
  std::span<const uint32_t> all() const { return planes_; }

 private:
  static constexpr uint32_t kNone = UINT32_MAX;
  std::vector<uint32_t> planes_;
  std::vector<uint32_t> numbers_;  ///< by plane
};

class LeafFunction {
 public:
  struct Literal {
    uint32_t local;
    PlaneSide inside;
    bool negated;
  };
  /// What is left of the function where some sides are known.
  struct State {
    uint64_t table = 0;  ///< of up to kTableLiterals literals
    uint32_t step = 0;   ///< of a program
  };
  struct Answer {
    std::optional<bool> value;
    uint32_t asks = 0;  ///< no value yet: the side of this plane matters
  };

  /// Of a leaf, an empty cell or a full one. Its planes are added to `local`.
  void set(CellLink link, std::span<const PlacedHalfSpace> half_spaces, LocalPlanes& local);

  CellKind kind() const { return link_.kind(); }
  std::span<const Literal> literals() const { return literals_; }

  /// Where nothing is known.
  State start() const { return {has_table() ? link_.leaf().table & rows() : 0, 0}; }
  /// The side of one plane more is known.
  void learn(State& state, uint32_t local_plane, PlaneSide side) const;
  /// `sides`: by local number of plane all that are known, else 0.
  Answer at(State& state, std::span<const PlaneSide> sides) const;

  /// The id of the first body that has a face in a plane; kSharedOwner if none has.
  uint32_t owner(const Scene& scene, uint32_t local_plane) const;

 private:
  bool has_table() const { return is_leaf(link_.kind()) && literals_.size() <= kTableLiterals; }
  uint64_t rows() const { return table_rows(uint32_t(literals_.size())); }
  std::optional<bool> is_inside(const Literal& literal, std::span<const PlaneSide> sides) const;
  Answer by_table(uint64_t table) const;
  Answer by_group(std::span<const PlaneSide> sides) const;
  Answer by_program(std::span<const PlaneSide> sides, uint32_t& at) const;

  CellLink link_;
  std::vector<Literal> literals_;
};

}  // namespace whittle
