#include "host/input_kinds.h"

#include <gtest/gtest.h>

namespace whittle {
namespace {

TEST(InputKinds, TheEndingOfTheNameDecides) {
  for (const char* path : {"a.scad", "b/A.SCAD", ".scad"}) {
    EXPECT_EQ(kind_of_input(path), InputKind::kScad) << path;
  }
  for (const char* path :
       {"a.stl", "A.STL", "a.off", "a.obj", "a.3mf", "a.amf", "a.svg", "a.Dxf"}) {
    EXPECT_EQ(kind_of_input(path), InputKind::kShape) << path;
  }
  for (const char* path : {"", "-", "a", "a.csg", "A.CSG", "a.stl.gz", "a.stl/b", "stl", "scad"}) {
    EXPECT_EQ(kind_of_input(path), InputKind::kCsg) << path;
  }
}

TEST(InputKinds, TextIsNothingElse) {
  for (const char* text : {"", "cube();", "solid", "solid = 3;", "BZh = 3;", "OFFSET = 1;", "P",
                           "// <svg>", "// ISO-10303-21"}) {
    EXPECT_FALSE(describe_foreign(text)) << text;
  }
  for (const char* text : {"\x1f\x8b", "BZh91AY&SY", "PK\x03\x04", "\x89PNG", "%PDF-1.4",
                           "ISO-10303-21;", "OFF\n8 6 0", "<svg>", "solid x\nfacet normal"}) {
    EXPECT_TRUE(describe_foreign(text)) << text;
  }
}

TEST(InputKinds, StringsAreQuoted) {
  EXPECT_EQ(quoted_string("a \"b\" \\c"), "\"a \\\"b\\\" \\\\c\"");
}

}  // namespace
}  // namespace whittle
