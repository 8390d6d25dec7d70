// The solids of `cases` as files: OpenSCAD's STL and our mesh enclose the same. What one has and
// the other has not is a solid too, which whittle evaluates.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/folder_for_test.h"
#include "host/read_file.h"
#include "support/mesh_checks.h"
#include "support/solid_difference.h"
#include "whittle/reading.h"
#include "whittle/solid_output.h"

namespace whittle {
namespace {

/// OpenSCAD writes six digits: half a unit of the last one of 1.00000.
constexpr double kDigits = 5e-6;
/// It lays out glyphs in FreeType's whole pixels, some 10^-3 of their size.
constexpr double kTextDigits = 1e-3;

std::vector<std::string> solids() {
  std::vector<std::string> names;
  std::ifstream file(WHITTLE_CASES "/manifest.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name, pixels, expected;
    words >> name >> pixels >> expected;
    if (expected == "picture") names.push_back(name);
  }
  return names;
}

Result<SolidMesh> mesh_of(const Model& model) {
  const Workers workers(2);
  return solid_or_nothing_of(model, workers);
}

Result<SolidMesh> ours_of(const std::string& file) {
  FileOptions options;
  options.reading.curves = Curves::kOpenscad2021;
  options.reading.solid_box = box_maker(2);
  options.reading.closed_mesh = mesh_maker(2);
  const Result<Read> read = read_file(file, options);
  if (!read) return read.error();
  return mesh_of(read->model);
}

class Solids : public testing::TestWithParam<std::string> {};

TEST_P(Solids, EncloseWhatOpenscadsEnclose) {
  const TestFolder folder;
  const std::string stl = folder / "theirs.stl", file = WHITTLE_CASES "/" + GetParam() + ".csg";
  const std::string command = "HOME='" + std::string(folder / "") +
                              "' timeout 120 '" WHITTLE_OPENSCAD "' -o '" + stl + "' '" + file +
                              "' >/dev/null 2>&1 </dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  const Result<Read> read = read_file(stl, {});
  ASSERT_TRUE(read) << read.error().message;
  const Result<SolidMesh> theirs = mesh_of(read->model), ours = ours_of(file);
  ASSERT_TRUE(theirs) << theirs.error().message;
  ASSERT_TRUE(ours) << ours.error().message;
  ASSERT_FALSE(ours->triangles.empty());
  const double digits = GetParam().starts_with("text_") ? kTextDigits : kDigits;
  EXPECT_LE(symmetric_difference(*ours, *theirs), digits * reach_of(*ours) * surface(*ours));
}

INSTANTIATE_TEST_SUITE_P(Openscad, Solids, testing::ValuesIn(solids()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace whittle
