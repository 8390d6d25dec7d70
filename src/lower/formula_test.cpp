#include "lower/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "lower/evaluate.h"

namespace whittle {
namespace {

constexpr TokenKind kFace = TokenKind::kFace, kUnit = TokenKind::kUnit, kAnd = TokenKind::kAnd,
                    kOr = TokenKind::kOr;

/// What a formula means: a tree, in which nothing is a pass.
struct Tree {
  Token token;  ///< of a group, its kind alone
  std::vector<Tree> operands;
};

std::string text(const Tree& tree) {
  if (!tree.token.is_group())
    return (tree.token.negated() ? "-" : "") + std::to_string(tree.token.payload());
  std::string all = tree.token.kind() == kAnd ? "and(" : "or(";
  for (const Tree& operand : tree.operands) all += text(operand) + " ";
  return all + ")";
}

bool value(const Tree& tree, uint32_t trues) {
  if (!tree.token.is_group()) return (trues >> tree.token.payload() & 1) != tree.token.negated();
  const auto is_true = [&](const Tree& operand) { return value(operand, trues); };
  return tree.token.kind() == kAnd ? std::ranges::all_of(tree.operands, is_true)
                                   : std::ranges::any_of(tree.operands, is_true);
}

class RandomFormula {
 public:
  explicit RandomFormula(uint64_t seed) : random_(seed) {}

  Tree tree(int depth) {
    if (depth == 0 || one_in(3))
      return {Token::make(one_in(2) ? kFace : kUnit, number(10), one_in(2)), {}};
    Tree group{Token::make(one_in(2) ? kAnd : kOr, 0), {}};
    for (uint32_t n = number(5); n > 0; --n) group.operands.push_back(tree(depth - 1));
    return group;
  }

  /// The tree as tokens, with passes around some of what stands in a row.
  void write(const Tree& tree, Formula& out) {
    if (one_in(4)) {
      const size_t header = out.size();
      out.push_back({});
      write(tree, out);
      out[header] = pass(uint32_t(out.size() - header));
      return;
    }
    if (!tree.token.is_group()) {
      out.push_back(tree.token);
      return;
    }
    const size_t header = out.size();
    out.push_back({});
    write_operands(tree.operands, out);
    out[header] = Token::make(tree.token.kind(), uint32_t(out.size() - header));
  }

 private:
  uint32_t number(uint32_t n) { return uint32_t(random_() % n); }
  bool one_in(uint32_t n) { return number(n) == 0; }
  Token pass(uint32_t length) { return Token::make(one_in(2) ? kAnd : kOr, length, true); }

  void write_operands(std::span<const Tree> operands, Formula& out) {
    while (!operands.empty()) {
      const size_t count = 1 + number(uint32_t(operands.size()));
      if (count < operands.size() && one_in(2)) {
        const size_t header = out.size();
        out.push_back({});
        write_operands(operands.first(count), out);
        out[header] = pass(uint32_t(out.size() - header));
      } else {
        for (const Tree& operand : operands.first(count)) write(operand, out);
      }
      operands = operands.subspan(count);
    }
  }

  std::mt19937_64 random_;
};

/// The tree again, operand by operand.
Tree read(std::span<const Token> formula, Operand operand) {
  EXPECT_EQ(formula[operand.index], operand.token());
  EXPECT_EQ(operand.tokens.data(), formula.data() + operand.index);
  if (!operand.is_group()) return {operand.token(), {}};
  Tree tree{Token::make(operand.token().kind(), 0), {}};
  for (const Operand one : operands_of(operand)) tree.operands.push_back(read(formula, one));
  return tree;
}

std::string walked(std::span<const Token> formula) {
  std::string all;
  walk(
      formula, [&](const Operand& group) { all += group.token().kind() == kAnd ? "and(" : "or("; },
      [&](const Operand& one) {
        all += text({one.token(), {}}) + " ";
      },
      [&] { all += ") "; });
  // What is outermost has nothing after it.
  if (!all.empty()) all.pop_back();
  return all;
}

std::string folded(std::span<const Token> formula) {
  struct Group {
    std::string all;
    void add(const std::string& operand) { all += operand + " "; }
    std::string result() const { return all + ")"; }
  };
  return fold(
      formula, [](TokenKind kind) { return Group{kind == kAnd ? "and(" : "or("}; },
      [](Token token) {
        return text({token, {}});
      });
}

TEST(Formula, IsReadAsTheTreeThatItMeans) {
  size_t passes = 0, groups = 0;
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    RandomFormula random(seed);
    const Tree tree = random.tree(int(seed % 6));
    Formula formula;
    random.write(tree, formula);
    const std::string expected = text(tree);
    ASSERT_EQ(text(read(formula, whole(formula))), expected) << seed;
    ASSERT_EQ(walked(formula), expected) << seed;
    ASSERT_EQ(folded(formula), expected) << seed;
    for (uint32_t k = 0; k < 64; ++k) {
      const uint32_t trues = uint32_t(seed * 2654435761u >> 8) ^ k * 0x9e3779b9u;
      const auto is_true = [&](Token token) -> uint8_t {
        return (trues >> token.payload() & 1) != token.negated();
      };
      ASSERT_EQ(evaluate<uint8_t>(formula, 1, is_true), value(tree, trues)) << seed;
    }
    size_t flat = 0;
    for (const Token token : flat_tokens(formula)) flat += !token.is_pass();
    passes += formula.size() - flat;
    groups += size_t(std::ranges::count_if(flat_tokens(formula), &Token::is_group));
  }
  EXPECT_GT(passes, 3000u);
  EXPECT_GT(groups, 3000u);
}

TEST(Formula, OperandsSayWhereTheyStand) {
  // or(pass(1 2) and(3 4) pass(pass(5)))
  const auto face = [](uint32_t number) { return Token::make(kFace, number); };
  const Formula formula{Token::make(kOr, 10),
                        Token::make(kAnd, 3, true),
                        face(1),
                        face(2),
                        Token::make(kAnd, 3),
                        face(3),
                        face(4),
                        Token::make(kOr, 3, true),
                        Token::make(kAnd, 2, true),
                        face(5)};
  std::vector<size_t> first, end;
  for (const Operand operand : operands_of(whole(formula))) {
    first.push_back(operand.index);
    end.push_back(operand.end());
  }
  EXPECT_EQ(first, (std::vector<size_t>{2, 3, 4, 9}));
  EXPECT_EQ(end, (std::vector<size_t>{3, 4, 7, 10}));
  EXPECT_EQ(operand_at(formula, 1).index, 2u);
  EXPECT_EQ(operand_at(formula, 4).tokens.size(), 3u);
}

TEST(Formula, EmptyGroupsAreConstants) {
  const auto value = [](const Formula& formula) {
    return evaluate<uint8_t>(formula, 1, [](Token) -> uint8_t { return 1; });
  };
  EXPECT_EQ(value({Token::make(kAnd, 1)}), 1);
  EXPECT_EQ(value({Token::make(kOr, 1)}), 0);
  EXPECT_EQ(value({Token::make(kAnd, 3), Token::make(kAnd, 1), Token::make(kOr, 1)}), 0);
  const Formula empty{Token::make(kOr, 1)};
  EXPECT_EQ(std::ranges::distance(operands_of(whole(empty))), 0);
}

TEST(Formula, IsReadWithoutRecursion) {
  constexpr uint32_t kDeep = 300000;
  Formula formula;
  for (uint32_t i = 0; i < kDeep; ++i)
    formula.push_back(Token::make(i % 2 ? kAnd : kOr, kDeep + 1 - i, i % 3 == 0));
  formula.push_back(Token::make(kFace, 7));
  EXPECT_EQ(
      evaluate<uint8_t>(formula, 1, [](Token token) -> uint8_t { return token.payload() == 7; }),
      1);
  size_t depth = 0, deepest = 0;
  walk(
      formula, [&](const Operand&) { deepest = std::max(deepest, ++depth); }, [](const Operand&) {},
      [&] { --depth; });
  EXPECT_EQ(depth, 0u);
  EXPECT_EQ(deepest, size_t(kDeep - kDeep / 3));
}

}  // namespace
}  // namespace whittle
