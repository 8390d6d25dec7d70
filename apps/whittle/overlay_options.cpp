#include "overlay_options.h"

#include <fmt/format.h>

namespace whittle {

void add_overlay_options(CLI::App& app, OverlaySettings& overlays) {
  constexpr size_t kMostBytes = 200;
  OptionGroup group(app, "Look");
  group.add_flag("--axes", overlays.axes, "the axes x, y and z, hidden where the solid is before");
  group.add_flag("--grid", overlays.grid, "a grid in the plane z = 0, in steps of round lengths");
  group.add_flag("--scale-bar", overlays.scale_bar, "with --projection ortho: a round length");
  group.add_text("--title", "TEXT", "a line of words in the picture", [&](const std::string& text) {
    if (text.size() > kMostBytes)
      refuse("--title",
             fmt::format("has {} bytes; a title has at most {}", text.size(), kMostBytes));
    overlays.title = text;
  });
}

}  // namespace whittle
