#include "csg/statement_counter.h"

#include <gtest/gtest.h>

#include "csg/read_csg.h"

namespace whittle {
namespace {

StatementCounts counts_of(std::string_view text) {
  const Result<Read> read = read_csg(text, "t.csg");
  EXPECT_TRUE(read);
  return read ? read->counts : StatementCounts{};
}

using Words = std::vector<WordCount>;

TEST(StatementCounter, CountsTheMostFrequentFirst) {
  EXPECT_EQ(
      counts_of("sphere(1); union() { cube(1); cube(0); cube(2); } sphere(2); group();").words,
      (Words{{"cube", 3}, {"sphere", 2}, {"group", 1}, {"union", 1}}));
  EXPECT_EQ(counts_of("").words, Words{});
}

TEST(StatementCounter, CountsWhatIsDropped) {
  const StatementCounts counts = counts_of(
      "*cube(1); *union() { %sphere(1); } cube(1) { circle(1); } #%hull(); what() { what(); } "
      "!group() { !group(); }");
  EXPECT_EQ(counts.words, (Words{{"cube", 2},
                                 {"group", 2},
                                 {"what", 2},
                                 {"circle", 1},
                                 {"hull", 1},
                                 {"sphere", 1},
                                 {"union", 1}}));
  EXPECT_EQ(counts.disabled, 2u);
  EXPECT_EQ(counts.background, 2u);
  EXPECT_EQ(counts.highlight, 1u);
  EXPECT_EQ(counts.root, 2u);
}

TEST(StatementCounter, CountsWhatEvaluatingTurnsIntoOthers) {
  EXPECT_EQ(counts_of("linear_extrude(2) { square(1); circle(1); }").words,
            (Words{{"circle", 1}, {"linear_extrude", 1}, {"square", 1}}));
}

}  // namespace
}  // namespace whittle
