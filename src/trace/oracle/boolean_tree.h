// The Boolean tree of a model by definition, with the values of all its nodes kept up to date while
// a ray enters and leaves primitives.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace whittle {

/// The operators and operands of a model; what is under `%` is not there. Nodes keep file order.
struct BooleanTree {
  struct Node {
    NodeKind kind = NodeKind::kUnion;
    uint32_t parent = 0;    ///< the root is its own
    uint32_t operands = 0;  ///< how many the node has
    bool is_first = false;  ///< the first operand of its parent
    uint32_t model_node = 0;
  };
  std::vector<Node> nodes;       ///< nodes[0] is the root
  std::vector<uint32_t> leaves;  ///< the primitives' nodes, in the order of instances()
};

BooleanTree make_boolean_tree(const Model& model);

/// Which nodes hold at a point. At first the point is outside every primitive. The tree must
/// outlive it.
class BooleanState {
 public:
  explicit BooleanState(const BooleanTree& tree);

  /// The value of the whole solid.
  bool value() const { return value_[0]; }
  /// Is the point inside this leaf (index into BooleanTree::leaves)?
  bool is_inside(uint32_t leaf) const { return value_[tree_->leaves[leaf]]; }

  /// From here on, changes are remembered against the values of now.
  void begin_step();
  /// Enters or leaves a primitive.
  void flip(uint32_t leaf);
  /// True if the whole solid's value is not what it was at begin_step().
  bool has_changed() const { return is_changed(0); }
  /// The leaf (index into BooleanTree::leaves) that owns the change since begin_step(), by the tie
  /// rule of docs/conventions.md. Precondition: has_changed().
  uint32_t owner();

 private:
  bool is_changed(uint32_t node) const {
    return step_of_[node] == step_ && before_[node] != value_[node];
  }
  void set(uint32_t node, bool value);
  /// Only asked of nodes with operands; without, all are false for ever.
  bool evaluate(uint32_t node) const;

  const BooleanTree* tree_;
  std::vector<uint8_t> value_, first_value_;
  std::vector<uint32_t> true_operands_;  ///< for a difference: of those that are subtracted
  uint64_t step_ = 0;
  std::vector<uint64_t> step_of_;  ///< the last step in which the node was set
  std::vector<uint8_t> before_;    ///< its value when that step began
  std::vector<uint32_t> touched_;  ///< the nodes set in this step
  std::vector<uint32_t> first_changed_;
  std::vector<uint32_t> leaf_of_;
};

}  // namespace whittle
