#include "whittle/section_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <vector>

namespace whittle {
namespace {

std::string planes_of(const std::string& text) {
  const Result<Section> section = parse_section(text);
  if (!section) return "refused";
  std::string planes;
  for (const auto& [n, d] : section->planes)
    planes += fmt::format("{:.4g},{:.4g},{:.4g}@{:.4g} ", n.x + 0, n.y + 0, n.z + 0, d + 0);
  return planes;
}

TEST(SectionText, SaysWhatIsTakenAway) {
  EXPECT_EQ(planes_of("x>1"), "1,0,0@1 ");
  EXPECT_EQ(planes_of("x<1"), "-1,0,0@-1 ");
  EXPECT_EQ(planes_of("z > -3.5"), "0,0,1@-3.5 ");
  EXPECT_EQ(planes_of("n=[3,0,4],d>10"), "0.6,0,0.8@2 ");
  EXPECT_EQ(planes_of(" n = [ 3 , 0 , 4 ] , d < 10 "), "-0.6,0,-0.8@-2 ");
  EXPECT_EQ(planes_of("x>0,y<0"), "1,0,0@0 0,-1,0@0 ");
  EXPECT_EQ(planes_of("n=[0,0,2],d>1,x<+5"), "0,0,1@0.5 -1,0,0@-5 ");
}

TEST(SectionText, WithoutASideTheDefaultCameraLooksIntoTheCut) {
  EXPECT_EQ(planes_of("x=2"), planes_of("x>2"));
  EXPECT_EQ(planes_of("y=2"), planes_of("y<2"));
  EXPECT_EQ(planes_of("z=2"), planes_of("z>2"));
  EXPECT_EQ(planes_of("n=[1,1,0],d=3"), planes_of("n=[1,1,0],d<3"));
  EXPECT_EQ(planes_of("n=[-1,-1,0],d=3"), planes_of("n=[-1,-1,0],d>3"));
}

TEST(SectionText, AnythingElseIsRefusedInWords) {
  for (const char* text : {"",
                           " ",
                           "x",
                           "x=",
                           "=1",
                           "x==1",
                           "w=1",
                           "x=1y=2",
                           "x=1,",
                           "x=1,,y=1",
                           ",",
                           "x=nan",
                           "x=inf",
                           "x=1e999",
                           "x=-nan",
                           "x>0x10",
                           "x=++1",
                           "x=1 2",
                           "n=[0,0,0],d=1",
                           "n=[0,0,1]",
                           "n=[0,0,1],",
                           "n=[0,0],d=1",
                           "n=[0,0,1,0],d=1",
                           "n=[nan,0,1],d=1",
                           "n=[1e999,0,1],d=1",
                           "n=0,0,1,d=1",
                           "n=[0,0,1],d=1e101",
                           "n=[0,0,1e-200],d=1e200",
                           "n>[0,0,1],d=1",
                           "X=1",
                           "x=1;y=2",
                           "d=1"}) {
    const Result<Section> section = parse_section(text);
    ASSERT_FALSE(section) << text;
    EXPECT_EQ(section.error().kind, ErrorKind::kUsage);
    EXPECT_NE(section.error().message.find(text), std::string::npos) << section.error().message;
  }
}

TEST(SectionText, HasSoManyPlanesAndNoMore) {
  std::string text = "x=1";
  for (size_t i = 1; i < kMostSectionPlanes; ++i) text += ",y=2";
  EXPECT_EQ(parse_section(text)->planes.size(), kMostSectionPlanes);
  EXPECT_FALSE(parse_section(text + ",z=0"));
}

TEST(SectionText, ALongTextIsNotRepeatedWhole) {
  const Result<Section> section = parse_section(std::string(1'000'000, 'x'));
  ASSERT_FALSE(section);
  EXPECT_LT(section.error().message.size(), 300u);
}

TEST(SectionText, AnyPlaneIsReadAsItIsWritten) {
  EXPECT_TRUE(rc::check([] {
    const auto number = [] { return double(*rc::gen::inRange(-1000000, 1000000)) / 1000; };
    const Vec3 n{number(), number(), number()};
    const double d = number();
    RC_PRE(n != Vec3{});
    const bool lesser = *rc::gen::arbitrary<bool>();
    const Result<Section> section =
        parse_section(fmt::format("n=[{},{},{}],d{}{}", n.x, n.y, n.z, lesser ? '<' : '>', d));
    RC_ASSERT(bool(section));
    const Plane& plane = section->planes.at(0);
    const double sign = lesser ? -1 : 1;
    RC_ASSERT(length(plane.n * length(n) - n * sign) <= 1e-12 * length(n));
    RC_ASSERT(std::fabs(plane.d * length(n) - d * sign) <= 1e-12 * (1 + std::fabs(d)));
  }));
}

TEST(SectionText, AnyTextIsReadOrRefused) {
  EXPECT_TRUE(rc::check([] {
    const std::string alphabet = "xyznd=<>[],.-+0123456789e \t";
    std::string text;
    for (const uint8_t c : *rc::gen::arbitrary<std::vector<uint8_t>>())
      text += c < 250 ? alphabet[c % alphabet.size()] : char(c);
    const Result<Section> section = parse_section(text);
    if (!section) return;
    RC_ASSERT(!section->planes.empty() && section->planes.size() <= kMostSectionPlanes);
    for (const Plane& plane : section->planes) {
      RC_ASSERT(std::fabs(length(plane.n) - 1) < 1e-12);
      RC_ASSERT(std::fabs(plane.d) <= kFarthestSection);
    }
  }));
}

}  // namespace
}  // namespace whittle
