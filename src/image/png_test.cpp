#include "image/png.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/folder_for_test.h"

namespace whittle {
namespace {

Picture random_picture(int width, int height, uint32_t seed) {
  Picture picture(width, height);
  for (uint8_t& v : picture.rgba) {
    seed = seed * 1664525u + 1013904223u;
    v = uint8_t(seed >> 24);
  }
  return picture;
}

RC_GTEST_PROP(Png, WhatIsWrittenIsReadBack, ()) {
  const Picture p = random_picture(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40),
                                   *rc::gen::arbitrary<uint32_t>());
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  RC_ASSERT(bool(write_png(path, p, true)));
  const Result<Picture> read = read_png(path);
  RC_ASSERT(bool(read));
  RC_ASSERT(read->width == p.width && read->height == p.height && read->rgba == p.rgba);
}

TEST(Png, WithoutAlphaTheColorsStay) {
  const Picture p = random_picture(31, 17, 5);
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  ASSERT_TRUE(write_png(path, p, false));
  const Result<Picture> read = read_png(path);
  ASSERT_TRUE(read);
  for (size_t i = 0; i < p.rgba.size(); ++i) {
    ASSERT_EQ(read->rgba[i], i % 4 == 3 ? 255 : p.rgba[i]) << i;
  }
}

TEST(Png, WritesToAnOpenFileAfterWhatIsThere) {
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  std::fputs("before", file);
  EXPECT_TRUE(write_png(file, "appended", random_picture(3, 3, 1), true));
  EXPECT_EQ(std::fputs("after", file) >= 0, true);
  std::fclose(file);
  std::ifstream in(path, std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(all.substr(0, 6), "before");
  EXPECT_EQ(all.substr(7, 3), "PNG");
  EXPECT_EQ(all.substr(all.size() - 5), "after");
}

TEST(Png, AFullDiskIsAnErrorThatNamesTheFile) {
  const Picture p = random_picture(300, 300, 1);
  for (const char* path : {"/dev/full", "/no/such/folder/a.png"}) {
    const Status written = write_png(path, p, true);
    ASSERT_FALSE(written) << path;
    EXPECT_EQ(written.error().kind, ErrorKind::kMachine);
    EXPECT_EQ(written.error().message.find(path), 0u) << written.error().message;
  }
}

TEST(Png, AnErrorThatComesWithTheLastBytesIsSeen) {
  std::FILE* file = std::fopen("/dev/full", "wb");
  ASSERT_NE(file, nullptr);
  EXPECT_FALSE(write_png(file, "full", random_picture(2, 2, 1), true));
  std::fclose(file);
}

TEST(Png, WhatIsNoPngIsAnError) {
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  EXPECT_FALSE(read_png("/no/such/file.png"));
  std::ofstream(path) << "hello";
  EXPECT_FALSE(read_png(path));
  ASSERT_TRUE(write_png(path, random_picture(40, 40, 2), true));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const Result<Picture> read = read_png(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace whittle
