#include <algorithm>
#include <compare>
#include <utility>

#include "boundary/face_maker.h"
#include "subdivide/simplify.h"
#include "subdivide/subdivide.h"

namespace whittle {
namespace {

/// A group of more faces is halved, if it is more than one unit.
constexpr size_t kFacesInGroup = 4096;
/// Every body of a group reads the group's formula: so many tokens in all.
constexpr uint64_t kMostTokens = uint64_t(1) << 27;
/// The formulas of groups should get shorter as fast as there are more of them. They may have so
/// many tokens together, and some times those of the scene's.
constexpr size_t kFewTokens = size_t(1) << 20, kMostTimes = 8;

Vec3 middle(const Scene& scene, uint32_t unit) {
  return intersect(scene.units[unit].outer, scene.region).center();
}

bool is_convex(const Scene& scene, uint32_t face) {
  return scene.units[scene.faces[face].unit].is_conjunction();
}

struct PlaneFace {
  uint32_t plane, face;

  auto operator<=>(const PlaneFace&) const = default;
};

/// Holds a face of a convex body.
Box box_of(const Scene& scene, uint32_t face) {
  const Unit& unit = scene.units[scene.faces[face].unit];
  if (unit.first_box == Unit::kNoBoxes) return unit.outer;
  const Box& own = scene.face_boxes[unit.first_box + face - unit.first_face];
  return intersect(unit.outer, transform(inverse(scene.box_frames[unit.box_frame]), own));
}

/// Whether no two of the faces of a plane touch, as far as their boxes tell, and that soon.
bool are_apart(const Scene& scene, std::span<const PlaneFace> faces) {
  constexpr size_t kLooksEach = 64;
  std::vector<Box> boxes;
  for (const PlaneFace& face : faces) {
    if (!is_convex(scene, face.face)) return false;
    if (const Box box = box_of(scene, face.face); !box.is_empty()) boxes.push_back(box);
  }
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.lo.x < b.lo.x; });
  size_t looks = kLooksEach * boxes.size();
  for (size_t i = 0; i < boxes.size(); ++i)
    for (size_t j = i + 1; j < boxes.size() && boxes[j].lo.x <= boxes[i].hi.x; ++j)
      if (looks-- == 0 || overlaps(boxes[i], boxes[j])) return false;
  return true;
}

class UnitGrouper {
 public:
  UnitGrouper(const Scene& scene, const UnitBoxes& boxes, FacePlan* plan)
      : scene_(scene),
        plan_(plan),
        simplifier_(scene, boxes, max_component(scene.region.size()) * kCellMargin) {}

  bool is_large(const UnitGroup& group) const {
    if (group.last - group.first < 2) return false;
    size_t faces = 0;
    for (uint32_t i = group.first; i < group.last && faces <= kFacesInGroup; ++i)
      faces += scene_.units[plan_->units[i]].face_count;
    return faces > kFacesInGroup;
  }

  /// A part of a group; without units if nothing there is boundary.
  UnitGroup part_of(const UnitGroup& whole, uint32_t first, uint32_t last) {
    UnitGroup part{first, last, {}, {}};
    for (uint32_t i = first; i < last; ++i)
      part.box = unite(part.box, intersect(scene_.units[plan_->units[i]].outer, scene_.region));
    if (part.box.is_empty() || simplifier_.simplify(whole.formula, part.box, Expand::kNone,
                                                    part.formula) != Truth::kVaries)
      part.last = first;
    return part;
  }

  std::pair<UnitGroup, UnitGroup> halves(const UnitGroup& group) {
    const int axis = split_axis(group.box.size(), SplitRule::kLongest, 0);
    const uint32_t at = group.first + (group.last - group.first) / 2;
    const auto begin = plan_->units.begin();
    std::nth_element(begin + group.first, begin + at, begin + group.last,
                     [&](uint32_t a, uint32_t b) {
                       const double x = middle(scene_, a)[axis], y = middle(scene_, b)[axis];
                       return x != y ? x < y : a < b;
                     });
    return {part_of(group, group.first, at), part_of(group, at, group.last)};
  }

 private:
  const Scene& scene_;
  FacePlan* const plan_;
  Simplifier simplifier_;
};

size_t tokens_of(const std::vector<UnitGroup>& groups) {
  size_t tokens = 0;
  for (const UnitGroup& group : groups) tokens += group.formula.size();
  return tokens;
}

/// Takes those groups off the plan whose bodies would read too much.
void leave_to_cells(const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
                    std::vector<UnitGroup>& groups, FacePlan& plan) {
  uint64_t tokens = 0;
  std::erase_if(groups, [&](const UnitGroup& group) {
    const uint64_t its = uint64_t(group.last - group.first) * group.formula.size();
    if (its <= kMostTokens - tokens) {
      tokens += its;
      return false;
    }
    for (uint32_t i = group.first; i < group.last; ++i) {
      const Unit& unit = scene.units[plan.units[i]];
      for (uint32_t k = 0; k < unit.face_count; ++k)
        plan.is_whole[half_spaces[scene.faces[unit.first_face + k].literal >> 1].plane] = 0;
    }
    return true;
  });
}

}  // namespace

FacePlan plan_faces(const Scene& scene, std::span<const PlacedHalfSpace> half_spaces,
                    size_t planes) {
  constexpr uint32_t kNone = UINT32_MAX, kSeveral = UINT32_MAX - 1;
  std::vector<uint32_t> only(planes, kNone);  // the face in each plane
  FacePlan plan;
  plan.is_whole.resize(planes);
  std::vector<PlaneFace> shared;
  const auto plane_of = [&](uint32_t face) {
    return half_spaces[scene.faces[face].literal >> 1].plane;
  };
  for (uint32_t face = 0; face < scene.faces.size(); ++face) {
    uint32_t& first = only[plane_of(face)];
    if (first == kNone) {
      first = face;
      continue;
    }
    if (first != kSeveral) shared.push_back({plane_of(face), first});
    first = kSeveral;
    shared.push_back({plane_of(face), face});
  }
  for (size_t plane = 0; plane < planes; ++plane)
    if (only[plane] < kSeveral && is_convex(scene, only[plane]))
      plan.is_whole[plane] = FacePlan::kSingle;
  std::sort(shared.begin(), shared.end());
  for (auto first = shared.begin(); first != shared.end();) {
    const auto last = std::find_if(
        first, shared.end(), [&](const PlaneFace& other) { return other.plane != first->plane; });
    // Where there are bodies of triangles, one of the faces may be left to cells, so all are.
    if (scene.boundaries.empty() && are_apart(scene, {first, last}))
      plan.is_whole[first->plane] = FacePlan::kShared;
    first = last;
  }
  for (uint32_t u = 0; u < scene.units.size(); ++u) {
    const Unit& unit = scene.units[u];
    if (!unit.is_conjunction()) continue;
    const auto is_whole = [&](const Face& face) {
      return plan.is_whole[half_spaces[face.literal >> 1].plane] != 0;
    };
    const auto first = scene.faces.begin() + unit.first_face;
    if (std::any_of(first, first + unit.face_count, is_whole)) plan.units.push_back(u);
  }
  return plan;
}

std::vector<UnitGroup> group_units(const Scene& scene, const UnitBoxes& boxes,
                                   std::span<const PlacedHalfSpace> half_spaces, FacePlan& plan,
                                   const Workers& workers) {
  PerWorker<UnitGrouper> groupers(workers);
  std::vector<UnitGroup> done, open;
  UnitGroup all{0, uint32_t(plan.units.size()), {}, scene.formula};
  all = UnitGrouper(scene, boxes, &plan).part_of(all, all.first, all.last);
  if (all.first < all.last) open.push_back(std::move(all));
  while (!open.empty()) {
    std::vector<std::pair<UnitGroup, UnitGroup>> halves(open.size());
    workers.for_parts(open.size(), 1, [&](size_t first, size_t last, size_t worker) {
      UnitGrouper& grouper = groupers.of(worker, scene, boxes, &plan);
      for (size_t i = first; i < last; ++i)
        if (grouper.is_large(open[i])) halves[i] = grouper.halves(open[i]);
    });
    std::vector<UnitGroup> next;
    for (size_t i = 0; i < open.size(); ++i) {
      auto& [low, high] = halves[i];
      if (!low.box.is_empty() || !high.box.is_empty()) {
        for (UnitGroup* half : {&low, &high})
          if (half->first < half->last) next.push_back(std::move(*half));
      } else {
        done.push_back(std::move(open[i]));
      }
    }
    open = std::move(next);
    if (tokens_of(open) + tokens_of(done) > kFewTokens + kMostTimes * scene.formula.size()) {
      plan = {};
      return {};
    }
  }
  std::sort(done.begin(), done.end(),
            [](const UnitGroup& a, const UnitGroup& b) { return a.first < b.first; });
  leave_to_cells(scene, half_spaces, done, plan);
  return done;
}

}  // namespace whittle
