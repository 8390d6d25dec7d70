#include "boundary/piece_collector.h"

#include <cstdint>

namespace whittle {

void append_pieces(std::vector<Pieces>& chunks, const Workers& workers, Pieces& out) {
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
  workers.for_parts(chunks.size(), 1, [&](size_t first, size_t last, size_t) {
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

}  // namespace whittle
