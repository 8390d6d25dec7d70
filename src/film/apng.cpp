#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "base/workers.h"
#include "film/film_writer.h"
#include "image/png.h"

namespace whittle {
namespace {

constexpr size_t kSignatureSize = 8;

void put(std::string& bytes, uint32_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) bytes += char(uint8_t(value >> shift));
}

uint32_t word_at(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  for (size_t i = 0; i < 4; ++i) word = word << 8 | uint8_t(bytes[at + i]);
  return word;
}

/// Calls visit(name, data, whole chunk) for the chunks of a PNG of our own.
template <class Visit>
void for_chunks(std::string_view png, const Visit& visit) {
  constexpr size_t kFrame = 12;  // length, name and check
  for (size_t at = kSignatureSize; at < png.size();) {
    const size_t size = word_at(png, at);
    visit(png.substr(at + 4, 4), png.substr(at + 8, size), png.substr(at, size + kFrame));
    at += size + kFrame;
  }
}

/// Each frame is the data of a PNG: of the first the chunks are as they were, of the others they
/// are numbered.
class ApngWriter : public FilmWriter {
 public:
  ApngWriter(const FilmSettings& settings, ByteSink sink)
      : settings_(settings), sink_(std::move(sink)), workers_(settings.threads) {}

  Status add(const Picture& picture) override {
    WHITTLE_CHECK(picture.width == settings_.width && picture.height == settings_.height);
    WHITTLE_CHECK(added_ < settings_.frames);
    const std::string png = encode_png(picture, settings_.with_alpha, &workers_);
    std::string bytes;
    if (added_ == 0) bytes = png.substr(0, kSignatureSize);
    bool has_control = false;
    for_chunks(png, [&](std::string_view name, std::string_view data, std::string_view chunk) {
      if (name == "IEND") return;
      if (name != "IDAT") {
        if (added_ == 0) bytes += chunk;
        return;
      }
      if (!has_control) put_controls(bytes);
      has_control = true;
      if (added_ == 0) {
        bytes += chunk;
        return;
      }
      std::string numbered;
      put(numbered, next_number_++, 4);
      put_png_chunk(bytes, "fdAT", numbered.append(data));
    });
    ++added_;
    return sink_(bytes);
  }

  Status finish() override {
    WHITTLE_CHECK(added_ == settings_.frames);
    std::string end;
    put_png_chunk(end, "IEND", "");
    return sink_(end);
  }

 private:
  void put_controls(std::string& bytes) {
    if (added_ == 0) {
      std::string all;
      put(all, uint32_t(settings_.frames), 4);
      put(all, 0, 4);  // it is played for ever
      put_png_chunk(bytes, "acTL", all);
    }
    std::string frame;
    put(frame, next_number_++, 4);
    put(frame, uint32_t(settings_.width), 4);
    put(frame, uint32_t(settings_.height), 4);
    put(frame, 0, 4);  // where it is: x
    put(frame, 0, 4);  // and y
    // A frame is shown for 100 / (100 fps) seconds.
    put(frame, 100, 2);
    put(frame, uint32_t(std::lround(100 * settings_.fps)), 2);
    put(frame, 0, 1);  // it stays until the next,
    put(frame, 0, 1);  // which takes its place
    put_png_chunk(bytes, "fcTL", frame);
  }

  FilmSettings settings_;
  ByteSink sink_;
  Workers workers_;
  int added_ = 0;
  uint32_t next_number_ = 0;
};

}  // namespace

std::unique_ptr<FilmWriter> make_apng_writer(const FilmSettings& settings, ByteSink sink) {
  return std::make_unique<ApngWriter>(settings, std::move(sink));
}

}  // namespace whittle
