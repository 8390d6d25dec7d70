#include <bit>
#include <cstring>

#include "mesh/formats.h"
#include "mesh/text_scanner.h"

namespace whittle {
namespace {

constexpr size_t kHeader = 84, kRecord = 50;

uint32_t count_in(std::string_view content) {
  static_assert(std::endian::native == std::endian::little);
  uint32_t count = 0;
  std::memcpy(&count, content.data() + kHeader - sizeof count, sizeof count);
  return count;
}

bool is_binary(std::string_view content) {
  if (content.size() < kHeader) return false;
  if (content.size() == kHeader + kRecord * uint64_t(count_in(content))) return true;
  return !content.starts_with("solid");
}

Result<RawMesh> read_binary(std::string_view content, size_t most_triangles) {
  // Where the file was cut off, what is there.
  const uint64_t held = (content.size() - kHeader) / kRecord;
  const uint64_t count = std::min<uint64_t>(count_in(content), held);
  if (count > most_triangles) return too_many_triangles(most_triangles);
  RawMesh mesh;
  mesh.points.reserve(3 * count);
  mesh.triangles.reserve(count);
  const char* at = content.data() + kHeader;
  for (uint64_t i = 0; i < count; ++i, at += kRecord) {
    float corner[9];  // after the normal, which the corners tell too
    std::memcpy(corner, at + 3 * sizeof(float), sizeof corner);
    const auto first = uint32_t(mesh.points.size());
    for (int k = 0; k < 9; k += 3) mesh.points.push_back({corner[k], corner[k + 1], corner[k + 2]});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Result<RawMesh> read_text(std::string_view content, size_t most_triangles) {
  RawMesh mesh;
  std::vector<uint32_t> loop;
  TextScanner scanner(content);
  for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
    if (word == "outer") {
      loop.clear();
    } else if (word == "vertex") {
      const auto x = scanner.number<double>(), y = scanner.number<double>(),
                 z = scanner.number<double>();
      if (!x || !y || !z) return mesh_error("a vertex is not three numbers");
      loop.push_back(uint32_t(mesh.points.size()));
      mesh.points.push_back({*x, *y, *z});
    } else if (word == "endloop") {
      if (loop.size() == 3)
        mesh.triangles.push_back({loop[0], loop[1], loop[2]});
      else if (loop.size() > 3)
        mesh.faces.push_back(loop);
      loop.clear();
    }
    if (mesh.points.size() > 3 * most_triangles) return too_many_triangles(most_triangles);
  }
  return mesh;
}

}  // namespace

Result<RawMesh> read_stl(std::string_view content, size_t most_triangles) {
  if (is_binary(content)) return read_binary(content, most_triangles);
  if (!content.starts_with("solid")) return mesh_error("this is no STL file");
  return read_text(content, most_triangles);
}

}  // namespace whittle
