#include "viewer/actions.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace whittle {
namespace {

/// The rows of the page's tables under a heading: `| keys | what |`.
std::vector<std::pair<std::string, std::string>> rows_under(const std::string& heading) {
  std::ifstream file(WHITTLE_VIEWER_PAGE);
  std::vector<std::pair<std::string, std::string>> rows;
  std::string line;
  bool is_there = false;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) is_there = line == "### " + heading;
    const size_t middle = line.find(" | ");
    if (!is_there || !line.starts_with("| ") || middle == std::string::npos) continue;
    rows.emplace_back(line.substr(2, middle - 2),
                      line.substr(middle + 3, line.size() - middle - 5));
  }
  return rows;
}

TEST(ActionsTest, NoKeyMeansTwoThings) {
  std::set<std::tuple<int, bool, bool>> keys;
  for (const KeyBinding& binding : key_bindings())
    EXPECT_TRUE(keys.insert({int(binding.key), binding.with.control, binding.with.shift}).second)
        << binding.shown;
}

TEST(ActionsTest, KeysAreFound) {
  EXPECT_EQ(action_of(key_of('H'), {}), Action::kHelp);
  EXPECT_EQ(action_of(key_of('C'), {.control = true}), Action::kCopyCamera);
  EXPECT_EQ(action_of(key_of('C'), {}), Action::kCells);
  EXPECT_EQ(action_of(Key::kPlus, {.shift = true}), Action::kZoomIn);
  EXPECT_EQ(action_of(key_of('H'), {.control = true}), std::nullopt);
  EXPECT_EQ(action_of(key_of('Y'), {}), std::nullopt);
}

TEST(ActionsTest, EveryActionHasAKey) {
  std::set<Action> actions;
  for (const KeyBinding& binding : key_bindings()) actions.insert(binding.action);
  EXPECT_EQ(actions.size(), size_t(Action::kQuit) + 1);
}

TEST(ActionsTest, KeysWithOneMeaningShareALine) {
  for (const HelpLine& line : help_lines()) {
    if (line.does == "quit") {
      EXPECT_EQ(line.keys, "Q, Ctrl+Q, Esc");
    }
  }
}

TEST(ActionsTest, ThePageListsWhatTheHelpLists) {
  std::vector<std::pair<std::string, std::string>> expected, found;
  for (const HelpGroup group : kHelpGroups) {
    expected.clear();
    for (const HelpLine& line : help_lines())
      if (line.group == group) expected.emplace_back(line.keys, line.does);
    found = rows_under(title_of(group));
    ASSERT_GE(found.size(), 1u) << title_of(group);
    found.erase(found.begin());  // the table's head
    EXPECT_EQ(found, expected) << title_of(group);
  }
}

}  // namespace
}  // namespace whittle
