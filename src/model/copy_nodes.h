// Trees made of parts of others: nodes with what they name, one after the other in preorder.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace whittle {

/// Writes the nodes of a new model. The source must outlive it; its tables keep what they hold.
class NodeCopier {
 public:
  /// Begins with nodes[0], a union without a mark.
  NodeCopier(const Model& from, Model& to);

  /// Adds a node of the source without what stands below it, and without its mark, as the next one
  /// within the innermost open one. It is open until close_before() says otherwise.
  void open(uint32_t node);
  /// Adds a transform, or a colour, that the source does not have; it is open until its child
  /// `node` ends.
  void open_transform(const Affine& map, uint32_t node);
  void open_color(const Rgba& color, uint32_t node);
  /// Ends what is open and ends, in the source, at a node or before it.
  void close_before(uint32_t node);
  /// Ends all that is open.
  void finish();

 private:
  struct Open {
    uint32_t source_end = 0, node = 0;
  };
  void open_around(NodeKind kind, uint32_t payload, uint32_t node);

  const Model& from_;
  Model& to_;
  std::vector<Open> open_;
};

}  // namespace whittle
