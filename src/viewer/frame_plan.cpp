#include "viewer/frame_plan.h"

#include <array>

namespace whittle {
namespace {

/// What a picture may take while something moves, milliseconds: that of 60 in a second, less what
/// it takes to show it.
constexpr double kInTime = 13;
/// A finer scale must fit into this share of that, or pictures would go to and fro between two.
constexpr double kClearly = 0.75;
/// So long nobody minds that the last picture stays.
constexpr double kSoon = 350;
constexpr std::array<int, 7> kScales{1, 2, 3, 4, 6, 8, 12};
/// Where nothing is known yet.
constexpr int kFirstScale = 2;

double mixed(double known, double seen) {
  return known > 0 ? (known + seen) / 2 : seen;
}

}  // namespace

int FramePlan::scale_in_time() const {
  if (draft_ <= 0) return kFirstScale;
  for (const int scale : kScales) {
    const double expected = draft_ * double(pixels_) / (scale * scale);
    if (expected <= (scale < last_scale_ ? kInTime * kClearly : kInTime)) return scale;
  }
  return kScales.back();
}

void FramePlan::restart(int64_t pixels, bool is_moving) {
  pixels_ = pixels;
  const bool is_final_soon = final_ > 0 && final_ * double(pixels) <= kSoon;
  if (!is_moving && is_final_soon)
    next_ = FrameStep{1, true};
  else
    next_ = FrameStep{last_scale_ = scale_in_time(), false};
}

void FramePlan::took(double milliseconds) {
  if (!next_) return;
  const auto [scale, is_final] = *next_;
  if (is_final) {
    final_ = mixed(final_, milliseconds / double(pixels_));
    next_.reset();
    return;
  }
  draft_ = mixed(draft_, milliseconds * scale * scale / double(pixels_));
  const bool is_final_soon = final_ > 0 && final_ * double(pixels_) <= kSoon;
  next_ = scale > 1 && !is_final_soon ? FrameStep{1, false} : FrameStep{1, true};
}

}  // namespace whittle
