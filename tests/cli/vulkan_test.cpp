// Vulkan as the program's users meet it: there, not there, or not built.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace whittle {
namespace {

/// An environment variable that has another value for as long as this lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    ::setenv(name, value, 1);
  }
  ~Environment() { old_.empty() ? ::unsetenv(name_) : ::setenv(name_, old_.c_str(), 1); }
  Environment(const Environment&) = delete;

 private:
  const char* name_;
  std::string old_;
};

class Vulkan : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("part.csg", "difference() { cube(20, center = true); sphere(12); }\n");
  }
  Ended render(const std::string& backend, const std::string& out) const {
    return run({"part.csg", "-o", out, "--backend", backend, "--imgsize", "48,36"});
  }

 private:
  // Mesa's software driver forgets 240 bytes when it ends.
  Environment leaks_{"ASAN_OPTIONS", "detect_leaks=0"};
};

TEST_F(Vulkan, ADeviceThatIsNamedIsUsedOrRefused) {
  for (const char* backend : {"cpu", "oracle"}) {
    const Ended refused =
        run({"part.csg", "-o", "x.png", "--backend", backend, "--device", "nosuch"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_EQ(refused.err, "whittle: --device names a device for --backend vulkan-raster\n");
  }
  // Named, it is asked for: then its backend is.
  for (const char* command : {"", "cells", "bench"}) {
    std::vector<std::string> arguments{"part.csg", "--device", "nosuch"};
    if (*command != '\0') arguments.insert(arguments.begin(), command);
    if (std::string(command) != "bench") arguments.insert(arguments.end(), {"-o", "x.png"});
    const Ended none = run(arguments);
    EXPECT_TRUE(none.exit_code == 2 || none.exit_code == 3) << none.exit_code;
    EXPECT_NE(none.err.find("Vulkan"), std::string::npos) << none.err;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
}

#if WHITTLE_HAS_VULKAN

TEST_F(Vulkan, ShowsWhatTheCpuShows) {
  const Ended cpu = render("cpu", "cpu.exr"), raster = render("vulkan-raster", "raster.exr");
  EXPECT_EQ(raster.exit_code, 0) << raster.err;
  EXPECT_EQ(raster.err, "");
  EXPECT_EQ(run({"compare", "cpu.exr", "raster.exr"}).exit_code, 0);
}

TEST_F(Vulkan, ShowsOfADrawingWhatTheCpuShows) {
  write("part.csg", "square([20, 10]); translate([9, 9]) circle(4); text(\"a\");\n");
  render("cpu", "cpu.exr"), render("vulkan-raster", "raster.exr");
  EXPECT_EQ(run({"compare", "cpu.exr", "raster.exr"}).exit_code, 0);
}

TEST_F(Vulkan, BenchHasThePapersQuantities) {
  for (const char* rules : {"--quiet", "--paper"}) {
    const Ended done = run({"bench", "part.csg", "--json", "--repeat", "2", "--imgsize", "48,36",
                            "--backend", "vulkan-raster", rules});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const nlohmann::json one = nlohmann::json::parse(done.out)[0];
    for (const char* name : {"S", "T_S", "T_R", "S_R"})
      EXPECT_GT(one["paper_ms"][name].get<double>(), 0) << name;
    for (const char* name : {"in_turn_ms", "stream_first_ms", "stream_batches", "stream_cells"})
      EXPECT_GT(one[name].get<double>(), 0) << name;
    EXPECT_LT(one["paper_ms"]["S"], one["in_turn_ms"]);
    EXPECT_LE(one["stream_first_ms"], one["paper_ms"]["S_R"]);
    EXPECT_EQ(one["backend"], "vulkan-raster");
    EXPECT_GT(one["checked"], 1000);
  }
  const Ended table = run(
      {"bench", "part.csg", "--repeat", "1", "--imgsize", "48,36", "--backend", "vulkan-raster"});
  EXPECT_NE(table.out.find("ms cells refined while drawn"), std::string::npos) << table.out;
}

TEST_F(Vulkan, ShadersAndCullingDoNotShow) {
  const std::vector<std::string> plain{
      "part.csg", "--backend", "vulkan-raster", "--imgsize", "48,36", "--stats", "-o"};
  const auto with = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), plain.begin(), plain.end());
    more.insert(more.begin() + std::ptrdiff_t(plain.size()), out);
    const Ended made = run(more);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return made.err;
  };
  // Of 48 x 36 pixels, few cells, all in view.
  EXPECT_NE(with("x.exr", {}).find("cells in view"), std::string::npos);
  with("y.exr", {"--shaders", "unified"});
  EXPECT_NE(with("z.exr", {"--culling", "off"}).find("in view, 0 of them because"),
            std::string::npos);
  EXPECT_EQ(read("x.exr"), read("y.exr"));
  EXPECT_EQ(read("x.exr"), read("z.exr"));
}

TEST_F(Vulkan, DevicesAreListedAndChosen) {
  const Ended list = run({"devices"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_EQ(list.out.substr(0, 3), "0  ");
  EXPECT_EQ(run({"devices", "--json"}).out.substr(0, 2), "[\n");
  const Ended none =
      run({"part.csg", "-o", "x.png", "--backend", "vulkan-raster", "--device", "voodoo"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err.find("whittle: no Vulkan device 'voodoo'; there are: 0 ("), 0u) << none.err;
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
}

TEST_F(Vulkan, WithoutADriverOneLineSaysSoAndAutoGoesOn) {
  const Environment drivers("VK_DRIVER_FILES", "/nowhere.json");
  const Environment older_loaders("VK_ICD_FILENAMES", "/nowhere.json");
  const std::string message =
      "whittle: there is no Vulkan driver here (Debian's mesa-vulkan-drivers has one that needs no "
      "GPU)\n";
  const Ended refused = render("vulkan-raster", "x.png"), list = run({"devices"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.err, message);
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
  EXPECT_EQ(list.exit_code, 3);
  EXPECT_EQ(list.err, message);
  EXPECT_EQ(render("auto", "x.png").exit_code, 0);
}

#else

TEST_F(Vulkan, NotBuiltOneLineSaysSoAndAutoGoesOn) {
  for (const Ended& refused : {render("vulkan-raster", "x.png"), run({"devices"})}) {
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(refused.err, "whittle: this whittle was built without Vulkan (WHITTLE_VULKAN=OFF)\n");
  }
  EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
  EXPECT_EQ(render("auto", "x.png").exit_code, 0);
}

#endif

}  // namespace
}  // namespace whittle
