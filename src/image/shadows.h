// Which lights do not reach which hits: exactly, a ray from the light to every hit.
//
// Based on: section 5 of the paper (Romeiro, Velho, de Figueiredo 2008), a first pass from the
// light into a shadow buffer. What we changed: the pass does not look at the pixels of a picture
// seen from the light, but at the very points that are to be lit, so nothing is a staircase.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "image/shade.h"
#include "trace/tracer.h"

namespace whittle {

/// A hit is in shadow if something stands more than this share of both ways (eye to hit, light to
/// hit) in front of it, divided by the cosine at which the light falls: docs/numerics.md.
inline constexpr double kShadowTolerance = 1.0 / (1 << 18);

/// Adds to the mask the pixels that are lit otherwise than one of their eight neighbours.
void add_shadow_edges(const std::vector<uint8_t>& shadows, size_t width,
                      std::vector<uint8_t>& mask);

class Shadows {
 public:
  /// Precondition: settings.casters is finite or empty. The tracer, and the status of it, are the
  /// caller's.
  Shadows(Tracer& tracer, const Camera& camera, const ShadeSettings& settings,
          const Workers& workers);

  /// find() for every pixel of a frame.
  std::vector<uint8_t> of_frame(const Frame& frame);

  /// For hits seen through as many places: bit k says that light k of lights() falls on the side
  /// that is seen, but something stands before it. Where a light comes from behind the bit is 0.
  void find(std::span<const Hit> hits, std::span<const PixelPosition> places,
            std::vector<uint8_t>& shadows);

 private:
  /// A hit, and the normal of its side that is seen.
  struct Seen {
    Vec3 point;
    Vec3f normal;
    float way;  ///< from the eye
  };
  /// A hit that faces a light.
  struct Target {
    uint32_t hit;
    float cosine;  ///< of the light's fall
  };

  void find_light(const Light& light, uint8_t bit, std::span<const Hit> hits,
                  std::vector<uint8_t>& shadows);
  /// From the light.
  Ray ray_to(Vec3 point, const Light& light) const;

  Tracer& tracer_;
  const Camera camera_;
  const std::vector<Light> lights_;
  const Box casters_;
  const Workers& workers_;
  // Scratch space.
  std::vector<Seen> seen_;
  std::vector<Target> targets_;
  std::vector<Ray> rays_;
  std::vector<Hit> found_;
};

}  // namespace whittle
