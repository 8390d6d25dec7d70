#include "trace/vulkan/probe_layers.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(ProbeLayers, PlacesInOnePixelGoToLayersOfTheirOwn) {
  const std::vector<PixelPosition> positions = {
      {2.5f, 1.5f}, {2.25f, 1.75f}, {4.0f, 1.0f}, {-0.5f, 3.0f}, {2.0f, 1.0f}};
  const PixelRect tile = pixels_of(positions);
  EXPECT_EQ(tile.x0, -1);
  EXPECT_EQ(tile.x1, 5);
  EXPECT_EQ(tile.y0, 1);
  EXPECT_EQ(tile.y1, 4);
  const std::vector<ProbeLayer> layers = probe_layers(positions, tile);
  ASSERT_EQ(layers.size(), 3u);
  std::vector<int> seen(positions.size());
  for (const ProbeLayer& layer : layers) {
    ASSERT_EQ(layer.positions.size(), 18u);
    float asked = 0;
    for (const float depth : layer.depth) asked += depth;
    EXPECT_EQ(asked, float(layer.places.size()));
    for (const ProbeLayer::Place& place : layer.places) {
      ++seen[place.position];
      EXPECT_EQ(layer.depth[place.pixel], 1);
      EXPECT_EQ(layer.positions[place.pixel].x, positions[place.position].x);
      EXPECT_EQ(layer.positions[place.pixel].y, positions[place.position].y);
    }
  }
  EXPECT_EQ(seen, std::vector<int>(positions.size(), 1)) << "each place once";
  EXPECT_EQ(layers[0].places.size(), 3u);
}

TEST(ProbeLayers, OtherTilesPlacesAreLeftOut) {
  const std::vector<PixelPosition> positions = {{0.5f, 0.5f}, {8.5f, 0.5f}};
  EXPECT_EQ(probe_layers(positions, {0, 0, 8, 8}).size(), 1u);
  EXPECT_EQ(probe_layers(positions, {0, 8, 8, 16}).size(), 0u);
}

}  // namespace
}  // namespace whittle
