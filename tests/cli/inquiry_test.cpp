// whittle pick, cast and measure: what is asked of a model has a known answer.
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/exr.h"
#include "support/program.h"

namespace whittle {
namespace {

using Json = nlohmann::json;

class Inquiry : public ProgramTest {
 protected:
  void SetUp() override {
    // A plate with a hole, seen from above: x to the right, y up, ten pixels a unit.
    write("plate.csg",
          "difference() {\n"
          "  color([0.2, 0.4, 0.8, 1])\n"
          "    cube([40, 20, 5], center = true);\n"
          "  multmatrix([[2,0,0,10],[0,2,0,0],[0,0,2,0],[0,0,0,1]]) cylinder(h = 3, r = 2);\n"
          "}\n");
  }
  /// A view of 400 x 200 pixels from above.
  static std::vector<std::string> from_above(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--imgsize", "400,200", "--camera", "0,0,0,0,0,0,100",
                                       "--projection", "ortho", "--fov", "11.421186274999286"});
    return arguments;
  }
  /// Standard output as JSON, one value a line.
  static std::vector<Json> lines_of(const Ended& ended) {
    std::vector<Json> lines;
    std::istringstream text(ended.out);
    for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
    return lines;
  }
  static void expect_vector(const Json& json, double x, double y, double z) {
    ASSERT_EQ(json.size(), 3u) << json;
    EXPECT_NEAR(json[0].get<double>(), x, 1e-9);
    EXPECT_NEAR(json[1].get<double>(), y, 1e-9);
    EXPECT_NEAR(json[2].get<double>(), z, 1e-9);
  }
};

TEST_F(Inquiry, APickSaysWhatIsSeenAndWhere) {
  const Ended ended = run(from_above(
      {"pick", "plate.csg", "--at", "100,100", "--at", "300,100", "--at", "5,1", "--json"}));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::vector<Json> picks = lines_of(ended);
  ASSERT_EQ(picks.size(), 3u);
  EXPECT_TRUE(picks[0]["hit"]);
  EXPECT_EQ(picks[0]["id"], 1);
  EXPECT_EQ(picks[0]["place"], "plate.csg:3:5");
  EXPECT_EQ(picks[0]["statement"], "cube([40, 20, 5], center = true)");
  expect_vector(picks[0]["point"], -10, 0, 2.5);
  expect_vector(picks[0]["normal"], 0, 0, 1);
  EXPECT_NEAR(picks[0]["distance"].get<double>(), 97.5, 1e-9);
  EXPECT_EQ(picks[0]["primitive"]["kind"], "cube");
  EXPECT_EQ(picks[0]["primitive"]["parameters"]["size"], Json({40, 20, 5}));
  EXPECT_NEAR(picks[0]["color"][2].get<double>(), 0.8, 1e-6);
  // The hole begins in the middle of the plate: its floor is the cylinder's end.
  EXPECT_EQ(picks[1]["id"], 2);
  expect_vector(picks[1]["point"], 10, 0, 0);
  EXPECT_EQ(picks[1]["primitive"]["kind"], "cylinder");
  EXPECT_EQ(picks[1]["primitive"]["parameters"]["r1"], 2);
  EXPECT_TRUE(picks[2]["hit"]);
}

TEST_F(Inquiry, APickInWords) {
  const Ended ended = run(from_above({"pick", "plate.csg", "--at", "100,100"}));
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.out,
            "statement  cube([40, 20, 5], center = true)\n"
            "place      plate.csg:3:5\n"
            "point      -10,0,2.5\n"
            "normal     0,0,1\n"
            "distance   97.5\n"
            "id         1\n"
            "primitive  cube, size [40.0,20.0,5.0], center true\n"
            "color      0.2,0.4,0.8,1\n");
  EXPECT_EQ(run({"pick", "plate.csg", "--at", "0,0", "--at", "511.5,9"}).out,
            "0,0: nothing is seen there\n\n511.5,9: nothing is seen there\n");
  EXPECT_EQ(run({"pick", "plate.csg", "--at", "0,0", "--json"}).out,
            "{\"at\":[0.0,0.0],\"hit\":false}\n");
}

TEST_F(Inquiry, APickIsOfThePictureThatIsMadeWithTheSameOptions) {
  for (const std::vector<std::string>& look :
       {std::vector<std::string>{}, {"--style", "plain"}, {"--style", "openscad"}}) {
    std::vector<std::string> draw = {"plate.csg", "-o", "facts.exr", "--imgsize", "64,48"};
    std::vector<std::string> pick = {"pick", "plate.csg", "--json", "--imgsize", "64,48"};
    draw.insert(draw.end(), look.begin(), look.end());
    pick.insert(pick.end(), look.begin(), look.end());
    ASSERT_EQ(run(draw).exit_code, 0);
    const Result<Frame> facts = read_exr(path("facts.exr"));
    ASSERT_TRUE(bool(facts));
    for (int y = 0; y < 48; y += 3)
      for (int x = 0; x < 64; x += 3)
        pick.insert(pick.end(), {"--at", std::to_string(x) + ".5," + std::to_string(y) + ".5"});
    const Ended ended = run(pick);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    size_t hits = 0;
    for (const Json& picked : lines_of(ended)) {
      const int x = picked["at"][0].get<int>(), y = picked["at"][1].get<int>();
      SCOPED_TRACE(picked["at"].dump());
      const Hit& hit = facts->at(x, y);
      ASSERT_EQ(picked["hit"].get<bool>(), hit.hit());
      if (!hit.hit()) continue;
      ++hits;
      EXPECT_EQ(picked["id"].get<uint32_t>(), hit.id);
      EXPECT_NEAR(picked["distance"].get<double>(), double(hit.distance), 1e-3);
    }
    EXPECT_GT(hits, 40u);
  }
}

TEST_F(Inquiry, APlaceOutsideOfThePictureIsRefused) {
  const Ended ended = run({"pick", "plate.csg", "--at", "1,1", "--at", "600,-600"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_EQ(ended.err,
            "whittle: --at 600,-600 is outside of the picture, which has 512 x 512 pixels\n");
  EXPECT_EQ(run({"measure", "plate.csg", "--imgsize", "40,30", "--at", "40,5"}).err,
            "whittle: --at 40,5 is outside of the picture, which has 40 x 30 pixels\n");
  EXPECT_EQ(run({"measure", "plate.csg", "--at", "-0.1,5"}).exit_code, 2);
}

TEST_F(Inquiry, AnExtrusionIsABody) {
  write("body.csg", "linear_extrude(height = 2) { square(9, center = true); circle(r = 3); }\n");
  const Ended ended = run(from_above({"pick", "body.csg", "--at", "200,100", "--json"}));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const Json pick = lines_of(ended).at(0);
  EXPECT_EQ(pick["statement"], "linear_extrude(height = 2)");
  EXPECT_EQ(pick["place"], "body.csg:1:1");
  expect_vector(pick["point"], 0, 0, 2);
}

TEST_F(Inquiry, PicksNeedAPlace) {
  const Ended none = run({"pick", "plate.csg"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err, "whittle: pick needs a place: --at X,Y\n");
  EXPECT_EQ(run({"pick", "plate.csg", "--at", "1"}).exit_code, 2);
  EXPECT_EQ(run({"pick", "missing.csg", "--at", "1,1"}).exit_code, 1);
  const Ended three = run({"measure", "plate.csg", "--at", "1,1", "--at", "1,1", "--at", "1,1"});
  EXPECT_EQ(three.exit_code, 2);
  EXPECT_EQ(three.err, "whittle: measure needs one place or two (--at X,Y), not 3\n");
}

TEST_F(Inquiry, ARayIsCastThroughAll) {
  const Ended ended = run({"cast", "plate.csg", "-100,0,1", "7,0,0", "0,0,50", "0,0,1"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out,
            "1 enters 80 at -20,0,1 normal -1,0,0 id 1\n"
            "1 leaves 106 at 6,0,1 normal 1,0,0 id 2\n"
            "1 enters 114 at 14,0,1 normal -1,0,0 id 2\n"
            "1 leaves 120 at 20,0,1 normal 1,0,0 id 1\n"
            "2 nothing\n");
}

TEST_F(Inquiry, RaysComeFromStandardInput) {
  const std::string rays = "-100,0,1,1,0,0\n\n 0 0 50\t0 0 1\r\n0,15,50,0,0,-1";
  const Ended all = run({"cast", "plate.csg", "--json"}, {.in = rays});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  const std::vector<Json> found = lines_of(all);
  ASSERT_EQ(found.size(), 3u);
  ASSERT_EQ(found[0]["crossings"].size(), 4u);
  EXPECT_EQ(found[0]["ray"], 1);
  EXPECT_EQ(found[0]["crossings"][1]["enters"], false);
  EXPECT_EQ(found[0]["crossings"][1]["distance"], 106);
  EXPECT_EQ(found[0]["crossings"][1]["id"], 2);
  EXPECT_EQ(found[1]["crossings"].size(), 0u);
  EXPECT_EQ(found[2]["crossings"].size(), 0u);
  const Ended first = run({"cast", "plate.csg", "--json", "--first"}, {.in = rays});
  EXPECT_EQ(lines_of(first).at(0)["crossings"].size(), 1u);
  EXPECT_EQ(lines_of(first).at(0)["crossings"][0]["distance"], 80);
  EXPECT_EQ(lines_of(first).at(0)["crossings"][0]["enters"], true);
}

TEST_F(Inquiry, ManyRaysAreAnsweredInOrder) {
  std::ostringstream rays;
  constexpr int kRays = 50000;
  for (int i = 0; i < kRays; ++i) rays << -20 + 40.0 * (i + 0.5) / kRays << ",9,50,0,0,-1\n";
  const Ended ended = run({"cast", "plate.csg", "--json"}, {.in = rays.str()});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::vector<Json> found = lines_of(ended);
  ASSERT_EQ(found.size(), size_t(kRays));
  for (int i = 0; i < kRays; ++i) {
    ASSERT_EQ(found[size_t(i)]["ray"], i + 1);
    ASSERT_EQ(found[size_t(i)]["crossings"].size(), 2u);
    ASSERT_NEAR(found[size_t(i)]["crossings"][0]["point"][0].get<double>(),
                -20 + 40.0 * (i + 0.5) / kRays, 1e-3);
  }
}

TEST_F(Inquiry, WhatIsNoRayIsNamed) {
  const Ended bad = run({"cast", "plate.csg"}, {.in = "0,0,50,0,0,-1\n1,2,3\n0,0,50,0,0,1\n"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_TRUE(bad.out.starts_with("1 enters")) << bad.out;
  EXPECT_EQ(bad.err,
            "<stdin>:2: error: a ray is six numbers, where it starts and which way it goes: "
            "x,y,z dx,dy,dz\n");
  EXPECT_EQ(run({"cast", "plate.csg"}, {.in = "0,0,5,0,0,0"}).err,
            "<stdin>:1: error: the way of a ray must have a length\n");
  EXPECT_EQ(run({"cast", "plate.csg"}, {.in = "0,0,5,0,0,nan"}).exit_code, 1);
  EXPECT_EQ(run({"cast", "plate.csg"}, {.in = std::string(100000, '1')}).exit_code, 1);
  EXPECT_EQ(run({"cast", "plate.csg", "1,2,3"}).err,
            "whittle: a ray is two words, X,Y,Z and DX,DY,DZ; '1,2,3' is alone\n");
  EXPECT_EQ(run({"cast", "-"}, {.in = "cube(1);"}).err,
            "whittle: the model and the rays cannot both be standard input\n");
}

TEST_F(Inquiry, ADrawingIsPassedOnce) {
  write("flat.csg", "square(10);\n");
  const Ended ended = run({"cast", "flat.csg", "5,5,9", "0,0,-1", "15,5,9", "0,0,-1"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out, "1 enters 9 at 5,5,0 normal 0,0,1 id 1\n2 nothing\n");
}

TEST_F(Inquiry, ThicknessDistanceAngleAndDiameter) {
  // On top, and on the wall of the hole, which is seen a little aslant.
  const Ended ended =
      run({"measure", "plate.csg", "--json", "--imgsize", "400,200", "--projection", "ortho",
           "--camera", "-10,0,2.5,0,0,0,100", "--at", "200,100", "--at", "250,100"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const Json top = lines_of(ended).at(0);
  EXPECT_NEAR(top["places"][0]["thickness"].get<double>(), 5, 1e-9);
  EXPECT_TRUE(top["places"][0]["diameter"].is_null());
  EXPECT_NEAR(top["angle"].get<double>(), 0, 1e-9);
  EXPECT_NEAR(top["along"][1].get<double>(), 0, 1e-9);
  EXPECT_NEAR(top["distance"].get<double>(), top["along"][0].get<double>(), 1e-9);

  const Ended wall = run({"measure", "plate.csg", "--json", "--imgsize", "100,100", "--camera",
                          "10,0,3,14,0,1", "--at", "50,50", "--at", "50,99"});
  EXPECT_EQ(wall.exit_code, 0) << wall.err;
  const Json hole = lines_of(wall).at(0);
  EXPECT_EQ(hole["places"][0]["id"], 2);
  EXPECT_NEAR(hole["places"][0]["diameter"].get<double>(), 8, 1e-9);
  EXPECT_NEAR(hole["places"][0]["thickness"].get<double>(), 6, 1e-9);
}

TEST_F(Inquiry, DiametersOfBallsConesFacetsAndWhatIsNotRound) {
  const auto diameter = [&](const std::string& text) {
    write("one.csg", text);
    const Ended ended =
        run({"measure", "one.csg", "--json", "--camera", "30,1,1,0,0,1", "--at", "256,256"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return lines_of(ended).at(0)["places"][0]["diameter"];
  };
  EXPECT_NEAR(diameter("sphere(4);").get<double>(), 8, 1e-9);
  EXPECT_NEAR(diameter("sphere($fn = 20, r = 4);").get<double>(), 8, 1e-9);
  EXPECT_NEAR(diameter("cylinder($fn = 12, h = 9, r = 4);").get<double>(), 8, 1e-9);
  // A quarter of the way up, about.
  const double cone = diameter("cylinder(h = 4, r1 = 4, r2 = 0);").get<double>();
  EXPECT_NEAR(cone, 6, 0.5);
  EXPECT_NEAR(diameter("linear_extrude(height = 9) circle(r = 5);").get<double>(), 10, 1e-9);
  EXPECT_TRUE(
      diameter("multmatrix([[1,0,0,0],[0,2,0,0],[0,0,1,0],[0,0,0,1]]) sphere(4);").is_null());
  EXPECT_TRUE(diameter("cube(8, center = true);").is_null());
}

TEST_F(Inquiry, NothingToMeasureIsSaid) {
  const Ended ended = run({"measure", "plate.csg", "--at", "5,0"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_EQ(ended.err, "plate.csg: nothing is seen at 5,0\n");
}

}  // namespace
}  // namespace whittle
