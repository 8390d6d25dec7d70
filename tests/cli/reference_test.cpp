// whittle FILE --reference: whether a picture still looks as it did.
#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

class Reference : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg", "cube(10, center = true);\n");
    write("other.csg",
          "cube(10, center = true);\n"
          "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]) sphere(2);\n");
    ASSERT_EQ(draw("part.csg", {"-o", "ref.png", "-o", "ref.exr"}).exit_code, 0);
  }
  Ended draw(const std::string& file, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), file);
    arguments.insert(arguments.end(), {"--imgsize", "80,60", "--camera", "0,0,0,55,0,25,60"});
    return run(arguments);
  }
};

TEST_F(Reference, TheSameIsTheSame) {
  for (const char* reference : {"ref.png", "ref.exr"}) {
    const Ended same = draw("part.csg", {"--reference", reference});
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_EQ(same.err, "");
    EXPECT_EQ(same.out, "");
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"other.csg", "part.csg", "ref.exr", "ref.png"}));
}

TEST_F(Reference, WhatHasChangedIsSaidAndShown) {
  const Ended changed = draw(
      "other.csg", {"--reference", "ref.png", "--reference-difference", "d.png", "-o", "new.png"});
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_TRUE(changed.err.starts_with("other.csg: error: not as in ref.png: ")) << changed.err;
  EXPECT_NE(changed.err.find(" of 4800 pixels differ ("), std::string::npos) << changed.err;
  const Result<Picture> difference = read_png(path("d.png")), ref = read_png(path("ref.png")),
                        now = read_png(path("new.png"));
  ASSERT_TRUE(difference && ref && now);
  size_t red = 0, different = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const uint8_t* d = difference->at(x, y);
      red += d[0] == 220 && d[1] == 30;
      int most = 0;
      for (int i = 0; i < 3; ++i)
        most = std::max(most, std::abs(int(ref->at(x, y)[i]) - int(now->at(x, y)[i])));
      different += most > 8;
    }
  }
  EXPECT_GT(red, 20u);
  EXPECT_EQ(red, different);
}

TEST_F(Reference, FactsAreCompared) {
  const Ended changed = draw("other.csg", {"--reference", "ref.exr"});
  EXPECT_EQ(changed.exit_code, 1);
  EXPECT_TRUE(changed.err.starts_with("other.csg: error: not as in ref.exr: ")) << changed.err;
}

TEST_F(Reference, AShareOfThePixelsMayDiffer) {
  EXPECT_EQ(draw("other.csg", {"--reference", "ref.png", "--reference-threshold", "0.5"}).exit_code,
            0);
  EXPECT_EQ(
      draw("other.csg", {"--reference", "ref.png", "--reference-threshold", "0.001"}).exit_code, 1);
  // Another size is another picture.
  EXPECT_EQ(run({"part.csg", "--reference", "ref.png", "--reference-threshold", "0.9"}).exit_code,
            1);
}

TEST_F(Reference, ManyFilesHaveTheirOwn) {
  ASSERT_EQ(draw("other.csg", {"-o", "other-ref.png"}).exit_code, 0);
  ASSERT_EQ(draw("part.csg", {"-o", "part-ref.png"}).exit_code, 0);
  EXPECT_EQ(draw("part.csg", {"other.csg", "--reference", "{name}-ref.png"}).exit_code, 0);
  ASSERT_EQ(draw("part.csg", {"-o", "other-ref.png"}).exit_code, 0);
  const Ended one = draw("part.csg", {"other.csg", "--reference", "{name}-ref.png"});
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_NE(one.err.find("whittle: 1 of 2 files have errors: other.csg\n"), std::string::npos)
      << one.err;
}

TEST_F(Reference, WhatCannotBeComparedIsRefused) {
  const auto expect = [&](std::vector<std::string> arguments, int code, const std::string& why) {
    const Ended ended = draw("part.csg", std::move(arguments));
    EXPECT_EQ(ended.exit_code, code);
    EXPECT_EQ(ended.err, why + "\n");
  };
  expect({"--reference", "ref.jpg"}, 2,
         "whittle: --reference 'ref.jpg' does not end in .png or .exr, so its format is not known");
  expect({"-o", "x.png", "--reference-difference", "d.png"}, 2,
         "whittle: --reference-difference is for --reference FILE");
  expect({"--reference", "ref.png", "--reference-difference", "d.exr"}, 2,
         "whittle: --reference-difference wants a .png file");
  expect({"-o", "ref.png", "--reference", "ref.png"}, 2,
         "whittle: -o ref.png is the file that is read, ref.png, which would be lost");
  expect({"--reference", "none.png"}, 1, "none.png: cannot read: No such file or directory");
  expect({"--reference", "{nome}.png"}, 2,
         "whittle: --reference '{nome}.png': there is no {nome}; there are {name}, with "
         "--animate or --turntable {n}, with --from or --views {view}, and {{ is a brace");
}

}  // namespace
}  // namespace whittle
