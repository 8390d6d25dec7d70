#include "whittle/camera_text.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(CameraText, MustBeSixOrSevenNumbers) {
  for (const char* text : {"", "1", "1,2,3", "1,2,3,4,5,6,7,8", "1,2,3,4,5,x", "1,2,3,4,5,",
                           "1,2,3,4,5,6,inf", "1,2,3,4,5,nan", "1 2 3 4 5 6"}) {
    const Result<ViewOptions> parsed = parse_camera(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().kind, ErrorKind::kUsage);
    EXPECT_NE(parsed.error().message.find("Camera"), std::string::npos);
  }
  EXPECT_TRUE(parse_camera(" 1, +2 ,3e0,-4,5,.6,7"));
}

TEST(CameraText, ALaterOneReplacesTheEarlier) {
  const ViewOptions gimbal = *parse_camera("0,0,0,0,0,0,50");
  const ViewOptions both = *parse_camera("1,2,3,4,5,6", gimbal);
  EXPECT_FALSE(both.distance);
  EXPECT_TRUE(both.eye);
  EXPECT_FALSE(parse_camera("0,0,0,0,0,0,50", both)->eye);
}

TEST(CameraText, IsWhatIsReadAgain) {
  for (const char* text : {"1,2,3,40,0,60.5,70", "1,-2,3,4,5,6e-07"}) {
    EXPECT_EQ(camera_text(*parse_camera(text)), text);
  }
}

}  // namespace
}  // namespace whittle
