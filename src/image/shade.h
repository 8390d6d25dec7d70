// From facts to colours. Shading never changes a hit, and there is one function that colours one:
// Shader::color, used for pictures, antialiasing and the window alike.
//
// Three styles: whittle's own studio; the paper's Blinn (Romeiro, Velho, de Figueiredo 2008,
// algorithm 4); and OpenSCAD's look, reproduced to the 8-bit value.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/workers.h"
#include "image/colorscheme.h"
#include "image/cut_faces.h"
#include "image/picture.h"
#include "image/pixel_rays.h"
#include "model/instances.h"
#include "trace/camera.h"
#include "trace/frame.h"

namespace whittle {

enum class Style {
  kStudio,    ///< soft lights fixed to the camera, computed in linear light
  kBlinn,     ///< one positional light, Blinn highlight; values are display values, as in the paper
  kOpenscad,  ///< what OpenSCAD's --render draws; it knows no color()
};

struct ShadeSettings {
  Style style = Style::kStudio;
  /// Background and the colours of uncoloured surfaces, in any style; null: the style's own
  /// (Cornfield for OpenSCAD's).
  const ColorScheme* scheme = nullptr;
  std::optional<Vec3> light;  ///< kBlinn: position in world space; unset: the eye
  bool background = true;     ///< false: what is not hit is transparent (alpha 0)
  /// kOpenscad: the model's, for coincident faces; null: the owner of a hit decides what is cut.
  const CutFaces* cut_faces = nullptr;
  /// kOpenscad: the primitive that is all of the solid, if it is one; it has a colour of its own.
  std::optional<uint32_t> lone_primitive;
};

/// kBlinn: display value = kBlinnAmbient * base + kBlinnDiffuse * base * max(n.l, 0) +
/// kBlinnSpecular * max(n.h, 0)^16, the last only where n.l > 0. Chosen so that a white base that
/// faces the light reaches 0.9, and clips only in the middle of its highlight.
inline constexpr float kBlinnAmbient = 0.2f, kBlinnDiffuse = 0.7f, kBlinnSpecular = 0.3f;
inline constexpr int kBlinnExponent = 16;

/// The colours of surfaces without color(), and of the background, as a style has them.
ColorScheme effective_scheme(const ShadeSettings& settings);

/// The display value of a surface before any light falls on it: its own colour, else the scheme's.
/// Not in style kOpenscad, which knows the scheme's alone.
Vec3f base_color(const Appearance& appearance, const ColorScheme& scheme);

/// Colours hits of one model seen by one camera. Colours are in the style's averaging space: linear
/// light for kStudio, display values for the others; 1 is white, more is clipped when stored.
/// Thread-safe after construction.
class Shader {
 public:
  /// `appearances` is indexed by id; ids beyond it look like uncoloured material. Alpha of color()
  /// is ignored: nothing is known of what stands behind a hit.
  Shader(const Camera& camera, std::span<const Appearance> appearances,
         const ShadeSettings& settings);

  /// The colour of `hit` (or of the background) seen through picture position (px, py).
  Vec3f color(const Hit& hit, float px, float py) const {
    return hit.hit() ? surface(hit, px, py) : background(py);
  }
  Vec3f background(float py) const;
  /// False if what is not hit stays transparent.
  bool has_background() const { return has_background_; }
  /// Writes the colour as four bytes.
  void store(Vec3f color, float alpha, uint8_t* rgba) const;

 private:
  Vec3f surface(const Hit& hit, float px, float py) const;
  Vec3f studio(const Hit& hit, Vec3f base, float px, float py) const;
  Vec3f blinn(const Hit& hit, Vec3f base, float px, float py) const;
  Vec3f openscad(const Hit& hit, Vec3f base, float px, float py) const;

  Style style_;
  bool has_background_;
  float inverse_height_;
  Camera camera_;
  PixelRays rays_;
  Vec3f light_from_eye_;     ///< kBlinn
  Vec3f headlight_;          ///< kOpenscad: one of its two opposite directions
  Vec3f key_, fill_, rim_;   ///< kStudio: unit, from the surface to the light
  Vec3f top_, bottom_;       ///< background
  std::vector<Vec3f> base_;  ///< by id
  Vec3f material_, cut_;
  const CutFaces* cut_faces_;  ///< kOpenscad
};

/// Colours every pixel, in parallel. A pure function: the same bytes on any number of threads.
/// Precondition: the frame has the camera's size.
Picture shade(const Frame& frame, const Camera& camera, std::span<const Appearance> appearances,
              const ShadeSettings& settings, const Workers& workers);

}  // namespace whittle
