#include "film/palette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <span>

#include "base/result.h"

namespace whittle {
namespace {

/// Levels of a channel are counted in pairs, so that all there are fit a table.
constexpr int kBits = 7;
constexpr size_t kBins = size_t(1) << (3 * kBits);

size_t bin_of(const uint8_t* rgba) {
  constexpr int kDrop = 8 - kBits;
  return size_t(rgba[0] >> kDrop) << (2 * kBits) | size_t(rgba[1] >> kDrop) << kBits |
         size_t(rgba[2] >> kDrop);
}

/// A bin that pixels are in: the sum of their colours, and how many there are.
struct Bin {
  size_t number = 0;
  double count = 0;
  std::array<double, 3> sum{};

  double mean(int channel) const { return sum[size_t(channel)] / count; }
};

/// Bins that become one colour.
struct ColorBox {
  std::span<Bin> bins;
  double count = 0;
  std::array<double, 3> mean{};
  int widest = 0;    ///< the channel with the largest error
  double error = 0;  ///< the squares of what is off in it, summed up

  explicit ColorBox(std::span<Bin> held) : bins(held) {
    std::array<double, 3> sum{}, squares{};
    for (const Bin& bin : bins) {
      count += bin.count;
      for (size_t c = 0; c < 3; ++c) {
        sum[c] += bin.sum[c];
        squares[c] += bin.sum[c] * bin.mean(int(c));
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      mean[c] = sum[c] / count;
      const double off = squares[c] - sum[c] * mean[c];
      if (off > error) error = off, widest = int(c);
    }
    if (bins.size() == 1) error = 0;
  }
  bool operator<(const ColorBox& other) const { return error < other.error; }
};

std::vector<Bin> bins_of(const Picture& picture, bool with_alpha, std::vector<uint32_t>& places) {
  std::vector<Bin> bins;
  for (size_t i = 0; i < picture.rgba.size(); i += 4) {
    const uint8_t* rgba = &picture.rgba[i];
    if (with_alpha && rgba[3] < 128) continue;
    uint32_t& place = places[bin_of(rgba)];
    if (place == 0) {
      bins.push_back({.number = bin_of(rgba), .count = 0, .sum = {}});
      place = uint32_t(bins.size());
    }
    Bin& bin = bins[place - 1];
    ++bin.count;
    for (size_t c = 0; c < 3; ++c) bin.sum[c] += rgba[c];
  }
  return bins;
}

std::vector<ColorBox> cut(std::vector<Bin>& bins, size_t most) {
  std::priority_queue<ColorBox> open;
  std::vector<ColorBox> done;
  if (!bins.empty()) open.emplace(std::span(bins));
  while (!open.empty()) {
    const ColorBox box = open.top();
    open.pop();
    if (!(box.error > 0) || open.size() + done.size() + 2 > most) {
      done.push_back(box);
      continue;
    }
    const auto middle = std::stable_partition(
        box.bins.begin(), box.bins.end(),
        [&](const Bin& bin) { return bin.mean(box.widest) <= box.mean[size_t(box.widest)]; });
    const size_t below = size_t(middle - box.bins.begin());
    if (below == 0 || below == box.bins.size()) {  // rounding alone tells them apart
      done.push_back(box);
      continue;
    }
    open.emplace(box.bins.first(below));
    open.emplace(box.bins.subspan(below));
  }
  return done;
}

}  // namespace

IndexedPicture to_palette(const Picture& picture, size_t most, bool with_alpha) {
  WHITTLE_CHECK(most >= 2 && most <= 256);
  std::vector<uint32_t> places(kBins);
  std::vector<Bin> bins = bins_of(picture, with_alpha, places);
  IndexedPicture indexed;
  if (with_alpha) indexed.colors.emplace_back();
  for (const ColorBox& box : cut(bins, most - indexed.colors.size())) {
    for (const Bin& bin : box.bins) places[bin.number] = uint32_t(indexed.colors.size());
    const auto level = [&](size_t c) { return uint8_t(std::lround(box.mean[c])); };
    indexed.colors.push_back({level(0), level(1), level(2)});
  }
  indexed.indices.reserve(picture.rgba.size() / 4);
  for (size_t i = 0; i < picture.rgba.size(); i += 4) {
    const uint8_t* rgba = &picture.rgba[i];
    const bool is_clear = with_alpha && rgba[3] < 128;
    indexed.indices.push_back(is_clear ? uint8_t(0) : uint8_t(places[bin_of(rgba)]));
  }
  return indexed;
}

}  // namespace whittle
