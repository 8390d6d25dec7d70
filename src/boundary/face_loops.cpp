#include "boundary/face_loops.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace whittle {

std::vector<uint32_t> twins_of(const SolidMesh& mesh) {
  // By lower corner first.
  struct Edge {
    uint32_t high, number;
  };
  const auto visit_edges = [&](const auto& visit) {
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (uint32_t i = 0; i < 3; ++i) {
        const auto [low, high] =
            std::minmax(mesh.triangles[t].corners[i], mesh.triangles[t].corners[(i + 1) % 3]);
        visit(low, Edge{high, 3 * t + i});
      }
  };
  std::vector<uint32_t> ends(mesh.corners.size() + 1);
  visit_edges([&](uint32_t low, const Edge&) { ++ends[low + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Edge> edges(3 * mesh.triangles.size());
  visit_edges([&](uint32_t low, const Edge& edge) { edges[ends[low]++] = edge; });
  size_t first = 0;
  for (size_t low = 0; low < mesh.corners.size(); first = ends[low++])
    std::sort(edges.begin() + std::ptrdiff_t(first), edges.begin() + ends[low],
              [](const Edge& a, const Edge& b) { return a.high < b.high; });
  std::vector<uint32_t> twins(edges.size());
  for (size_t i = 0; i + 1 < edges.size(); i += 2) {
    twins[edges[i].number] = edges[i + 1].number;
    twins[edges[i + 1].number] = edges[i].number;
  }
  return twins;
}

std::vector<std::vector<std::vector<uint32_t>>> face_loops(const SolidMesh& mesh) {
  const std::vector<uint32_t> twins = twins_of(mesh);
  const auto face = [&](uint32_t edge) { return mesh.triangles[edge / 3].face; };
  std::vector<std::vector<std::vector<uint32_t>>> loops(mesh.faces.size());
  std::vector<bool> is_seen(twins.size());
  for (uint32_t first = 0; first < twins.size(); ++first) {
    if (is_seen[first] || face(twins[first]) == face(first)) continue;
    std::vector<uint32_t>& loop = loops[face(first)].emplace_back();
    uint32_t edge = first;
    do {
      is_seen[edge] = true;
      loop.push_back(mesh.triangles[edge / 3].corners[edge % 3]);
      edge = next_half_edge(edge);
      while (face(twins[edge]) == face(edge)) edge = next_half_edge(twins[edge]);
    } while (edge != first);
  }
  return loops;
}

}  // namespace whittle
