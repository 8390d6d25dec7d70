// Any bytes given to the readers of flat files, SVG if they begin with `<` and DXF if not: what is
// read must be finite and outlines, what is refused must be refused in one line, and both must be
// so again.
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "flat/outlines.h"
#include "fuzz/require.h"
#include "fuzz/target.h"

namespace whittle {
namespace {

void check(std::string_view content) {
  const bool is_svg = content.starts_with('<');
  std::string said;
  const auto read = [&] {
    Import how;
    how.center = content.size() % 2 == 1;
    if (content.size() % 7 == 0) how.layer = "0";
    const Remark remark = [&](const std::string& kind, const std::string& message) {
      require(!kind.empty() && !message.empty(), "a remark without words");
      said += message;
    };
    return is_svg ? read_svg(content, how, remark) : read_dxf(content, how, remark);
  };
  const Result<Polygons> first = read();
  const std::string said_first = std::exchange(said, {});
  const Result<Polygons> second = read();
  require(bool(first) == bool(second) && said == said_first, "read again it is another");
  if (!first) {
    const std::string& message = first.error().message;
    require(!message.empty() && message.find('\n') == std::string::npos, "no line: " + message);
    require(message == second.error().message, "refused again it is for another reason");
    return;
  }
  require(first->contours == second->contours, "read again it is another");
  for (const Contour& contour : first->contours) {
    require(contour.size() >= 3, "a contour without an area");
    for (const Vec2 corner : contour)
      require(std::isfinite(corner.x) && std::isfinite(corner.y), "a corner at no place");
  }
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  whittle::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
