#include "trace/vulkan/front_to_back.h"

#include <cmath>

namespace whittle {
namespace {

/// A corner so many widths of the tile beside its middle would be placed badly by a rasteriser.
constexpr double kMostBeside = 16;
/// Corners that are not this share of their distance ahead of the eye, too.
constexpr double kLeastAhead = 1e-3;

enum class Sight { kNone, kSome, kWide };

class Frustum {
 public:
  Frustum(const Camera& camera, Vec3 eye, const PixelRect& tile, double margin)
      : camera_(camera), eye_(eye), grow_(margin * camera.units_per_pixel()) {
    const double s = camera.units_per_pixel();
    lo_x_ = (tile.x0 - margin - 0.5 * camera.width) * s;
    hi_x_ = (tile.x1 + margin - 0.5 * camera.width) * s;
    lo_y_ = (0.5 * camera.height - tile.y1 - margin) * s;
    hi_y_ = (0.5 * camera.height - tile.y0 + margin) * s;
  }

  /// How the tile sees a box. kNone is a proof.
  Sight look(Box box) const {
    // As large as it is drawn: that may reach to the eye where the box itself does not.
    box = {box.lo - eye_, box.hi - eye_};
    const double grow = grow_ * (camera_.orthographic ? 1 : length(max(abs(box.lo), abs(box.hi))));
    box = {box.lo - Vec3{grow, grow, grow}, box.hi + Vec3{grow, grow, grow}};
    // Bits: all corners left of, right of, below, above, and behind what is seen.
    unsigned beside = 31;
    bool wide = false;
    for (int i = 0; i < 8; ++i) {
      const Vec3 p = box.corner(i);
      const double ahead = camera_.orthographic ? 1 : dot(p, camera_.forward);
      const double x = dot(p, camera_.right), y = dot(p, camera_.up);
      beside &= unsigned(x < lo_x_ * ahead) | unsigned(x > hi_x_ * ahead) << 1 |
                unsigned(y < lo_y_ * ahead) << 2 | unsigned(y > hi_y_ * ahead) << 3 |
                unsigned(ahead < 0) << 4;
      wide = wide || is_far(x, ahead, lo_x_, hi_x_) || is_far(y, ahead, lo_y_, hi_y_) ||
             (!camera_.orthographic && !(ahead > kLeastAhead * length(p)));
    }
    return beside != 0 ? Sight::kNone : wide ? Sight::kWide : Sight::kSome;
  }

 private:
  static bool is_far(double x, double ahead, double lo, double hi) {
    return !(std::fabs(x - 0.5 * (lo + hi) * ahead) < kMostBeside * (hi - lo) * ahead);
  }

  const Camera& camera_;
  Vec3 eye_;
  double grow_;                       ///< at distance 1
  double lo_x_, hi_x_, lo_y_, hi_y_;  ///< of the tile, at distance 1
};

}  // namespace

void order_front_to_back(const FlatCells& flat, const Camera& camera, Vec3 eye,
                         const PixelRect& tile, double margin, std::vector<VisibleCell>& cells) {
  cells.clear();
  if (flat.root == kNoChild) return;
  const Frustum frustum(camera, eye, tile, margin);
  struct Open {
    uint32_t at;
    Box box;
  };
  std::vector<Open> open{{flat.root, flat.region}};
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    const Sight sight = frustum.look(now.box);
    if (sight == Sight::kNone) continue;
    if (now.at & kCellBit) {
      cells.push_back({now.at & ~kCellBit, sight == Sight::kWide});
      continue;
    }
    const FlatNode& node = flat.nodes[now.at];
    // Rays come from the eye's side, or orthographic ones from where they look away from.
    const bool starts_above =
        camera.orthographic ? camera.forward[node.axis] < 0 : eye[node.axis] > node.split;
    // What is pushed last comes first.
    for (const uint32_t side : {starts_above ? 0u : 1u, starts_above ? 1u : 0u}) {
      if (node.child[side] == kNoChild) continue;
      Box box = now.box;
      (side == 0 ? box.hi : box.lo)[node.axis] = node.split;
      open.push_back({node.child[side], box});
    }
  }
}

}  // namespace whittle
