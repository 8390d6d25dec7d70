// Command lines of openscad for programs: variables, views, animations, the openscad that is run.
#include <algorithm>
#include <cstdlib>
#include <thread>

#include "drop_in.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

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
            "(the options name it)\n");
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
  const std::string fake = script(
      "fake",
      "echo \"unrecognised option '--enable'\" >&2; echo >&2; echo 'Usage: openscad file' >&2\n"
      "for i in $(seq 57); do echo \"  --usage-$i arg  what\"; done >&2\n"
      "exit 1\n");
  const Ended done =
      run({"choice.scad", "-o", "x.png", "--openscad", fake, "--enable", "no-such-thing"});
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  EXPECT_LT(done.err.size(), 200u) << done.err;
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
