#include "csg/lexer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace whittle {
namespace {

constexpr double kHuge = std::numeric_limits<double>::infinity();

TEST(CsgLexer, ReadsEveryFormOfNumber) {
  const std::pair<const char*, double> cases[] = {
      {"0", 0},
      {"12", 12},
      {"1.5", 1.5},
      {".5", 0.5},
      {"1.", 1},
      {"1.e2", 100},
      {"1e-7", 1e-7},
      {"1e-007", 1e-7},
      {"1e+06", 1e6},
      {"2E3", 2000},
      {"0x1F", 31},
      {"0X10", 16},
      {"0.1234567890123456789", 0.1234567890123456789},
      {"1e999", kHuge},
      {"1e-999", 0},
      {"123456e99999999999999999999", kHuge},
      {"1e-99999999999999999999", 0},
      {"0e99999", 0},
  };
  for (const auto& [text, expected] : cases) {
    CsgLexer lexer(text);
    double value = -1;
    EXPECT_TRUE(lexer.number(value)) << text;
    EXPECT_EQ(value, expected) << text;
    EXPECT_EQ(lexer.peek(), '\0') << text;
  }
}

TEST(CsgLexer, ReadsLongNumbersBeyondTheRangeOfDoubles) {
  const std::pair<std::string, double> cases[] = {
      {std::string(400, '9'), kHuge},
      {"0." + std::string(400, '0') + "1", 0},
      {"0." + std::string(400, '0') + "1e800", kHuge},
      {std::string(400, '9') + "e-900", 0},
  };
  for (const auto& [text, expected] : cases) {
    CsgLexer lexer(text);
    double value = -1;
    EXPECT_TRUE(lexer.number(value)) << text;
    EXPECT_EQ(value, expected) << text;
  }
}

TEST(CsgLexer, RefusesWhatOnlyLooksLikeANumber) {
  for (const char* text : {".", "1abc", "1.2.3", "1e", "0x", "0xg", "1..2", "5$"}) {
    CsgLexer lexer(text);
    double value = 0;
    EXPECT_FALSE(lexer.number(value)) << text;
    EXPECT_EQ(lexer.mistake()->message, "malformed number '" + std::string(text) + "'");
  }
}

TEST(CsgLexer, KnowsLineAndColumnBehindBlanksAndComments) {
  CsgLexer lexer(" \t\r\n  // a comment; } \n/* two\nlines */ \xc2\xa0x");
  EXPECT_EQ(lexer.peek(), 'x');
  EXPECT_EQ(lexer.location().line, 4u);
  EXPECT_EQ(lexer.location().column, 12u);
  EXPECT_EQ(lexer.identifier(), "x");
  EXPECT_EQ(lexer.peek(), '\0');
}

TEST(CsgLexer, CountsTheLinesInsideOfStrings) {
  CsgLexer lexer("\"a\nb\"\nx");
  std::string_view raw;
  EXPECT_TRUE(lexer.string(raw));
  EXPECT_EQ(raw, "a\nb");
  EXPECT_EQ(lexer.peek(), 'x');
  EXPECT_EQ(lexer.location().line, 3u);
}

TEST(CsgLexer, AnEscapedQuoteDoesNotEndAString) {
  CsgLexer lexer(R"("a\"b\\" x)");
  std::string_view raw;
  EXPECT_TRUE(lexer.string(raw));
  EXPECT_EQ(raw, R"(a\"b\\)");
  EXPECT_EQ(lexer.peek(), 'x');
}

TEST(CsgLexer, RecoversTheTextOfDumpsWhereQuotesAreNotEscaped) {
  const std::pair<std::string, std::string> cases[] = {
      {R"("A"b", size = 10, spacing = 1))", "A\"b"},
      {R"("A\", size = 10))", "A\\"},
      {R"("A", b", size = 10))", "A\", b"},
      {R"("", size = 10))", ""},
      {R"("plain", size = 10))", "plain"},
      {R"("a\"b", size = 10))", R"(a\"b)"},
      {R"("by hand"); text(text = "b", size = 3))", "by hand"},
      {R"("by hand", 10); cube(); text(text = "b", size = 3))", "by hand"},
      {R"("by hand", n); cube(); text(text = "b", size = 3))", "by hand"},
      {R"("by hand", font = "b", size = 3))", "by hand"},
  };
  for (const auto& [text, expected] : cases) {
    CsgLexer lexer(text);
    std::string_view raw;
    EXPECT_TRUE(lexer.dumped_text(raw)) << text;
    EXPECT_EQ(raw, expected) << text;
  }
}

TEST(CsgLexer, QuotesInMessagesStayShortAndOnOneLine) {
  EXPECT_EQ(quote("cube"), "'cube'");
  EXPECT_EQ(quote("a\nb\x01"), "'a?b?'");
  EXPECT_EQ(quote(std::string(41, 'a')), "'" + std::string(40, 'a') + "...'");
  EXPECT_EQ(quote(std::string(39, 'a') + "\xc3\xa4"), "'" + std::string(39, 'a') + "...'");
}

}  // namespace
}  // namespace whittle
