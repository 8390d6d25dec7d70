// Makes the units of a scene and their faces, as they were written: every primitive by itself, on
// all threads. Which of the faces lie on others is decided after that (merge_faces.h).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/uninitialized.h"
#include "base/workers.h"
#include "lower/face_sieve.h"
#include "lower/fingerprint.h"
#include "lower/primitive_faces.h"
#include "lower/scene.h"
#include "model/instances.h"

namespace whittle {

/// Merging may move a face; corners move by more than the faces that meet there.
inline constexpr double kCornersMore = 10;

inline Box grown(const Box& box, double margin) {
  const Vec3 all{margin, margin, margin};
  return {box.lo - all, box.hi + all};
}

/// Merging may move a plane by the tolerance, and so a facet's corner by much more where it meets
/// its neighbours at small angles. So may the digits of a file, but for bodies that are made of
/// numbers. Boxes that are too large only cost time.
void grow_for_moved_planes(const Unit& unit, double moved, Scene& scene);

/// The two steps are for one scene, in this order.
class UnitMaker {
 public:
  /// Without workers all is done on this thread.
  UnitMaker(const Model& model, const Workers* workers);

  /// Bounds of the model. The scene gets its units, of which nothing but boxes is known.
  Bounds measure(Scene& scene);
  size_t face_count() const { return total_.faces; }

  /// Once the scene's origin, region and tolerance are known: its units and faces, and of each face
  /// the half-space that it was written as, by its number. `least_tolerance`: see ray_tolerance().
  void make(Scene& scene, double least_tolerance);

  FaceSieve& sieve() { return *sieve_; }
  const Reach& reach(uint32_t unit) const { return reaches_[unit]; }

  /// A primitive where it stands.
  struct Placed {
    uint32_t primitive = 0;
    Affine local_from_object;
  };
  /// Those of some units, which rise.
  std::vector<Placed> placed(const Scene& scene, std::span<const uint32_t> units) const;

 private:
  /// Of units, or of all before a range.
  struct Counts {
    size_t faces = 0, boxes = 0, frames = 0;
    void add(const Counts& more) {
      faces += more.faces, boxes += more.boxes, frames += more.frames;
    }
  };
  struct Surface {
    uint32_t unit;
    const TriangleMesh* mesh;
    Affine local_from_mesh;
    Vec3 middle;  ///< of the mesh, its own coordinates
  };
  /// What a range has few of.
  struct Rare {
    std::vector<std::pair<uint32_t, Vec3>> tips;  ///< by face
    std::vector<Surface> surfaces;
    std::vector<uint32_t> overflowing;  ///< units
  };

  void for_ranges(const std::function<void(size_t range)>& body) const;
  void count(Scene& scene);
  void make_units(size_t range, double least_tolerance, Scene& scene, Rare& rare);
  void add_face(uint32_t face, uint32_t unit, const HalfSpace& half_space, Scene& scene);
  void add_facets(const Surface& surface, Scene& scene, const Workers* workers);
  void add_tips(const std::vector<Rare>& rare, Scene& scene) const;
  void add_boundaries(const std::vector<Rare>& rare, Scene& scene);

  const Model& model_;
  const Workers* workers_;
  std::vector<InstanceRange> ranges_;
  std::vector<Counts> before_;  ///< by range
  Counts total_;
  std::vector<uint32_t> overflowing_;  ///< units whose numbers do; they are empty
  UninitializedVector<Reach> reaches_;
  std::optional<FaceSieve> sieve_;
};

}  // namespace whittle
