#include "boundary/write_solid.h"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/append_number.h"
#include "boundary/write_xml.h"

namespace whittle {
namespace {

using Corner = std::array<float, 3>;

/// Without negative zeros, so that equal corners have equal bytes.
Corner to_floats(Vec3 p) {
  return {float(p.x) + 0.0f, float(p.y) + 0.0f, float(p.z) + 0.0f};
}

/// A triangle as STL says it.
struct Facet {
  Corner normal;
  std::array<Corner, 3> corners;
};

Facet facet_of(const SolidMesh& mesh, const SolidMesh::Triangle& triangle) {
  Facet facet{to_floats(mesh.faces[triangle.face].outward), {}};
  for (size_t i = 0; i < 3; ++i) facet.corners[i] = to_floats(mesh.corners[triangle.corners[i]]);
  return facet;
}

/// Calls `take` for the facets that are written, and says what is lost with the others.
template <class Take>
StlLoss for_facets(const SolidMesh& mesh, const Take& take) {
  std::vector<bool> is_short;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Facet facet = facet_of(mesh, mesh.triangles[t]);
    bool has_shrunk = false;
    for (size_t i = 0; i < 3; ++i) {
      if (facet.corners[i] != facet.corners[(i + 1) % 3]) continue;
      has_shrunk = true;
      is_short.resize(3 * mesh.triangles.size());
      is_short[3 * t + i] = true;
    }
    if (!has_shrunk) take(facet);
  }
  return is_short.empty() ? StlLoss{} : loss_of(mesh, is_short);
}

void append(std::string& out, uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(char(value >> shift & 255));
}

void append(std::string& out, const Corner& corner) {
  for (const float value : corner) append(out, std::bit_cast<uint32_t>(value));
}

template <class Numbers>
void append_row(std::string& out, const char* name, const Numbers& numbers) {
  out += name;
  bool is_first = *name == '\0';
  for (const auto value : numbers) {
    if (!is_first) out += ' ';
    is_first = false;
    append_number(out, value);
  }
  out += '\n';
}

std::array<double, 3> coordinates(Vec3 p) {
  return {p.x, p.y, p.z};
}

SolidFile binary_stl(const SolidMesh& mesh) {
  constexpr size_t kHeader = 80, kFacet = 50;
  SolidFile file;
  std::string& out = file.bytes;
  out.reserve(kHeader + 4 + kFacet * mesh.triangles.size());
  // What begins with "solid" is taken for text.
  out = "binary STL, written by whittle";
  out.resize(kHeader, ' ');
  append(out, 0);
  uint32_t count = 0;
  file.lost = for_facets(mesh, [&](const Facet& facet) {
    ++count;
    append(out, facet.normal);
    for (const Corner& corner : facet.corners) append(out, corner);
    out.append(2, '\0');
  });
  for (size_t i = 0; i < 4; ++i) out[kHeader + i] = char(count >> (8 * i) & 255);
  return file;
}

SolidFile ascii_stl(const SolidMesh& mesh) {
  SolidFile file;
  std::string& out = file.bytes;
  out = "solid whittle\n";
  file.lost = for_facets(mesh, [&](const Facet& facet) {
    append_row(out, "  facet normal", facet.normal);
    out += "    outer loop\n";
    for (const Corner& corner : facet.corners) append_row(out, "      vertex", corner);
    out += "    endloop\n  endfacet\n";
  });
  out += "endsolid whittle\n";
  return file;
}

SolidFile off(const SolidMesh& mesh) {
  SolidFile file;
  std::string& out = file.bytes;
  append_row(out, "OFF", std::array<size_t, 3>{mesh.corners.size(), mesh.triangles.size(), 0});
  for (const Vec3& corner : mesh.corners) append_row(out, "", coordinates(corner));
  for (const SolidMesh::Triangle& triangle : mesh.triangles) append_row(out, "3", triangle.corners);
  return file;
}

SolidFile obj(const SolidMesh& mesh) {
  SolidFile file;
  std::string& out = file.bytes;
  for (const Vec3& corner : mesh.corners) append_row(out, "v", coordinates(corner));
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle.corners;
    append_row(out, "f", std::array<uint32_t, 3>{a + 1, b + 1, c + 1});
  }
  return file;
}

}  // namespace

Result<SolidFile> write_solid(const SolidMesh& mesh, SolidFormat format, const Workers& workers) {
  switch (format) {
    case SolidFormat::kStl:
      return binary_stl(mesh);
    case SolidFormat::kAsciiStl:
      return ascii_stl(mesh);
    case SolidFormat::kOff:
      return off(mesh);
    case SolidFormat::kObj:
      return obj(mesh);
    case SolidFormat::kAmf:
      return SolidFile{write_amf(mesh)};
    case SolidFormat::k3mf:
      break;
  }
  Result<std::string> archive = write_3mf(mesh, workers);
  if (!archive) return archive.error();
  return SolidFile{*std::move(archive)};
}

}  // namespace whittle
