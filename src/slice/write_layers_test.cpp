#include "slice/write_layers.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(WriteLayers, HasAGroupALayer) {
  const std::vector<SlicedLayer> layers = {
      {0.2, {{{0, 0}, {3, 0}, {3, 2.5}}, {{1, 0}, {2, 1}, {2, 0}}}}, {-1, {}}};
  const std::string svg = write_layers(layers, {{0, 0}, {3, 2.5}});
  EXPECT_NE(svg.find("width=\"3mm\" height=\"3mm\" viewBox=\"0 -3 3 3\""), std::string::npos)
      << svg;
  EXPECT_NE(
      svg.find("<g id=\"layer0\" data-z=\"0.2\">\n<path d=\"\nM 0,0 L 3,0 L 3,-2.5 z\n"
               "M 1,0 L 2,-1 L 2,0 z\n\" fill=\"lightgray\" fill-rule=\"evenodd\" "
               "stroke=\"black\" stroke-width=\"0.1\"/>\n</g>\n<g id=\"layer1\" data-z=\"-1\">\n"
               "</g>\n</svg>\n"),
      std::string::npos)
      << svg;
}

}  // namespace
}  // namespace whittle
