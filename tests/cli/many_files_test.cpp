// whittle FILE... -o '{name}.png': many files in one run.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sstream>

#include "support/program.h"

namespace whittle {
namespace {

class ManyFiles : public ProgramTest {
 protected:
  void SetUp() override {
    write("ball.csg", "sphere(3);\n");
    write("box.csg", "cube(3);\n");
    write("rod.csg", "cylinder(h = 9, r = 1);\n");
  }

  std::vector<std::string> lines_of_error(const Ended& ended) const {
    std::vector<std::string> lines;
    std::istringstream text(ended.err);
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  void expect_refused(std::vector<std::string> arguments, const std::string& why) const {
    const std::vector<std::string> before = files();
    arguments.insert(arguments.end(), {"--imgsize", "20,20"});
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_EQ(ended.err, "whittle: " + why + "\n");
    EXPECT_EQ(files(), before);
  }
};

TEST_F(ManyFiles, EachGetsThePictureThatItGetsAlone) {
  const std::vector<std::string> names = {"ball", "box", "rod"};
  for (const std::string& name : names)
    ASSERT_EQ(run({name + ".csg", "-o", name + "-alone.png", "--imgsize", "60,40"}).exit_code, 0);
  for (const char* threads : {"1", "2", "7"}) {
    const Ended ended = run({"ball.csg", "box.csg", "rod.csg", "-o", "{name}.png", "-o",
                             "{name}-facts.exr", "--imgsize", "60,40", "--threads", threads});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_EQ(ended.err, "");
    for (const std::string& name : names) {
      EXPECT_EQ(read(name + ".png"), read(name + "-alone.png"));
      EXPECT_FALSE(read(name + "-facts.exr").empty());
      std::filesystem::remove(path(name + ".png"));
    }
  }
}

TEST_F(ManyFiles, ABadOneStopsNoOtherAndIsNamed) {
  write("bad.csg", "sphere(;\n");
  const Ended ended = run(
      {"ball.csg", "bad.csg", "missing.csg", "rod.csg", "-o", "{name}.png", "--imgsize", "20,20"});
  EXPECT_EQ(ended.exit_code, 1);
  const std::vector<std::string> lines = lines_of_error(ended);
  ASSERT_EQ(lines.size(), 3u) << ended.err;
  EXPECT_TRUE(lines[0].starts_with("bad.csg:1:8: error: ")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("missing.csg: error: ")) << lines[1];
  EXPECT_EQ(lines[2], "whittle: 2 of 4 files have errors: bad.csg, missing.csg");
  EXPECT_FALSE(read("ball.png").empty());
  EXPECT_FALSE(read("rod.png").empty());
}

TEST_F(ManyFiles, TheExitCodeIsThatOfTheWorst) {
  write("bad.csg", "sphere(;\n");
  write("empty.csg", "");
  // The folder of one output is not there.
  const Ended ended = run({"bad.csg", "ball.csg", "-o", "{name}/x.png"});
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  const Ended lenient = run({"empty.csg", "ball.csg", "-o", "{name}.png", "--imgsize", "9,9"});
  EXPECT_EQ(lenient.exit_code, 0);
  EXPECT_EQ(lenient.err, "empty.csg: warning: the solid is empty\n");
}

TEST_F(ManyFiles, WhatAFileSaysStaysTogetherInTheOrderOfTheFiles) {
  std::vector<std::string> arguments;
  std::string expected;
  for (int i = 0; i < 12; ++i) {
    const std::string name = "w" + std::to_string(i);
    std::string text = "cube(1);\n";
    for (int k = 0; k < 5; ++k) {
      text += "nonsense" + std::to_string(k) + "();\n";
    }
    // Those that come first take longest.
    if (i < 3) text += std::string(200000, ' ');
    write(name + ".csg", text);
    arguments.push_back(name + ".csg");
    const Ended alone = run({name + ".csg", "-o", "x.png", "--imgsize", "9,9", "--lenient"});
    EXPECT_FALSE(alone.err.empty());
    expected += alone.err;
  }
  arguments.insert(arguments.end(),
                   {"-o", "{name}.png", "--imgsize", "9,9", "--lenient", "--threads", "4"});
  const Ended ended = run(arguments);
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, expected);
}

TEST_F(ManyFiles, SeveralWithOneOutputAreRefused) {
  expect_refused({"ball.csg", "box.csg", "-o", "x.png"},
                 "there are 2 files and one -o x.png; with {name} in it, as in '{name}.png', each "
                 "has its own");
  expect_refused({"ball.csg", "box.csg", "-o", "-", "--export-format", "png"},
                 "there are 2 files and one -o -; with {name} in it, as in '{name}.png', each has "
                 "its own");
  expect_refused({"ball.csg", "box.csg", "-o", "{name}.png", "--summary-file", "x.json"},
                 "there are 2 files and one --summary-file x.json; with {name} in it, as in "
                 "'{name}.png', each has its own");
}

TEST_F(ManyFiles, OneOutputOfTwoFilesIsRefused) {
  std::filesystem::create_directory(path("sub"));
  write("sub/ball.csg", "cube(1);\n");
  expect_refused({"ball.csg", "sub/ball.csg", "-o", "{name}.png"},
                 "ball.csg and sub/ball.csg would both be written to ball.png");
  // By another way to the same place.
  std::filesystem::create_directory(path("rod"));
  std::filesystem::create_symlink("rod", path("box"));
  expect_refused({"box.csg", "rod.csg", "-o", "{name}/x.png"},
                 "box.csg and rod.csg would both be written to rod/x.png");
  expect_refused({"box.csg", "box.csg", "-o", "{name}.png"},
                 "box.csg and box.csg would both be written to box.png");
}

TEST_F(ManyFiles, NoOutputTakesThePlaceOfAnInput) {
  write("part.stl", "solid x\nendsolid x\n");
  expect_refused({"rod.csg", "part.stl", "-o", "{name}.stl"},
                 "-o part.stl is a file that is read, part.stl, which would be lost");
  write("lid.off", "OFF\n");
  std::filesystem::create_symlink("lid.off", path("part.off"));
  expect_refused({"part.csg", "lid.off", "-o", "{name}.off"},
                 "-o part.off is a file that is read, lid.off, which would be lost");
}

TEST_F(ManyFiles, TemplatesHaveTheirWordsAndNoOthers) {
  expect_refused({"ball.csg", "-o", "{nom}.png"},
                 "-o '{nom}.png': there is no {nom}; there are {name}, with --animate or "
                 "--turntable {n}, with --from or --views {view}, and {{ is a brace");
  expect_refused({"ball.csg", "-o", "{n}.png"},
                 "-o '{n}.png': {n} is the number of a frame, and here is no frame of --animate "
                 "or --turntable");
  expect_refused({"ball.csg", "-o", "{view}.png"},
                 "-o '{view}.png': {view} is the name of a view, and here is none of --from or "
                 "--views");
  expect_refused({"ball.csg", "-o", "{name.png"},
                 "-o '{name.png': a brace is not closed; {{ is one that stands for itself");
  write("a{n}.b.csg", "cube(1);\n");
  EXPECT_EQ(run({"a{n}.b.csg", "-o", "{{}{name}}.png", "--imgsize", "9,9"}).exit_code, 0);
  EXPECT_FALSE(read("{}a{n}.b}.png").empty());
}

TEST_F(ManyFiles, AllNamesOfFilesAreTemplates) {
  const Ended ended = run({"ball.csg", "box.csg", "-o", "{name}.png", "-d", "{name}.d",
                           "--summary-file", "{name}.json", "--imgsize", "9,9"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(read("box.d"), "box.png: \\\n\tbox.csg\n");
  EXPECT_EQ(read("ball.json").substr(0, 1), "{");
}

TEST_F(ManyFiles, SolidsAreWrittenToo) {
  const Ended ended =
      run({"box.csg", "rod.csg", "-o", "{name}.stl", "-o", "{name}.png", "--imgsize", "9,9"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(read("box.stl").size(), 84u + 12 * 50);
}

#if !defined(WHITTLE_SANITIZED)
/// About 40 MB each while they are drawn; two are expected to fit into half of what there is.
TEST_F(ManyFiles, MemoryBoundsHowManyAreDrawnAtATime) {
  std::ostringstream text;
  for (int i = 0; i < 40000; ++i) {
    text << "multmatrix([[1,0,0," << i % 200 << "],[0,1,0," << i / 200 << "],[0,0,1,0],[0,0,0,1]])"
         << " sphere($fn = 0, $fa = 12, $fs = 2, r = 0.4);\n";
  }
  std::vector<std::string> arguments = {"-o",        "{name}.png", "--imgsize", "64,64",
                                        "--threads", "8",          "--limit",   "memory=400M"};
  for (int i = 0; i < 8; ++i) {
    write("big" + std::to_string(i) + ".csg", text.str());
    arguments.push_back("big" + std::to_string(i) + ".csg");
  }
  const Ended alone = run({"big0.csg", "-o", "x.png", "--imgsize", "64,64"});
  ASSERT_EQ(alone.exit_code, 0);
  const Ended ended = run(arguments);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (int i = 0; i < 8; ++i) EXPECT_EQ(read("big" + std::to_string(i) + ".png"), read("x.png"));
  // Half of what there is; all at a time take more.
  EXPECT_LT(ended.peak_memory_bytes, 200'000'000u);
}
#endif

TEST_F(ManyFiles, AnInterruptedRunLeavesNothingUnfinished) {
  std::vector<std::string> arguments = {"-o", "{name}.png", "--imgsize", "2000,2000"};
  for (int i = 0; i < 6; ++i) {
    write("s" + std::to_string(i) + ".csg", "sphere(3);\n");
    arguments.push_back("s" + std::to_string(i) + ".csg");
  }
  for (const int after : {5000, 50000, 200000}) {
    run_and_signal(arguments, SIGTERM, after);
    for (const std::string& name : files()) {
      const bool is_known = name.ends_with(".csg") || name.ends_with(".png");
      EXPECT_TRUE(is_known) << name;
      // A picture that is there is whole.
      if (name.ends_with(".png")) {
        EXPECT_NE(read(name).find("IEND"), std::string::npos) << name;
      }
    }
  }
}

}  // namespace
}  // namespace whittle
