// whittle slice: layers as one SVG, or as a PNG each.
#include <regex>
#include <string>
#include <vector>

#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

class Slice : public ProgramTest {
 protected:
  void SetUp() override {
    write("plate.csg",
          "difference() { cube(size = [20, 10, 4]);"
          " multmatrix([[1, 0, 0, 5], [0, 1, 0, 5], [0, 0, 1, 1], [0, 0, 0, 1]])"
          " cube(size = [4, 2, 9]); }\n");
  }

  void expect_usage_error(std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), {"slice", "plate.csg"});
    const Ended refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2) << message;
    EXPECT_EQ(refused.err.substr(0, refused.err.find('\n')), "whittle: " + message);
    EXPECT_EQ(files(), std::vector<std::string>{"plate.csg"}) << "a refused run makes nothing";
  }

  /// How white a picture is, in pixels.
  double white(const std::string& name) {
    const Result<Picture> picture = read_png(path(name));
    if (!picture) {
      ADD_FAILURE() << picture.error().message;
      return 0;
    }
    double sum = 0;
    for (int y = 0; y < picture->height; ++y) {
      for (int x = 0; x < picture->width; ++x) {
        const uint8_t* at = picture->at(x, y);
        EXPECT_TRUE(at[0] == at[1] && at[1] == at[2] && at[3] == 255);
        sum += at[0] / 255.0;
      }
    }
    return sum;
  }
};

TEST_F(Slice, AnSvgHasAGroupALayer) {
  const Ended done = run({"slice", "plate.csg", "--z", "0:1.5:4,4", "-o", "{name}.svg"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
  const std::string svg = read("plate.svg");
  const std::regex groups("<g id=\"layer(\\d)\" data-z=\"([^\"]*)\">");
  std::string found;
  for (std::sregex_iterator it(svg.begin(), svg.end(), groups), end; it != end; ++it)
    found += (*it)[1].str() + " at " + (*it)[2].str() + "; ";
  EXPECT_EQ(found, "0 at 0; 1 at 1.5; 2 at 3; 3 at 4; ");
  EXPECT_NE(svg.find("width=\"20mm\" height=\"10mm\""), std::string::npos);
  const auto count = [&](const std::string& word) {
    size_t n = 0;
    for (size_t at = svg.find(word); at != std::string::npos; at = svg.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<path"), 3u) << "nothing of the solid is above 4";
  EXPECT_EQ(count(" z\n"), 1u + 2u + 2u) << "the hole begins at 1";
}

TEST_F(Slice, PicturesAreWhiteInside) {
  const Ended done = run({"slice", "plate.csg", "--z", "0,2", "-o", "layer{n}.png", "--imgsize",
                          "30,30", "--pixel-size", "1"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(files(), (std::vector<std::string>{"layer00000.png", "layer00001.png", "plate.csg"}));
  EXPECT_DOUBLE_EQ(white("layer00000.png"), 200);
  EXPECT_DOUBLE_EQ(white("layer00001.png"), 200 - 8);
  const Result<Picture> picture = read_png(path("layer00001.png"));
  ASSERT_TRUE(picture);
  // The box's middle, 10,5, is the picture's; the hole's, 7,6, is 3 to the left and 1 above.
  EXPECT_EQ(picture->at(12, 14)[0], 0);
  EXPECT_EQ(picture->at(17, 14)[0], 255);
  EXPECT_EQ(picture->at(5, 15)[0], 255);
  EXPECT_EQ(picture->at(4, 15)[0], 0);
}

TEST_F(Slice, PicturesFitTheBoxAndAreAntialiased) {
  const Ended done = run({"slice", "plate.csg", "--z", "0", "-o", "one.png", "--imgsize", "30,30"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  // Two thirds of a millimetre a pixel. Rows that are half covered are 127.5, rounded up.
  EXPECT_NEAR(white("one.png"), 200 * 2.25, 0.12);
}

TEST_F(Slice, IsTheSameOnAnyNumberOfThreads) {
  write("ball.csg", "sphere(r = 10, $fn = 40);\n");
  for (const char* threads : {"1", "3"}) {
    const std::string name = std::string("t") + threads;
    EXPECT_EQ(
        run({"slice", "ball.csg", "--z", "-10:0.5:10", "-o", name + ".svg", "--threads", threads})
            .exit_code,
        0);
    EXPECT_EQ(run({"slice", "ball.csg", "--z", "-10:4:10", "-o", name + "_{n}.png", "--imgsize",
                   "40,40", "--threads", threads})
                  .exit_code,
              0);
  }
  EXPECT_EQ(read("t1.svg"), read("t3.svg"));
  for (int i = 0; i <= 5; ++i) {
    const std::string rest = "_0000" + std::to_string(i) + ".png";
    EXPECT_EQ(read("t1" + rest), read("t3" + rest)) << i;
  }
}

TEST_F(Slice, SaysWhenThereIsNothing) {
  write("none.csg", "difference() { cube(size = 1); cube(size = 1); }\n");
  const Ended none = run({"slice", "none.csg", "--z", "0:2", "-o", "none.svg"});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_EQ(none.err, "none.csg: note: the solid is empty, and so are the layers\n");
  EXPECT_NE(read("none.svg").find("<g id=\"layer2\" data-z=\"2\">\n</g>"), std::string::npos);
  const Ended dark = run({"slice", "none.csg", "--z", "0", "-o", "none.png", "--imgsize", "4,4"});
  EXPECT_EQ(dark.exit_code, 0);
  EXPECT_EQ(white("none.png"), 0);
  const Ended above = run({"slice", "plate.csg", "--z", "4:9", "-o", "above.svg"});
  EXPECT_EQ(above.exit_code, 0);
  EXPECT_EQ(above.err, "plate.csg: note: no layer meets the solid, which is from z = 0 to 4\n");
  EXPECT_EQ(run({"slice", "plate.csg", "--z", "4:9", "-o", "above.svg", "-q"}).err, "");
}

TEST_F(Slice, RefusesWhatHasNoLayers) {
  write("flat.csg", "square(size = 1);\n");
  const Ended flat = run({"slice", "flat.csg", "--z", "0", "-o", "x.svg"});
  EXPECT_EQ(flat.exit_code, 1);
  EXPECT_EQ(flat.err,
            "flat.csg: error: the model is flat, not a solid; .svg and .dxf hold what is flat\n");
  write("ball.csg", "sphere(r = 1);\n");
  const Ended curves = run({"slice", "ball.csg", "--z", "0", "-o", "x.svg", "--curves", "smooth"});
  EXPECT_EQ(curves.exit_code, 1);
  EXPECT_NE(curves.err.find("(--curves smooth asks for them)"), std::string::npos) << curves.err;
  const Ended large = run({"slice", "plate.csg", "--z", "0", "-o", "x.png", "--imgsize", "30,30",
                           "--pixel-size", "0.5"});
  EXPECT_EQ(large.exit_code, 1);
  EXPECT_EQ(
      large.err,
      "plate.csg: error: the solid is 20 x 10 mm, and 30 x 30 pixels of 0.5 mm are 15 x 15\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"ball.csg", "flat.csg", "plate.csg"}));
}

TEST_F(Slice, WhatIsNotShownIsNoSuccess) {
  write("part.csg", "cube(size = 1); roof() square(size = 1);\n");
  const Ended done = run({"slice", "part.csg", "--z", "0", "-o", "x.svg", "-q"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_NE(done.err.find("so the stack of layers is not what was meant"), std::string::npos);
  EXPECT_EQ(run({"slice", "part.csg", "--z", "0", "-o", "x.svg", "--lenient"}).exit_code, 0);
}

TEST_F(Slice, RefusesCommandLinesThatAreNotRight) {
  expect_usage_error({"-o", "x.svg"}, "--z is required: the layers' heights, as in 0:0.2:40");
  expect_usage_error({"--z", "1"}, "-o is required: an .svg, or '{n}.png'");
  expect_usage_error({"--z", "2:0:4", "-o", "x.svg"}, "--z: the range 2:0:4 has a step of 0");
  expect_usage_error({"--z", "0:1e-9:4", "-o", "x.svg"},
                     "--z: wants at most 100000 layers, not 0:1e-9:4");
  expect_usage_error({"--z", "1", "-o", "x.stl"}, "-o wants an .svg or .png file, not 'x.stl'");
  expect_usage_error({"--z", "1", "-o", "{n}.svg"},
                     "-o '{n}.svg': an .svg holds all layers; {n} is for .png");
  expect_usage_error({"--z", "1:3", "-o", "x.png"},
                     "there are 3 layers and one -o x.png; with {n} in it, as in '{n}.png', each "
                     "has its own");
  expect_usage_error({"--z", "1", "-o", "{nom}.png"},
                     "-o '{nom}.png': there is no {nom}; there are {name} and {n}, and {{ is a "
                     "brace");
  expect_usage_error({"--z", "1", "-o", "x.svg", "--imgsize", "9,9"},
                     "--imgsize and --pixel-size are for .png; an .svg is in millimetres");
  expect_usage_error({"--z", "1", "-o", "x.png", "--pixel-size", "0"},
                     "--pixel-size: wants a number above 0, not 0");
}

TEST_F(Slice, WritesNoFolderThatIsNotThere) {
  const Ended refused = run({"slice", "plate.csg", "--z", "1:3", "-o", "no/{n}.png"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("no/00000.png"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace whittle
