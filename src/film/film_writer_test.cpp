#include "film/film_writer.h"

#include <gif_lib.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "base/folder_for_test.h"
#include "film/film_for_test.h"
#include "host/output_file.h"
#include "image/png.h"

namespace whittle {
namespace {

using MakeWriter = std::unique_ptr<FilmWriter> (*)(const FilmSettings&, ByteSink);

std::string film_of(MakeWriter make, const FilmSettings& settings,
                    const std::vector<Picture>& frames) {
  std::string bytes;
  const std::unique_ptr<FilmWriter> writer = make(settings, [&](std::string_view more) -> Status {
    bytes += more;
    return Done{};
  });
  for (const Picture& frame : frames) EXPECT_TRUE(writer->add(frame));
  EXPECT_TRUE(writer->finish());
  return bytes;
}

uint32_t number_at(std::string_view bytes, size_t at, size_t size) {
  uint32_t number = 0;
  for (size_t i = 0; i < size; ++i) number = number << 8 | uint8_t(bytes[at + i]);
  return number;
}

/// What a player of animated PNGs finds.
struct ApngFrames {
  uint32_t said = 0;                ///< how many frames the file says it has
  std::vector<double> seconds;      ///< each is shown
  std::vector<std::string> as_png;  ///< a file of its own
};

void add_chunk(std::string& png, std::string_view name, std::string_view data) {
  // The reader is libpng, which looks at the check.
  static const auto crc = [](std::string_view bytes) {
    uint32_t c = 0xffffffffu;
    for (const char byte : bytes) {
      c ^= uint8_t(byte);
      for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    }
    return ~c;
  };
  const auto put = [&png](uint32_t word) {
    for (int shift = 24; shift >= 0; shift -= 8) png += char(uint8_t(word >> shift));
  };
  put(uint32_t(data.size()));
  const std::string body = std::string(name) + std::string(data);
  png += body;
  put(crc(body));
}

ApngFrames read_apng(const std::string& bytes) {
  ApngFrames found;
  std::string header;
  uint32_t next_number = 0;
  for (size_t at = 8; at < bytes.size();) {
    const uint32_t size = number_at(bytes, at, 4);
    const std::string name = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, size);
    at += size + 12;
    if (name == "acTL") {
      found.said = number_at(data, 0, 4);
      EXPECT_EQ(number_at(data, 4, 4), 0u);
    } else if (name == "fcTL") {
      EXPECT_EQ(number_at(data, 0, 4), next_number++);
      found.seconds.push_back(double(number_at(data, 20, 2)) / double(number_at(data, 22, 2)));
      found.as_png.push_back(bytes.substr(0, 8) + header);
    } else if (name == "IDAT") {
      EXPECT_EQ(found.as_png.size(), 1u);
      add_chunk(found.as_png.back(), "IDAT", data);
    } else if (name == "fdAT") {
      EXPECT_EQ(number_at(data, 0, 4), next_number++);
      add_chunk(found.as_png.back(), "IDAT", data.substr(4));
    } else if (name != "IEND") {
      add_chunk(header, name, data);
    }
  }
  for (std::string& png : found.as_png) add_chunk(png, "IEND", "");
  return found;
}

TEST(Apng, FramesAreThePicturesToTheBit) {
  const TestFolder folder;
  std::vector<Picture> frames;
  // More than one stripe of the encoder.
  for (int i = 0; i < 5; ++i) frames.push_back(striped_frame(300, 400, i));
  frames[3].at(7, 9)[3] = 80;
  const std::string bytes =
      film_of(make_apng_writer,
              {.width = 300, .height = 400, .frames = 5, .fps = 12.5, .with_alpha = true}, frames);
  const ApngFrames found = read_apng(bytes);
  EXPECT_EQ(found.said, 5u);
  ASSERT_EQ(found.as_png.size(), 5u);
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(found.seconds[i], 0.08);
    ASSERT_TRUE(write_file(folder / "frame.png", found.as_png[i]));
    const Result<Picture> read = read_png(folder / "frame.png");
    ASSERT_TRUE(read) << i;
    EXPECT_EQ(read->rgba, frames[i].rgba) << i;
  }
  // Who knows no animation sees the first frame.
  ASSERT_TRUE(write_file(folder / "whole.png", bytes));
  const Result<Picture> whole = read_png(folder / "whole.png");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->rgba, frames[0].rgba);
}

struct GifFrames {
  std::vector<Picture> pictures;
  std::vector<int> delays;  ///< hundredths of a second
  bool is_endless = false;
};

GifFrames read_gif(const std::string& bytes) {
  struct Rest {
    const std::string& bytes;
    size_t at = 0;
  } rest{bytes};
  const auto take = [](GifFileType* file, GifByteType* to, int size) {
    Rest& from = *static_cast<Rest*>(file->UserData);
    const size_t got = std::min(size_t(size), from.bytes.size() - from.at);
    std::memcpy(to, from.bytes.data() + from.at, got);
    from.at += got;
    return int(got);
  };
  GifFrames found;
  int error = 0;
  GifFileType* const file = DGifOpen(&rest, take, &error);
  if (file == nullptr || DGifSlurp(file) != GIF_OK) {
    ADD_FAILURE() << "not a GIF";
    return found;
  }
  for (int i = 0; i < file->ImageCount; ++i) {
    const SavedImage& image = file->SavedImages[i];
    GraphicsControlBlock control{};
    DGifSavedExtensionToGCB(file, i, &control);
    found.delays.push_back(control.DelayTime);
    for (int k = 0; k < image.ExtensionBlockCount; ++k)
      found.is_endless |= image.ExtensionBlocks[k].Function == APPLICATION_EXT_FUNC_CODE;
    Picture picture(image.ImageDesc.Width, image.ImageDesc.Height);
    for (size_t p = 0; p < picture.rgba.size() / 4; ++p) {
      const int index = image.RasterBits[p];
      const GifColorType color = image.ImageDesc.ColorMap->Colors[index];
      const uint8_t alpha = index == control.TransparentColor ? 0 : 255;
      const uint8_t rgba[4] = {color.Red, color.Green, color.Blue, alpha};
      std::memcpy(&picture.rgba[4 * p], rgba, 4);
    }
    found.pictures.push_back(std::move(picture));
  }
  DGifCloseFile(file, &error);
  return found;
}

TEST(Gif, FramesOfFewColorsAreThePicturesToTheBit) {
  std::vector<Picture> frames;
  for (int i = 0; i < 4; ++i) frames.push_back(striped_frame(37, 23, i));
  const GifFrames found = read_gif(
      film_of(make_gif_writer, {.width = 37, .height = 23, .frames = 4, .fps = 30}, frames));
  ASSERT_EQ(found.pictures.size(), 4u);
  EXPECT_TRUE(found.is_endless);
  // 3.33 hundredths each, without drift.
  EXPECT_EQ(found.delays, (std::vector<int>{3, 4, 3, 3}));
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(found.pictures[i].rgba, frames[i].rgba) << i;
}

TEST(Gif, WhatIsLessThanHalfCoveredIsTransparent) {
  Picture frame = striped_frame(8, 8, 0);
  frame.at(3, 3)[3] = 127;
  frame.at(4, 3)[3] = 128;
  const GifFrames found = read_gif(
      film_of(make_gif_writer,
              {.width = 8, .height = 8, .frames = 1, .fps = 10, .with_alpha = true}, {frame}));
  ASSERT_EQ(found.pictures.size(), 1u);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(found.pictures[0].at(x, y)[3], x == 3 && y == 3 ? 0 : 255) << x << ' ' << y;
}

TEST(Films, WhatTheSinkRefusesIsPassedOn) {
  for (const MakeWriter make : {make_gif_writer, make_apng_writer}) {
    const std::unique_ptr<FilmWriter> writer =
        make({.width = 9, .height = 9, .frames = 1}, [](std::string_view) -> Status {
          return Error{ErrorKind::kMachine, "the disk is full"};
        });
    const Status added = writer->add(striped_frame(9, 9, 0));
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().message, "the disk is full");
  }
}

}  // namespace
}  // namespace whittle
