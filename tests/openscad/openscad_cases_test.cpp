// The small files of `cases`: for every node its defaults, its edge cases and what is degenerate.
// `manifest.txt` beside them says what is expected of each; a test a group of files, which is what
// their names begin with.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "look.h"

namespace whittle {
namespace {

struct Case {
  std::string name;
  std::string pixels;    ///< a side
  std::string expected;  ///< picture, drawing, empty or alone: see manifest.txt
};

struct Group {
  std::string name;
  std::vector<Case> cases;
};
std::ostream& operator<<(std::ostream& out, const Group& group) {
  return out << group.name;
}

std::vector<Case> manifest() {
  std::vector<Case> cases;
  std::ifstream file(WHITTLE_CASES "/manifest.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    Case next;
    words >> next.name >> next.pixels >> next.expected;
    cases.push_back(next);
  }
  return cases;
}

std::vector<Group> groups() {
  std::map<std::string, Group> by_name;
  for (const Case& one : manifest()) {
    const std::string name = one.name.substr(0, one.name.find('_'));
    by_name[name].name = name;
    by_name[name].cases.push_back(one);
  }
  std::vector<Group> result;
  for (const auto& [name, group] : by_name) result.push_back(group);
  return result;
}

class Cases : public testing::TestWithParam<Group> {};

TEST_P(Cases, LookAsInOpenscad) {
  for (const Case& one : GetParam().cases) {
    const std::string file = WHITTLE_CASES "/" + one.name + ".csg";
    const std::string options = "--imgsize=" + one.pixels + "," + one.pixels;
    if (one.expected == "picture") {
      expect_the_same(file, options);
      continue;
    }
    if (one.expected == "drawing") {
      expect_the_same_drawing(file, options);
      continue;
    }
    SCOPED_TRACE(file);
    Look look;
    look_at_ours(file, options, look);
    if (one.expected == "empty") {
      EXPECT_EQ(hits(look.facts), 0u);
      expect_empty_to_openscad(file);
    } else {
      EXPECT_GT(hits(look.facts), 400u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Openscad, Cases, testing::ValuesIn(groups()),
                         [](const auto& group) { return group.param.name; });

TEST(CasesManifest, NamesEveryFileOnce) {
  std::set<std::string> named;
  for (const Case& one : manifest()) {
    EXPECT_TRUE(named.insert(one.name).second) << one.name << " twice";
    EXPECT_TRUE(one.expected == "picture" || one.expected == "drawing" || one.expected == "empty" ||
                one.expected == "alone")
        << one.name << ": " << one.expected;
  }
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(WHITTLE_CASES))
    if (entry.path().extension() == ".csg") there.insert(entry.path().stem());
  EXPECT_EQ(named, there);
  EXPECT_GE(named.size(), 160u);
}

}  // namespace
}  // namespace whittle
