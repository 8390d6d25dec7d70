#include "host/file_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/folder_for_test.h"
#include "host/output_file.h"
#include "host/read_file.h"

namespace whittle {
namespace {

class FileTextTest : public testing::Test {
 protected:
  std::string write(std::string_view text) const {
    const std::string path = (folder_.path() / "a.csg").string();
    EXPECT_TRUE(write_file(path, text));
    return path;
  }
  const TestFolder folder_;
};

/// More than is read at once.
std::string large(int statements = 100'000) {
  std::string text = "group() {\n";
  for (int i = 0; i < statements; ++i) text += fmt::format("\tsphere(r = {});\n", i % 9);
  return text + "}\n";
}

TEST_F(FileTextTest, IsReadPieceByPieceOrAtOnce) {
  const std::string path = write("0123456789");
  const auto text = FileText::open(path, 100);
  ASSERT_TRUE(text);
  UninitializedVector<char> buffer;
  EXPECT_EQ(text->read(2, 3, buffer), "234");
  EXPECT_EQ(text->read(7, 30, buffer), "789");
  ASSERT_TRUE(text->load());
  EXPECT_EQ(text->place(), "0123456789");
}

TEST_F(FileTextTest, OnlyPlainFilesAreRead) {
  EXPECT_FALSE(FileText::open(folder_.path().string(), 100));
  EXPECT_FALSE(FileText::open("/dev/null", 100));
  EXPECT_FALSE(FileText::open((folder_.path() / "none").string(), 100));
  EXPECT_FALSE(FileText::open(write(""), 100));
  EXPECT_FALSE(FileText::open(write("12345"), 4));
  EXPECT_TRUE(FileText::open(write("12345"), 5));
}

TEST_F(FileTextTest, OneThatShrinksIsAnError) {
  const std::string path = write(large());
  const auto text = FileText::open(path, 100'000'000);
  ASSERT_TRUE(text);
  std::filesystem::resize_file(path, 1'000'000);
  const Result<Read> read = read_csg(*text, path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message,
            path + ": error: cannot be read: it has become shorter meanwhile");
}

TEST_F(FileTextTest, LargeFilesAreReadAsTexts) {
  for (const char* tail : {"", "cube(", "/*", "}", "what();", "cube(unknown);", "// end"}) {
    const std::string text = large() + tail, path = write(text);
    ASSERT_GT(text.size(), size_t{1} << 20);
    for (const int threads : {1, 3}) {
      const Result<Read> file = read_file(path, {.reading = {.threads = threads}});
      const Result<Read> same = read_csg(text, path);
      ASSERT_EQ(bool(file), bool(same)) << tail;
      if (!file) {
        EXPECT_EQ(file.error().message, same.error().message);
        continue;
      }
      EXPECT_EQ(file->model.nodes.size(), same->model.nodes.size());
      EXPECT_EQ(file->warnings, same->warnings);
    }
  }
}

TEST_F(FileTextTest, ANulComesBeforeMistakes) {
  for (const size_t at : {size_t{5'000}, size_t{1'000'000}}) {
    std::string text = large();
    text.insert(text.size() / 2, "cube(");
    text[at] = '\0';
    const Result<Read> read = read_file(write(text));
    ASSERT_FALSE(read);
    EXPECT_TRUE(read.error().message.ends_with("error: a NUL byte; this is not a text file"));
  }
}

}  // namespace
}  // namespace whittle
