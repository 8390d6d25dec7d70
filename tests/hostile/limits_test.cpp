// Limits of what a file may ask for: where they are, what is said there, and that they move.
#include <fstream>
#include <iterator>

#include "support/hostile.h"

namespace whittle {
namespace {

std::string repeated(const std::string& part, size_t times) {
  std::string text;
  for (size_t i = 0; i < times; ++i) text += part;
  return text;
}

class LimitsOfFiles : public ProgramTest {
 protected:
  /// The file is refused with that limit, and read with the next larger one.
  void expect_limit(const std::string& text, const std::string& name, size_t limit,
                    const std::string& message) {
    SCOPED_TRACE(name);
    write("part.csg", text);
    const auto given = [&](size_t value) {
      return run({"part.csg", "-o", "x.png", "--imgsize", "8,8", "--limit",
                  name + "=" + std::to_string(value)});
    };
    expect_refused(given(limit), 1, "part.csg" + message);
    EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
    EXPECT_EQ(given(limit + 1).exit_code, 0);
    EXPECT_EQ(::unlink(path("x.png").c_str()), 0);
  }
};

TEST_F(LimitsOfFiles, AreNamedWithTheirValueAndTheWayToRaiseThem) {
  expect_limit("cube(1);\n", "bytes", 8,
               ": error: larger than the limit of 8 bytes; --limit bytes=N raises it");
  expect_limit("union() union() union() cube(1);", "depth", 2,
               ":1:25: error: statements are nested deeper than the limit of 2; --limit depth=N "
               "raises it");
  expect_limit("cube(1);\nsphere(1);\n", "nodes", 1,
               ":2:1: error: there are more statements than the limit of 1; --limit nodes=N raises "
               "it");
  expect_limit("cube([1, 2, 3]);", "values", 3,
               ":1:13: error: the statement has more values than the limit of 3; --limit values=N "
               "raises it");
  expect_limit("cylinder($fn = 6);", "facets", 7,
               ":1:1: error: with this shape the model has 8 facets, more than the limit of 7; a "
               "smaller $fn gives fewer, smooth curves none; --limit facets=N raises it");
}

TEST_F(LimitsOfFiles, CanBeGivenTogetherAndForEveryCommandThatReads) {
  write("part.csg", "union() cube([1, 2, 3]);");
  const std::string message =
      "part.csg:1:9: error: there are more statements than the limit of 1; --limit nodes=N raises "
      "it";
  const std::vector<std::string> limits{"--limit", "nodes=1", "--limit", "depth=5"};
  for (std::vector<std::string> command : {std::vector<std::string>{"part.csg", "-o", "x.png"},
                                           {"info", "part.csg"},
                                           {"bench", "part.csg"}}) {
    command.insert(command.end(), limits.begin(), limits.end());
    expect_refused(run(command), 1, message);
  }
}

TEST_F(LimitsOfFiles, LetAHundredThousandLevelsPass) {
  constexpr size_t kLevels = 100'000;
  write("deep.csg", repeated("difference(){translate([0,0,0]){cube(9);}", kLevels / 2) +
                        repeated("}", kLevels / 2));
  const Ended done = run({"deep.csg", "-o", "x.png", "--imgsize", "16,16"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  expect_little_memory(done);
}

TEST_F(LimitsOfFiles, MemoryOfCellsChangesNoPixel) {
  const std::string model = WHITTLE_EXAMPLES "/cheese100.csg";
  const auto picture = [&](const std::string& memory, const std::string& threads) {
    const Ended done = run({model, "-o", "x.png", "--imgsize", "64,64", "--threads", threads,
                            "--stats", "--memory", memory});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_NE(done.err.find("disagreements            0"), std::string::npos) << done.err;
    return read("x.png");
  };
  const std::string free = picture("1G", "2");
  for (const char* memory : {"1", "20K", "50K", "300K"}) {
    EXPECT_EQ(picture(memory, "1"), free) << memory;
    EXPECT_EQ(picture(memory, "2"), free) << memory;
  }
}

// Many copies of one cube, a thousand cylinders through one point: nothing that splitting
// space could part.
TEST_F(LimitsOfFiles, WhatNoSplitPartsEndsInLittleMemory) {
  write("copies.csg", repeated("cube(1);", 200'000));
  const Ended copies = run({"copies.csg", "-o", "x.png", "--imgsize", "16,16"});
  EXPECT_EQ(copies.exit_code, 0) << copies.err;
  expect_little_memory(copies);

  std::string bundle;
  for (int i = 0; i < 1000; ++i) {
    bundle += "rotate([" + std::to_string(i * 7 % 360) + "," + std::to_string(i * 31 % 360) +
              ",0])cylinder(h=10,r=1,center=true);";
  }
  write("bundle.csg", bundle);
  const Ended done = run({"bundle.csg", "-o", "x.png", "--imgsize", "16,16", "--memory", "10M"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  expect_little_memory(done);
}

// A leaf of as many literals as the model has facets.
TEST_F(LimitsOfFiles, ALeafOfVeryManyLiteralsIsSolvedInLittleMemory) {
  std::string bundle;
  for (int i = 0; i < 200; ++i) {
    bundle += "rotate([" + std::to_string(i % 50) + "," + std::to_string(i / 50) +
              ",0])cylinder(r=1,h=5,$fn=2048);";
  }
  write("bundle.csg", bundle);
  const Ended done =
      run({"bundle.csg", "-o", "x.png", "--imgsize", "4,4", "--aa", "1", "--memory", "1"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  expect_little_memory(done);
}

}  // namespace
}  // namespace whittle
