#include "mesh/formats.h"
#include "mesh/text_scanner.h"

namespace whittle {
namespace {

/// The next line that holds anything, without its comment.
std::string_view next_line(TextScanner& scanner) {
  while (!scanner.is_at_end()) {
    std::string_view line = scanner.line();
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t") != std::string_view::npos) return line;
  }
  return {};
}

}  // namespace

Result<RawMesh> read_off(std::string_view content, size_t most_triangles) {
  TextScanner scanner(content);
  std::string_view line = next_line(scanner);
  TextScanner head(line);
  const std::string_view name = head.word();
  if (!name.ends_with("OFF")) return mesh_error("this is no OFF file");
  if (name.find_first_of("4n") != std::string_view::npos)
    return mesh_error("OFF of other dimensions than three is not read");
  std::string_view word = head.word();
  if (word == "BINARY") return mesh_error("binary OFF is not read");
  if (word.empty()) {
    line = next_line(scanner);
    head = TextScanner(line);
    word = head.word();
  }
  const auto points = TextScanner::as_number<uint32_t>(word), faces = head.number<uint32_t>();
  if (!points || !faces) return mesh_error("the numbers of points and faces are missing");
  if (*faces > most_triangles || *points > 3 * most_triangles)
    return too_many_triangles(most_triangles);

  RawMesh mesh;
  for (uint32_t i = 0; i < *points; ++i) {
    TextScanner numbers(next_line(scanner));
    const auto x = numbers.number<double>(), y = numbers.number<double>(),
               z = numbers.number<double>();
    if (!x || !y || !z) return mesh_error("a point is not three numbers");
    mesh.points.push_back({*x, *y, *z});
  }
  size_t corners = 0;
  for (uint32_t i = 0; i < *faces; ++i) {
    TextScanner numbers(next_line(scanner));
    const auto count = numbers.number<uint32_t>();
    if (!count) return mesh_error("a face does not say how many corners it has");
    corners += *count;
    if (corners > 3 * most_triangles) return too_many_triangles(most_triangles);
    std::vector<uint32_t> face;
    for (uint32_t k = 0; k < *count; ++k) {
      const auto corner = numbers.number<uint32_t>();
      if (!corner || *corner >= *points) return mesh_error("a face has a corner that is no point");
      face.push_back(*corner);
    }
    if (face.size() >= 3) mesh.faces.push_back(std::move(face));
  }
  return mesh;
}

}  // namespace whittle
