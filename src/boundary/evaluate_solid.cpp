#include "boundary/evaluate_solid.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "base/timing.h"
#include "boundary/cell_walk.h"
#include "boundary/collapse.h"
#include "boundary/fill_faces.h"
#include "boundary/finish.h"
#include "boundary/paints.h"
#include "subdivide/subdivide.h"

namespace whittle {
namespace {

bool has_plane(CellLink link, std::span<const PlacedHalfSpace> half_spaces, uint32_t plane) {
  if (!is_leaf(link.kind())) return false;
  const std::span<const LeafLiteral> literals = link.leaf().literals();
  return std::any_of(literals.begin(), literals.end(), [&](const LeafLiteral& literal) {
    return half_spaces[literal.literal >> 1].plane == plane;
  });
}

/// What is made of cells, some at a time, by all workers, in one order.
class PieceCollector {
 public:
  PieceCollector(const Scene& scene, const ExactGeometry& geometry,
                 std::span<const PlacedHalfSpace> half_spaces, const Paints& paints,
                 const Workers& workers, const BoundarySettings& settings)
      : workers_(workers),
        makers_(workers),
        scene_(scene),
        geometry_(geometry),
        half_spaces_(half_spaces),
        paints_(paints),
        settings_(settings) {}

  /// Adds what `add(maker, i, pieces)` makes for all i < n. Of all that is to be done these are the
  /// shares `from` to `to`. False if there are more pieces than may be.
  template <class Add>
  bool collect(size_t n, const Add& add, double from, double to, Pieces& out) {
    constexpr size_t kChunk = 32;
    std::atomic<size_t> count = out.count;
    std::vector<Pieces> chunks((n + kChunk - 1) / kChunk);
    std::atomic<size_t> done = 0;
    workers_.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t worker) {
      PieceMaker& maker = makers_.of(worker, scene_, geometry_, half_spaces_, paints_);
      const auto is_over = [&] {
        return settings_.stop.stop_requested() || count > settings_.pieces;
      };
      for (size_t chunk = first; chunk < last && !is_over(); ++chunk) {
        for (size_t i = chunk * kChunk; i < std::min(n, (chunk + 1) * kChunk); ++i)
          add(maker, i, chunks[chunk]);
        count += chunks[chunk].count;
        if (settings_.progress)
          settings_.progress(from + (to - from) * double(++done) / double(chunks.size()));
      }
    });
    if (count > settings_.pieces) return false;
    append(chunks, out);
    return true;
  }

 private:
  /// One after the other.
  void append(std::vector<Pieces>& chunks, Pieces& out) const {
    struct Start {
      size_t points, edges;
    };
    std::vector<Start> starts;
    Start next{out.points.size(), out.edges.size()};
    for (const Pieces& chunk : chunks) {
      starts.push_back(next);
      next.points += chunk.points.size(), next.edges += chunk.edges.size();
      out.owners.insert(out.owners.end(), chunk.owners.begin(), chunk.owners.end());
      out.count += chunk.count;
    }
    out.points.resize(next.points);
    out.edges.resize(next.edges);
    workers_.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t) {
      for (size_t i = first; i < last; ++i) {
        const Pieces chunk = std::move(chunks[i]);
        std::copy(chunk.points.begin(), chunk.points.end(),
                  out.points.begin() + std::ptrdiff_t(starts[i].points));
        const auto points = uint32_t(starts[i].points);
        std::transform(chunk.edges.begin(), chunk.edges.end(),
                       out.edges.begin() + std::ptrdiff_t(starts[i].edges), [&](auto edge) {
                         edge.from += points, edge.to += points;
                         return edge;
                       });
      }
    });
  }

  const Workers& workers_;
  PerWorker<PieceMaker> makers_;
  const Scene& scene_;
  const ExactGeometry& geometry_;
  std::span<const PlacedHalfSpace> half_spaces_;
  const Paints& paints_;
  const BoundarySettings& settings_;
};

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
/// there, those in planes that are to be asked, or all in which something may.
std::vector<Contact> contacts_of(const CellTree& tree, const ExactGrid& grid,
                                 const PlaneTable& planes,
                                 std::span<const PlacedHalfSpace> half_spaces,
                                 const std::vector<bool>& asked_planes, bool asks_all) {
  return walk_contacts(tree, grid, planes, [&](CellLink below, CellLink above, uint32_t plane) {
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

}  // namespace

Result<SolidMesh> evaluate_solid(const Scene& scene, const Workers& workers, BoundaryStats* stats,
                                 const BoundarySettings& settings) {
  if (Status possible = check_solid(scene); !possible) return possible.error();
  if (scene.region.is_empty()) return SolidMesh{};

  BoundaryStats ignored;
  BoundaryStats& s = stats != nullptr ? *stats : ignored;
  s = {};
  Stopwatch watch;
  const auto lap = [&watch](double& time) {
    time += watch.milliseconds();
    watch = Stopwatch();
  };
  const ExactGrid grid(scene.region);
  PlaneTable planes;
  std::vector<PlacedHalfSpace> half_spaces(scene.half_spaces.size());
  for (size_t i = 0; i < half_spaces.size(); ++i)
    half_spaces[i].plane = planes.add(grid.plane(scene.half_spaces[i], half_spaces[i].inside));
  const Paints paints(scene, half_spaces, settings.paints, planes);
  SubdivideSettings subdivide = cells_for_faces();
  subdivide.memory = settings.cell_memory;
  const CellTree tree = open_cells(scene, subdivide, &workers);
  refine_all(tree, workers);
  const std::vector<WalkedLeaf> leaves = walk_leaves(tree, grid, planes);
  s.leaves = leaves.size();
  lap(s.cells_ms);
  const Error too_much{ErrorKind::kInput, "its surfaces cross one another in too many places"};
  if (pairs_in(leaves) > settings.pairs) return too_much;
  constexpr double kWithin = 0.4, kBetween = 0.6, kJoined = 0.7, kFilled = 0.9;
  const auto is_stopped = [&](double share) {
    if (settings.progress) settings.progress(share);
    return settings.stop.stop_requested();
  };

  const ExactGeometry geometry(planes);
  PieceCollector collector(scene, geometry, half_spaces, paints, workers, settings);
  Pieces pieces;
  const auto add_leaf = [&](PieceMaker& maker, size_t i, Pieces& out) {
    maker.within(leaves[i].link, leaves[i].sides, out);
  };
  if (!collector.collect(leaves.size(), add_leaf, kWithin, kBetween, pieces)) return too_much;
  const PieceMark within(pieces);

  // Leaves are proven to agree where they touch, but for what lies there. Where a body is a mesh
  // they need not, by less than its slack; then pieces are missing in a contact, and the lines
  // around them are open, which lie in its plane.
  constexpr size_t kJoinsByPlanes = 3;
  std::vector<bool> asked_planes(planes.size());
  std::vector<uint32_t> open_planes;
  while (true) {
    const std::vector<Contact> contacts =
        contacts_of(tree, grid, planes, half_spaces, asked_planes, s.asked_all_contacts);
    const auto add_contact = [&](PieceMaker& maker, size_t i, Pieces& out) {
      const Contact& contact = contacts[i];
      maker.between(contact.below, contact.above, contact.axis, contact.rectangle, out);
    };
    if (!collector.collect(contacts.size(), add_contact, kBetween, kJoined, pieces))
      return too_much;
    s.contacts = contacts.size();
    lap(s.cut_ms);
    if (is_stopped(kJoined)) return SolidMesh{};
    const Result<FaceOutlines> outlines = join(pieces, geometry, workers, open_planes);
    ++s.joins;
    lap(s.join_ms);
    if (is_stopped(kFilled)) return SolidMesh{};
    if (!outlines) {
      if (s.asked_all_contacts) return outlines.error();
      bool has_new = false;
      for (const uint32_t plane : open_planes) {
        has_new = has_new || !asked_planes[plane];
        asked_planes[plane] = true;
      }
      s.asked_all_contacts = !has_new || s.joins == kJoinsByPlanes;
      within.go_back(pieces);
      continue;
    }
    s.pieces = pieces.count;
    s.outline_edges = outlines->edges.size() / 2;
    s.shared_edges = outlines->shared_edges;
    SolidMesh mesh =
        finish(fill(*outlines, geometry, workers), *outlines, first_owners(pieces.owners),
               first_half_spaces(half_spaces, paints, planes.size()), geometry, grid.per_unit(),
               scene.origin);
    // Planes that were written to meet in one point do so but for rounding.
    constexpr double kRounding = 1e-12;
    s.collapsed = collapse_short_edges(mesh, kRounding * max_component(scene.region.size()));
    lap(s.fill_ms);
    if (is_stopped(1)) return SolidMesh{};
    return mesh;
  }
}

}  // namespace whittle
