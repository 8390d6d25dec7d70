#include "whittle/output.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/folder_for_test.h"
#include "image/exr.h"

namespace whittle {
namespace {

namespace fs = std::filesystem;

Frame frame_with_one_hit() {
  Frame frame(2, 1);
  frame.hits[1] = {2.5f, 7, {0, 0, 1}};
  return frame;
}

TEST(Output, TheEndingTellsTheFormat) {
  EXPECT_EQ(*format_of("a.png"), FileFormat::kPng);
  EXPECT_EQ(*format_of("a.b/c.EXR"), FileFormat::kExr);
  for (const char* path : {"png", "a.png/b", "a.png.", "a.pngx", "", ".", "a."}) {
    const Result<FileFormat> format = format_of(path);
    ASSERT_FALSE(format) << path;
    EXPECT_EQ(format.error().kind, ErrorKind::kUsage);
  }
}

TEST(Output, AnEncodedExrHoldsTheFacts) {
  const TestFolder folder;
  const Frame frame = frame_with_one_hit();
  const Result<std::string> bytes = encode(FileFormat::kExr, frame, Picture(2, 1), false, "x");
  ASSERT_TRUE(bool(bytes));
  ASSERT_TRUE(bool(write_output(folder / "x.exr", *bytes)));
  const Result<Frame> read = read_exr(folder / "x.exr");
  ASSERT_TRUE(bool(read));
  EXPECT_EQ(read->at(1, 0).id, 7u);
  EXPECT_EQ(read->at(1, 0).distance, 2.5f);
  EXPECT_FALSE(read->at(0, 0).hit());
}

TEST(Output, EncodingTwiceGivesTheSameBytes) {
  const Frame frame = frame_with_one_hit();
  for (const FileFormat format : {FileFormat::kPng, FileFormat::kExr}) {
    EXPECT_EQ(*encode(format, frame, Picture(2, 1), true, "x"),
              *encode(format, frame, Picture(2, 1), true, "y"));
  }
}

TEST(Output, PassesHaveABackgroundUnlessItIsNotWanted) {
  const Frame frame = frame_with_one_hit();
  for (const Pass pass : {Pass::kDepth, Pass::kNormal, Pass::kId}) {
    EXPECT_EQ(pass_picture(frame, pass, true).at(0, 0)[3], 255);
    EXPECT_EQ(pass_picture(frame, pass, false).at(0, 0)[3], 0);
    EXPECT_EQ(pass_picture(frame, pass, false).at(1, 0)[3], 255);
  }
}

TEST(Output, AskingWhetherAFileCanBeWrittenLeavesNothing) {
  const TestFolder folder;
  EXPECT_TRUE(bool(check_writable(folder / "x.png")));
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_TRUE(bool(check_writable("-")));
  EXPECT_TRUE(bool(check_writable("/dev/null")));
  for (const std::string& path : {folder / "absent/x.png", folder / ""}) {
    const Status possible = check_writable(path);
    ASSERT_FALSE(possible) << path;
    EXPECT_EQ(possible.error().kind, ErrorKind::kMachine);
  }
}

}  // namespace
}  // namespace whittle
