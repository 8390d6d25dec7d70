// whittle info --mass: what a solid weighs.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program.h"

namespace whittle {
namespace {

class MassCommand : public ProgramTest {
 protected:
  void SetUp() override {
    write("two.csg",
          "color([1, 0, 0, 1]) cube(size = 10);"
          "multmatrix([[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])"
          "color([0, 0, 1, 0.5]) cube(size = 10);\n");
    write("ball.csg", "sphere(r = 1);\n");
  }
};

TEST_F(MassCommand, SaysWhatItIs) {
  const Ended done = run({"info", "two.csg", "--density", "2.5"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.err, "");
  for (const char* line :
       {"\nvolume       2000", "\nsurface      1000", "\nmass         5", "\ncentroid     [10",
        "\ncolor        #ff0000\nvolume       1000", "\ncolor        #0000ff80\nvolume       1000"})
    EXPECT_NE(done.out.find(line), std::string::npos) << line << " in\n" << done.out;
  EXPECT_EQ(run({"info", "two.csg"}).out.find("volume"), std::string::npos);
}

TEST_F(MassCommand, AsJson) {
  const Ended done =
      run({"info", "ball.csg", "--mass", "--within", "1e-4", "--json", "--threads", "1"});
  EXPECT_EQ(done.exit_code, 0);
  const auto mass = nlohmann::json::parse(done.out)["mass"];
  EXPECT_NEAR(mass["volume"].get<double>(), 4.18879020478639, mass["volume_bound"].get<double>());
  EXPECT_LE(mass["volume_bound"].get<double>(), 4.2e-4);
  EXPECT_TRUE(mass["within"].get<bool>());
  EXPECT_FALSE(mass["facetted"].get<bool>());
  EXPECT_EQ(mass["inertia"].size(), 3u);
  EXPECT_EQ(mass["colors"].size(), 0u);
  EXPECT_FALSE(mass.contains("mass"));
  const Ended facets = run({"info", "ball.csg", "--mass", "--json", "--curves", "facets"});
  const auto other = nlohmann::json::parse(facets.out)["mass"];
  EXPECT_TRUE(other["facetted"].get<bool>());
  EXPECT_LT(other["volume"].get<double>(), 4.18);
}

TEST_F(MassCommand, RefusesWhatItCannotWeigh) {
  write("flat.csg", "square(size = 1);\n");
  const Ended flat = run({"info", "flat.csg", "--mass"});
  EXPECT_EQ(flat.exit_code, 1);
  EXPECT_EQ(flat.err, "flat.csg: error: what is flat has no volume\n");
  write("endless.csg", "halfspace(n = [0, 0, 1], d = 0);\n");
  EXPECT_EQ(run({"info", "endless.csg", "--mass"}).err,
            "endless.csg: error: the solid has no end, so no volume\n");
  EXPECT_EQ(run({"info", "ball.csg", "--density", "0"}).exit_code, 2);
  EXPECT_EQ(run({"info", "ball.csg", "--within", "0"}).exit_code, 2);
  EXPECT_EQ(run({"info", "ball.csg", "--within", "2"}).exit_code, 2);
}

TEST_F(MassCommand, EmptyHasNoCentre) {
  write("empty.csg", "difference() { cube(size = 1); cube(size = 1); }\n");
  const Ended done = run({"info", "empty.csg", "--mass", "--json"});
  EXPECT_EQ(done.exit_code, 0);
  const auto mass = nlohmann::json::parse(done.out)["mass"];
  EXPECT_EQ(mass["volume"].get<double>(), 0);
  EXPECT_FALSE(mass.contains("centroid"));
}

}  // namespace
}  // namespace whittle
