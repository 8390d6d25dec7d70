#include "boundary/face_loops.h"

#include <algorithm>

namespace whittle {

std::vector<uint32_t> twins_of(const SolidMesh& mesh) {
  struct Edge {
    uint32_t low, high, number;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (uint32_t i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax({mesh.triangles[t].corners[i], mesh.triangles[t].corners[(i + 1) % 3]});
      edges.push_back({low, high, 3 * t + i});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
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
