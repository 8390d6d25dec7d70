#include "boundary/collapse.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

namespace whittle {
namespace {

class Collapser {
 public:
  explicit Collapser(SolidMesh& mesh) : mesh_(mesh), is_gone_(mesh.triangles.size()) {}

  size_t run(double length) {
    std::vector<std::array<uint32_t, 2>> edges;
    for (const SolidMesh::Triangle& triangle : mesh_.triangles)
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = triangle.corners[i], b = triangle.corners[(i + 1) % 3];
        if (a < b && is_short(a, b, length)) edges.push_back({a, b});
      }
    if (edges.empty()) return 0;
    first_.assign(mesh_.corners.size(), kNone);
    next_.resize(3 * mesh_.triangles.size());
    for (uint32_t place = 0; place < next_.size(); ++place) push(corner_at(place), place);
    // An edge that cannot go yet may once another one went.
    size_t gone = 0;
    while (true) {
      const size_t before = gone;
      std::erase_if(edges, [&](const auto& edge) {
        const bool goes = collapse(edge[0], edge[1]);
        gone += goes;
        return goes;
      });
      if (gone == before) break;
      follow(edges, length);
    }
    clean();
    return gone;
  }

 private:
  bool is_short(uint32_t a, uint32_t b, double length) const {
    const Vec3 d = mesh_.corners[a] - mesh_.corners[b];
    return dot(d, d) <= length * length;
  }

  /// The edges by where their ends are now; those that are no edges any more go.
  void follow(std::vector<std::array<uint32_t, 2>>& edges, double length) {
    std::erase_if(edges, [&](auto& edge) {
      for (uint32_t& end : edge)
        while (!moved_.empty() && moved_[end] != end) end = moved_[end];
      return edge[0] == edge[1] || !is_short(edge[0], edge[1], length);
    });
  }

  uint32_t& corner_at(uint32_t place) { return mesh_.triangles[place / 3].corners[place % 3]; }

  void push(uint32_t corner, uint32_t place) {
    next_[place] = first_[corner];
    first_[corner] = place;
  }

  /// Takes a triangle off a corner's.
  void erase(uint32_t corner, uint32_t triangle) {
    uint32_t* at = &first_[corner];
    while (*at / 3 != triangle) at = &next_[*at];
    *at = next_[*at];
  }

  template <class Test>
  bool any_around(uint32_t corner, const Test& test) const {
    for (uint32_t place = first_[corner]; place != kNone; place = next_[place])
      if (test(place / 3)) return true;
    return false;
  }

  void neighbours(uint32_t corner, std::vector<uint32_t>& found) const {
    found.clear();
    for (uint32_t place = first_[corner]; place != kNone; place = next_[place])
      for (const uint32_t other : mesh_.triangles[place / 3].corners)
        if (other != corner) found.push_back(other);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }

  /// Moves b to a, if what the two have in common is the edge between them and the two triangles
  /// on it, and no more: the link condition (Dey, Edelsbrunner, Guha and Nekhayev 1999).
  bool collapse(uint32_t a, uint32_t b) {
    if (first_[a] == kNone || first_[b] == kNone) return false;
    neighbours(a, near_a_);
    neighbours(b, near_b_);
    if (!std::binary_search(near_a_.begin(), near_a_.end(), b)) return false;
    common_.clear();
    std::set_intersection(near_a_.begin(), near_a_.end(), near_b_.begin(), near_b_.end(),
                          std::back_inserter(common_));
    if (common_.size() != 2) return false;
    const auto has = [](const SolidMesh::Triangle& triangle, uint32_t corner) {
      return std::find(triangle.corners.begin(), triangle.corners.end(), corner) !=
             triangle.corners.end();
    };
    // A tetrahedron stays.
    const auto closes = [&](uint32_t t) {
      return has(mesh_.triangles[t], common_[0]) && has(mesh_.triangles[t], common_[1]);
    };
    if (any_around(a, closes) && any_around(b, closes)) return false;
    for (uint32_t place = first_[b], next; place != kNone; place = next) {
      next = next_[place];
      const uint32_t t = place / 3;
      if (!has(mesh_.triangles[t], a)) {
        corner_at(place) = a;
        push(a, place);
        continue;
      }
      is_gone_[t] = true;
      for (const uint32_t corner : mesh_.triangles[t].corners)
        if (corner != b) erase(corner, t);
    }
    first_[b] = kNone;
    if (moved_.empty())
      for (uint32_t i = 0; i < mesh_.corners.size(); ++i) moved_.push_back(i);
    moved_[b] = a;
    return true;
  }

  /// Leaves out what is gone.
  void clean() {
    std::vector<uint32_t> numbers(mesh_.corners.size());
    uint32_t corners = 0;
    for (uint32_t i = 0; i < mesh_.corners.size(); ++i) {
      numbers[i] = corners;
      if (first_[i] != kNone) mesh_.corners[corners++] = mesh_.corners[i];
    }
    mesh_.corners.resize(corners);
    size_t triangles = 0;
    std::vector<bool> has_triangles(mesh_.faces.size());
    for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_gone_[t]) continue;
      SolidMesh::Triangle kept = mesh_.triangles[t];
      for (uint32_t& corner : kept.corners) corner = numbers[corner];
      has_triangles[kept.face] = true;
      mesh_.triangles[triangles++] = kept;
    }
    mesh_.triangles.resize(triangles);
    clean_faces(has_triangles);
  }

  void clean_faces(const std::vector<bool>& has_triangles) {
    std::vector<uint32_t> numbers(mesh_.faces.size());
    uint32_t faces = 0;
    for (uint32_t i = 0; i < mesh_.faces.size(); ++i) {
      numbers[i] = faces;
      if (has_triangles[i]) mesh_.faces[faces++] = mesh_.faces[i];
    }
    mesh_.faces.resize(faces);
    for (SolidMesh::Triangle& triangle : mesh_.triangles) triangle.face = numbers[triangle.face];
  }

  static constexpr uint32_t kNone = UINT32_MAX;
  SolidMesh& mesh_;
  std::vector<bool> is_gone_;  ///< by triangle
  // The triangles around a corner are a list of places, 3 t + i for corner i of triangle t.
  std::vector<uint32_t> first_;  ///< by corner
  std::vector<uint32_t> next_;   ///< by place
  std::vector<uint32_t> moved_;  ///< by corner: where it went
  std::vector<uint32_t> near_a_, near_b_, common_;
};

}  // namespace

size_t collapse_short_edges(SolidMesh& mesh, double length) {
  return Collapser(mesh).run(length);
}

}  // namespace whittle
