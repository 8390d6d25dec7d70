// info, cells, compare, bench and model.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "image/png.h"
#include "support/program.h"

namespace whittle {
namespace {

using Json = nlohmann::json;

class Commands : public ProgramTest {
 protected:
  void SetUp() override {
    write("part.csg",
          "difference() {\n"
          "  cube(20, center = true);\n"
          "  sphere(12);\n"
          "  multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,-10],[0,0,0,1]]) cylinder(h = 30, r = 4);\n"
          "  cube([0, 1, 1]);\n"
          "}\n"
          "%sphere(1);\n");
  }
  Ended good(const std::vector<std::string>& arguments, const RunSettings& settings = {}) {
    Ended done = run(arguments, settings);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done;
  }
};

class Info : public Commands {};
class Cells : public Commands {};
class Compare : public Commands {};
class Bench : public Commands {};
class ModelCommand : public Commands {};

TEST_F(Info, JsonCountsWhatIsInTheModel) {
  const Json info = Json::parse(good({"info", "part.csg", "--json"}).out);
  EXPECT_EQ(info["file"], "part.csg");
  EXPECT_EQ(info["statements"], 5);
  EXPECT_EQ(
      info["nodes"],
      Json({{"cube", 2}, {"sphere", 2}, {"cylinder", 1}, {"difference", 1}, {"multmatrix", 1}}));
  EXPECT_EQ(info["model_nodes"]["difference"], 1);
  EXPECT_EQ(info["model_nodes"]["transform"], 1);
  EXPECT_EQ(info["model_nodes"]["primitive"], 5);
  EXPECT_EQ(info["primitives"]["cube"], 2);
  EXPECT_EQ(info["primitives"]["sphere"], 2);
  EXPECT_EQ(info["primitives"]["cylinder"], 1);
  EXPECT_EQ(info["curved_primitives"], 3);
  EXPECT_EQ(info["empty_primitives"], 1);
  EXPECT_EQ(info["background_nodes"], 1);
  // The cube's six, the sphere's one, the cylinder's three; its base lies in the cube's.
  EXPECT_EQ(info["faces"], 10);
  EXPECT_EQ(info["half_spaces"], 9);
  EXPECT_EQ(info["merged_faces"], 1);
  EXPECT_EQ(info["bounded"], true);
  EXPECT_EQ(info["bounds"]["lo"], Json({-10.0, -10.0, -10.0}));
  EXPECT_EQ(info["bounds"]["hi"], Json({10.0, 10.0, 10.0}));
  EXPECT_DOUBLE_EQ(info["tolerance"].get<double>(), 4e-5);
  EXPECT_EQ(info["supported"], true);
  EXPECT_TRUE(info["warnings"].empty());
}

TEST_F(Info, TextSaysTheSame) {
  const Ended info = good({"info", "part.csg"});
  for (const char* part :
       {"statements   5\n",
        "nodes        cube 2, sphere 2, cylinder 1, difference 1, multmatrix 1\n",
        "marked       background (%) 1\n",
        "evaluated    union 1, difference 1, transform 1, primitive 5\n",
        "primitives   cube 2, sphere 2, cylinder 1; 3 curved\n",
        "in the solid 4 primitives, 1 of them empty\n", "half-spaces  9 for 10 faces, 1 merged\n",
        "bounds       [-10, -10, -10] to [10, 10, 10]\n", "tolerance    4e-05\n",
        "warnings     0\n"})
    EXPECT_NE(info.out.find(part), std::string::npos) << part << "\n" << info.out;
}

/// Words before brackets, outside of strings and comments.
std::map<std::string, size_t> words_before_brackets(std::string text) {
  text =
      std::regex_replace(text, std::regex(R"re("(\\.|[^"\\])*"|//[^\n]*|/\*[^]*?\*/)re"), "\"\"");
  std::map<std::string, size_t> words;
  const std::regex word(R"(([A-Za-z_]\w*)\s*\()");
  for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at)
    ++words[(*at)[1]];
  return words;
}

TEST_F(Info, NodesAreThoseOfTheText) {
  write("all.csg", R"(
    // cube(1);  /* sphere(2); */
    group() { linear_extrude(height = 2, $fn = 0) { text(text = "cube(3);", size = 4); }
      %linear_extrude(height = 1) { polygon(points = [[0, 0], [1, 0], [0, 1]], paths = undef); }
      *rotate_extrude(angle = 90) square(1);
      rotate_extrude(angle = 90) { multmatrix([[1, 0, 0, 4], [0, 1, 0, 0]]) circle(r = 1); }
      #hull() { sphere(1); translate([9, 0, 0]) sphere(2); cube(0); }
      minkowski() { cube(3); cylinder(h = 1, r1 = 1, r2 = 1); }
      render(convexity = 1) { intersection() { cube(1); group(); } }
      resize(newsize = [1, 2, 3]) union() { cube(1); difference() { cube(1); sphere(1); } }
      projection(cut = false) cube(1);
      offset(r = 1) { fill() { square(2); } }
      color([1, 0, 0, 1]) import(file = "no.stl"); surface(file = "no.dat");
      polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
                 faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);
      halfspace(n = [0, 0, 1], d = 0); nothing_of_ours() { cube(1); }
    })");
  for (const char* file : {"all.csg", "part.csg"}) {
    const Json info = Json::parse(run({"info", file, "--json", "-q"}).out);
    EXPECT_EQ(info["nodes"], Json(words_before_brackets(read(file)))) << file;
  }
  const Json marks = Json::parse(run({"info", "all.csg", "--json", "-q"}).out);
  EXPECT_EQ(marks["background_nodes"], 1);
  EXPECT_EQ(marks["highlight_nodes"], 1);
  EXPECT_EQ(marks["disabled_nodes"], 1);
  EXPECT_EQ(marks["root_nodes"], 0);
  EXPECT_GT(marks["nodes"].size(), 20u);
}

TEST_F(Info, ADrawingIsCalledOne) {
  const RunSettings flat{.in = "square([3, 2]);"};
  EXPECT_NE(good({"info", "-"}, flat).out.find("; a drawing\n"), std::string::npos);
  const Json info = Json::parse(good({"info", "-", "--json"}, flat).out);
  EXPECT_EQ(info["drawing"], true);
  EXPECT_EQ(info["bounds"]["lo"], Json({0.0, 0.0, 0.0}));
  EXPECT_EQ(info["bounds"]["hi"], Json({3.0, 2.0, 0.0}));
  EXPECT_EQ(Json::parse(good({"info", "part.csg", "--json"}).out)["drawing"], false);
}

TEST_F(Info, ThePlateOfTheGuideHasAFlushFace) {
  // docs/README.md follows a ray through it.
  const RunSettings plate{
      .in =
          "difference() {\n  cube([30, 20, 10]);\n"
          "  multmatrix([[1,0,0,20],[0,1,0,10],[0,0,1,10],[0,0,0,1]]) sphere(6, $fn = 0);\n"
          "  multmatrix([[1,0,0,4],[0,1,0,5],[0,0,1,5],[0,0,0,1]]) cube([6, 10, 5]);\n}\n"};
  const Json info = Json::parse(good({"info", "-", "--json"}, plate).out);
  EXPECT_EQ(info["faces"], 13);
  EXPECT_EQ(info["half_spaces"], 12);
}

TEST_F(Info, TheSolidsBoxIsThatOfWhatIsLeft) {
  const RunSettings half{.in = "difference() { cube(10); translate([-1, -1, 5]) cube(12); }"};
  const Json info = Json::parse(good({"info", "-", "--json"}, half).out);
  EXPECT_EQ(info["bounds"]["hi"], Json({10.0, 10.0, 10.0}));
  EXPECT_NEAR(info["solid_box"]["hi"][0].get<double>(), 10, 1e-5);
  EXPECT_NEAR(info["solid_box"]["hi"][2].get<double>(), 5, 1e-5);
  EXPECT_NE(good({"info", "-"}, half).out.find("solid's box  [0, 0, 0] to [10, 10, 5]\n"),
            std::string::npos);
}

TEST_F(Info, UnboundedAndEmptySolidsAreCalledSo) {
  const RunSettings unbounded{.in = "halfspace(n = [0, 0, 1], d = 3);"};
  const Json open = Json::parse(good({"info", "-", "--json"}, unbounded).out);
  EXPECT_EQ(open["file"], "<stdin>");
  EXPECT_EQ(open["bounded"], false);
  EXPECT_NE(good({"info", "-"}, unbounded).out.find("unbounded"), std::string::npos);
  EXPECT_TRUE(open["solid_box"].is_null());
  const Json empty = Json::parse(good({"info", "-", "--json"}, {.in = "cube(0);"}).out);
  EXPECT_TRUE(empty["bounds"].is_null());
}

TEST_F(Info, WarningsAreInTheJsonAndElseOnStandardError) {
  const RunSettings roof{.in = "roof() { square(1); }"};
  const std::string warning =
      "<stdin>:1:1: warning: roofs are not supported; nothing is shown for it";
  const Ended text = good({"info", "-"}, roof);
  EXPECT_EQ(text.err, warning + "\n");
  EXPECT_NE(text.out.find("warnings     1, and not everything is supported\n"), std::string::npos);
  const Ended json = good({"info", "-", "--json"}, roof);
  EXPECT_EQ(json.err, "");
  EXPECT_EQ(Json::parse(json.out)["warnings"], Json({warning}));
  EXPECT_EQ(Json::parse(json.out)["supported"], false);
  EXPECT_EQ(run({"info", "-", "--strict"}, roof).exit_code, 1);
}

TEST_F(Cells, TheyAreDrawnOverTheRendering) {
  const std::vector<std::string> view{"--imgsize", "80,60", "--leaf-size", "2"};
  const auto picture = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), view.begin(), view.end());
    const Ended done = good(arguments);
    EXPECT_EQ(done.out + done.err, "");
    return *read_png(path("x.png"));
  };
  const Picture model = picture({"part.csg", "-o", "x.png", "--style", "plain"});
  const Picture edges = picture({"cells", "part.csg", "-o", "x.png"});
  const Picture faces = picture({"cells", "part.csg", "-o", "x.png", "--show", "faces"});
  ASSERT_EQ(edges.rgba.size(), model.rgba.size());
  const auto changed = [&](const Picture& drawn) {
    size_t count = 0;
    for (size_t i = 0; i < model.rgba.size(); i += 4)
      count += !std::equal(&model.rgba[i], &model.rgba[i + 4], &drawn.rgba[i]);
    return double(count) / double(model.rgba.size() / 4);
  };
  EXPECT_GT(changed(edges), 0.05);
  EXPECT_LT(changed(edges), 0.6) << "lines leave the model to be seen";
  EXPECT_GT(changed(faces), 0.2);
  EXPECT_EQ(edges.at(0, 0)[0], model.at(0, 0)[0]) << "and the background";
}

TEST_F(Cells, StatisticsCountAllCells) {
  const Ended done =
      good({"cells", "part.csg", "-o", "x.png", "--paper", "--pixel-threshold", "60", "--stats"});
  EXPECT_NE(done.err.find("\n  conjunctions "), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("\n  ignored "), std::string::npos) << done.err;
  EXPECT_EQ(done.err.find("\n  open "), std::string::npos) << "only final cells: " << done.err;
}

TEST_F(Cells, WhatCannotBeIsRefused) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Ended done = run(arguments);
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_NE(done.err.find(message), std::string::npos) << done.err;
  };
  refused({"cells", "part.csg"}, "give -o FILE.png");
  refused({"cells", "part.csg", "-o", "x.exr"}, "-o: wants a .png file");
  refused({"cells", "part.csg", "-o", "x.png", "--show", "all"}, "there are: edges, faces");
  refused({"cells", "part.csg", "-o", "x.png", "--backend", "oracle"}, "oracle has no cells");
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
}

TEST_F(Compare, EqualFactsAreEqualWhateverTheirColours) {
  // Both framed as OpenSCAD does it.
  good({"part.csg", "-o", "a.exr", "--imgsize", "32,32", "--style", "plain"});
  good({"part.csg", "-o", "b.exr", "--imgsize", "32,32", "--style", "blinn"});
  const Ended equal = good({"compare", "a.exr", "b.exr"});
  EXPECT_FALSE(equal.out.empty());
  EXPECT_EQ(equal.err, "");
  EXPECT_EQ(good({"compare", "a.exr", "b.exr", "-q"}).out, "");
}

TEST_F(Compare, DifferentFactsSayWhere) {
  write("a.csg", "cube(10, center = true);");
  write("b.csg", "cube(0); cube([10, 10, 10.2], center = true);");
  for (const char* name : {"a", "b"})
    good({std::string(name) + ".csg", "-o", std::string(name) + ".exr", "--imgsize", "32,32",
          "--camera", "0,0,0,0,0,0,50"});
  const Ended differ = run({"compare", "a.exr", "b.exr", "-o", "d.png"});
  EXPECT_EQ(differ.exit_code, 1);
  EXPECT_NE(differ.out.find("id"), std::string::npos) << differ.out;
  EXPECT_NE(differ.out.find("pixel"), std::string::npos) << differ.out;
  const Result<Picture> picture = read_png(path("d.png"));
  ASSERT_TRUE(bool(picture));
  EXPECT_EQ(picture->width, 32);
}

TEST_F(Compare, TolerancesAreTheUsers) {
  write("b.csg", "cube([10, 10, 10.02], center = true);");
  write("a.csg", "cube(10, center = true);");
  for (const char* name : {"a", "b"})
    good({std::string(name) + ".csg", "-o", std::string(name) + ".exr", "--imgsize", "9,9",
          "--camera", "0,0,0,0,0,0,20"});
  EXPECT_EQ(run({"compare", "a.exr", "b.exr"}).exit_code, 1);
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--distance", "1e-2"}).exit_code, 0);
}

TEST_F(Compare, PicturesOfAnotherSizeDiffer) {
  good({"part.csg", "-o", "a.exr", "--imgsize", "32,32"});
  good({"part.csg", "-o", "b.exr", "--imgsize", "32,31"});
  EXPECT_EQ(run({"compare", "a.exr", "b.exr"}).exit_code, 1);
}

TEST_F(Compare, WhatIsNoFileOfFactsIsBadInput) {
  const Ended text = run({"compare", "part.csg", "part.csg"});
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_EQ(text.err, "part.csg: not an OpenEXR file\n");
  EXPECT_EQ(run({"compare", "absent.exr", "part.csg"}).err,
            "absent.exr: cannot read: No such file or directory\n");
}

TEST_F(Bench, JsonIsAnArrayWithAnObjectAFile) {
  const Ended done = good({"bench", "part.csg", "part.csg", "--json", "--repeat", "2", "--imgsize",
                           "64,48", "--threads", "1"});
  const Json all = Json::parse(done.out);
  ASSERT_EQ(all.size(), 2u);
  for (const Json& one : all) {
    EXPECT_EQ(one["file"], "part.csg");
    EXPECT_EQ(one["backend"], "cpu");
    EXPECT_EQ(one["width"], 64);
    EXPECT_EQ(one["height"], 48);
    EXPECT_EQ(one["threads"], 1);
    EXPECT_EQ(one["repeat"], 2);
    EXPECT_EQ(one["rays"], 64 * 48);
    EXPECT_EQ(one["half_spaces"], 9);
    EXPECT_EQ(one["wrong"], 0);
    for (const char* name :
         {"parse_ms", "lower_ms", "subdivide_ms", "trace_ms", "shade_ms", "cold_ms", "file_ms",
          "peak_memory_bytes", "cells", "leaves", "leaf_visits_per_ray", "cell_visits_per_ray",
          "literals_per_ray", "checked"})
      EXPECT_GT(one[name].get<double>(), 0) << name;
    EXPECT_EQ(one["paper_ms"]["S"], one["subdivide_ms"]);
    EXPECT_EQ(one["paper_ms"]["T"], one["trace_ms"]);
    EXPECT_EQ(one["paper_ms"]["cold"], one["cold_ms"]);
  }
}

TEST_F(Bench, TheTableNamesTheStages) {
  const Ended done = good({"bench", "part.csg", "--repeat", "1", "--imgsize", "32,32"});
  for (const char* stage :
       {"parse", "lower", "subdivide", "trace", "shade", "cold", "file", "memory"})
    EXPECT_NE(done.out.find(stage), std::string::npos) << stage;
}

TEST_F(Bench, WhatIgnoredCellsHideIsCountedAndNotWrong) {
  good({"model", "cheese", "60", "-o", "cheese.csg"});
  std::vector<std::string> arguments = {"bench",  "cheese.csg",    "--repeat", "1",
                                        "--json", "--leaf-size",   "2",        "--pixel-threshold",
                                        "100",    "--small-cells", "ignore"};
  const Json ignored = Json::parse(good(arguments).out)[0];
  EXPECT_GT(ignored["lost_to_ignored_cells"], 100);
  EXPECT_EQ(ignored["wrong"], 0);
  EXPECT_GT(ignored["checked"], 2000);
  arguments.back() = "trace";
  const Json traced = Json::parse(good(arguments).out)[0];
  EXPECT_FALSE(traced.contains("lost_to_ignored_cells"));
  EXPECT_EQ(traced["wrong"], 0);
}

TEST_F(Bench, AnOrbitTellsWhatItsStepsRefine) {
  good({"model", "cheese", "60", "-o", "cheese.csg"});
  const Json orbit = Json::parse(good({"bench", "cheese.csg", "--repeat", "1", "--json", "--paper",
                                       "--imgsize", "64,64", "--orbit", "6"})
                                     .out)[0]["orbit"];
  EXPECT_EQ(orbit["steps"], 6);
  for (const char* list : {"step_ms", "of_it_cells_ms", "afresh_ms", "refined", "refined_afresh"})
    EXPECT_EQ(orbit[list].size(), 6u) << list;
  for (size_t i = 0; i < 6; ++i)
    EXPECT_LT(10 * orbit["refined"][i].get<int>(), orbit["refined_afresh"][i].get<int>()) << i;
  EXPECT_GT(orbit["most_refined_share"], 0);
  EXPECT_GE(orbit["most_refined_share"], orbit["median_refined_share"]);
  EXPECT_GT(orbit["refined_share_in_all"], orbit["most_refined_share"]);
  const std::string table =
      good({"bench", "part.csg", "--repeat", "1", "--imgsize", "16,16", "--orbit", "2"}).out;
  EXPECT_NE(table.find("ms a degree, afresh"), std::string::npos) << table;
}

TEST_F(Bench, TheOracleCanBeMeasuredToo) {
  const Ended done = good({"bench", "part.csg", "--repeat", "1", "--json", "--backend", "oracle",
                           "--imgsize", "16,16"});
  EXPECT_EQ(Json::parse(done.out)[0]["backend"], "oracle");
}

TEST_F(Bench, ABadFileIsBadInput) {
  const Ended absent = run({"bench", "absent.csg"});
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_EQ(absent.err, "absent.csg: error: cannot be read: No such file or directory\n");
  const Ended standard = run({"bench", "-"});
  EXPECT_EQ(standard.exit_code, 2);
  EXPECT_EQ(standard.err, "whittle: standard input cannot be read again; bench wants files\n");
}

TEST_F(ModelCommand, EveryModelOfTheListIsMadeAndRead) {
  const Ended list = good({"model", "--list"});
  size_t made = 0;
  for (size_t at = 0; at < list.out.size(); at = list.out.find('\n', at) + 1, ++made) {
    const std::string name = list.out.substr(at, list.out.find(' ', at) - at);
    const Ended model = good({"model", name});
    EXPECT_EQ(model.out.find("// " + name), 0u) << model.out.substr(0, 60);
    EXPECT_EQ(run({"info", "-", "--strict", "-q"}, {.in = model.out}).exit_code, 0) << name;
  }
  EXPECT_GE(made, 10u);
}

TEST_F(ModelCommand, TheSeedDecidesAndTheFileIsWhatIsPrinted) {
  const std::string one = good({"model", "cheese", "20"}).out;
  EXPECT_EQ(good({"model", "cheese", "20", "--seed", "1"}).out, one);
  EXPECT_NE(good({"model", "cheese", "20", "--seed", "2"}).out, one);
  EXPECT_NE(good({"model", "cheese", "20", "--seed", "18446744073709551615"}).out, one);
  good({"model", "cheese", "20", "-o", "x.csg"});
  EXPECT_EQ(read("x.csg"), one);
}

TEST_F(ModelCommand, AsPovItHasTheAskedPicture) {
  good({"model", "widget", "-o", "x.pov", "--imgsize", "320,200"});
  const std::string pov = read("x.pov");
  EXPECT_NE(pov.find("camera"), std::string::npos);
  EXPECT_NE(pov.find("difference"), std::string::npos);
  EXPECT_NE(pov.find("320"), std::string::npos);
  good({"model", "widget", "-o", "y.pov", "--imgsize", "320,200", "--camera", "0,0,0,0,0,0,900"});
  EXPECT_NE(read("y.pov"), pov);
}

TEST_F(ModelCommand, WhatCannotBeMadeIsBadUsage) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const Ended done = run(arguments);
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_EQ(done.err, "whittle: " + message + "\n");
  };
  refused({"model"}, "NAME is required; 'whittle model --list' says which");
  refused({"model", "nope"},
          "there is no model 'nope'; there are: cheese, cyl, cone, tube, widget, r9, plate, "
          "menger, random, lattice");
  refused({"model", "cheese", "0"},
          "model 'cheese': N is the number of spheres, 1 to 1000000, not 0");
  refused({"model", "widget", "3"}, "model 'widget' has one size; leave N out");
  refused({"model", "widget", "-o", "x.stl"},
          "'x.stl' does not end in .csg or .pov, so its format is not known");
  refused({"model", "cheese", "many"}, "N: 'many' is not a number\nTry 'whittle model --help'.");
  refused({"model", "cheese", "--seed", "-3"},
          "--seed: wants a whole number from 0, not -3\nTry 'whittle model --help'.");
}

}  // namespace
}  // namespace whittle
