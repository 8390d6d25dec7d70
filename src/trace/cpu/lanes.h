// Rays in vector lanes. A tile of rays walks through the cells as one; its rays are computed in
// packets, as many at once as a vector holds doubles. The instruction set is chosen at run time,
// and all give the same bits.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/uninitialized.h"
#include "kernels/constants.h"
#include "subdivide/refine.h"
#include "trace/cpu/cpu.h"
#include "trace/cpu/solve.h"

namespace whittle {

/// A half-space as the lanes read it, a cache line each. Quadrics have the rest in the scene.
struct alignas(64) LaneHalfSpace {
  Vec3 center;  ///< cones: the tip
  Vec3 v;       ///< plane: Quadric::b; sphere: v.x is the scale; kDiagonal: Quadric::diag
  double c = 0;
  AlongKind kind = AlongKind::kPlane;
};

/// A scene and its cells, prepared for rays. Both must outlive it.
struct LaneScene {
  /// Made on all workers, if there are any.
  LaneScene(const Scene& scene, const CellTree& tree, const Workers* workers = nullptr);

  const Scene& scene;
  const CellTree& tree;
  double edge;           ///< the longest of the region
  double ray_tolerance;  ///< crossings closer than this coincide
  Box clip;              ///< rays are cut to it: the region and half the margin
  UninitializedVector<LaneHalfSpace> half_spaces;  ///< by number
  /// False: every ray is solved by itself, by LeafSolver, whose answers lanes must have. For tests.
  bool solves_in_lanes = true;
};

inline constexpr size_t kMaxLanes = 8;
inline constexpr size_t kTileRays = 256;  ///< rays in a tile, at most
inline constexpr size_t kGroupRays = 64;  ///< of them, in a group that is solved in one go, at most

/// Places of hits one after the other.
inline constexpr std::array<uint32_t, kTileRays> kInOrder = [] {
  std::array<uint32_t, kTileRays> places{};
  for (uint32_t i = 0; i < kTileRays; ++i) places[i] = i;
  return places;
}();

/// A leaf with more literals than this is long: of its literals nothing is kept but signs, and the
/// rest is computed again where it is needed.
inline constexpr size_t kKeptLiterals = 64;
/// Programs of more steps than this are run for each ray by itself.
inline constexpr size_t kMostSteps = 128;

/// f of one half-space along the rays of a group.
struct alignas(64) GroupAlong {
  double a[kGroupRays], h[kGroupRays], k[kGroupRays], about[kGroupRays];
};

/// Where the solid changes along a ray of a tile that goes on.
struct LaneChange {
  /// A change between two cells that disagree: id and surface are not known.
  static constexpr uint32_t kNoHalfSpace = UINT32_MAX;
  uint32_t ray;  ///< in the tile
  Change change;
};

/// What one thread needs besides the scene and the cells.
struct LaneScratch {
  explicit LaneScratch(const LaneScene& scene) : refiner(scene.tree), solver(scene.scene) {}

  RefinerLease refiner;
  LeafSolver solver;
  // Of the leaf at hand. A long one may have millions of literals, so only signs are kept of it.
  std::array<GroupAlong, kKeptLiterals> along;  ///< by literal
  /// By literal, one for each packet of a group.
  std::array<LaneSigns, kKeptLiterals * kGroupRays / kMaxLanes> signs;
  std::vector<LaneSigns> long_signs;  ///< by literal, of one packet
  std::vector<LaneChange> changes;    ///< of a tile of rays that go on
  TraceStats stats;
};

/// Rays of a packet that meet something in a leaf: how they come there, and between which t.
struct LeafRecord {
  CellLink leaf;
  uint32_t packet;
  uint32_t lanes, known, solid;
  alignas(64) double t0[kMaxLanes], t1[kMaxLanes];
};
/// Of the rays of one tile.
using TileRecord = std::vector<LeafRecord>;

/// Traces the rays through `positions`, at most kTileRays; it is fast if they are close to one
/// another. The hit of positions[i] is written to hits[places[i]]. Fills the record, if there is
/// one.
void trace_lanes(const LaneScene& scene, const Camera& camera,
                 std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                 LaneScratch& scratch, TileRecord* record = nullptr);

/// The hits of any rays, which had better be close to one another; hits.size() == rays.size().
void trace_lanes(const LaneScene& scene, std::span<const Ray> rays, Hit* hits,
                 LaneScratch& scratch);

/// Adds all crossings of any rays, which had better be close to one another.
void cross_lanes(const LaneScene& scene, std::span<const Ray> rays, RayCrossings& found,
                 LaneScratch& scratch);

/// The same hits from what trace_lanes() recorded with the same instruction set: no walk, only the
/// leaves in which something is met.
void retrace_lanes(const LaneScene& scene, const Camera& camera,
                   std::span<const PixelPosition> positions, const uint32_t* places, Hit* hits,
                   LaneScratch& scratch, const TileRecord& record);

}  // namespace whittle
