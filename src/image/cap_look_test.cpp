#include "image/cap_look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/shade.h"

namespace whittle {
namespace {

TEST(HatchLine, CoversItsShareOfThePicture) {
  constexpr float kSpacing = 8, kLine = 1.6f;
  for (uint32_t kind = 0; kind < 8; ++kind) {
    double sum = 0;
    constexpr int kSide = 400;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        sum += double(hatch_line({float(x) + 0.5f, float(y) + 0.5f}, kind, kSpacing, kLine));
    EXPECT_NEAR(sum / (kSide * kSide), kLine / kSpacing, 0.01) << kind;
  }
}

TEST(HatchLine, TheFirstRisesToTheRightAndTheSecondFalls) {
  for (float along = 0; along < 50; along += 3.7f) {
    EXPECT_FLOAT_EQ(hatch_line({100 + along, 100 - along}, 0, 9, 2),
                    hatch_line({100, 100}, 0, 9, 2));
    EXPECT_FLOAT_EQ(hatch_line({100 + along, 100 + along}, 1, 9, 2),
                    hatch_line({100, 100}, 1, 9, 2));
  }
}

/// A statement of each colour, and the caps of both behind one plane.
class CapPicture : public testing::Test {
 protected:
  CapPicture() {
    looks[1].color = {0.5f, 0.25f, 1, 1};
    looks[2].color = {1, 1, 0, 1};
    for (uint32_t id = 1; id <= 2; ++id) looks[cut.cap_of(id)] = {looks[id].color, true};
    settings.style = Style::kBlinn;
    settings.cut = cut;
  }
  Picture picture(uint32_t id) const {
    Camera camera;
    camera.width = camera.height = 64;
    Frame frame(64, 64);
    for (Hit& hit : frame.hits) hit = {1, id, {0, 0, 1}};
    return shade(frame, camera, looks, settings, Workers(1));
  }

  const Cut cut{.first_primitive = 2, .first_plane = 3, .last_plane = 3};
  std::vector<Appearance> looks = std::vector<Appearance>(6);
  ShadeSettings settings;
};

TEST_F(CapPicture, IsFlat) {
  const Picture made = picture(cut.cap_of(1));
  for (size_t i = 0; i < made.rgba.size(); i += 4) {
    EXPECT_EQ(made.rgba[i], to_8_bits(0.92f * 0.5f));
    EXPECT_EQ(made.rgba[i + 1], to_8_bits(0.92f * 0.25f));
    EXPECT_EQ(made.rgba[i + 2], to_8_bits(0.92f));
    EXPECT_EQ(made.rgba[i + 3], 255);
  }
}

TEST_F(CapPicture, IsHatchedAnotherWayForEachColour) {
  settings.hatch = true;
  const Picture one = picture(cut.cap_of(1)), other = picture(cut.cap_of(2));
  // Along a diagonal of the picture one is of one tone, and the other is not.
  bool falls = false, rises = false;
  for (int i = 1; i < 64; ++i) {
    falls |= *one.at(i, i) != *one.at(0, 0);
    EXPECT_NEAR(*one.at(i, 63 - i), *one.at(0, 63), 1);
    EXPECT_NEAR(*other.at(i, i), *other.at(0, 0), 1);
    rises |= *other.at(i, 63 - i) != *other.at(0, 63);
  }
  EXPECT_TRUE(falls && rises);
}

TEST_F(CapPicture, OfThePlaneItselfIsPaintedToo) {
  settings.hatch = true;
  const Picture made = picture(cut.first_plane);
  EXPECT_EQ(made.rgba[3], 255);
}

}  // namespace
}  // namespace whittle
