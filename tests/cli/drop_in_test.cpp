// Command lines of openscad: what they ask is done, or refused with a reason.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/exr.h"
#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class DropIn : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg", "cube(10);\n");
    write("choice.scad",
          "part = \"body\";\nsize = 2;\n"
          "if (part == \"body\") cube(size); else sphere(size);\n");
    write("preview.scad", "if ($preview) sphere(5); else cube(5);\n");
  }

  Ended good(const std::vector<std::string>& arguments) {
    Ended done = run(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done;
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& message) {
    const std::vector<std::string> before = files();
    const Ended refused = run(arguments);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err.find("whittle: " + message), 0u) << refused.err;
    EXPECT_EQ(files(), before) << "a refused run makes nothing";
  }
  /// What kinds of primitives there are, as `whittle info` counts them.
  Json primitives(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "info");
    arguments.emplace_back("--json");
    Json counted = Json::parse(good(arguments).out)["primitives"];
    Json found = Json::object();
    for (const auto& [name, count] : counted.items()) {
      if (count != 0) found[name] = count;
    }
    return found;
  }
  /// Puts a shell script in a file that can be run.
  std::string script(const std::string& name, const std::string& text) {
    write(name, "#!/bin/sh\n" + text);
    fs::permissions(path(name), fs::perms::owner_all);
    return path(name);
  }
  /// The same picture of two files, whatever of whittle's options.
  void expect_same(const std::string& a, const std::string& b,
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{a, "-o", "a.exr", "--imgsize", "60,40"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    good(arguments);
    arguments[0] = b;
    arguments[2] = "b.exr";
    good(arguments);
    EXPECT_TRUE(read("a.exr") == read("b.exr")) << a << " and " << b;
  }
};

TEST_F(DropIn, VariablesAreSet) {
  const Json cube{{"cube", 1}}, sphere{{"sphere", 1}};
  EXPECT_EQ(primitives({"choice.scad"}), cube);
  EXPECT_EQ(primitives({"choice.scad", "-D", "part=\"lid\""}), sphere);
  EXPECT_EQ(primitives({"choice.scad", "-Dpart=\"lid\"", "-q"}), sphere);
  const Json both =
      Json::parse(good({"info", "choice.scad", "-D", "size=7", "-D", "size=9", "--json"}).out);
  EXPECT_EQ(both["bounds"]["hi"], Json({9.0, 9.0, 9.0}));
}

TEST_F(DropIn, ParameterSetsAreChosen) {
  write("sets.json",
        "{\"parameterSets\": {\"lid\": {\"part\": \"lid\"}}, \"fileFormatVersion\": \"1\"}");
  EXPECT_EQ(primitives({"choice.scad", "-p", "sets.json", "-P", "lid", "-q"}),
            (Json{{"sphere", 1}}));
  const Ended absent = run({"choice.scad", "-p", "none.json", "-P", "lid", "-o", "x.png", "-q"});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_EQ(absent.err.find("choice.scad: error: openscad: Cannot open Parameter Set 'none.json'"),
            0u)
      << absent.err;
}

TEST_F(DropIn, WhatOnlyAProgramCanFollowIsRefusedForOtherFiles) {
  for (const std::string option : {"-D", "-p", "-P", "-m"}) {
    expect_refused({"part.csg", "-o", "x.png", option, "x=1"},
                   option +
                       " is for a .scad file, which openscad evaluates; nothing is left to be "
                       "set in part.csg\n");
  }
  expect_refused({"info", "part.csg", "-D", "x=1"}, "-D is for a .scad file");
  expect_refused({"-", "-o", "x.png", "-D", "x=1"}, "-D is for a .scad file");
}

TEST_F(DropIn, RenderAndPreviewDecideWhatTheProgramSees) {
  const Json cube{{"cube", 1}}, sphere{{"sphere", 1}};
  EXPECT_EQ(primitives({"preview.scad"}), sphere);
  EXPECT_EQ(primitives({"--preview", "preview.scad"}), sphere);
  EXPECT_EQ(primitives({"--render", "preview.scad"}), cube);
  EXPECT_EQ(primitives({"preview.scad", "--render=force"}), cube);
  EXPECT_EQ(primitives({"preview.scad", "--render", "force"}), cube);
  EXPECT_EQ(primitives({"--preview", "png", "preview.scad"}), sphere);
  // As in OpenSCAD the preview wins, whichever comes first.
  EXPECT_EQ(primitives({"preview.scad", "--render", "--preview"}), sphere);
  EXPECT_EQ(primitives({"preview.scad", "--preview", "--render"}), sphere);
  // A file may well be called so.
  write("force", "cube(1);");
  EXPECT_EQ(primitives({"--render", "force"}), cube);
}

TEST_F(DropIn, AProgramSetsItsView) {
  const std::string view = "$vpr = [90, 0, 0]; $vpt = [0, 0, 0.5]; $vpd = 7; $vpf = 30;";
  write("view.scad", view + "cube();");
  write("view.csg", view + "cube();");
  expect_same("view.scad", "view.csg");
  const Ended done = good({"view.scad", "-o", "x.png"});
  EXPECT_EQ(done.err, "") << "openscad's own line about the view is no news";
  // Each alone; what looks from above is what openscad says of a view that nobody has set.
  for (const char* one : {"$vpr = [0, 0, 0];", "$vpt = [0, 0, 0.5];", "$vpd = 500;", "$vpd=140;",
                          "$vpf /* x */ = 12;", "/* $vpd = 3; */ $vpd\n=\n9;"}) {
    write("one.scad", std::string(one) + "cube();");
    write("one.csg", std::string(one) + "cube();");
    expect_same("one.scad", "one.csg");
  }
  // A camera that is asked for wins.
  write("plain.csg", "cube();");
  expect_same("view.scad", "plain.csg", {"--camera", "0,0,0,10,20,30,9"});
}

TEST_F(DropIn, TheViewIsSetBy) {
  write("plain.csg", "cube();");
  write("view.csg", "$vpr = [90, 0, 0]; cube();");
  write("there.scad", "$vpr = [90, 0, 0];");
  write("including.scad", "include <there.scad>\ncube();");
  expect_same("including.scad", "view.csg");
  write("program.scad", "cube();");
  good({"view.csg", "-o", "a.png"});
  good({"program.scad", "-o", "b.png", "-D", "$vpr=[90,0,0]"});
  EXPECT_TRUE(read("a.png") == read("b.png"));
  write("computed.scad", "a = 45; $vpr = [2 * a, 0, 0]; cube();");
  expect_same("computed.scad", "view.csg");
  // By none of these.
  write("not.scad",
        "// $vpd = 3;\ns = \"$vpd = 4;\"; module m() { $vpd = 5; cube(); } m();\n"
        "function f() = $vpd == 6; b = f();");
  expect_same("not.scad", "plain.csg");
}

TEST_F(DropIn, AnimationsAreFrames) {
  write("turn.scad", "angle = 360 * $t; $vpr = [60, 0, angle]; rotate($t * 90) cube([1, 2, 3]);");
  good({"turn.scad", "-o", "x.png", "-o", "x.exr", "--animate", "4", "--imgsize", "16,16"});
  EXPECT_EQ(std::ranges::count_if(files(), [](const auto& name) { return name[0] == 'x'; }), 8);
  for (const int frame : {0, 3}) {
    write("still.csg", "$vpr = [60, 0, " + std::to_string(90 * frame) + "]; multmatrix(" +
                           (frame == 0 ? "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"
                                       : "[[0.382683,-0.92388,0,0],[0.92388,0.382683,0,0],"
                                         "[0,0,1,0],[0,0,0,1]]") +
                           ") cube([1, 2, 3]);");
    good({"still.csg", "-o", "still.exr", "--imgsize", "16,16"});
    EXPECT_TRUE(read("still.exr") == read("x0000" + std::to_string(frame) + ".exr")) << frame;
  }
}

TEST_F(DropIn, ShardsOfAnAnimationAreItsParts) {
  write("turn.scad", "rotate($t * 90) cube([1, 2, 3]);");
  const auto frames_of = [&](const std::string& shard) {
    for (const std::string& name : files()) {
      if (name.starts_with("y")) fs::remove(path(name));
    }
    good({"turn.scad", "-o", "y.png", "--animate", "5", "--animate_sharding", shard, "--imgsize",
          "8,8"});
    std::string digits;
    for (const std::string& name : files()) {
      if (name.starts_with("y")) digits += name.substr(5, 1);
    }
    return digits;
  };
  EXPECT_EQ(frames_of("1/2"), "01");
  EXPECT_EQ(frames_of("2/2"), "234");
  EXPECT_EQ(frames_of("3/3"), "34");
  EXPECT_EQ(frames_of("1/9"), "");
}

TEST_F(DropIn, FramesFindWhatTheirProgramNames) {
  fs::create_directory(path("lib"));
  write("lib/used.scad", "module used() cube($t + 1);");
  write("lib/main.scad", "\xef\xbb\xbfuse <used.scad>\nused();\nsphere(nothing);");
  write("sets.json", "{\"parameterSets\": {}, \"fileFormatVersion\": \"1\"}");
  const Ended done = good({"lib/main.scad", "-o", "x.png", "--animate", "2", "-p", "sets.json",
                           "-P", "none", "-d", "deps", "--imgsize", "8,8"});
  EXPECT_EQ(done.err.find("lib/main.scad: openscad: WARNING: Ignoring unknown variable 'nothing' "
                          "in file main.scad, line 3\n"),
            0u)
      << done.err;
  EXPECT_NE(read("deps").find("/lib/used.scad"), std::string::npos) << read("deps");
}

TEST_F(DropIn, AnimationsThatCannotBeAreRefused) {
  expect_refused({"part.csg", "-o", "x.png", "--animate", "3"},
                 "--animate: part.csg has no time; only a .scad file has\n");
  expect_refused({"choice.scad", "-o", "-", "--export-format", "png", "--animate", "3"},
                 "--animate makes many files; -o - is one\n");
  expect_refused({"choice.scad", "-o", "x.png", "--animate", "0"}, "--animate: wants a whole");
  expect_refused({"choice.scad", "-o", "x.png", "--animate_sharding", "1/2"},
                 "--animate_sharding is for --animate N\n");
  for (const char* shard : {"2", "0/2", "3/2", "1/0", "a/b"}) {
    expect_refused({"choice.scad", "-o", "x.png", "--animate", "3", "--animate_sharding", shard},
                   "--animate_sharding: ");
  }
  write("late.scad", "assert($t < 0.5); cube();");
  const Ended late = run({"late.scad", "-o", "x.png", "--animate", "4", "--imgsize", "8,8"});
  EXPECT_EQ(late.exit_code, 1);
  EXPECT_NE(late.err.find("late.scad:1: error: openscad: Assertion"), std::string::npos);
  EXPECT_NE(late.err.find("($t = 0.5)"), std::string::npos) << late.err;
  EXPECT_TRUE(fs::exists(path("x00001.png")));
  EXPECT_FALSE(fs::exists(path("x00002.png")));
}

TEST_F(DropIn, SeveralFramesAreEvaluatedAtATime) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  // Each waits until there is another one.
  const std::string program =
      script("fake", "mkdir -p " + path("here") + "; touch " + path("here") +
                         "/$$\nn=0\nwhile [ $(ls " + path("here") +
                         " | wc -l) -lt 2 ] && [ $n -lt 500 ]; do n=$((n+1)); sleep 0.02; done\n"
                         "[ $n -lt 500 ] && echo 'cube();' > \"$3\"\n" +
                         "[ $n -lt 500 ] && cp \"$3\" \"$2\"\n");
  write("any.scad", "cube();");
  good({"any.scad", "-o", "x.png", "--animate", "2", "--openscad", program, "--imgsize", "8,8"});
}

TEST_F(DropIn, TheProgramIsChosen) {
  const std::string program = script("my openscad", "echo 'cube([1, 2, 3]);' > \"$2\"\n");
  write("any.scad", "sphere();");
  EXPECT_EQ(primitives({"any.scad", "--openscad", program}), (Json{{"cube", 1}}));
  ::setenv("OPENSCAD", program.c_str(), 1);
  EXPECT_EQ(primitives({"any.scad"}), (Json{{"cube", 1}}));
  EXPECT_EQ(primitives({"any.scad", "--openscad", "openscad"}), (Json{{"sphere", 1}}));
  ::setenv("OPENSCAD", "./nothing", 1);
  const Ended absent = run({"any.scad", "-o", "x.png"});
  ::unsetenv("OPENSCAD");
  EXPECT_EQ(absent.exit_code, 3);
  EXPECT_EQ(absent.err,
            "whittle: any.scad: error: there is no program './nothing' to evaluate it "
            "($OPENSCAD names it)\n");
  const Ended named = run({"any.scad", "-o", "x.png", "--openscad", "no-openscad"});
  EXPECT_EQ(named.exit_code, 3);
  EXPECT_EQ(named.err,
            "whittle: any.scad: error: there is no program 'no-openscad' on PATH to evaluate it "
            "(--openscad names it)\n");
}

TEST_F(DropIn, OpenscadIsToldWhatConcernsIt) {
  const std::string program = script("fake", "for word; do echo \"<$word>\"; done > " +
                                                 path("words") + "\necho 'cube();' > \"$2\"\n");
  good({"choice.scad",
        "-o",
        "x.png",
        "--openscad",
        program,
        "--enable=manifold",
        "--enable",
        "lazy-union",
        "--hardwarnings",
        "--check-parameters",
        "true",
        "--check-parameter-ranges=false",
        "-m",
        "make",
        "--camera=1,2,3,4,5,6,7",
        "-D",
        "-1=$x",
        "--render",
        "--imgsize",
        "8,8"});
  const std::string words = read("words");
  for (const char* word : {"--enable=manifold", "--enable=lazy-union", "--hardwarnings",
                           "--check-parameters=true", "--check-parameter-ranges=false", "-mmake",
                           "--camera=1,2,3,4,5,6,7", "-D-1=$x", "--render=force"}) {
    EXPECT_NE(words.find("<" + std::string(word) + ">\n"), std::string::npos) << word << words;
  }
}

TEST_F(DropIn, AnOptionThatOpenscadDoesNotKnowIsOneLine) {
  const Ended done = run({"choice.scad", "-o", "x.png", "--enable", "no-such-thing"});
  if (done.exit_code == 0) GTEST_SKIP() << "an openscad with experiments";
  EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  EXPECT_LT(done.err.size(), 200u) << done.err;
}

TEST_F(DropIn, HardWarningsEndTheRun) {
  write("odd.csg", "cube(1, length = 3);");
  const Ended own = run({"odd.csg", "-o", "x.png", "--hardwarnings"});
  EXPECT_EQ(own.exit_code, 1);
  EXPECT_EQ(own.err,
            "odd.csg:1:9: warning: cube: the argument 'length' is not known; it is ignored "
            "(--hardwarnings)\n");
  write("echo.scad", "echo(\"this is none\"); cube();");
  good({"echo.scad", "-o", "y.png", "--hardwarnings", "--imgsize", "8,8"});
  EXPECT_FALSE(fs::exists(path("x.png")));
}

TEST_F(DropIn, WhatChangesNoPictureIsSilent) {
  good({"part.csg", "-o", "a.png", "--imgsize", "32,32"});
  const Ended silent =
      good({"--render", "part.csg", "-o", "b.png", "--imgsize", "32,32", "--csglimit", "5",
            "--enable=manifold", "--debug", "all", "--check-parameters", "true", "--backend",
            "Manifold", "--hardwarnings", "--check-parameter-ranges=true"});
  EXPECT_EQ(silent.err, "");
  EXPECT_TRUE(read("a.png") == read("b.png"));
  for (const char* backend : {"cgal", "CGAL", "manifold"}) {
    EXPECT_EQ(good({"part.csg", "-o", "b.png", "--backend", backend}).err, "");
  }
}

TEST_F(DropIn, WhatWouldBeAnotherPictureIsRefused) {
  expect_refused({"part.csg", "-o", "x.png", "--preview=throwntogether"},
                 "--preview: throwntogether is not drawn by whittle\n");
  for (const char* view : {"axes", "crosshairs", "edges", "scales", "axes,edges"}) {
    expect_refused({"part.csg", "-o", "x.png", "--view", view},
                   "--view: axes, crosshairs, edges, scales and the wireframe are not drawn");
  }
}

TEST_F(DropIn, OnlyPicturesAreMade) {
  for (const std::string ending :
       {"stl", "off", "amf", "3mf", "csg", "dxf", "svg", "pdf", "echo", "ast", "STL"}) {
    expect_refused({"part.csg", "-o", "x.png", "-o", "x." + ending},
                   "'x." + ending + "' asks for .");
  }
  expect_refused({"part.csg", "-o", "x.stl"},
                 "'x.stl' asks for .stl, but whittle makes pictures only, .png or .exr\n");
  expect_refused({"part.csg", "-o", "x.png", "--export-format", "binstl"},
                 "--export-format: 'binstl' asks for .binstl, but whittle makes pictures only");
  expect_refused({"part.csg", "-s", "x.stl"}, "-s: whittle makes pictures only");
  expect_refused({"part.csg", "-x", "x.dxf"}, "-x: whittle makes pictures only");
}

TEST_F(DropIn, InfoIsOfThisProgram) {
  const Ended info = good({"--info"});
  EXPECT_EQ(info.out.find("whittle "), 0u);
  EXPECT_NE(info.out.find("\nopenscad, for .scad files: "), std::string::npos);
}

TEST_F(DropIn, ViewAllReplacesADistance) {
  const std::vector<std::string> command{"part.csg", "-o", "a.png", "--imgsize", "32,32"};
  std::vector<std::string> odd = command, even = command;
  odd.insert(odd.end(), {"--camera=-1,-1,-1,90,0,0,-1", "--viewall"});
  even[2] = "b.png";
  even.insert(even.end(), {"--viewall", "--camera=-1,-1,-1,90,0,0,1"});
  EXPECT_EQ(good(odd).err, "");
  good(even);
  EXPECT_TRUE(read("a.png") == read("b.png"));
  fs::remove(path("a.png"));
  fs::remove(path("b.png"));
  for (const std::vector<std::string>& start : {std::vector<std::string>{}, {"cells"}, {"bench"}}) {
    std::vector<std::string> arguments = start;
    arguments.insert(arguments.end(), {"part.csg", "--camera=-1,-1,-1,90,0,0,-1"});
    if (start.empty() || start[0] == "cells") arguments.insert(arguments.end(), {"-o", "x.png"});
    expect_refused(arguments, "Camera distance must not be negative, unless --viewall replaces it");
  }
}

TEST_F(DropIn, DependenciesAreWritten) {
  fs::create_directory(path("lib"));
  write("lib/a b.scad", "module a() cube(1);");
  write("lib/c#$.scad", "x = 1;");
  write("main.scad", "use <lib/a b.scad>\ninclude <lib/c#$.scad>\na();");
  good({"main.scad", "-o", "out put.png", "-o", "y.exr", "-d", "deps", "--imgsize", "8,8"});
  const std::string deps = read("deps");
  EXPECT_EQ(deps.find("out\\ put.png y.exr: \\\n\tmain.scad"), 0u) << deps;
  for (const char* part : {"/lib/a\\ b.scad", "/lib/c\\#$$.scad"}) {
    EXPECT_NE(deps.find(part), std::string::npos) << deps;
  }
  good({"part.csg", "-o", "x.png", "-d", "deps", "--imgsize", "8,8"});
  EXPECT_EQ(read("deps"), "x.png: \\\n\tpart.csg\n");
  good({"main.scad", "-o", "f.png", "-d", "deps", "--animate", "2", "--imgsize", "8,8"});
  EXPECT_EQ(read("deps").find("f00000.png f00001.png: \\\n\tmain.scad \\\n"), 0u) << read("deps");
  EXPECT_EQ(std::ranges::count(read("deps"), '\n'), 4);
}

TEST_F(DropIn, ADependencyFileMustBePossible) {
  expect_refused({"part.csg", "-o", "x.png", "-d", "part.csg"}, "-o part.csg is the file that is");
  const Ended nowhere = run({"part.csg", "-o", "x.png", "-d", "none/deps"});
  EXPECT_EQ(nowhere.exit_code, 3);
  EXPECT_FALSE(fs::exists(path("x.png"))) << "that is known before the work";
}

TEST_F(DropIn, MakeWorksWithTheDependencies) {
  if (std::system("make --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no make";
  write("other.scad", "module a() cube(1);");
  write("main.scad", "use <other.scad>\na();");
  good({"main.scad", "-o", "x.png", "-d", "deps", "--imgsize", "8,8"});
  write("Makefile", "x.png:\n\t@echo again\ninclude deps\n");
  const std::string make = "make -q -C '" + path("") + "' x.png >/dev/null 2>&1";
  EXPECT_EQ(std::system(make.c_str()), 0) << "up to date";
  fs::last_write_time(path("other.scad"),
                      fs::last_write_time(path("x.png")) + std::chrono::seconds(5));
  EXPECT_NE(std::system(make.c_str()), 0) << "to be made again";
}

TEST_F(DropIn, ASummaryIsWritten) {
  write("box.csg", "difference() { cube([1, 2, 3]); cube([1, 1, 1]); }");
  const std::vector<std::string> command{"box.csg",           "-o",        "x.png", "--camera",
                                         "1,2,3,40,50,60,70", "--imgsize", "8,8"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return good(arguments);
  };
  EXPECT_EQ(with({"--summary-file", "s.json"}).err, "");
  const Json all = Json::parse(read("s.json"));
  EXPECT_EQ(all["geometry"]["dimensions"], 3);
  EXPECT_EQ(all["geometry"]["bounding_box"]["min"], Json({0.0, 0.0, 0.0}));
  EXPECT_EQ(all["geometry"]["bounding_box"]["max"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["geometry"]["bounding_box"]["size"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["camera"]["translation"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(all["camera"]["rotation"], Json({40.0, 50.0, 60.0}));
  EXPECT_EQ(all["camera"]["distance"], 70.0);
  EXPECT_EQ(all["camera"]["fov"], 22.5);
  EXPECT_GE(all["time"]["total"], 0);
  EXPECT_EQ(all["time"]["hours"], 0);
  const Ended some = with({"--summary", "camera", "--summary-file", "-"});
  const Json camera = Json::parse(some.out);
  EXPECT_TRUE(camera.contains("camera"));
  EXPECT_FALSE(camera.contains("time"));
  EXPECT_EQ(some.err.find("Camera:\n   Translation: 1.00, 2.00, 3.00\n"), 0u) << some.err;
  EXPECT_EQ(with({"--summary", "all", "-q"}).err, "");
  EXPECT_EQ(with({"--summary", "cache"}).err, "");
  expect_refused({"part.csg", "-o", "y.png", "--summary", "weight"},
                 "--summary: unknown part 'weight'; there are: all, cache, time");
}

TEST_F(DropIn, SuffixesMayBeInCapitals) {
  fs::rename(path("choice.scad"), path("CHOICE.SCAD"));
  write("PART.CSG", "cube(10);\n");
  good({"CHOICE.SCAD", "-o", "X.PNG", "--imgsize", "8,8"});
  good({"PART.CSG", "-o", "Y.Exr", "--imgsize", "8,8"});
  EXPECT_EQ(read("X.PNG").substr(1, 3), "PNG");
}

TEST_F(DropIn, InputsOfOtherKindsAreCalledWhatTheyAre) {
  const auto expect_called = [&](const std::string& name, const std::string& bytes,
                                 const std::string& message) {
    write(name, bytes);
    const Ended done = run({name, "-o", "x.png"});
    EXPECT_EQ(done.exit_code, 1);
    EXPECT_EQ(done.err, name + ": error: it is " + message + "\n");
    fs::remove(path(name));
  };
  const std::string gzip = "compressed by gzip; unpack it first (gunzip)";
  expect_called("x.csg.gz", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.csg", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.scad", std::string("\x1f\x8b\x08\x00", 4), gzip);
  expect_called("x.bz2", "BZh91AY&SY", "compressed by bzip2; unpack it first (bunzip2)");
  expect_called("x.model", "solid a\n facet normal 0 0 1\n",
                "a mesh (STL); its name has to end in .stl");
  expect_called("x.zip", "PK\x03\x04",
                "a zip archive; unpack it first, or name it .3mf or .amf if it is such a mesh");
  expect_called("x.png.csg", "\x89PNG\r\n", "a picture (PNG), no model");
  expect_called("x.step", "ISO-10303-21;",
                "a STEP model; export a mesh (.stl) from the program that made it");
  const Ended absent = run({"none.stl", "-o", "x.png"});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_EQ(absent.err, "none.stl: error: cannot be read: No such file or directory\n");
}

TEST_F(DropIn, WarningsAboutAProgramQuoteTheStatement) {
  write("part.scad", "cube(1);\nmodule top() { roof() square(1); }\ntop();\n");
  const std::string fake = script("fake",
                                  "printf 'cube(1);\\ngroup() {\\n\\troof(method = \"voronoi\", "
                                  "convexity = 1, $fn = 0, $fa = 12, $fs = 2) {\\n\\t\\tsquare();"
                                  "\\n\\t}\\n}\\n' > \"$2\"\n");
  const Ended done = run({"part.scad", "-o", "x.png", "--openscad", fake, "--imgsize", "8,8"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(
      done.err.find("part.scad: warning: in \"roof(method = \"voronoi\", convexity = 1, $fn = "
                    "0, ...)\": roofs are not supported; nothing is shown for it\n"),
      0u)
      << done.err;
}

TEST_F(DropIn, ARootOfImportsIsNotForPrograms) {
  expect_refused({"choice.scad", "-o", "x.png", "--import-root", "."},
                 "--import-root: openscad, which evaluates a .scad file, reads whatever the file "
                 "names; make a .csg of it where it can do no harm\n");
  good({"part.csg", "-o", "x.png", "--import-root", ".", "--imgsize", "8,8"});
}

}  // namespace
}  // namespace whittle
