// What the program says about itself and about command lines that are not right: exit code 2.
#include <filesystem>

#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

class Usage : public ProgramTest {
 protected:
  void SetUp() override { write("part.csg", "cube(10);\n"); }

  /// Runs `part.csg -o x.png` with more arguments, which must be refused with that message.
  void expect_refused(std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), {"part.csg", "-o", "x.png"});
    const Ended refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err, "whittle: " + message + "\nTry 'whittle --help'.\n");
    EXPECT_EQ(files(), std::vector<std::string>{"part.csg"}) << "a refused run makes nothing";
  }
};

TEST_F(Usage, HelpOfEveryCommandTellsUsageExamplesAndExitCodes) {
  for (const char* command : {"", "info", "cells", "compare", "bench", "model", "devices", "pick",
                              "cast", "measure", "slice", "params", "edit"}) {
    std::vector<std::string> arguments{"--help"};
    if (*command != '\0') arguments.insert(arguments.begin(), command);
    const Ended help = run(arguments);
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.err, "") << command;
    for (const char* part : {"Usage: whittle", "Examples:", "Exit codes: 0", "-h,--help"})
      EXPECT_NE(help.out.find(part), std::string::npos) << command << " says no " << part;
    EXPECT_EQ(help.out.find(" \n"), std::string::npos) << command << ": blanks at a line's end";
    size_t column = 0;
    for (const char c : help.out) {
      column = c == '\n' ? 0 : column + 1;
      ASSERT_LE(column, 100u) << command << ": a line too long for a terminal";
    }
  }
}

TEST_F(Usage, TheVersionIsOneLine) {
  const Ended version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out.substr(0, 8), "whittle ");
  EXPECT_EQ(version.out.find('\n'), version.out.size() - 1);
  EXPECT_EQ(run({"-v"}).out, version.out);
}

TEST_F(Usage, AFileIsRequired) {
  const Ended missing = run({});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_EQ(missing.err, "whittle: FILE is required\nTry 'whittle --help'.\n");
}

TEST_F(Usage, AWordThatIsNoFileIsNoCommandEither) {
  const Ended typo = run({"rander", "-o", "x.png"});
  EXPECT_EQ(typo.exit_code, 2);
  EXPECT_EQ(typo.err,
            "whittle: there is neither a file nor a command 'rander'; commands are: info, cells, "
            "compare, bench, model, devices, pick, cast, measure, slice, params, edit\nTry "
            "'whittle --help'.\n");
}

TEST_F(Usage, WithoutAnOutputAndADisplayItSaysThatThereIsNoWindow) {
  const Ended missing = run({"part.csg"});
  EXPECT_EQ(missing.exit_code, WHITTLE_HAS_VIEWER ? 3 : 2);
  EXPECT_EQ(missing.err,
            std::string("whittle: ") +
                (WHITTLE_HAS_VIEWER ? "there is no display for a window"
                                    : "this whittle was built without its window") +
                "; give -o FILE, which may end in .png, .exr, .stl, .off, .obj, .3mf, .amf, .svg, "
                ".dxf, .gif, .apng, .mp4 or .webm\n");
}

TEST_F(Usage, AWindowMakesNoFiles) {
  if (!WHITTLE_HAS_VIEWER) return;
  const Ended animated = run({"part.csg", "--summary", "all"});
  EXPECT_EQ(animated.exit_code, 2);
  EXPECT_EQ(animated.err, "whittle: --summary is for files that are made; give -o FILE\n");
}

TEST_F(Usage, TheEndingOfTheOutputMustBeKnown) {
  const Ended unknown = run({"part.csg", "-o", "x.jpg"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.err,
            "whittle: 'x.jpg' does not end in .png, .exr, .stl, .off, .obj, .3mf, .amf, .svg, "
            ".dxf, .gif, .apng, .mp4 or .webm, so its format is not known\n");
  const Ended standard = run({"part.csg", "-o", "-"});
  EXPECT_EQ(standard.exit_code, 2);
  EXPECT_EQ(
      standard.err,
      "whittle: -o - (standard output) needs --export-format png, exr, stl, off, obj, 3mf, amf, "
      "svg, dxf, gif, apng, mp4, webm, binstl, asciistl\n");
}

TEST_F(Usage, StandardOutputHoldsOnePicture) {
  const Ended twice =
      run({"part.csg", "-o", "-", "-o", "x.png", "-o", "-", "--export-format", "png"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_EQ(twice.out, "");
  EXPECT_EQ(twice.err, "whittle: -o - (standard output) is given more than once\n");
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
}

TEST_F(Usage, TheInputIsNoOutput) {
  const std::string text = read("part.csg");
  std::filesystem::create_symlink("part.csg", path("link.png"));
  std::filesystem::create_symlink(path("link.png"), path("chain.png"));
  std::filesystem::create_hard_link(path("part.csg"), path("hard.png"));
  const std::vector<std::string> before = files();
  const auto expect_kept = [&](const std::vector<std::string>& arguments, const std::string& output,
                               const std::string& input, const RunSettings& settings = {}) {
    const Ended refused = run(arguments, settings);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err, "whittle: -o " + output + " is the file that is read, " + input +
                               ", which would be lost\n");
    EXPECT_EQ(read("part.csg"), text);
    EXPECT_EQ(files(), before);
  };
  expect_kept({"part.csg", "-o", "x.png", "-o", "part.csg", "--export-format", "png"}, "part.csg",
              "part.csg");
  expect_kept({"link.png", "-o", "./link.png"}, "./link.png", "link.png");
  for (const char* output : {"link.png", "chain.png", "hard.png"}) {
    expect_kept({"part.csg", "-o", output}, output, "part.csg");
    expect_kept({"cells", "part.csg", "-o", output}, output, "part.csg");
    expect_kept({"compare", "x.exr", "part.csg", "-o", output}, output, "part.csg");
    expect_kept({"compare", "part.csg", "x.exr", "-o", output}, output, "part.csg");
  }
  // What is no file of bytes may be both.
  EXPECT_EQ(run({"/dev/null", "-o", "/dev/null", "--export-format", "png"}).exit_code, 0);
}

TEST_F(Usage, NamesInMessagesCommandNoTerminal) {
  const std::string odd = "a\nb\x1b[31m.csg", shown = "a?b?[31m.csg";
  write(odd, "cube(1); roof() square(1);\n");
  EXPECT_EQ(run({odd, "-o", "x.png", "--imgsize", "8,8", "--lenient"}).err,
            shown + ":1:10: warning: roofs are not supported; nothing is shown for it\n");
  EXPECT_EQ(run({odd, "-o", "x.png", "--strict"}).err,
            shown + ":1:10: error: roofs are not supported (--strict)\n");
  EXPECT_EQ(run({odd, "-o", odd}).err,
            "whittle: '" + shown +
                "' asks for .csg, which whittle does not write; it writes .png, .exr, .stl, "
                ".off, .obj, .3mf, .amf, .svg, .dxf, .gif, .apng, .mp4 or .webm\n");
  EXPECT_EQ(run({"part.csg", "-o", "b\x1b/x.png"}).err,
            "whittle: cannot write 'b?/x.png': No such file or directory\n");
  EXPECT_EQ(run({"part.csg", "-o", "x.png", "--style", "\n\x1b"}).err,
            "whittle: --style: unknown style '?\?'; there are: studio, plain, blinn, openscad\n"
            "Try 'whittle --help'.\n");
  EXPECT_EQ(run({"info", odd}).out.find("file         " + shown + "\n"), 0u);
  EXPECT_EQ(run({"bench", odd, "--imgsize", "8,8", "--repeat", "1"}).out.find(shown + ": 8 x 8"),
            0u);
}

TEST_F(Usage, AnOptionWithoutItsValueIsNamed) {
  for (const std::string option : {"--view", "--csglimit", "--debug"}) {
    expect_refused({option}, option + ": 1 required VALUE missing");
  }
  expect_refused({"-D"}, "-D: 1 required NAME=VALUE missing");
  expect_refused({"--summary-file"}, "--summary-file: 1 required FILE missing");
  expect_refused({"--imgsize"}, "--imgsize: 1 required W,H missing");
}

TEST_F(Usage, WrongNumbersAreRefused) {
  expect_refused({"--imgsize", "64"}, "--imgsize: wants 2 numbers, not 1 ('64')");
  expect_refused({"--imgsize", "64x64"}, "--imgsize: wants W,H as in 800,600, not 64x64");
  expect_refused({"--imgsize", "64,64,3"}, "--imgsize: wants 2 numbers, not 3 ('64,64,3')");
  expect_refused({"--imgsize", "64,x"}, "--imgsize: 'x' is not a number");
  expect_refused({"--imgsize", "64,1.5"}, "--imgsize: wants whole numbers, not 64,1.5");
  expect_refused({"--imgsize", "0,64"},
                 "--imgsize: a picture of 0 x 64 pixels is not possible: each side is 1 to 65535, "
                 "and all together at most 268435456 pixels");
  expect_refused({"--imgsize", "65535,65535"},
                 "--imgsize: a picture of 65535 x 65535 pixels is not possible: each side is 1 to "
                 "65535, and all together at most 268435456 pixels");
  expect_refused({"--imgsize", "99999999999,1"},
                 "--imgsize: wants sides of 1 to 65535, not 99999999999,1");
  expect_refused({"--imgsize", "1,-1e300"}, "--imgsize: wants sides of 1 to 65535, not 1,-1e300");
  expect_refused({"--fov", "180"}, "--fov: wants an angle between 0 and 180, not 180");
  expect_refused({"--aa", "0"}, "--aa: wants a whole number, 1 to 16, not 0");
  expect_refused({"--threads", "-1"}, "--threads: wants a whole number, 0 to 1024, not -1");
  expect_refused({"--leaf-size", "0"}, "--leaf-size: wants a whole number, 1 to 1000, not 0");
  expect_refused({"--pixel-threshold", "-1"},
                 "--pixel-threshold: wants a number from 0 on, not -1");
  expect_refused({"--light", "1,2"}, "--light: wants 3 numbers, not 2 ('1,2')");
  expect_refused({"--light", "1,2,nan"}, "--light: 'nan' is not a number");
}

TEST_F(Usage, LimitsAreNamesAndNumbers) {
  expect_refused({"--limit", "width=3"},
                 "--limit: unknown limit 'width'; there are: bytes, depth, nodes, values, facets, "
                 "memory; as in --limit depth=1000");
  expect_refused({"--limit", "depth"}, "--limit: '' is not a number");
  expect_refused({"--limit", "nodes=0"}, "--limit: wants a whole number, 1 to 1000000000, not 0");
  expect_refused({"--memory", "0"}, "--memory: wants a whole number, 1 to 1125899906842624, not 0");
  expect_refused({"--memory", "2X"}, "--memory: '2X' is not a number");
  expect_refused({"--limit", "memory=10M"}, "--limit: memory must be at least 64M, not 10M");
  expect_refused({"--limit", "memory=2X"}, "--limit: '2X' is not a number");
}

TEST_F(Usage, OfAnOptionGivenTwiceTheLastValueCounts) {
  const Ended done = run({"part.csg", "-o", "x.png", "--imgsize", "64,64", "--imgsize=7,5"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const Result<Picture> picture = read_png(path("x.png"));
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(picture->width, 7);
  EXPECT_EQ(picture->height, 5);
}

TEST_F(Usage, ACameraHasSixOrSevenNumbers) {
  expect_refused({"--camera", "1,2,3"},
                 "--camera: Camera setup requires either 7 numbers for Gimbal Camera or 6 numbers "
                 "for Vector Camera (--camera=1,2,3)");
}

TEST_F(Usage, UnknownNamesAreAnsweredWithThoseThereAre) {
  expect_refused({"--quality", "x"},
                 "--quality: unknown quality 'x'; there are: draft, good, best");
  expect_refused({"--style", "x"},
                 "--style: unknown style 'x'; there are: studio, plain, blinn, openscad");
  expect_refused({"--backend", "gpu"},
                 "--backend: unknown backend 'gpu'; there are: auto, cpu, vulkan-raster, oracle");
  expect_refused({"--pass", "x"}, "--pass: unknown pass 'x'; there are: color, depth, normal, id");
  expect_refused({"--curves", "x"},
                 "--curves: unknown kind of curves 'x'; there are: auto, facets, smooth");
  expect_refused({"--projection", "x"},
                 "--projection: unknown projection 'x'; there are: perspective, p, orthogonal, "
                 "ortho, o");
  expect_refused({"--split", "x"},
                 "--split: unknown split rule 'x'; there are: longest, xyz, octree, cost");
  expect_refused({"--small-cells", "x"},
                 "--small-cells: unknown fate of small cells 'x'; there are: trace, ignore");
  expect_refused({"--colorscheme", "Foo"},
                 "--colorscheme: unknown colour scheme 'Foo'; there are: Cornfield, Metallic, "
                 "Sunset, Starnight, BeforeDawn, Nature, Daylight Gem, Nocturnal Gem, DeepOcean, "
                 "Solarized, Tomorrow, Tomorrow Night, ClearSky, Monotone");
}

TEST_F(Usage, UnknownOptionsAreRefused) {
  expect_refused({"--bogus"}, "The following argument was not expected: --bogus");
}

TEST_F(Usage, EveryCommandRefusesWhatItDoesNotKnow) {
  for (const char* command : {"info", "compare", "bench", "model", "pick", "cast", "measure",
                              "slice", "params", "edit"}) {
    const Ended refused = run({command, "--bogus"});
    EXPECT_EQ(refused.exit_code, 2) << command;
    EXPECT_NE(refused.err.find(std::string("Try 'whittle ") + command + " --help'."),
              std::string::npos)
        << refused.err;
  }
}

TEST_F(Usage, AFileCalledLikeACommandIsReached) {
  write("info", "cube(10);\n");
  EXPECT_EQ(run({"./info", "-o", "x.png", "--imgsize", "8,8"}).exit_code, 0);
  EXPECT_EQ(run({"info", "info"}).exit_code, 0);
}

}  // namespace
}  // namespace whittle
