// The formats of mesh files, each from the content of a file. Errors are one sentence without a
// place.
#pragma once

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

inline Error mesh_error(std::string message) {
  return {ErrorKind::kInput, std::move(message)};
}
Error too_many_triangles(size_t most);

}  // namespace whittle
