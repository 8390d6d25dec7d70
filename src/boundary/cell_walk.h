// The cells as a complex: leaves with their sides as planes, and where two of them touch.
#pragma once

#include <vector>

#include "boundary/piece_maker.h"

namespace whittle {

struct WalkedLeaf {
  CellLink link;
  CellSides sides;
};

/// Where a side of one cell and a side of another lie on one another.
struct Contact {
  CellLink below, above;  ///< beyond the region all is empty
  int axis;
  CellSides rectangle;  ///< on `axis` both are the plane between the two
};

/// The leaves of a tree in which no cell is open. Splits are added to the planes.
std::vector<WalkedLeaf> walk_leaves(const CellTree& tree, const ExactGrid& grid,
                                    PlaneTable& planes);

/// The contacts for which `is_wanted(below, above, plane between)` holds, in a fixed order. The
/// planes know all splits.
template <class IsWanted>
std::vector<Contact> walk_contacts(const CellTree& tree, const ExactGrid& grid,
                                   const PlaneTable& planes, const IsWanted& is_wanted);

namespace cell_walk {

struct Range {
  Vec3 lo, hi;
  CellSides sides;

  void set_lo(int axis, double at, uint32_t plane) {
    lo[axis] = at, sides.lo[size_t(axis)] = plane;
  }
  void set_hi(int axis, double at, uint32_t plane) {
    hi[axis] = at, sides.hi[size_t(axis)] = plane;
  }
};

/// A cell, or (above != null) two cells that touch in a rectangle.
struct Item {
  const Cell* cell;  ///< null: what is beyond the region
  const Cell* above;
  bool is_contact;
  int axis;
  Range range;
};

inline CellLink link_of(const Cell* cell) {
  return cell == nullptr ? CellLink(CellKind::kEmpty, nullptr) : cell->link();
}

/// What touches in a contact of which one cell at least is split.
template <class PlaneOf>
void open_contact(const Item& item, const PlaneOf& plane_of, std::vector<Item>& stack) {
  const CellLink below = link_of(item.cell), above = link_of(item.above);
  const bool opens_below = below.kind() == CellKind::kNode;
  const CellLink link = opens_below ? below : above;
  const Cell* const node = opens_below ? item.cell : item.above;
  const auto with = [&](const Cell* part) {
    Item next = item;
    (opens_below ? next.cell : next.above) = part;
    return next;
  };
  const Cell *low = link.children(), *high = link.children() + 1;
  const int cut = link.axis();
  if (cut == item.axis) {
    stack.push_back(with(opens_below ? high : low));
  } else if (node->split <= item.range.lo[cut]) {
    stack.push_back(with(high));
  } else if (node->split >= item.range.hi[cut]) {
    stack.push_back(with(low));
  } else {
    const uint32_t plane = plane_of(cut, node->split);
    Item upper = with(high), lower = with(low);
    upper.range.set_lo(cut, node->split, plane);
    lower.range.set_hi(cut, node->split, plane);
    stack.push_back(upper);
    stack.push_back(lower);
  }
}

Range region_range(const CellTree& tree, const ExactGrid& grid, const PlaneTable& planes);

}  // namespace cell_walk

template <class IsWanted>
std::vector<Contact> walk_contacts(const CellTree& tree, const ExactGrid& grid,
                                   const PlaneTable& planes, const IsWanted& is_wanted) {
  using namespace cell_walk;
  std::vector<Contact> contacts;
  std::vector<Item> stack;
  if (tree.root == nullptr) return contacts;
  const auto plane_of = [&](int axis, double at) {
    return planes.find(grid.square_plane(axis, at));
  };
  const Range whole = region_range(tree, grid, planes);
  for (int axis = 0; axis < 3; ++axis) {
    Range low = whole, high = whole;
    low.set_hi(axis, low.lo[axis], low.sides.lo[size_t(axis)]);
    high.set_lo(axis, high.hi[axis], high.sides.hi[size_t(axis)]);
    stack.push_back({nullptr, tree.root, true, axis, low});
    stack.push_back({tree.root, nullptr, true, axis, high});
  }
  stack.push_back({tree.root, nullptr, false, 0, whole});
  while (!stack.empty()) {
    const Item item = stack.back();
    stack.pop_back();
    const CellLink link = link_of(item.cell);
    if (!item.is_contact) {
      if (link.kind() != CellKind::kNode) continue;
      const int axis = link.axis();
      const uint32_t plane = plane_of(axis, item.cell->split);
      Item low = item, high = item;
      low.cell = link.children(), high.cell = link.children() + 1;
      low.range.set_hi(axis, item.cell->split, plane);
      high.range.set_lo(axis, item.cell->split, plane);
      Item contact{low.cell, high.cell, true, axis, low.range};
      contact.range.set_lo(axis, item.cell->split, plane);
      stack.push_back(high);
      stack.push_back(low);
      stack.push_back(contact);
      continue;
    }
    const CellLink above = link_of(item.above);
    if (link.kind() == CellKind::kNode || above.kind() == CellKind::kNode)
      open_contact(item, plane_of, stack);
    else if (is_wanted(link, above, item.range.sides.lo[size_t(item.axis)]))
      contacts.push_back({link, above, item.axis, item.range.sides});
  }
  return contacts;
}

}  // namespace whittle
