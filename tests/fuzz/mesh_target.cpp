// Any bytes as a mesh file, the first of them saying of which format; then as a closed surface.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/box.h"
#include "fuzz/require.h"
#include "fuzz/target.h"
#include "mesh/close_mesh.h"
#include "mesh/mesh_files.h"
#include "mesh/zip_for_test.h"

namespace whittle {
namespace {

constexpr size_t kMost = 2000;

/// What the low bits of the first byte ask for. A text in an archive is packed here, for its
/// checksum could not be guessed.
enum Kind { kStl, kOff, kObj, kAmf, kPackage, kPackedModel, kHeights, kHeightsTurned, kKindCount };

Result<RawMesh> read(Kind kind, std::string_view content) {
  switch (kind) {
    case kStl:
      return read_mesh(content, "fuzz.stl", kMost);
    case kOff:
      return read_mesh(content, "fuzz.off", kMost);
    case kObj:
      return read_mesh(content, "fuzz.obj", kMost);
    case kAmf:
      return read_mesh(content, "fuzz.amf", kMost);
    case kPackage:
      return read_mesh(content, "fuzz.3mf", kMost);
    case kPackedModel:
      return read_mesh(make_zip({{"3D/3dmodel.model", std::string(content), false}}), "fuzz.3mf",
                       kMost);
    default: {
      HeightMap how;
      how.center = how.invert = kind == kHeightsTurned;
      return read_height_map(content, how, kMost);
    }
  }
}

bool is_sentence(const std::string& message) {
  return !message.empty() && message.size() < 300 &&
         std::ranges::none_of(message, [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; });
}

bool is_same(const RawMesh& a, const RawMesh& b) {
  const auto same_bits = [](Vec3 p, Vec3 q) {
    // What is not a number equals nothing.
    return p == q || !is_finite(p);
  };
  return std::ranges::equal(a.points, b.points, same_bits) && a.faces == b.faces &&
         a.triangles == b.triangles && a.is_closed == b.is_closed;
}

void check_raw(const RawMesh& raw) {
  size_t triangles = raw.triangles.size();
  const auto check_corner = [&](uint32_t corner) {
    require(corner < raw.points.size(), "a corner that is no point");
  };
  for (const auto& face : raw.faces) {
    require(face.size() >= 3, "a face with fewer than three corners");
    triangles += face.size() - 2;
    for (const uint32_t corner : face) check_corner(corner);
  }
  for (const auto& corners : raw.triangles)
    for (const uint32_t corner : corners) check_corner(corner);
  require(triangles <= 3 * kMost, "more triangles than the limit");
}

void check_closed(const ClosedMesh& closed) {
  const TriangleMesh& mesh = closed.mesh;
  Box box;
  for (const Vec3& p : mesh.points) {
    require(is_finite(p), "a point that is not finite");
    box.include(p);
  }
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    require(t.facet < mesh.facets.size(), "a triangle without a plane");
    const Plane& plane = mesh.facets[t.facet];
    for (size_t e = 0; e < 3; ++e) {
      const uint32_t a = t.corners[e], b = t.corners[(e + 1) % 3];
      require(a < mesh.points.size() && a != b, "a triangle with a corner too few");
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
      const double off = std::fabs(dot(plane.n, mesh.points[a]) - plane.d);
      require(off <= mesh.rise + 1e-12 * (box.diagonal() + std::fabs(plane.d)),
              "a corner farther from its plane than said");
    }
  }
  for (const auto& [edge, times] : balance) require(times == 0, "an open edge");
  for (const Plane& plane : mesh.facets)
    require(std::fabs(length(plane.n) - 1) < 1e-9, "a plane without a unit normal");
  require(std::isfinite(mesh.rise) && mesh.rise >= 0, "no rise");
  require(closed.open_edges == 0 || is_finite(closed.first_open), "an open edge nowhere");
}

void check(uint8_t choice, std::string_view content) {
  const auto kind = Kind(choice % kKindCount);
  const Result<RawMesh> raw = read(kind, content), again = read(kind, content);
  require(bool(raw) == bool(again), "read again it is another");
  if (!raw) {
    require(is_sentence(raw.error().message), "a message of another form");
    require(raw.error().message == again.error().message, "another message the second time");
    return;
  }
  require(is_same(*raw, *again), "read again it is another");
  check_raw(*raw);
  const int digits = choice / kKindCount % 2 == 0 ? 6 : 0;
  const ClosedMesh closed = close_mesh(*raw, digits);
  check_closed(closed);
  if (raw->is_closed) require(closed.open_edges == 0, "what is made closed is not");
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size > 0) whittle::check(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
