// Triangle meshes from files: STL, OFF, OBJ, 3MF, AMF, and surface()'s height maps.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "mesh/close_mesh.h"
#include "model/document.h"

namespace whittle {

/// The formats of import(), by the file's suffix (any case).
bool is_mesh_file(std::string_view file_name);

/// Reads the content of a mesh file; the format follows from the suffix of `file_name`. Errors are
/// one sentence without a place. `most_triangles`: more are an error that names the limit.
Result<RawMesh> read_mesh(std::string_view content, std::string_view file_name,
                          size_t most_triangles);

/// The solid below a height map, as OpenSCAD's surface() makes it: from text, or from a PNG if the
/// content is one.
Result<RawMesh> read_height_map(std::string_view content, const HeightMap& how,
                                size_t most_triangles);

}  // namespace whittle
