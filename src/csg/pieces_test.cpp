// However a text is cut into pieces, and on however many threads they are read: the same is read,
// and the same is said of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "csg/read_csg.h"
#include "csg/test_support.h"
#include "csg/text_pieces.h"

namespace whittle {
namespace {

/// All that is told of a text, but the form of its shapes.
std::string all_of(const std::string& text, const ReadOptions& options) {
  const Result<Read> read = read_csg(text, "t.csg", options);
  if (!read) return read.error().message;
  std::string all = tree(read->model) + fmt::format("\n{}\n", read->model.statement_count);
  for (const Node& node : read->model.nodes)
    all += fmt::format("{}:{} {} ", node.where.line, node.where.column, node.payload);
  for (const Affine& map : read->model.transforms) all += fmt::format("{} ", map.translation.x);
  for (const Rgba& color : read->model.colors) all += fmt::format("{} ", color.r);
  for (const Primitive& primitive : read->model.primitives)
    all += fmt::format("{} ", facet_count(primitive.shape));
  for (const WordCount& count : read->counts.words)
    all += fmt::format("{} {}\n", count.word, count.count);
  for (const std::string& warning : read->warnings) all += warning + '\n';
  return all + read->refusal;
}

/// The text without a cut in it, and cut in many ways.
void expect_same_in_pieces(const std::string& text, ReadOptions options = {}) {
  options.threads = 1;
  options.piece_bytes = text.size() + 1;
  const std::string whole = all_of(text, options);
  for (const size_t bytes : {1, 2, 7, 40, 111}) {
    for (const int threads : {1, 3}) {
      options.threads = threads;
      options.piece_bytes = bytes;
      ASSERT_EQ(all_of(text, options), whole) << bytes << " bytes, " << threads << " threads\n"
                                              << text;
    }
  }
}

/// What stands in texts, whole or not, right or wrong.
constexpr const char* kWords[] = {
    "cube(2);",
    "sphere(r = 3, $fn = 8);",
    "sphere(2);",
    "circle(1);",
    "group() {",
    "group() {",
    "difference() {",
    "intersection() {",
    "}",
    "}",
    "}",
    "group();",
    "multmatrix([[1, 0, 0, 5], [0, 1, 0, 0.0123456], [0, 0, 1, 1e-5], [0, 0, 0, 1]]) {",
    "translate([1, 2, 3]) {}",
    "translate([1, 2, 3])",
    "color([1, 0.5, 0, 1]) {",
    "%",
    "#",
    "!group() {",
    "*group() {",
    "hull() {",
    "linear_extrude(height = 3, $fn = 6) {",
    "linear_extrude(height = 3) {",
    "rotate_extrude() {",
    "{",
    ";",
    "\n",
    "\n\n",
    "\r\n",
    "// ; a comment }\n",
    "/* ; { \n } */",
    "what(x) {",
    "what_else();",
    "cube(size = bad, 3);",
    "cube(nan);",
    "polyhedron([[0,0,0],[3,0,0],[0,3,0],[0,0,3]], [[0,1,2],[0,3,1],[1,3,2],[2,3,0]]);",
    "text(text = \"a;{\", size = 3);",
    "cylinder(h = 2, r = 1, what = \";\");",
    "import(file = \"none;.stl\");",
    "$fn = 12;",
    "$vpd = 3;",
    "a = [1, 2];",
    "cube(a);",
    "nan = 3;",
};

std::string random_text(std::mt19937_64& random, int words) {
  std::string text;
  int depth = 0;
  for (int i = 0; i < words; ++i) {
    std::string word = kWords[random() % std::size(kWords)];
    // Mostly such as is right.
    if (word == "}" && depth == 0 && random() % 20 != 0) continue;
    depth += word.back() == '{' ? 1 : word == "}" ? -1 : 0;
    if (random() % 200 == 0) word.erase(random() % word.size(), 1);
    text += word;
    if (random() % 2 == 0) text += ' ';
  }
  for (; depth > 0 && random() % 20 != 0; --depth) text += "}";
  return text;
}

TEST(CsgPieces, AreReadAsOneText) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 300; ++i) {
    expect_same_in_pieces(random_text(random, 5 + static_cast<int>(random() % 60)));
    if (HasFatalFailure()) return;
  }
}

TEST(CsgPieces, HaveOneSumOfWarnings) {
  std::string text;
  for (int i = 0; i < 70; ++i)
    text += fmt::format("what(); cube(bad{});\n group() {{ x(); }}", i % 3);
  expect_same_in_pieces(text);
  for (int i = 0; i < 150; ++i) text += fmt::format("what_{}();", i);
  expect_same_in_pieces(text);
}

TEST(CsgPieces, HaveTheLimitsOfOneText) {
  std::string nested, many;
  for (int i = 0; i < 60; ++i) nested += "group() {\n", many += "group() { cube(1); }";
  nested += "cube(1);" + std::string(60, '}');
  for (const size_t limit : {58, 59, 60, 61, 62}) {
    ReadOptions options;
    options.limits.depth = limit;
    expect_same_in_pieces(nested, options);
    options = {};
    options.limits.nodes = 2 * limit;
    expect_same_in_pieces(many, options);
    expect_same_in_pieces(nested, options);
  }
}

TEST(CsgPieces, OfAnOperationAreInIt) {
  for (const char* outer : {"hull()", "%group()", "*group()", "!group()", "rotate_extrude($fn = 7)",
                            "minkowski()", "difference()", "intersection()", "what()"}) {
    std::string text = std::string(outer) + " {";
    for (int i = 0; i < 30; ++i) text += "group(); translate([2, 0, 0]) circle(3); sphere(2); ";
    expect_same_in_pieces(text + "}");
    expect_same_in_pieces(text + "} cube(1); cube(2); cube(3); cube(4);");
  }
}

TEST(CsgPieces, EndBehindAMark) {
  EXPECT_EQ(find_mark("", 0), std::string_view::npos);
  EXPECT_EQ(find_mark("abc", 1), std::string_view::npos);
  EXPECT_EQ(find_mark("abc", 5), std::string_view::npos);
  for (const char mark : {';', '{', '}'}) {
    for (size_t at = 0; at < 300; ++at) {
      std::string text(300, 'x');
      text[at] = mark;
      for (const size_t from : {size_t{0}, at / 2, at}) EXPECT_EQ(find_mark(text, from), at);
      EXPECT_EQ(find_mark(text, at + 1), std::string_view::npos);
    }
  }
}

TEST(CsgPieces, TogetherAreTheText) {
  std::mt19937_64 random(8);
  UninitializedVector<char> buffer;
  for (int i = 0; i < 300; ++i) {
    const std::string text = random_text(random, 40);
    const TextInMemory source(text);
    for (const size_t bytes : {1, 3, 10, 64, 1000}) {
      std::string together;
      bool has_last = false;
      for (size_t k = 0; k * bytes < text.size(); ++k) {
        const TextPiece piece = read_piece(source, k, bytes, buffer);
        if (piece.text.empty()) continue;
        EXPECT_EQ(piece.first, together.size());
        together += piece.text;
        has_last = piece.is_last;
      }
      EXPECT_EQ(together, text);
      EXPECT_EQ(has_last, !text.empty());
    }
  }
}

}  // namespace
}  // namespace whittle
