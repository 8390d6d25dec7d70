#include "boundary/evaluate_solid.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/timing.h"
#include "boundary/cell_walk.h"
#include "boundary/collapse.h"
#include "boundary/face_maker.h"
#include "boundary/fill_faces.h"
#include "boundary/finish.h"
#include "boundary/paints.h"
#include "boundary/piece_collector.h"
#include "subdivide/subdivide.h"
#include "subdivide/unit_boxes.h"

namespace whittle {
namespace {

bool has_plane(CellLink link, std::span<const PlacedHalfSpace> half_spaces, uint32_t plane) {
  if (!is_leaf(link.kind())) return false;
  const std::span<const LeafLiteral> literals = link.leaf().literals();
  return std::any_of(literals.begin(), literals.end(), [&](const LeafLiteral& literal) {
    return half_spaces[literal.literal >> 1].plane == plane;
  });
}

/// The lowest id of those that own a part of a sheet, by sheet.
std::vector<Pieces::Owner> first_owners(std::vector<Pieces::Owner> owners) {
  std::sort(owners.begin(), owners.end());
  const auto is_same = [](const auto& a, const auto& b) { return a.sheet == b.sheet; };
  owners.erase(std::unique(owners.begin(), owners.end(), is_same), owners.end());
  return owners;
}

/// The first half-space of every plane that bounds one.
std::vector<uint32_t> first_half_spaces(std::span<const PlacedHalfSpace> half_spaces,
                                        const Paints& paints, size_t planes) {
  std::vector<uint32_t> firsts(planes);
  for (size_t i = half_spaces.size(); i-- > 0;) firsts[half_spaces[i].plane] = uint32_t(i);
  paints.spread(firsts);
  return firsts;
}

/// Only planes have facets, and only what has an end fits into a file.
Status check_solid(const Scene& scene) {
  if (!scene.bounded)
    return Error{ErrorKind::kInput, "the solid has no end, so no file holds all of it"};
  const auto is_curved = [](const HalfSpace& h) { return !h.is_plane(); };
  if (std::any_of(scene.half_spaces.begin(), scene.half_spaces.end(), is_curved))
    return Error{ErrorKind::kInput, "there are true curves in it, which have no facets"};
  return Done{};
}

uint64_t pairs_in(const std::vector<WalkedLeaf>& leaves) {
  uint64_t pairs = 0;
  for (const WalkedLeaf& leaf : leaves) {
    const uint64_t literals = leaf.link.leaf().literals().size();
    pairs += literals * literals;
  }
  return pairs;
}

/// How much there is of pieces, to go back to.
class PieceMark {
 public:
  explicit PieceMark(const Pieces& pieces)
      : points_(pieces.points.size()),
        edges_(pieces.edges.size()),
        owners_(pieces.owners.size()),
        count_(pieces.count) {}

  void go_back(Pieces& pieces) const {
    pieces.points.resize(points_);
    pieces.edges.resize(edges_);
    pieces.owners.resize(owners_);
    pieces.count = count_;
  }

 private:
  size_t points_, edges_, owners_, count_;
};

/// The contacts that are asked what lies between their cells: those of which a leaf has a plane
/// there, those in planes that are to be asked, or all in which something may; none in planes that
/// are left out.
std::vector<Contact> contacts_of(const CellTree& tree, const ExactGrid& grid,
                                 const PlaneTable& planes,
                                 std::span<const PlacedHalfSpace> half_spaces,
                                 std::span<const uint8_t> left_out,
                                 const std::vector<bool>& asked_planes, bool asks_all) {
  return walk_contacts(tree, grid, planes, [&](CellLink below, CellLink above, uint32_t plane) {
    if (plane < left_out.size() && left_out[plane] != 0) return false;
    if (!is_leaf(below.kind()) && !is_leaf(above.kind())) return below.kind() != above.kind();
    return asks_all || asked_planes[plane] || has_plane(below, half_spaces, plane) ||
           has_plane(above, half_spaces, plane);
  });
}

/// Cells for faces rather than rays: each plane of a leaf is cut by all others, and each split cuts
/// the faces that it meets.
SubdivideSettings cells_for_faces() {
  constexpr uint32_t kPlanes = 24;
  SubdivideSettings settings;
  settings.leaf_size = kPlanes;
  settings.least_use = 0;
  settings.smallest_edge = 1e-6;
  return settings;
}

constexpr double kMade = 0.4, kWithin = 0.5, kBetween = 0.6, kJoined = 0.7, kFilled = 0.9;

Error too_much() {
  return {ErrorKind::kInput, "its surfaces cross one another in too many places"};
}

/// One solid's boundary, step by step.
class SolidEvaluation {
 public:
  SolidEvaluation(const Scene& scene, const Workers& workers, BoundaryStats& stats,
                  const BoundarySettings& settings)
      : scene_(scene),
        workers_(workers),
        stats_(stats),
        settings_(settings),
        grid_(scene.region),
        half_spaces_(placed(scene, grid_, workers, planes_)),
        paints_(scene, half_spaces_, settings.paints, planes_),
        geometry_(planes_),
        collector_(workers, {settings.stop, settings.progress, settings.pieces}) {}

  Result<SolidMesh> run() {
    if (settings_.whole_faces) plan_ = plan_faces(scene_, half_spaces_, planes_.size());
    if (Status made = make_faces(); !made) return made.error();
    if (is_stopped(kMade)) return SolidMesh{};
    Result<FaceOutlines> outlines = join_with_cells();
    if (!outlines && !plan_.units.empty() && !is_too_much_ && !settings_.stop.stop_requested()) {
      // Bodies of triangles say by a hair's breadth different things in cells and here.
      plan_ = {};
      pieces_ = {};
      stats_.asked_all_contacts = false;
      stats_.whole_planes = 0;
      outlines = join_with_cells();
    }
    if (is_stopped(kFilled)) return SolidMesh{};
    if (!outlines) return outlines.error();
    return finished(*outlines);
  }

 private:
  static std::vector<PlacedHalfSpace> placed(const Scene& scene, const ExactGrid& grid,
                                             const Workers& workers, PlaneTable& planes) {
    constexpr size_t kSome = 1 << 16, kGrain = 1024;
    std::vector<PlacedHalfSpace> half_spaces(scene.half_spaces.size());
    std::vector<ExactPlane> some(std::min(kSome, half_spaces.size()));
    for (size_t begin = 0; begin < half_spaces.size(); begin += kSome) {
      const size_t count = std::min(kSome, half_spaces.size() - begin);
      workers.for_parts(count, kGrain, [&](size_t first, size_t last, size_t) {
        for (size_t i = first; i < last; ++i)
          some[i] = grid.plane(scene.half_spaces[begin + i], half_spaces[begin + i].inside);
      });
      for (size_t i = 0; i < count; ++i) half_spaces[begin + i].plane = planes.add(some[i]);
    }
    return half_spaces;
  }

  bool is_stopped(double share) const {
    if (settings_.progress) settings_.progress(share);
    return settings_.stop.stop_requested();
  }

  void lap(double& time) {
    time += watch_.milliseconds();
    watch_ = Stopwatch();
  }

  Status make_faces() {
    lap(stats_.planes_ms);
    if (plan_.units.empty()) return Done{};
    const CuttingPlanes cuts(scene_.region, scene_.faces.size(), grid_, planes_);
    const UnitBoxes boxes(scene_, &workers_);
    const std::vector<UnitGroup> groups = group_units(scene_, boxes, half_spaces_, plan_, workers_);
    lap(stats_.group_ms);
    PerWorker<FaceMaker> makers(workers_);
    std::atomic<uint64_t> pairs = 0;
    const auto maker_of = [&](size_t worker) -> FaceMaker& {
      return makers.of(worker, scene_, boxes, geometry_, half_spaces_, paints_, cuts,
                       grid_.per_unit(), &plan_);
    };
    const auto add_group = [&](FaceMaker& maker, size_t i, Pieces& out) {
      if (pairs > settings_.pairs) return;
      const uint64_t before = maker.pairs();
      maker.make(groups[i], out);
      pairs += maker.pairs() - before;
    };
    if (!collector_.collect(groups.size(), 1, maker_of, add_group, 0, kMade, pieces_) ||
        pairs > settings_.pairs)
      return too_much();
    stats_.whole_planes =
        plan_.is_whole.size() - size_t(std::count(plan_.is_whole.begin(), plan_.is_whole.end(), 0));
    lap(stats_.faces_ms);
    return Done{};
  }

  /// Whether cells are needed: for the planes of some faces.
  bool needs_cells() const {
    return std::any_of(scene_.faces.begin(), scene_.faces.end(), [&](const Face& face) {
      const uint32_t plane = half_spaces_[face.literal >> 1].plane;
      return plane >= plan_.is_whole.size() || plan_.is_whole[plane] == 0;
    });
  }

  /// A limit is reached; what is tried next would reach it too.
  Error refuse() {
    is_too_much_ = true;
    return too_much();
  }

  Result<FaceOutlines> join_with_cells() {
    std::vector<uint32_t> open_planes;
    if (!needs_cells()) return joined(open_planes);
    SubdivideSettings subdivide = cells_for_faces();
    subdivide.memory = settings_.cell_memory;
    const CellTree tree = open_cells(scene_, subdivide, &workers_);
    refine_all(tree, workers_);
    const std::vector<WalkedLeaf> leaves = walk_leaves(tree, grid_, planes_);
    stats_.leaves = leaves.size();
    lap(stats_.cells_ms);
    if (pairs_in(leaves) > settings_.pairs) return refuse();
    PerWorker<PieceMaker> makers(workers_);
    const auto maker_of = [&](size_t worker) -> PieceMaker& {
      return makers.of(worker, scene_, geometry_, half_spaces_, paints_,
                       std::span<const uint8_t>(plan_.is_whole));
    };
    const auto add_leaf = [&](PieceMaker& maker, size_t i, Pieces& out) {
      maker.within(leaves[i].link, leaves[i].sides, out);
    };
    constexpr size_t kLeavesAtATime = 32;
    if (!collector_.collect(leaves.size(), kLeavesAtATime, maker_of, add_leaf, kMade, kWithin,
                            pieces_))
      return refuse();
    const PieceMark within(pieces_);

    // Leaves are proven to agree where they touch, but for what lies there. Where a body is a mesh
    // they need not, by less than its slack; then pieces are missing in a contact, and the lines
    // around them are open, which lie in its plane.
    constexpr size_t kJoinsByPlanes = 3;
    std::vector<bool> asked_planes(planes_.size());
    for (size_t joins = 1;; ++joins) {
      const std::vector<Contact> contacts =
          contacts_of(tree, grid_, planes_, half_spaces_, plan_.is_whole, asked_planes,
                      stats_.asked_all_contacts);
      const auto add_contact = [&](PieceMaker& maker, size_t i, Pieces& out) {
        const Contact& contact = contacts[i];
        maker.between(contact.below, contact.above, contact.axis, contact.rectangle, out);
      };
      if (!collector_.collect(contacts.size(), kLeavesAtATime, maker_of, add_contact, kWithin,
                              kBetween, pieces_))
        return refuse();
      stats_.contacts = contacts.size();
      lap(stats_.cut_ms);
      Result<FaceOutlines> outlines = joined(open_planes);
      if (outlines || stats_.asked_all_contacts || settings_.stop.stop_requested()) return outlines;
      bool has_new = false;
      for (const uint32_t plane : open_planes) {
        has_new = has_new || !asked_planes[plane];
        asked_planes[plane] = true;
      }
      stats_.asked_all_contacts = !has_new || joins == kJoinsByPlanes;
      within.go_back(pieces_);
    }
  }

  Result<FaceOutlines> joined(std::vector<uint32_t>& open_planes) {
    if (is_stopped(kBetween)) return FaceOutlines{};
    Result<FaceOutlines> outlines = join(pieces_, geometry_, workers_, open_planes);
    ++stats_.joins;
    lap(stats_.join_ms);
    is_stopped(kJoined);
    return outlines;
  }

  SolidMesh finished(const FaceOutlines& outlines) {
    stats_.pieces = pieces_.count;
    stats_.outline_edges = outlines.edges.size() / 2;
    stats_.shared_edges = outlines.shared_edges;
    SolidMesh mesh =
        finish(fill(outlines, geometry_, workers_), outlines, first_owners(pieces_.owners),
               first_half_spaces(half_spaces_, paints_, planes_.size()), geometry_,
               grid_.per_unit(), scene_.origin, workers_);
    // Planes that were written to meet in one point do so but for rounding.
    constexpr double kRounding = 1e-12;
    stats_.collapsed = collapse_short_edges(mesh, kRounding * max_component(scene_.region.size()));
    lap(stats_.fill_ms);
    if (is_stopped(1)) return SolidMesh{};
    return mesh;
  }

  const Scene& scene_;
  const Workers& workers_;
  BoundaryStats& stats_;
  const BoundarySettings& settings_;
  const ExactGrid grid_;
  PlaneTable planes_;
  const std::vector<PlacedHalfSpace> half_spaces_;
  const Paints paints_;
  const ExactGeometry geometry_;
  const PieceCollector collector_;
  FacePlan plan_;
  bool is_too_much_ = false;
  Pieces pieces_;
  Stopwatch watch_;
};

}  // namespace

Result<SolidMesh> evaluate_solid(const Scene& scene, const Workers& workers, BoundaryStats* stats,
                                 const BoundarySettings& settings) {
  if (Status possible = check_solid(scene); !possible) return possible.error();
  if (scene.region.is_empty()) return SolidMesh{};
  BoundaryStats ignored;
  BoundaryStats& its_stats = stats != nullptr ? *stats : ignored;
  its_stats = {};
  return SolidEvaluation(scene, workers, its_stats, settings).run();
}

}  // namespace whittle
