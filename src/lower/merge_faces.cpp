#include "lower/merge_faces.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

#include "lower/merge.h"

namespace whittle {
namespace {

constexpr size_t kFacesEach = size_t(1) << 14;

/// The outlines of walls, made again when they are asked for.
class Outlines {
 public:
  /// `faces` rise. Only those that are curved have outlines.
  Outlines(const Model& model, const UnitMaker& made, const Scene& scene,
           std::span<const uint32_t> faces)
      : model_(model), scene_(scene) {
    for (const uint32_t face : faces)
      if (!scene.half_spaces[face].is_plane()) units_.push_back(scene.faces[face].unit);
    if (!units_.empty()) placed_ = made.placed(scene, units_);
  }

  /// Calls test(points) for the outline of one face.
  template <class Test>
  bool test(uint32_t face, const Test& test) {
    const auto unit = std::ranges::lower_bound(units_, scene_.faces[face].unit);
    const UnitMaker::Placed& placed = placed_[size_t(unit - units_.begin())];
    return test(wall_outline(model_.primitives[placed.primitive].shape, placed.local_from_object));
  }

 private:
  const Model& model_;
  const Scene& scene_;
  std::vector<uint32_t> units_;  ///< with walls, of which each has one
  std::vector<UnitMaker::Placed> placed_;
};

/// What has become of one of the faces that have others near them.
struct Found {
  Literal literal = 0;  ///< by the face that its half-space was written for
  float moved = 0;      ///< by how much that may differ
};

/// Merges some faces, which rise.
std::vector<Found> merge_some(const Model& model, const UnitMaker& made, double least_tolerance,
                              const Scene& scene, std::span<const uint32_t> faces) {
  Outlines outlines(model, made, scene, faces);
  FaceMerger merger(scene.region, scene.tolerance, least_tolerance);
  std::vector<Literal> written(faces.size());
  std::vector<uint32_t> first_of;  // by surface as it was written: its first face
  for (size_t i = 0; i < faces.size(); ++i) {
    const uint32_t face = faces[i];
    written[i] = merger.add(scene.half_spaces[face], made.reach(scene.faces[face].unit),
                            [&](const auto& test) { return outlines.test(face, test); });
    if (written[i] >> 1 == first_of.size()) first_of.push_back(face);
  }
  // The faces by surface.
  std::vector<uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  const auto surface_of = [&](uint32_t i) { return written[i] >> 1; };
  std::ranges::stable_sort(order, {}, surface_of);
  const FaceMerger::Merged merged = merger.merge([&](uint32_t surface) -> Outline {
    return [&, surface](const auto& test) {
      const auto first = std::ranges::lower_bound(order, surface, {}, surface_of);
      const auto last = std::ranges::upper_bound(order, surface, {}, surface_of);
      return std::all_of(first, last, [&](uint32_t i) { return outlines.test(faces[i], test); });
    };
  });
  std::vector<Found> found(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) {
    const Literal literal = merged.literals[written[i] >> 1] ^ (written[i] & 1);
    found[i] = {2 * first_of[literal >> 1] + (literal & 1), merged.moved[written[i] >> 1]};
  }
  return found;
}

/// Leaves out the half-spaces of some faces, which rise, and moves the rest up.
void leave_out(std::span<const uint32_t> gone, Scene& scene) {
  if (gone.empty()) return;
  const auto begin = scene.half_spaces.begin();
  auto to = begin + gone[0];
  for (size_t i = 0; i < gone.size(); ++i) {
    const auto from = begin + gone[i] + 1;
    to = std::move(from, i + 1 < gone.size() ? begin + gone[i + 1] : scene.half_spaces.end(), to);
  }
  scene.half_spaces.erase(to, scene.half_spaces.end());
}

/// Units grow by as much as merging may have moved their faces. `of_unit`: its faces' part of what
/// was found.
void grow(Unit& unit, uint32_t first, std::span<const uint32_t> faces, std::span<const Found> found,
          Scene& scene) {
  bool moved = false;
  float by = 0;
  for (size_t i = first; i < faces.size() && faces[i] < unit.first_face + unit.face_count; ++i) {
    moved |= found[i].literal >> 1 != faces[i];
    by = std::max(by, found[i].moved);
  }
  if (by > 0) unit.outer = grown(unit.outer, kCornersMore * by);
  if (moved && unit.first_box != Unit::kNoBoxes) grow_for_moved_planes(unit, by, scene);
}

}  // namespace

void merge_faces(const Model& model, UnitMaker& made, double least_tolerance,
                 const Workers* workers, Scene& scene) {
  const auto reach_of = [&](uint32_t face) -> const Reach& {
    return made.reach(scene.faces[face].unit);
  };
  const std::vector<uint32_t> faces =
      made.sieve().with_others(scene.half_spaces, reach_of, workers);
  const std::vector<Found> found = merge_some(model, made, least_tolerance, scene, faces);
  std::vector<uint32_t> gone;
  for (size_t i = 0; i < faces.size(); ++i) {
    if (found[i].literal >> 1 != faces[i]) gone.push_back(faces[i]);
    Unit& unit = scene.units[scene.faces[faces[i]].unit];
    if (i == 0 || faces[i - 1] < unit.first_face) grow(unit, uint32_t(i), faces, found, scene);
  }
  if (gone.empty()) return;
  leave_out(gone, scene);
  const auto number_of = [&](uint32_t face) {
    return face - uint32_t(std::ranges::lower_bound(gone, face) - gone.begin());
  };
  for_parts(workers, scene.faces.size(), kFacesEach, [&](size_t first, size_t last, size_t) {
    size_t next = size_t(std::ranges::lower_bound(gone, uint32_t(first)) - gone.begin());
    for (size_t face = first; face < last; ++face) {
      if (next < gone.size() && gone[next] == face) {
        ++next;
        continue;
      }
      scene.faces[face].literal = 2 * uint32_t(face - next);
    }
  });
  for (size_t i = 0; i < faces.size(); ++i)
    scene.faces[faces[i]].literal = 2 * number_of(found[i].literal >> 1) + (found[i].literal & 1);
}

}  // namespace whittle
