// When a cell is worth splitting, and what its parts may take: the cost model of the subdivision
// (docs/decisions/0014-leaf-size.md).
#pragma once

#include <span>

#include "subdivide/leaf.h"
#include "subdivide/open_cell.h"
#include "subdivide/simplify.h"
#include "subdivide/subdivide.h"

namespace whittle {

/// A ray that meets a box meets a part of it about as often as the part has surface of it.
double half_area(const Box& box);

class SplitRules {
 public:
  SplitRules(const Scene& scene, const SubdivideSettings& settings);

  /// What is known about a cell before its formula is looked at.
  struct Outlook {
    double rays = 0;        ///< that will meet it, about
    bool is_small = false;  ///< it is below the threshold, if there is one,
    bool must_end = false;  ///< or is not split for another reason
    bool is_long = false;   ///< splitting it comes before making a leaf of its formula is tried
  };
  Outlook outlook(const OpenCell& open) const;
  /// Whether a leaf of this formula needs no further splits.
  bool is_simple(const LeafAnalysis& analysis, const Outlook& outlook) const;

  /// What a cell takes if it is not split, at most. Its literals may be many and their half-spaces
  /// few.
  size_t bytes_unsplit(size_t literals, size_t words) const;
  /// Words that a formula takes at most, in the cell it is for or in a part of it, with the
  /// triangles that are listed.
  size_t most_words(std::span<const Token> formula) const;

  /// Gives each of the parts that are open (null: decided) its share of what the parent may take,
  /// when cells took `cell_bytes`, and notes whether splits stall. `splits` lead to each of them.
  void share(const OpenCell& parent, std::span<OpenCell* const> parts, size_t cell_bytes,
             uint32_t splits) const;

 private:
  const Scene& scene_;
  const SubdivideSettings& settings_;
  const double region_edge_;
  const bool is_auto_;
};

}  // namespace whittle
