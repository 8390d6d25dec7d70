#include "mesh/formats.h"
#include "mesh/text_scanner.h"

namespace whittle {

Result<RawMesh> read_obj(std::string_view content, size_t most_triangles) {
  RawMesh mesh;
  size_t corners = 0;
  TextScanner scanner(content);
  std::string joined;
  while (!scanner.is_at_end()) {
    std::string_view line = scanner.line();
    // A line that ends in a backslash goes on in the next one.
    if (line.ends_with('\\')) {
      joined.clear();
      while (line.ends_with('\\')) {
        joined.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = scanner.line();
      }
      joined.append(line);
      line = joined;
    }
    TextScanner words(line);
    const std::string_view kind = words.word();
    if (kind == "v") {
      const auto x = words.number<double>(), y = words.number<double>(), z = words.number<double>();
      if (!x || !y || !z) return mesh_error("a vertex is not three numbers");
      mesh.points.push_back({*x, *y, *z});
      if (mesh.points.size() > 3 * most_triangles) return too_many_triangles(most_triangles);
    } else if (kind == "f") {
      std::vector<uint32_t> face;
      for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
        // Vertex, texture, normal: 7/1/3. Negative numbers count from the last one so far.
        const auto number = TextScanner::as_number<int64_t>(word.substr(0, word.find('/')));
        const auto count = int64_t(mesh.points.size());
        const int64_t index = !number ? -1 : *number > 0 ? *number - 1 : count + *number;
        if (!number || *number == 0 || index < 0 || index >= count)
          return mesh_error("a face has a corner that is no vertex");
        face.push_back(uint32_t(index));
      }
      corners += face.size();
      if (corners > 3 * most_triangles) return too_many_triangles(most_triangles);
      if (face.size() >= 3) mesh.faces.push_back(std::move(face));
    }
  }
  return mesh;
}

}  // namespace whittle
