#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "boundary/faces.h"
#include "boundary/point_table.h"

namespace whittle {
namespace {

/// An edge of a piece, or of what pieces became.
struct Span {
  uint32_t line;
  Sheet sheet;
  uint32_t low, high;  ///< points, along the line
  int direction;       ///< 1: it runs up the line
};

/// The edges of all pieces.
std::vector<Span> spans_of(const Pieces& pieces, const ExactGeometry& geometry,
                           std::span<const uint32_t> numbers, std::span<const ExactPoint> points,
                           LineTable& lines) {
  std::vector<Span> spans;
  spans.reserve(pieces.edges.size());
  for (const Pieces::Edge& edge : pieces.edges) {
    const uint32_t from = numbers[edge.from], to = numbers[edge.to];
    const uint32_t line = lines.number(edge.sheet >> 1, edge.plane);
    const bool is_up = geometry.compare(points[from], points[to], lines[line].axis) < 0;
    spans.push_back({line, edge.sheet, is_up ? from : to, is_up ? to : from, is_up ? 1 : -1});
  }
  return spans;
}

/// In the order of their lines; `firsts`: where each line's begin, and the end.
std::vector<Span> by_line(const std::vector<Span>& spans, size_t lines,
                          std::vector<size_t>& firsts) {
  firsts.assign(lines + 1, 0);
  for (const Span& span : spans) ++firsts[span.line + 1];
  for (size_t i = 1; i < firsts.size(); ++i) firsts[i] += firsts[i - 1];
  std::vector<size_t> next(firsts.begin(), firsts.end() - 1);
  std::vector<Span> sorted(spans.size());
  for (const Span& span : spans) sorted[next[span.line]++] = span;
  return sorted;
}

/// The work on one line.
class LineJoiner {
 public:
  LineJoiner(const ExactGeometry& geometry, const LineTable& lines,
             std::span<const ExactPoint> points)
      : geometry_(geometry), lines_(lines), points_(points) {}

  /// Adds what is left of the edges on a line, and sorts them. False if it is no boundary.
  bool join(std::span<Span> on_line, std::vector<HalfEdge>& out, size_t& shared) {
    line_ = on_line[0].line;
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
    const int axis = lines_[line_].axis;
    std::sort(order_.begin(), order_.end());
    order_.erase(std::unique(order_.begin(), order_.end()), order_.end());
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      return geometry_.compare(points_[a], points_[b], axis) < 0;
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
      out.push_back({down.sheet, high, low, line_, number + 1});
      out.push_back({up.sheet, low, high, line_, number});
    }
    return true;
  }

  /// Faces around the line, counter-clockwise seen against it. In their stead are turned their
  /// normals, outward where they run up the line and inward where they run down.
  void sort_around() {
    const auto axis = size_t(lines_[line_].axis);
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
  const LineTable& lines_;
  std::span<const ExactPoint> points_;
  uint32_t line_ = 0;
  std::vector<uint32_t> order_, ends_;
  std::vector<std::pair<uint32_t, uint32_t>> ranks_;  ///< by point
  std::vector<std::pair<uint32_t, int>> steps_;
  std::vector<Rest> rests_, running_;
};

/// Puts edges of one sheet in a row.
void sort_by_sheet(std::vector<HalfEdge>& edges) {
  std::vector<uint32_t> order(edges.size()), place(edges.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return edges[a].sheet < edges[b].sheet; });
  for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<HalfEdge> sorted;
  sorted.reserve(edges.size());
  for (const uint32_t i : order) {
    sorted.push_back(edges[i]);
    sorted.back().twin = place[edges[i].twin];
  }
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

Result<FaceOutlines> join(const Pieces& pieces, const ExactGeometry& geometry, LineTable& lines,
                          const Workers& workers) {
  FaceOutlines outlines;
  std::vector<uint32_t> numbers;
  outlines.points = unify(pieces.points, geometry, numbers);
  std::vector<size_t> firsts;
  std::vector<Span> spans = spans_of(pieces, geometry, numbers, outlines.points, lines);
  spans = by_line(spans, lines.size(), firsts);

  struct Part {
    std::vector<HalfEdge> edges;
    size_t shared = 0;
    bool is_closed = true;
  };
  constexpr size_t kLines = 1024;
  std::vector<Part> parts((lines.size() + kLines - 1) / kLines);
  workers.for_parts(parts.size(), 1, [&](size_t begin, size_t end, size_t) {
    LineJoiner joiner(geometry, lines, outlines.points);
    for (size_t i = begin; i < end; ++i) {
      Part& part = parts[i];
      for (size_t line = i * kLines; line < std::min(lines.size(), (i + 1) * kLines); ++line) {
        const size_t first = firsts[line], count = firsts[line + 1] - first;
        part.is_closed = part.is_closed && joiner.join(std::span(spans).subspan(first, count),
                                                       part.edges, part.shared);
      }
    }
  });
  for (const Part& part : parts) {
    if (!part.is_closed) return Error{ErrorKind::kInput, "the boundary is not closed"};
    const auto before = uint32_t(outlines.edges.size());
    for (HalfEdge edge : part.edges) {
      edge.twin += before;
      outlines.edges.push_back(edge);
    }
    outlines.shared_edges += part.shared;
  }
  sort_by_sheet(outlines.edges);
  drop_unused(outlines);
  return outlines;
}

}  // namespace whittle
