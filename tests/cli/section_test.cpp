// --section and --xray, from the command line.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace whittle {
namespace {

using Json = nlohmann::json;

class SectionCommand : public ProgramTest {
 protected:
  void SetUp() override {
    write("parts.csg",
          "difference() { cube(10); multmatrix([[1,0,0,5],[0,1,0,5],[0,0,1,-1],[0,0,0,1]]) "
          "cylinder(h = 20, r = 2); }\n"
          "color([1, 0, 0, 1]) multmatrix([[1,0,0,5],[0,1,0,5],[0,0,1,0],[0,0,0,1]]) "
          "cylinder(h = 12, r = 1);\n");
    write("flat.csg", "square([3, 4]);\n");
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& why) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments.back();
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
  }
};

TEST_F(SectionCommand, APickOnACapIsThePartThatIsCut) {
  const Ended ended =
      run({"pick", "parts.csg", "--section", "y<5", "--json", "--imgsize", "100,100", "--camera",
           "5,-90,5,5,0,5", "--projection", "ortho", "--fov", "11.421186274999286", "--at", "50,50",
           "--at", "30,50", "--at", "50,97"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const size_t first = ended.out.find('\n'), second = ended.out.find('\n', first + 1);
  const Json pin = Json::parse(ended.out.substr(0, first));
  EXPECT_EQ(pin["id"], 3);
  EXPECT_EQ(pin["section"], true);
  EXPECT_EQ(pin["place"], "parts.csg:2:75");
  EXPECT_EQ(pin["primitive"]["kind"], "cylinder");
  EXPECT_NEAR(pin["point"][1].get<double>(), 5, 1e-9);
  EXPECT_NEAR(pin["normal"][1].get<double>(), -1, 1e-12);
  const Json block = Json::parse(ended.out.substr(first + 1, second - first - 1));
  EXPECT_EQ(block["id"], 1);
  EXPECT_EQ(block["section"], true);
  EXPECT_EQ(block["color"], nullptr);
}

TEST_F(SectionCommand, WhatIsLeftIsMeasuredAndSaved) {
  write("cube.csg", "cube(10);\n");
  const Ended ended = run({"info", "cube.csg", "--section", "x>5", "--mass", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const Json left = Json::parse(ended.out);
  EXPECT_NEAR(left["mass"]["volume"].get<double>(), 500, 1e-9);
  EXPECT_EQ(left["statements"], 1);
  ASSERT_EQ(
      run({"cube.csg", "-o", "half.stl", "--section", "x>5", "--section", "z>2", "-q"}).exit_code,
      0);
  const Ended again = run({"info", "half.stl", "--mass", "--json"});
  EXPECT_NEAR(Json::parse(again.out)["mass"]["volume"].get<double>(), 100, 1e-9);
}

TEST_F(SectionCommand, PicturesDoNotDependOnThreads) {
  for (const char* threads : {"1", "3"})
    ASSERT_EQ(run({"parts.csg", "-o", std::string(threads) + ".png", "--section", "x>5,y<5",
                   "--hatch", "--imgsize", "160,120", "--threads", threads, "-q"})
                  .exit_code,
              0);
  EXPECT_EQ(read("1.png"), read("3.png"));
  ASSERT_EQ(
      run({"parts.csg", "-o", "plain.png", "--section", "x>5,y<5", "--imgsize", "160,120", "-q"})
          .exit_code,
      0);
  EXPECT_NE(read("1.png"), read("plain.png"));
}

TEST_F(SectionCommand, AnXrayIsTheSameByEveryBackend) {
  const auto drawn = [&](const char* backend, const char* option, const char* file) {
    return run({"parts.csg", option, file, "--xray", "--backend", backend, "--imgsize", "80,60",
                "-q"})
        .exit_code;
  };
  EXPECT_EQ(drawn("cpu", "-o", "cpu.png"), 0);
  EXPECT_EQ(drawn("oracle", "--reference", "cpu.png"), 0);
}

TEST_F(SectionCommand, WhatCanNotBeIsRefused) {
  const std::vector<std::string> picture{"parts.csg", "-o", "p.png"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), picture.begin(), picture.end());
    return more;
  };
  EXPECT_EQ(run(with({"--section", "x=nan"})).exit_code, 2);
  EXPECT_NE(run(with({"--section", "n=[0,0,0],d=1"})).err.find("no length"), std::string::npos);
  EXPECT_EQ(run(with({"--section-keep", "no-colour", "--section", "x=0"})).exit_code, 2);
  expect_refused(with({"--section-keep", "red"}), "--section-keep is for --section");
  expect_refused(with({"--hatch"}), "--hatch is for --section");
  expect_refused(with({"--xray", "--pass", "normal"}), "--xray");
  expect_refused(with({"--xray", "--shadows"}), "--xray");
  expect_refused({"flat.csg", "-o", "p.png", "--section", "x=0"}, "flat");
  EXPECT_EQ(files(), (std::vector<std::string>{"flat.csg", "parts.csg"}));
}

}  // namespace
}  // namespace whittle
