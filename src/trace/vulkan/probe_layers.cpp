#include "trace/vulkan/probe_layers.h"

#include <algorithm>
#include <cmath>

namespace whittle {
namespace {

int pixel_of(float position) {
  return int(std::floor(position));
}

}  // namespace

PixelRect pixels_of(std::span<const PixelPosition> positions) {
  PixelRect rect{pixel_of(positions[0].x), pixel_of(positions[0].y), 0, 0};
  rect.x1 = rect.x0, rect.y1 = rect.y0;
  for (const PixelPosition& p : positions) {
    rect.x0 = std::min(rect.x0, pixel_of(p.x)), rect.x1 = std::max(rect.x1, pixel_of(p.x) + 1);
    rect.y0 = std::min(rect.y0, pixel_of(p.y)), rect.y1 = std::max(rect.y1, pixel_of(p.y) + 1);
  }
  return rect;
}

std::vector<ProbeLayer> probe_layers(std::span<const PixelPosition> positions,
                                     const PixelRect& tile) {
  const size_t pixels = size_t(tile.width()) * size_t(tile.height());
  std::vector<uint32_t> used(pixels);  // layers that have a place in a pixel
  std::vector<ProbeLayer> layers;
  for (size_t i = 0; i < positions.size(); ++i) {
    const int x = pixel_of(positions[i].x), y = pixel_of(positions[i].y);
    if (x < tile.x0 || x >= tile.x1 || y < tile.y0 || y >= tile.y1) continue;
    const auto pixel = uint32_t((y - tile.y0) * tile.width() + (x - tile.x0));
    const uint32_t layer = used[pixel]++;
    if (layer == layers.size()) layers.emplace_back();
    layers[layer].places.push_back({uint32_t(i), pixel});
  }
  for (ProbeLayer& layer : layers) {
    layer.positions.resize(pixels);
    layer.depth.resize(pixels);
    for (const ProbeLayer::Place& place : layer.places) {
      layer.positions[place.pixel] = positions[place.position];
      layer.depth[place.pixel] = 1;
    }
  }
  return layers;
}

}  // namespace whittle
