#include "subdivide/bsp_formula.h"

namespace whittle {

void BspFormula::find_forms(const CellPolygons& in, const BspTree& tree,
                            const PartWindings& windings) {
  const auto form_of_child = [&](uint32_t child) {
    if ((child & BspTree::kPart) == 0) return forms_[child];
    return windings.of(child & ~BspTree::kPart) != 0 ? Form::kTrue : Form::kFalse;
  };
  const auto form_of = [&](const BspTree::Node& node) {
    const Form front = form_of_child(node.child[0]), back = form_of_child(node.child[1]);
    const Side cell = in.planes[node.plane].cell;
    if (cell != Side::kCrosses) {
      const Form form = cell == Side::kInside ? back : front;
      if (form == Form::kFalse || form == Form::kTrue) return form;
      return cell == Side::kInside ? Form::kOnlyBack : Form::kOnlyFront;
    }
    const bool front_is_known = front == Form::kFalse || front == Form::kTrue;
    const bool back_is_known = back == Form::kFalse || back == Form::kTrue;
    if (front_is_known && back_is_known) {
      if (front == back) return front;
      return back == Form::kTrue ? Form::kBehind : Form::kInFront;
    }
    if (front_is_known) return front == Form::kFalse ? Form::kAnd : Form::kOrNot;
    if (back_is_known) return back == Form::kFalse ? Form::kAndNot : Form::kOr;
    return Form::kBoth;
  };
  forms_.resize(tree.nodes().size());
  // Children stand behind their parents.
  for (size_t i = forms_.size(); i-- > 0;) forms_[i] = form_of(tree.nodes()[i]);
}

/// From the tree to tokens, from the top, every group in one of the other kind.
void BspFormula::write(const Scene& scene, const CellPolygons& in, const BspTree& tree,
                       const PartWindings& windings, bool negated) {
  find_forms(in, tree, windings);
  tokens_.clear();
  operands_ = 0;
  tasks_.clear();
  const auto literal = [&](const BspTree::Node& node, bool behind) {
    const CellPolygons::Plane& plane = in.planes[node.plane];
    const bool is_complement = scene.faces[plane.face].literal & 1;
    // The face says: behind the plane, or if it is the complement, in front of it.
    tokens_.push_back(
        Token::make(TokenKind::kFace, plane.face, (behind == is_complement) != negated));
  };
  // Opens a group, unless it stands in one of its own kind, and puts its two operands in it.
  const auto group = [&](const Task& task, TokenKind kind, Task first, Task second) {
    if (negated) kind = kind == TokenKind::kAnd ? TokenKind::kOr : TokenKind::kAnd;
    const bool joins = task.depth > 0 && task.around == kind;
    const uint32_t depth = joins ? task.depth : task.depth + 1;
    if (!joins) {
      if (task.depth == 1) ++operands_;
      tasks_.push_back({What::kClose, kind, depth, uint32_t(tokens_.size())});
      tokens_.push_back(Token::make(kind, 0));
    }
    first.around = second.around = kind;
    first.depth = second.depth = depth;
    tasks_.push_back(second);
    tasks_.push_back(first);
  };
  tasks_.push_back({What::kNode, TokenKind::kAnd, 0, 0});
  while (!tasks_.empty()) {
    const Task task = tasks_.back();
    tasks_.pop_back();
    if (task.what == What::kClose) {
      tokens_[task.at] = Token::make(task.around, uint32_t(tokens_.size()) - task.at);
      continue;
    }
    const BspTree::Node& node = tree.nodes()[task.at];
    const auto of = [&](What what) { return Task{what, {}, 0, task.at}; };
    const auto child = [&](int side) { return Task{What::kNode, {}, 0, node.child[side]}; };
    const auto alone = [&](bool behind) {
      if (task.depth == 1) ++operands_;
      literal(node, behind);
    };
    switch (task.what) {
      case What::kBehind:
        alone(true);
        break;
      case What::kInFront:
        alone(false);
        break;
      case What::kBackHalf:
        group(task, TokenKind::kAnd, of(What::kBehind), child(1));
        break;
      case What::kFrontHalf:
        group(task, TokenKind::kAnd, of(What::kInFront), child(0));
        break;
      default:
        switch (forms_[task.at]) {
          case Form::kFalse:
          case Form::kTrue: {
            // Only the root: within, constants have gone.
            const bool value = (forms_[task.at] == Form::kTrue) != negated;
            tokens_.push_back(Token::make(value ? TokenKind::kAnd : TokenKind::kOr, 1));
            break;
          }
          case Form::kOnlyFront:
          case Form::kOnlyBack:
            tasks_.push_back({What::kNode, task.around, task.depth,
                              node.child[forms_[task.at] == Form::kOnlyBack ? 1 : 0]});
            break;
          case Form::kBehind:
            alone(true);
            break;
          case Form::kInFront:
            alone(false);
            break;
          case Form::kAnd:
            group(task, TokenKind::kAnd, of(What::kBehind), child(1));
            break;
          case Form::kAndNot:
            group(task, TokenKind::kAnd, of(What::kInFront), child(0));
            break;
          case Form::kOr:
            group(task, TokenKind::kOr, of(What::kBehind), child(0));
            break;
          case Form::kOrNot:
            group(task, TokenKind::kOr, of(What::kInFront), child(1));
            break;
          case Form::kBoth:
            group(task, TokenKind::kOr, of(What::kBackHalf), of(What::kFrontHalf));
            break;
        }
    }
  }
}

}  // namespace whittle
