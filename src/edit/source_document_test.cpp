#include "edit/source_document.h"

#include <gtest/gtest.h>

#include <string>

#include "edit/document_for_test.h"

namespace whittle {
namespace {

using Step = SourceDocument::Step;

TEST(SourceDocument, SaysWhyATextIsNotUnderstood) {
  const Result<SourceDocument> document = SourceDocument::open("cube(1);\n sphere(", "a.csg");
  ASSERT_FALSE(document);
  EXPECT_EQ(document.error().message,
            "a.csg:2:9: error: expected a value before the end of the file");
}

TEST(SourceDocument, EditsReplaceBytesAndLeaveOthers) {
  SourceDocument document = open_good("/* a */ cube(1); // b\nsphere(2);");
  ASSERT_TRUE(document.apply({{13, 1, "10"}, {29, 1, "3"}}));
  EXPECT_EQ(document.text(), "/* a */ cube(10); // b\nsphere(3);");
  EXPECT_TRUE(has_right_tree(document));
  EXPECT_EQ(document.version(), 1u);
}

TEST(SourceDocument, WhatIsNotUnderstoodChangesNothing) {
  const std::string text = "group() { cube(1); } sphere(2);";
  SourceDocument document = open_good(text);
  const Status status = document.apply({{10, 0, "("}});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "t.csg:1:11: error: expected a statement before '('");
  ASSERT_FALSE(document.apply({{0, 0, std::string("\0", 1)}}));
  EXPECT_EQ(document.text(), text);
  EXPECT_TRUE(has_right_tree(document));
  EXPECT_EQ(document.version(), 0u);
  EXPECT_FALSE(document.can_undo());
  EXPECT_FALSE(document.is_modified());
}

TEST(SourceDocument, ChangesThatReachFurtherAreSeen) {
  const std::string text = "cube(1); sphere(2); // c\n cube(3);";
  SourceDocument document = open_good(text);
  ASSERT_TRUE(document.apply({{8, 0, " /* "}, {text.find("// c") + 4, 0, "*/"}}));
  EXPECT_TRUE(has_right_tree(document));
  EXPECT_EQ(document.tree().nodes.size(), 3u);
  document.undo();
  ASSERT_TRUE(document.apply({{9, 0, "//"}}));
  EXPECT_TRUE(has_right_tree(document));
  document.undo();
  ASSERT_TRUE(document.apply({{7, 1, " group() {"}, {text.size(), 0, "}"}}));
  EXPECT_TRUE(has_right_tree(document));
  EXPECT_EQ(document.tree().child_count(0), 1u);
}

TEST(SourceDocument, EditsAreUndoneAndDoneAgain) {
  SourceDocument document = open_good("cube(1);");
  ASSERT_TRUE(document.apply({{5, 1, "22"}}));
  ASSERT_TRUE(document.apply({{9, 0, " sphere(3);"}}));
  EXPECT_TRUE(document.can_undo());
  EXPECT_FALSE(document.can_redo());
  document.undo();
  EXPECT_EQ(document.text(), "cube(22);");
  EXPECT_EQ(document.undo(), 1u);
  EXPECT_EQ(document.text(), "cube(1);");
  EXPECT_FALSE(document.undo());
  document.redo();
  document.redo();
  EXPECT_EQ(document.text(), "cube(22); sphere(3);");
  EXPECT_FALSE(document.redo());
  EXPECT_TRUE(has_right_tree(document));
}

TEST(SourceDocument, ANewEditEndsWhatCouldBeDoneAgain) {
  SourceDocument document = open_good("cube(1);");
  ASSERT_TRUE(document.apply({{5, 1, "2"}}));
  document.undo();
  ASSERT_TRUE(document.apply({{5, 1, "3"}}));
  EXPECT_FALSE(document.can_redo());
  document.undo();
  EXPECT_EQ(document.text(), "cube(1);");
}

TEST(SourceDocument, ADragIsOneStep) {
  SourceDocument document = open_good("cube(1); sphere(1);");
  ASSERT_TRUE(document.apply({{16, 1, "5"}}));
  ASSERT_TRUE(document.apply({{5, 1, "2"}}));
  for (const char* number : {"30", "4", "5.5"}) {
    const std::string& text = document.text();
    ASSERT_TRUE(document.apply({{5, text.find(')') - 5, number}}, Step::kWithLast));
  }
  // Elsewhere in the text, but still the same step.
  ASSERT_TRUE(document.apply({{0, 0, "#"}}, Step::kWithLast));
  EXPECT_EQ(document.text(), "#cube(5.5); sphere(5);");
  document.undo();
  EXPECT_EQ(document.text(), "cube(1); sphere(5);");
  document.redo();
  EXPECT_EQ(document.text(), "#cube(5.5); sphere(5);");
  document.undo();
  document.undo();
  EXPECT_EQ(document.text(), "cube(1); sphere(1);");
  EXPECT_TRUE(has_right_tree(document));
}

TEST(SourceDocument, KnowsWhetherItIsSaved) {
  SourceDocument document = open_good("cube(1);");
  EXPECT_FALSE(document.is_modified());
  ASSERT_TRUE(document.apply({{5, 1, "2"}}));
  EXPECT_TRUE(document.is_modified());
  document.mark_saved();
  EXPECT_FALSE(document.is_modified());
  document.undo();
  EXPECT_TRUE(document.is_modified());
  document.redo();
  EXPECT_FALSE(document.is_modified());
  ASSERT_TRUE(document.apply({{5, 1, "3"}}, Step::kWithLast));
  EXPECT_TRUE(document.is_modified());
}

TEST(SourceDocument, PlacesAreTheReaders) {
  const std::string text =
      "\xef\xbb\xbf"
      "cube(1);\n  # /**/ sphere(1);\r\nx = 1; {}";
  const SourceDocument document = open_good(text);
  EXPECT_EQ(document.location(1), (SourceLocation{1, 1}));
  EXPECT_EQ(document.location(2), (SourceLocation{2, 10}));
  EXPECT_EQ(document.location(3), (SourceLocation{3, 1}));
  for (const uint32_t node : {1u, 2u, 3u, 4u}) {
    EXPECT_EQ(document.find(document.location(node)), node);
  }
  for (const SourceLocation where :
       {SourceLocation{0, 1}, {1, 0}, {1, 2}, {2, 3}, {4, 1}, {3, 100}}) {
    EXPECT_FALSE(document.find(where)) << where.line << ":" << where.column;
  }
}

TEST(SourceDocument, AByteOrderMarkStaysFirst) {
  SourceDocument document = open_good(
      "\xef\xbb\xbf"
      "cube(1);");
  ASSERT_TRUE(document.apply({{document.node(1).begin, 0, "#"}}));
  EXPECT_EQ(document.text(), "\xef\xbb\xbf#cube(1);");
  EXPECT_TRUE(has_right_tree(document));
}

TEST(SourceDocument, IdsCountShapesAsTheReaderDoes) {
  const SourceDocument document =
      open_good("group() { *cube(1); { sphere(1); } } x = 1; linear_extrude(1) square(1);");
  EXPECT_EQ(document.id(node_named(document, "group")), 0u);
  EXPECT_EQ(document.id(node_named(document, "cube")), 1u);
  EXPECT_EQ(document.id(node_named(document, "sphere")), 2u);
  EXPECT_EQ(document.id(node_named(document, "x")), 0u);
  EXPECT_EQ(document.id(node_named(document, "square")), 4u);
  EXPECT_EQ(document.find_id(3), node_named(document, "linear_extrude"));
  EXPECT_FALSE(document.find_id(0));
  EXPECT_FALSE(document.find_id(5));
}

}  // namespace
}  // namespace whittle
