#include <algorithm>

#include "boundary/exact_line.h"
#include "boundary/faces.h"
#include "boundary/numbering.h"
#include "boundary/point_table.h"

namespace whittle {
namespace {

/// An edge of a piece.
struct Span {
  Sheet sheet;
  uint32_t low, high;  ///< points, along the line
  int direction;       ///< 1: it runs up the line
};

/// The work on one line.
class LineJoiner {
 public:
  LineJoiner(const ExactGeometry& geometry, std::span<const ExactPoint> points)
      : geometry_(geometry), points_(points) {}

  /// Adds what is left of the edges on a line along `axis`, and sorts them. False if it is no
  /// boundary.
  bool join(int axis, std::span<Span> on_line, std::vector<HalfEdge>& out, size_t& shared) {
    axis_ = axis;
    std::sort(on_line.begin(), on_line.end(),
              [](const Span& a, const Span& b) { return a.sheet < b.sheet; });
    rank(on_line);
    cancel(on_line);
    return cut(out, shared);
  }

 private:
  /// Numbers the points in their order along the line.
  void rank(std::span<const Span> on_line) {
    order_.clear();
    for (const Span& span : on_line) order_.push_back(span.low), order_.push_back(span.high);
    std::sort(order_.begin(), order_.end());
    order_.erase(std::unique(order_.begin(), order_.end()), order_.end());
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      return geometry_.compare(points_[a], points_[b], axis_) < 0;
    });
    ranks_.clear();
    for (uint32_t i = 0; i < order_.size(); ++i) ranks_.push_back({order_[i], i});
    std::sort(ranks_.begin(), ranks_.end());
  }
  uint32_t rank_of(uint32_t point) const {
    const auto at = std::lower_bound(ranks_.begin(), ranks_.end(), std::pair(point, 0u));
    return at->second;
  }

  /// What is left of each sheet where its pieces' edges have cancelled one another.
  struct Rest {
    Sheet sheet;
    uint32_t low, high;  ///< ranks
    int count;           ///< how often it runs up; negative: down
  };
  void cancel(std::span<const Span> on_line) {
    rests_.clear();
    for (size_t i = 0; i < on_line.size();) {
      const Sheet sheet = on_line[i].sheet;
      steps_.clear();
      for (; i < on_line.size() && on_line[i].sheet == sheet; ++i) {
        steps_.push_back({rank_of(on_line[i].low), on_line[i].direction});
        steps_.push_back({rank_of(on_line[i].high), -on_line[i].direction});
      }
      std::sort(steps_.begin(), steps_.end());
      int count = 0;
      uint32_t since = 0;
      for (size_t s = 0; s < steps_.size();) {
        const uint32_t at = steps_[s].first;
        int change = 0;
        for (; s < steps_.size() && steps_[s].first == at; ++s) change += steps_[s].second;
        if (change == 0) continue;
        if (count != 0) rests_.push_back({sheet, since, at, count});
        count += change;
        since = at;
      }
    }
  }

  /// Cuts what is left at all ends, and finds the twins.
  bool cut(std::vector<HalfEdge>& out, size_t& shared) {
    ends_.clear();
    for (const Rest& rest : rests_) ends_.push_back(rest.low), ends_.push_back(rest.high);
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    std::sort(rests_.begin(), rests_.end(),
              [](const Rest& a, const Rest& b) { return a.low < b.low; });
    size_t next = 0;
    running_.clear();
    for (size_t e = 0; e + 1 < ends_.size(); ++e) {
      std::erase_if(running_, [&](const Rest& rest) { return rest.high <= ends_[e]; });
      for (; next < rests_.size() && rests_[next].low == ends_[e]; ++next)
        running_.push_back(rests_[next]);
      if (!running_.empty() && !add_edges(order_[ends_[e]], order_[ends_[e + 1]], out, shared))
        return false;
    }
    return true;
  }

  bool add_edges(uint32_t low, uint32_t high, std::vector<HalfEdge>& out, size_t& shared) {
    if (running_.size() % 2 != 0) return false;
    if (running_.size() > 2) sort_around(), ++shared;
    // Counter-clockwise around the line, what runs down has its material behind it, and what runs
    // up before it.
    const size_t first = running_[0].count < 0 ? 0 : 1;
    for (size_t i = 0; i < running_.size(); i += 2) {
      const Rest& down = running_[(first + i) % running_.size()];
      const Rest& up = running_[(first + i + 1) % running_.size()];
      if (down.count != -1 || up.count != 1) return false;
      const auto number = uint32_t(out.size());
      out.push_back({down.sheet, high, low, number + 1});
      out.push_back({up.sheet, low, high, number});
    }
    return true;
  }

  /// Faces around the line, counter-clockwise seen against it. In their stead are turned their
  /// normals, outward where they run up the line and inward where they run down.
  void sort_around() {
    const auto axis = size_t(axis_);
    const auto normal = [&](const Rest& rest) {
      std::array<int64_t, 3> n = geometry_.plane(rest.sheet >> 1).n;
      if (bool(rest.sheet & 1) != (rest.count < 0))
        for (int64_t& component : n) component = -component;
      return n;
    };
    const std::array<int64_t, 3> reference = normal(running_[0]);
    // The line's direction is positive on its axis.
    const auto turn = [&](const std::array<int64_t, 3>& a, const std::array<int64_t, 3>& b) {
      const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      const Int128 product = Int128(a[u]) * b[v] - Int128(a[v]) * b[u];
      return product < 0 ? -1 : product > 0 ? 1 : 0;
    };
    const auto is_behind = [&](const std::array<int64_t, 3>& n) {
      const int side = turn(reference, n);
      if (side != 0) return side < 0;
      Int128 along = 0;
      for (size_t i = 0; i < 3; ++i) along += Int128(n[i]) * reference[i];
      return along < 0;
    };
    std::sort(running_.begin(), running_.end(), [&](const Rest& a, const Rest& b) {
      const auto na = normal(a), nb = normal(b);
      const bool a_behind = is_behind(na), b_behind = is_behind(nb);
      if (a_behind != b_behind) return b_behind;
      return turn(na, nb) > 0;
    });
  }

  const ExactGeometry& geometry_;
  std::span<const ExactPoint> points_;
  int axis_ = 0;
  std::vector<uint32_t> order_, ends_;
  std::vector<std::pair<uint32_t, uint32_t>> ranks_;  ///< by point
  std::vector<std::pair<uint32_t, int>> steps_;
  std::vector<Rest> rests_, running_;
};

/// The work on lines in a row.
struct JoinedLines {
  std::vector<HalfEdge> edges;
  size_t shared = 0;
  std::vector<uint32_t> open_planes;  ///< of lines on which there is no boundary
};

class LinesJoiner {
 public:
  LinesJoiner(const Pieces& pieces, std::span<const uint32_t> numbers,
              std::span<const ExactPoint> points, const NumberedLines& lines,
              const ExactGeometry& geometry)
      : pieces_(pieces),
        numbers_(numbers),
        points_(points),
        lines_(lines),
        geometry_(geometry),
        joiner_(geometry, points) {}

  /// Of lines from `first` to before `last`; `edges`: of all pieces' those on them.
  void join(size_t first, size_t last, std::span<const uint32_t> edges, JoinedLines& out) {
    firsts_.assign(last - first + 1, 0);
    for (const uint32_t edge : edges) ++firsts_[lines_.numbers[edge] - first + 1];
    for (size_t i = 1; i < firsts_.size(); ++i) firsts_[i] += firsts_[i - 1];
    next_ = firsts_;
    spans_.resize(edges.size());
    for (const uint32_t edge : edges) spans_[next_[lines_.numbers[edge] - first]++] = span_of(edge);
    is_open_.assign(last - first, false);
    bool has_open = false;
    for (size_t i = 0; i + 1 < firsts_.size(); ++i) {
      const auto on_line = std::span(spans_).subspan(firsts_[i], firsts_[i + 1] - firsts_[i]);
      if (!joiner_.join(lines_.axes[first + i], on_line, out.edges, out.shared))
        is_open_[i] = has_open = true;
    }
    if (!has_open) return;
    for (const uint32_t edge : edges) {
      if (!is_open_[lines_.numbers[edge] - first]) continue;
      out.open_planes.push_back(pieces_.edges[edge].plane);
      out.open_planes.push_back(pieces_.edges[edge].sheet >> 1);
    }
  }

 private:
  Span span_of(uint32_t number) const {
    const Pieces::Edge& edge = pieces_.edges[number];
    const uint32_t from = numbers_[edge.from], to = numbers_[edge.to];
    const int axis = lines_.axes[lines_.numbers[number]];
    const bool is_up = geometry_.compare(points_[from], points_[to], axis) < 0;
    return {edge.sheet, is_up ? from : to, is_up ? to : from, is_up ? 1 : -1};
  }

  const Pieces& pieces_;
  std::span<const uint32_t> numbers_;  ///< by the pieces' point: into points_
  std::span<const ExactPoint> points_;
  const NumberedLines& lines_;
  const ExactGeometry& geometry_;
  LineJoiner joiner_;
  std::vector<Span> spans_;
  std::vector<size_t> firsts_, next_;
  std::vector<bool> is_open_;
};

/// Puts edges of one sheet in a row.
void sort_by_sheet(std::vector<HalfEdge>& edges, size_t sheets, const Workers& workers) {
  constexpr size_t kSheets = 256;
  Buckets order = sort_into_buckets(
      edges.size(), sheets / kSheets + 1, [&](size_t i) { return edges[i].sheet / kSheets; },
      workers);
  std::vector<uint32_t> place(edges.size());
  std::vector<HalfEdge> sorted(edges.size());
  workers.for_parts(order.count(), 1, [&](size_t begin, size_t end, size_t) {
    for (size_t b = begin; b < end; ++b) {
      const auto from = order.items.begin() + std::ptrdiff_t(order.firsts[b]),
                 to = order.items.begin() + std::ptrdiff_t(order.firsts[b + 1]);
      std::stable_sort(from, to,
                       [&](uint32_t x, uint32_t y) { return edges[x].sheet < edges[y].sheet; });
      for (size_t i = order.firsts[b]; i < order.firsts[b + 1]; ++i) {
        sorted[i] = edges[order.items[i]];
        place[order.items[i]] = uint32_t(i);
      }
    }
  });
  for (HalfEdge& edge : sorted) edge.twin = place[edge.twin];
  edges = std::move(sorted);
}

/// Leaves out the points that no edge has.
void drop_unused(FaceOutlines& outlines) {
  std::vector<uint32_t> place(outlines.points.size(), UINT32_MAX);
  std::vector<ExactPoint> used;
  const auto take = [&](uint32_t& point) {
    if (place[point] == UINT32_MAX) {
      place[point] = uint32_t(used.size());
      used.push_back(outlines.points[point]);
    }
    point = place[point];
  };
  for (HalfEdge& edge : outlines.edges) take(edge.from), take(edge.to);
  outlines.points = std::move(used);
}

}  // namespace

Result<FaceOutlines> join(const Pieces& pieces, const ExactGeometry& geometry,
                          const Workers& workers, std::vector<uint32_t>& open_planes) {
  open_planes.clear();
  FaceOutlines outlines;
  std::vector<uint32_t> numbers;
  outlines.points = unify(pieces.points, geometry, workers, numbers);
  const NumberedLines lines = number_lines(
      pieces.edges.size(),
      [&](size_t i) {
        return std::array<uint32_t, 2>{pieces.edges[i].sheet >> 1, pieces.edges[i].plane};
      },
      geometry, workers);

  constexpr size_t kLines = 1024;
  const size_t count = lines.axes.size();
  const Buckets buckets = sort_into_buckets(
      pieces.edges.size(), (count + kLines - 1) / kLines,
      [&](size_t i) { return lines.numbers[i] / kLines; }, workers);
  std::vector<JoinedLines> parts(buckets.count());
  workers.for_parts(parts.size(), 1, [&](size_t begin, size_t end, size_t) {
    LinesJoiner joiner(pieces, numbers, outlines.points, lines, geometry);
    for (size_t i = begin; i < end; ++i)
      joiner.join(i * kLines, std::min(count, (i + 1) * kLines), buckets[i], parts[i]);
  });
  for (JoinedLines& part : parts) {
    open_planes.insert(open_planes.end(), part.open_planes.begin(), part.open_planes.end());
    const auto before = uint32_t(outlines.edges.size());
    for (HalfEdge edge : part.edges) {
      edge.twin += before;
      outlines.edges.push_back(edge);
    }
    outlines.shared_edges += part.shared;
    part.edges = {};
  }
  std::sort(open_planes.begin(), open_planes.end());
  open_planes.erase(std::unique(open_planes.begin(), open_planes.end()), open_planes.end());
  if (!open_planes.empty()) return Error{ErrorKind::kInput, "the boundary is not closed"};
  sort_by_sheet(outlines.edges, 2 * geometry.plane_count(), workers);
  drop_unused(outlines);
  return outlines;
}

}  // namespace whittle
