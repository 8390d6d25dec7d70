// See-through parts, ghosts and OpenSCAD's preview on the command line.
#include <algorithm>

#include "drop_in.h"

namespace whittle {
namespace {

class Ghosts : public DropIn {
 protected:
  void SetUp() override {
    DropIn::SetUp();
    write("marked.csg",
          "difference() { cube(10, center = true); #cylinder(h = 20, r = 3, center = true); }\n"
          "%sphere(9);\n");
    write("bare.csg",
          "difference() { cube(10, center = true); cylinder(h = 20, r = 3, center = true); }\n");
  }
  std::string picture(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", "p.png", "--imgsize", "64,64"});
    EXPECT_EQ(good(arguments).err, "");
    return read("p.png");
  }
};

TEST_F(Ghosts, AreDrawnWhereTheyAreAskedFor) {
  const std::string bare = picture({"bare.csg"});
  EXPECT_EQ(picture({"marked.csg"}), bare);
  EXPECT_EQ(picture({"bare.csg", "--ghosts"}), bare);
  const std::string ghosts = picture({"marked.csg", "--ghosts"});
  EXPECT_NE(ghosts, bare);
  EXPECT_EQ(picture({"marked.csg", "--preview"}), ghosts);
  EXPECT_EQ(picture({"marked.csg", "--render", "--preview"}), ghosts) << "--preview wins";
  EXPECT_EQ(picture({"marked.csg", "--render"}), bare);
}

TEST_F(Ghosts, WhatIsTrueOfAllPicturesIsSaidOnce) {
  write("flat.csg", "color([1, 0, 0, 0.5]) square([3, 4]);\n");
  const std::string expected =
      "flat.csg: warning: what is flat is drawn opaque, whatever the alpha of its colours\n";
  EXPECT_EQ(good({"flat.csg", "-o", "p.png", "--imgsize", "32,32"}).err, expected);
  EXPECT_EQ(good({"flat.csg", "-o", "{n}.png", "--turntable", "3", "--imgsize", "32,32"}).err,
            expected);
  EXPECT_EQ(good({"flat.csg", "-o", "{view}.png", "--views", "top,iso", "--imgsize", "32,32"}).err,
            expected);
}

TEST_F(Ghosts, NothingSeenInNamedViewsIsSaid) {
  write("empty.csg", "difference() { cube(1); cube(1); }\n");
  const Ended ended =
      run({"empty.csg", "-o", "{view}.png", "--views", "front,top", "--imgsize", "32,32"});
  EXPECT_NE(ended.err.find("the solid is empty"), std::string::npos) << ended.err;
  EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
}

// A section is no cutter of parts: it has caps.
TEST_F(Ghosts, ASectionChangesNoColorsOfCuts) {
  write("two.csg",
        "color([1, 0, 0, 1]) cube(5); color([0, 1, 0, 1]) "
        "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(5);\n");
  EXPECT_EQ(picture({"two.csg", "--section", "y<2", "--cut-color", "part"}),
            picture({"two.csg", "--section", "y<2"}));
}

TEST_F(Ghosts, AreNoPartOfFilesOfTheSolid) {
  for (const std::string ending : {"stl", "off"}) {
    good({"bare.csg", "-o", "bare." + ending});
    good({"marked.csg", "-o", "marked." + ending, "--ghosts"});
    good({"marked.csg", "-o", "preview." + ending, "-o", "p.png", "--preview"});
    EXPECT_EQ(read("marked." + ending), read("bare." + ending));
    EXPECT_EQ(read("preview." + ending), read("bare." + ending));
  }
  const std::vector<std::string> view{"--camera", "0,0,0,55,0,25,80", "--pass", "depth"};
  std::vector<std::string> bare{"bare.csg"}, marked{"marked.csg", "--ghosts"};
  bare.insert(bare.end(), view.begin(), view.end());
  marked.insert(marked.end(), view.begin(), view.end());
  EXPECT_EQ(picture(marked), picture(bare)) << "facts are the solid's";
}

TEST_F(Ghosts, StyleOpenscadHasThemInItsPreviewAlone) {
  expect_refused({"marked.csg", "-o", "x.png", "--style", "openscad", "--ghosts"},
                 "--ghosts: style openscad shows what OpenSCAD's --render does");
  expect_refused({"marked.csg", "-o", "x.png", "--style", "openscad", "--cut-color", "part"},
                 "--cut-color part: style openscad shows what OpenSCAD's --render does");
  const std::string preview = picture({"marked.csg", "--style", "openscad", "--preview"});
  EXPECT_NE(preview, picture({"marked.csg", "--style", "openscad"}));
  EXPECT_NE(preview, picture({"marked.csg", "--style", "openscad", "--preview=throwntogether"}));
}

TEST_F(Ghosts, ThrownTogetherIsForPictures) {
  for (const std::string command : {"info", "bench"}) {
    expect_refused({command, "marked.csg", "--preview=throwntogether"},
                   "--preview=throwntogether is for pictures");
  }
  EXPECT_NE(picture({"bare.csg", "--preview=throwntogether"}), picture({"bare.csg"}));
}

TEST_F(Ghosts, CutColorsAreTwo) {
  expect_refused({"bare.csg", "-o", "x.png", "--cut-color", "red"},
                 "--cut-color: wants cutter or part, not red");
  EXPECT_EQ(picture({"bare.csg", "--cut-color", "cutter"}), picture({"bare.csg"}));
  EXPECT_NE(picture({"bare.csg", "--cut-color", "part"}), picture({"bare.csg"}));
}

TEST_F(Ghosts, WhatCannotBeSeeThroughIsSaid) {
  write("flat.csg", "color([1, 0, 0, 0.5]) square(3);");
  EXPECT_EQ(good({"flat.csg", "-o", "p.png"}).err,
            "flat.csg: warning: what is flat is drawn opaque, whatever the alpha of its colours\n");
  EXPECT_EQ(good({"flat.csg", "-o", "p.png", "--style", "openscad"}).err, "");
  write("mark.csg", "cube(3);\n%square(3);");
  EXPECT_EQ(good({"mark.csg", "-o", "p.png"}).err, "");
  EXPECT_EQ(good({"mark.csg", "-o", "p.png", "--ghosts"}).err,
            "mark.csg:2:2: warning: what % marks is flat; it is not drawn\n");
}

}  // namespace
}  // namespace whittle
