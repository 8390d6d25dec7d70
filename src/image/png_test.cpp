#include "image/png.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <utility>

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

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

RC_GTEST_PROP(Png, WhatIsWrittenIsReadBack, ()) {
  const Picture p = random_picture(*rc::gen::inRange(1, 40), *rc::gen::inRange(1, 40),
                                   *rc::gen::arbitrary<uint32_t>());
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  write_bytes(path, encode_png(p, true));
  const Result<Picture> read = read_png(path);
  RC_ASSERT(bool(read));
  RC_ASSERT(read->width == p.width && read->height == p.height && read->rgba == p.rgba);
}

// Of more than one stripe.
TEST(Png, WithoutAlphaTheColorsStay) {
  const Picture p = random_picture(301, 317, 5);
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  write_bytes(path, encode_png(p, false));
  const Result<Picture> read = read_png(path);
  ASSERT_TRUE(read);
  for (size_t i = 0; i < p.rgba.size(); ++i) {
    ASSERT_EQ(read->rgba[i], i % 4 == 3 ? 255 : p.rgba[i]) << i;
  }
}

TEST(Png, GreyIsRed) {
  const Picture p = random_picture(301, 617, 7);
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  const std::string bytes = encode_grey_png(p);
  EXPECT_EQ(bytes[25], 0) << "the type of colour is grey";
  write_bytes(path, bytes);
  const Result<Picture> read = read_png(path);
  ASSERT_TRUE(read);
  for (size_t i = 0; i < p.rgba.size(); ++i)
    ASSERT_EQ(read->rgba[i], i % 4 == 3 ? 255 : p.rgba[i - i % 4]) << i;
}

TEST(Png, ThreadsMakeTheSameBytes) {
  const Workers workers(3);
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(700, 500), std::pair(50000, 5)}) {
    const Picture p = random_picture(width, height, 9);
    for (const bool with_alpha : {false, true})
      EXPECT_EQ(encode_png(p, with_alpha), encode_png(p, with_alpha, &workers));
    EXPECT_EQ(encode_grey_png(p), encode_grey_png(p, &workers));
  }
}

TEST(Png, SmoothPicturesAreSmall) {
  Picture p(1000, 1000);
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      p.at(x, y)[0] = uint8_t(x / 4), p.at(x, y)[1] = uint8_t(y / 4);
  EXPECT_LT(encode_png(p, true).size(), p.rgba.size() / 100);
}

TEST(Png, WhatIsNoPngIsAnError) {
  const TestFolder folder;
  const std::string file_name = folder / "x.png";
  const std::string& path = file_name;
  EXPECT_FALSE(read_png("/no/such/file.png"));
  std::ofstream(path) << "hello";
  EXPECT_FALSE(read_png(path));
  write_bytes(path, encode_png(random_picture(40, 40, 2), true));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  const Result<Picture> read = read_png(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace whittle
