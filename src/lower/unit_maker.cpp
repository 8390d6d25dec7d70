#include "lower/unit_maker.h"

#include <algorithm>
#include <cmath>

#include "shape/shape.h"

namespace whittle {
namespace {

/// Below this many faces a primitive is classified face by face anyway, and a ball inside it or
/// boxes around its facets would save nothing.
constexpr size_t kManyFaces = 12;

/// Boundaries with more facets than this are made by all threads together.
constexpr size_t kLargeBoundary = size_t(1) << 14;
constexpr size_t kFacetsEach = size_t(1) << 12;

/// Nodes of a range.
constexpr size_t kFewNodes = 64, kManyNodes = 2048, kMostRanges = 1024;

/// Grows the boxes of a primitive's facets by a share of their diagonal and by a length, both
/// local.
void grow_face_boxes(const Unit& unit, double share, double more, Scene& scene) {
  const Affine& object_from_local = scene.box_frames[unit.box_frame];
  const Affine local_from_object = inverse(object_from_local);
  const auto times = [](const Affine& map, Vec3 v) {
    return Vec3{dot(abs(map.row[0]), v), dot(abs(map.row[1]), v), dot(abs(map.row[2]), v)};
  };
  const Vec3 each{length(object_from_local.row[0]), length(object_from_local.row[1]),
                  length(object_from_local.row[2])};
  for (uint32_t i = 0; i < unit.face_count; ++i) {
    Box& box = scene.face_boxes[unit.first_box + i];
    const Vec3 by = each * (share * length(times(local_from_object, box.size())) + more);
    box = {box.lo - by, box.hi + by};
  }
}

bool has_face_boxes(const Shape& shape, size_t faces) {
  return faces >= kManyFaces && is_flat(shape) && boundary(shape) == nullptr;
}

}  // namespace

void grow_for_moved_planes(const Unit& unit, double moved, Scene& scene) {
  grow_face_boxes(unit, 0.05, kCornersMore * moved, scene);
}

UnitMaker::UnitMaker(const Model& model, const Workers* workers)
    : model_(model),
      workers_(workers),
      ranges_(instance_ranges(
          model, std::clamp(model.nodes.size() / kMostRanges, kFewNodes, kManyNodes))) {}

void UnitMaker::for_ranges(const std::function<void(size_t range)>& body) const {
  for_parts(workers_, ranges_.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t range = first; range < last; ++range) body(range);
  });
}

/// Says how many faces each unit has, and what stands before each range.
void UnitMaker::count(Scene& scene) {
  before_.assign(ranges_.size(), {});
  for_ranges([&](size_t range) {
    InstanceWalk walk(model_, ranges_[range]);
    uint32_t number = ranges_[range].first;
    for (const Instance* next = walk.next(); next != nullptr; next = walk.next(), ++number) {
      Unit unit;
      const Primitive& primitive = model_.primitives[next->primitive];
      unit.id = primitive.id;
      unit.outer = instance_box(model_, *next);
      if (!next->empty && !std::ranges::binary_search(overflowing_, number)) {
        const size_t faces = whittle::face_count(primitive.shape);
        const bool has_boxes = has_face_boxes(primitive.shape, faces);
        unit.face_count = uint32_t(faces);
        before_[range].add({faces, has_boxes ? faces : 0, has_boxes});
      }
      scene.units[number] = unit;
    }
  });
  total_ = {};
  for (Counts& before : before_) {
    const Counts here = before;
    before = total_;
    total_.add(here);
  }
}

Bounds UnitMaker::measure(Scene& scene) {
  scene.units.resize(ranges_.back().first + ranges_.back().count);
  count(scene);
  return bounds(model_, [&](uint32_t instance) { return scene.units[instance].outer; });
}

void UnitMaker::add_face(uint32_t face, uint32_t unit, const HalfSpace& half_space, Scene& scene) {
  scene.half_spaces[face] = half_space;
  scene.faces[face] = {2 * face, unit};
  sieve_->set(face, half_space, reaches_[unit]);
}

void UnitMaker::add_facets(const Surface& surface, Scene& scene, const Workers* workers) {
  const Affine mesh_from_local = inverse(surface.local_from_mesh);
  const std::vector<Plane>& facets = surface.mesh->facets;
  for_parts(workers, facets.size(), kFacetsEach, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i)
      add_face(
          scene.units[surface.unit].first_face + uint32_t(i), surface.unit,
          facet_half_space(facets[i], surface.middle, surface.local_from_mesh, mesh_from_local),
          scene);
  });
}

void UnitMaker::make_units(size_t range, double least_tolerance, Scene& scene, Rare& rare) {
  const Affine local_from_world = translation(-scene.origin);
  Counts before = before_[range];
  LoweredPrimitive lowered;
  InstanceWalk walk(model_, ranges_[range]);
  uint32_t number = ranges_[range].first;
  for (const Instance* next = walk.next_place(); next != nullptr;
       next = walk.next_place(), ++number) {
    Unit& unit = scene.units[number];
    unit.first_face = uint32_t(before.faces);
    if (unit.face_count == 0) {
      unit.outer = {};
      continue;
    }
    const Shape& shape = model_.primitives[next->primitive].shape;
    const Affine local_from_object = local_from_world * next->world_from_object;
    lower_primitive(shape, local_from_object, lowered);
    const TriangleMesh* const mesh = boundary(shape);
    if (mesh == nullptr && lowered.half_spaces.empty()) {
      rare.overflowing.push_back(number);
      continue;
    }
    const Extent extent = within(lowered.extent, scene.region);
    const double tolerance = own_tolerance(scene.tolerance, extent, least_tolerance);
    const double moved = joint_tolerance(scene.tolerance, extent.width, least_tolerance);
    reaches_[number] = {extent.center, extent.radius, extent.width, tolerance,
                        lowered.is_ball ? lowered.extent.radius : 0};
    // What moves a body's faces further is known once all are there.
    const double off = is_exact(shape) ? equal_tolerance(tolerance, least_tolerance) : moved;
    unit.outer = grown(transform(local_from_world, unit.outer), kCornersMore * off);
    if (lowered.tip) rare.tips.emplace_back(unit.first_face, *lowered.tip);
    if (mesh != nullptr) {
      rare.surfaces.push_back({number, mesh, local_from_object,
                               inverse(local_from_object).point(lowered.extent.center)});
      if (unit.face_count <= kLargeBoundary) add_facets(rare.surfaces.back(), scene, nullptr);
    } else {
      for (size_t i = 0; i < lowered.half_spaces.size(); ++i)
        add_face(unit.first_face + uint32_t(i), number, lowered.half_spaces[i], scene);
      if (unit.face_count >= kManyFaces) {
        unit.inner_center = lowered.extent.center;
        unit.inner_radius = std::max(0.0, lowered.extent.width / 2 - moved);
      }
    }
    const bool has_boxes = has_face_boxes(shape, unit.face_count);
    if (has_boxes) {
      unit.first_box = uint32_t(before.boxes);
      unit.box_frame = uint32_t(before.frames);
      scene.box_frames[unit.box_frame] = inverse(local_from_object);
      std::ranges::copy(facet_boxes(shape), scene.face_boxes.begin() + unit.first_box);
      if (is_exact(shape))
        grow_face_boxes(unit, 1e-4, 0, scene);
      else
        grow_for_moved_planes(unit, moved, scene);
    }
    before.add({unit.face_count, has_boxes ? unit.face_count : 0, has_boxes});
  }
}

void UnitMaker::add_tips(const std::vector<Rare>& rare, Scene& scene) const {
  for (const Rare& of_range : rare) {
    for (const auto& [face, tip] : of_range.tips) {
      scene.half_spaces[face].tip = uint32_t(scene.tips.size());
      scene.tips.push_back(tip);
    }
  }
}

void UnitMaker::add_boundaries(const std::vector<Rare>& rare, Scene& scene) {
  std::vector<const Surface*> surfaces;
  for (const Rare& of_range : rare)
    for (const Surface& surface : of_range.surfaces) surfaces.push_back(&surface);
  for (const Surface* surface : surfaces)
    if (scene.units[surface->unit].face_count > kLargeBoundary)
      add_facets(*surface, scene, workers_);
  std::vector<std::optional<Boundary>> made(surfaces.size());
  for_parts(workers_, surfaces.size(), 1, [&](size_t first, size_t last, size_t) {
    for (size_t i = first; i < last; ++i) {
      Unit& unit = scene.units[surfaces[i]->unit];
      unit.boundary = uint32_t(i);
      made[i].emplace(*surfaces[i]->mesh, surfaces[i]->local_from_mesh, unit.first_face);
    }
  });
  scene.boundaries.reserve(made.size());
  for (std::optional<Boundary>& boundary : made) scene.boundaries.push_back(*std::move(boundary));
}

void UnitMaker::make(Scene& scene, double least_tolerance) {
  std::vector<Rare> rare;
  for (bool again = true; again;) {
    scene.half_spaces.resize(total_.faces);
    scene.faces.resize(total_.faces);
    scene.face_boxes.resize(total_.boxes);
    scene.box_frames.resize(total_.frames);
    reaches_.resize(scene.units.size());
    sieve_.emplace(max_component(scene.region.size()) / 2,
                   std::max(scene.tolerance, least_tolerance), total_.faces);
    rare.assign(ranges_.size(), {});
    for_ranges([&](size_t range) { make_units(range, least_tolerance, scene, rare[range]); });
    again = false;
    for (const Rare& of_range : rare) {
      again |= !of_range.overflowing.empty();
      overflowing_.insert(overflowing_.end(), of_range.overflowing.begin(),
                          of_range.overflowing.end());
    }
    // Those have no faces. What stands behind them moves up.
    if (again) count(scene);
  }
  add_tips(rare, scene);
  add_boundaries(rare, scene);
}

std::vector<UnitMaker::Placed> UnitMaker::placed(const Scene& scene,
                                                 std::span<const uint32_t> units) const {
  std::vector<Placed> found(units.size());
  const Affine local_from_world = translation(-scene.origin);
  for_ranges([&](size_t range) {
    uint32_t number = ranges_[range].first;
    size_t i = size_t(std::ranges::lower_bound(units, number) - units.begin());
    InstanceWalk walk(model_, ranges_[range]);
    for (; i < units.size() && units[i] < ranges_[range].first + ranges_[range].count; ++i) {
      const Instance* instance = walk.next_place();
      for (; number < units[i]; ++number) instance = walk.next_place();
      ++number;
      found[i] = {instance->primitive, local_from_world * instance->world_from_object};
    }
  });
  return found;
}

}  // namespace whittle
