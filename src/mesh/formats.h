// The formats of mesh files, each from the content of a file. Errors are one sentence without a
// place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "mesh/close_mesh.h"

namespace whittle {

/// Text or binary, by the content: some binary files begin like a text, too.
Result<RawMesh> read_stl(std::string_view content, size_t most_triangles);
/// OFF and its variants with colours and normals, which are skipped.
Result<RawMesh> read_off(std::string_view content, size_t most_triangles);
/// Vertices and faces; all else is skipped.
Result<RawMesh> read_obj(std::string_view content, size_t most_triangles);

/// All objects, where they were made; a zip archive, too. Constellations and units are not asked,
/// as OpenSCAD does not.
Result<RawMesh> read_amf(std::string_view content, size_t most_triangles);
/// What is to be built, each object where it is placed; all objects where nothing is. Units are not
/// asked, as OpenSCAD does not. (OpenSCAD 2021.01 takes all objects where they were made; newer
/// ones do as here.)
Result<RawMesh> read_3mf(std::string_view content, size_t most_triangles);

inline Error mesh_error(std::string message) {
  return {ErrorKind::kInput, std::move(message)};
}
Error too_many_triangles(size_t most);
/// How many bytes the text of so many triangles may take once it is unpacked, and of what else is
/// in the file.
constexpr uint64_t most_unpacked(size_t most_triangles) {
  return uint64_t{500} * most_triangles + (1 << 20);
}

}  // namespace whittle
