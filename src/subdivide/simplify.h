// Simplifies a formula to what matters in a cell, from the formula of the cell around it.
//
// Based on: the paper, section 2.2.1 (pruning sub-trees whose surface does not meet the cell), over
// half-spaces instead of primitives: what the cell lies inside or outside of becomes a constant,
// constants are propagated, groups left with one operand vanish.
#pragma once

#include <span>
#include <vector>

#include "lower/scene.h"
#include "subdivide/classify.h"
#include "subdivide/formula_size.h"
#include "subdivide/local_bsp.h"
#include "subdivide/near_triangles.h"
#include "subdivide/unit_boxes.h"

namespace whittle {

/// Which primitives are replaced by what they say in a cell.
enum class Expand : uint8_t {
  kNone,   ///< none: all stay whole
  kLarge,  ///< those that are no smaller than the cell; no boundaries
  kUnits,  ///< all but boundaries
  kAll,    ///< all: the formula is of faces only. It serves a leaf; parts of the cell had better be
           ///< simplified from one in which boundaries are whole.
};

/// Formulas that would have no more literals than this get all their primitives expanded.
inline constexpr uint32_t kExpandAll = 64;
/// `literals`: those that a formula would have with all its primitives expanded.
constexpr Expand expand_of(uint32_t literals) {
  return literals <= kExpandAll ? Expand::kUnits : Expand::kLarge;
}

enum class Truth : uint8_t { kFalse, kTrue, kVaries };

class Simplifier {
 public:
  /// `boxes` are the scene's. `margin`: how far a cell is grown before anything is classified,
  /// local units.
  Simplifier(const Scene& scene, const UnitBoxes& boxes, double margin)
      : scene_(scene), boxes_(boxes), margin_(margin), bsp_(scene) {}

  /// Writes to `out` the formula that equals `in` at every point of `cell`, operands in the same
  /// order; returns its truth, and leaves `out` empty if that is constant. `in` and `out` must not
  /// overlap; boundaries must be whole in `in`. Linear in `in` and the faces looked at; what a
  /// decided group holds is skipped.
  ///
  /// `near`: triangles that reach the cell around, a row of NearTriangles of `in`.
  Truth simplify(std::span<const Token> in, const Box& cell, Expand expand, Formula& out,
                 std::span<const uint32_t> near = {});

  /// Literals that the formula written last would have with all its primitives expanded in the cell
  /// it was written for, and whether there are boundaries in it with too many to count; each of
  /// these counts as kManyLiterals.
  struct Size {
    uint32_t literals = 0;
    bool is_crowded = false;
  };
  Size size_of(std::span<const Token> written) const;
  /// The triangles that reach that cell: the row of NearTriangles of that formula.
  void list_near(std::span<const Token> written, std::vector<uint32_t>& near) const;

 private:
  /// What an operand that was kept amounts to for the group around it.
  struct Kept {
    uint32_t operands = 1;    ///< more than one if its own operands join that group
    uint32_t header = kNone;  ///< in `out`, if it is a group of the other kind
    uint32_t in_group = 0;    ///< that group's operands
  };
  struct Open {
    TokenKind kind;
    uint32_t in_end;
    uint32_t header;        ///< in `out`
    uint32_t operands = 0;  ///< kept so far
    Kept last;              ///< the last of them
  };
  static constexpr uint32_t kNone = UINT32_MAX;

  Truth unit(Token token, const CellBox& cell, double cell_edge, Expand expand, Formula& out,
             Kept& kept);
  Truth boundary(Token token, const CellBox& cell, Expand expand, Formula& out, Kept& kept);
  template <class FaceAt>
  Truth conjunction(FaceAt&& face_at, uint32_t count, bool negated, const CellBox& cell,
                    Formula& out);
  bool settle_pairs(const CellBox& cell, size_t first, Formula& out) const;
  void drop_far_facets(const Unit& unit, const CellBox& cell, size_t first, Formula& out) const;
  bool meets(std::span<const Token> faces, const CellBox& cell) const;
  template <class Visit>
  void for_each_counted(std::span<const Token> written, const Visit& visit) const;
  Kept close_group(const Open& group, Formula& out) const;
  bool joins_group_around(TokenKind kind, size_t depth) const;

  const Scene& scene_;
  const UnitBoxes& boxes_;
  double margin_;
  bool tight_ = false;  ///< few operands are looked at, so that each may take its time
  std::vector<Open> open_;
  LocalBsp bsp_;
  /// Boundaries that stayed whole, and their half-spaces in the cell; some may have gone since.
  struct Counted {
    uint32_t unit, half_spaces;
    uint32_t first, number;  ///< of its triangles, in listed_; or NearTriangles::kMany
  };
  std::vector<Counted> counted_;
  std::vector<uint32_t> listed_;
  NearTriangles near_;  ///< the cell's around; what is left of it
};

}  // namespace whittle
