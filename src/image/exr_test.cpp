#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <fstream>
#include <limits>

#include "base/folder_for_test.h"
#include "image/srgb.h"

namespace whittle {
namespace {

/// Every bit pattern may stand in a frame: nothing may be lost.
Frame random_frame(int width, int height, uint32_t seed) {
  Frame frame(width, height);
  const auto word = [&] { return seed = seed * 1664525u + 1013904223u; };
  const auto number = [&] {
    const uint32_t bits = word();
    float v = 0;
    std::memcpy(&v, &bits, sizeof v);
    return v;
  };
  for (Hit& h : frame.hits) {
    if (word() >> 30 == 0) continue;
    h.distance = number(), h.id = word(), h.normal = {number(), number(), number()};
  }
  return frame;
}

bool same_bits(const Frame& a, const Frame& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.hits.data(), b.hits.data(), a.hits.size() * sizeof(Hit)) == 0;
}

std::string read_all(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(in)), {});
}

void write_all(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

RC_GTEST_PROP(Exr, FactsComeBackBitByBit, ()) {
  const Frame f = random_frame(*rc::gen::inRange(1, 30), *rc::gen::inRange(1, 30),
                               *rc::gen::arbitrary<uint32_t>());
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  write_all(path, *encode_exr(f, Picture(f.width, f.height)));
  const Result<Frame> read = read_exr(path);
  RC_ASSERT(bool(read));
  RC_ASSERT(same_bits(*read, f));
}

// Noise of every size: some of it is just as large when it is compressed.
TEST(Exr, WhatCannotBeCompressedComesBack) {
  const TestFolder folder;
  const std::string path = folder / "x.exr";
  for (int width = 1; width < 12; ++width)
    for (uint32_t seed = 0; seed < 60; ++seed) {
      const Frame f = random_frame(width, 1, seed);
      write_all(path, *encode_exr(f, Picture(width, 1)));
      const Result<Frame> read = read_exr(path);
      ASSERT_TRUE(read && same_bits(*read, f)) << width << ", " << seed;
    }
}

TEST(Exr, BackgroundIsInfinitelyFar) {
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  write_all(path, *encode_exr(Frame(2, 1), Picture(2, 1)));
  const Result<Frame> read = read_exr(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->at(1, 0).distance, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(read->at(1, 0).hit());
}

TEST(Exr, ColorsAreLinearPremultipliedHalfs) {
  Picture picture(2, 1);
  const uint8_t bytes[] = {255, 128, 0, 255, 255, 128, 0, 51};
  std::copy(std::begin(bytes), std::end(bytes), picture.rgba.begin());
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  write_all(path, *encode_exr(Frame(2, 1), picture));

  Imf::InputFile file(path.c_str());
  half values[4][2];
  Imf::FrameBuffer buffer;
  const char* const names[] = {"R", "G", "B", "A"};
  for (int k = 0; k < 4; ++k) {
    ASSERT_NE(file.header().channels().findChannel(names[k]), nullptr);
    EXPECT_EQ(file.header().channels().findChannel(names[k])->type, Imf::HALF);
    buffer.insert(names[k], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values[k]), sizeof(half),
                                       2 * sizeof(half)));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(0, 0);
  const float green = linear_from_srgb(128.0f / 255);
  EXPECT_EQ(float(values[0][0]), 1);
  EXPECT_NEAR(float(values[1][0]), green, 1e-3);
  EXPECT_EQ(float(values[2][0]), 0);
  EXPECT_EQ(float(values[3][0]), 1);
  EXPECT_NEAR(float(values[0][1]), 0.2f, 1e-3);
  EXPECT_NEAR(float(values[1][1]), 0.2f * green, 1e-3);
  EXPECT_NEAR(float(values[3][1]), 0.2f, 1e-3);
}

/// A file of one kind of channel, all zero, with its window's corner at (x, y).
void write_channels(const std::string& path, std::initializer_list<const char*> names,
                    Imf::PixelType type, Imf::PixelType id_type, int x = 0, int y = 0) {
  const Imath::Box2i window({x, y}, {x + 2, y + 1});
  Imf::Header header(window, window);
  std::vector<float> zeros(16);
  Imf::FrameBuffer buffer;
  for (const char* name : names) {
    const Imf::PixelType own = std::string(name) == "id" ? id_type : type;
    header.channels().insert(name, own);
    buffer.insert(name, Imf::Slice::Make(own, zeros.data(), window));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(2);
}

void expect_error(const std::string& path, const std::string& part) {
  const Result<Frame> read = read_exr(path);
  ASSERT_FALSE(read) << part;
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  EXPECT_EQ(read.error().message.find(path + ": "), 0u) << read.error().message;
  EXPECT_NE(read.error().message.find(part), std::string::npos) << read.error().message;
  EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
}

TEST(Exr, WrongFilesAreErrorsThatSayWhy) {
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  expect_error("/no/such/file.exr", "No such file");
  write_all(path, "not a picture at all, but long enough to have a header");
  expect_error(path, "not an OpenEXR file");
  write_all(path, "");
  expect_error(path, "not an OpenEXR file");
  expect_error(testing::TempDir(), "");
  write_channels(path, {"R", "G", "B"}, Imf::HALF, Imf::UINT);
  expect_error(path, "no channel Z");
  write_channels(path, {"Z", "N.X", "N.Y", "N.Z"}, Imf::FLOAT, Imf::UINT);
  expect_error(path, "no channel id");
  write_channels(path, {"Z", "N.X", "N.Y", "N.Z", "id"}, Imf::FLOAT, Imf::FLOAT);
  expect_error(path, "channel id must be uint");
  write_channels(path, {"Z", "N.X", "N.Y", "N.Z", "id"}, Imf::HALF, Imf::UINT);
  expect_error(path, "channel Z must be float");
}

TEST(Exr, AWindowAwayFromTheOriginIsRead) {
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  write_channels(path, {"Z", "N.X", "N.Y", "N.Z", "id"}, Imf::FLOAT, Imf::UINT, -70, 40);
  const Result<Frame> read = read_exr(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->width, 3);
  EXPECT_EQ(read->height, 2);
  for (const Hit& h : read->hits) EXPECT_EQ(h.distance, 0);
}

TEST(Exr, ThreadsMakeTheSameBytes) {
  const Workers workers(3);
  const Frame frame = random_frame(70, 90, 1);
  EXPECT_EQ(*encode_exr(frame, Picture(70, 90)), *encode_exr(frame, Picture(70, 90), &workers));
}

TEST(Exr, TruncatedFilesAreErrors) {
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  write_all(path, *encode_exr(random_frame(20, 40, 3), Picture(20, 40)));
  const std::string whole = read_all(path);
  for (size_t length = 0; length < whole.size(); length += 1 + whole.size() / 50) {
    write_all(path, whole.substr(0, length));
    EXPECT_FALSE(read_exr(path)) << length;
  }
}

RC_GTEST_PROP(Exr, DamagedFilesNeverCrash, ()) {
  const TestFolder folder;
  const std::string file_name = folder / "x.exr";
  const std::string& path = file_name;
  write_all(path, *encode_exr(random_frame(8, 8, 3), Picture(8, 8)));
  std::string bytes = read_all(path);
  for (int i = 0; i < 4; ++i) {
    bytes[*rc::gen::inRange<size_t>(0, bytes.size())] = char(*rc::gen::inRange(0, 256));
  }
  write_all(path, bytes);
  const Result<Frame> read = read_exr(path);
  if (read) {
    RC_ASSERT(read->hits.size() == size_t(read->width) * size_t(read->height));
  } else {
    RC_ASSERT(!read.error().message.empty());
  }
}

}  // namespace
}  // namespace whittle
