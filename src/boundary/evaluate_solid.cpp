#include "boundary/evaluate_solid.h"

#include <algorithm>
#include <utility>

#include "base/timing.h"
#include "boundary/cell_walk.h"
#include "boundary/collapse.h"
#include "boundary/fill_faces.h"
#include "boundary/finish.h"
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
                 std::span<const PlacedHalfSpace> half_spaces, const Workers& workers)
      : workers_(workers),
        makers_(workers),
        scene_(scene),
        geometry_(geometry),
        half_spaces_(half_spaces) {}

  /// Adds what `add(maker, i, pieces)` makes for all i < n.
  template <class Add>
  void collect(size_t n, const Add& add, Pieces& out) {
    constexpr size_t kChunk = 256;
    std::vector<Pieces> chunks((n + kChunk - 1) / kChunk);
    workers_.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t worker) {
      PieceMaker& maker = makers_.of(worker, scene_, geometry_, half_spaces_);
      for (size_t chunk = first; chunk < last; ++chunk)
        for (size_t i = chunk * kChunk; i < std::min(n, (chunk + 1) * kChunk); ++i)
          add(maker, i, chunks[chunk]);
    });
    for (Pieces& chunk : chunks) append(chunk, out);
  }

 private:
  static void append(const Pieces& from, Pieces& to) {
    const auto points = uint32_t(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (Pieces::Edge edge : from.edges) {
      edge.from += points, edge.to += points;
      to.edges.push_back(edge);
    }
    to.owners.insert(to.owners.end(), from.owners.begin(), from.owners.end());
    to.count += from.count;
  }

  const Workers& workers_;
  PerWorker<PieceMaker> makers_;
  const Scene& scene_;
  const ExactGeometry& geometry_;
  std::span<const PlacedHalfSpace> half_spaces_;
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
                                        size_t planes) {
  std::vector<uint32_t> firsts(planes);
  for (size_t i = half_spaces.size(); i-- > 0;) firsts[half_spaces[i].plane] = uint32_t(i);
  return firsts;
}

/// Only planes have facets, and only what has an end fits into a file.
Status check_solid(const Scene& scene) {
  if (!scene.bounded)
    return Error{ErrorKind::kInput, "the solid has no end, so no file holds all of it"};
  const auto is_curved = [](const HalfSpace& h) { return !h.is_plane(); };
  if (std::any_of(scene.half_spaces.begin(), scene.half_spaces.end(), is_curved))
    return Error{ErrorKind::kInput,
                 "true curves have no facets (--curves facets gives them some; more than 2048 "
                 "count as a true curve)"};
  return Done{};
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

/// The contacts that are asked what lies between their cells; all in which something may, or only
/// those in which a leaf has a plane there.
std::vector<Contact> contacts_of(const CellTree& tree, const ExactGrid& grid,
                                 const PlaneTable& planes,
                                 std::span<const PlacedHalfSpace> half_spaces, bool asks_all) {
  return walk_contacts(tree, grid, planes, [&](CellLink below, CellLink above, uint32_t plane) {
    if (!is_leaf(below.kind()) && !is_leaf(above.kind())) return below.kind() != above.kind();
    return asks_all || has_plane(below, half_spaces, plane) || has_plane(above, half_spaces, plane);
  });
}

}  // namespace

Result<SolidMesh> evaluate_solid(const Scene& scene, const Workers& workers, BoundaryStats* stats) {
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
  const CellTree tree = open_cells(scene, {}, &workers);
  refine_all(tree, workers);
  const std::vector<WalkedLeaf> leaves = walk_leaves(tree, grid, planes);
  s.leaves = leaves.size();
  lap(s.cells_ms);

  const ExactGeometry geometry(planes);
  PieceCollector collector(scene, geometry, half_spaces, workers);
  Pieces pieces;
  const auto add_leaf = [&](PieceMaker& maker, size_t i, Pieces& out) {
    maker.within(leaves[i].link, leaves[i].sides, out);
  };
  collector.collect(leaves.size(), add_leaf, pieces);
  const PieceMark within(pieces);

  // Leaves are proven to agree where they touch, but for what lies there; where a body is a mesh
  // they need not, by less than its slack. If they do not, all contacts are asked.
  s.asked_all_contacts = !scene.boundaries.empty();
  while (true) {
    const std::vector<Contact> contacts =
        contacts_of(tree, grid, planes, half_spaces, s.asked_all_contacts);
    const auto add_contact = [&](PieceMaker& maker, size_t i, Pieces& out) {
      const Contact& contact = contacts[i];
      maker.between(contact.below, contact.above, contact.axis, contact.rectangle, out);
    };
    collector.collect(contacts.size(), add_contact, pieces);
    s.contacts = contacts.size();
    lap(s.cut_ms);
    LineTable lines(geometry);
    const Result<FaceOutlines> outlines = join(pieces, geometry, lines, workers);
    lap(s.join_ms);
    if (!outlines) {
      if (s.asked_all_contacts) return outlines.error();
      s.asked_all_contacts = true;
      within.go_back(pieces);
      continue;
    }
    s.pieces = pieces.count;
    s.outline_edges = outlines->edges.size() / 2;
    s.shared_edges = outlines->shared_edges;
    SolidMesh mesh = finish(
        fill(*outlines, geometry, workers), *outlines, first_owners(pieces.owners),
        first_half_spaces(half_spaces, planes.size()), geometry, grid.per_unit(), scene.origin);
    // Planes that were written to meet in one point do so but for rounding.
    constexpr double kRounding = 1e-12;
    s.collapsed = collapse_short_edges(mesh, kRounding * max_component(scene.region.size()));
    lap(s.fill_ms);
    return mesh;
  }
}

}  // namespace whittle
