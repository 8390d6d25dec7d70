// From facts to colours. Shading never changes a hit, and there is one arithmetic that colours one,
// used for pictures and antialiasing alike: shade_lanes.cpp.
//
// Four styles: whittle's own studio (image/studio.h) and plain; the paper's Blinn (Romeiro, Velho,
// de Figueiredo 2008, algorithm 4); and OpenSCAD's look, reproduced to the 8-bit value.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/box.h"
#include "base/workers.h"
#include "image/cap_look.h"
#include "image/colorscheme.h"
#include "image/cut_faces.h"
#include "image/picture.h"
#include "image/shade_lanes.h"
#include "model/instances.h"
#include "trace/camera.h"
#include "trace/frame.h"

namespace whittle {

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
  /// kOpenscad: OpenSCAD's preview and not its --render: color() counts, uncoloured surfaces have
  /// the scheme's colours for the preview, and the owner of a hit alone decides what is cut.
  bool is_preview = false;
  /// The model is a drawing: it has the scheme's colour for those, in kOpenscad without any light.
  bool is_drawing = false;
  /// Not kOpenscad: lights reach only what they see. Then the key light has sharp edges.
  bool shadows = false;
  Box casters;                       ///< with shadows: finite, holds all that casts them
  Quality quality = Quality::kGood;  ///< kStudio
  bool ground = true;                ///< kStudio: what is seen casts a soft shadow below it
  /// Ids of a model that is cut open: its caps are lit flatly (image/cap_look.h).
  std::optional<Cut> cut;
  bool hatch = false;  ///< with `cut`: caps are hatched
  Box solid;  ///< kStudio: the solid's; not finite or empty: it has no ground, nothing is hidden
};

/// What reaches hits: an entry each, or none at all where all of it does.
struct Reaching {
  std::span<const uint8_t> shadows{};  ///< bit k: light k does not
  std::span<const float> openness{};   ///< kStudio: the share of the surroundings that does
};

struct Light {
  Vec3 at;  ///< where it stands, or the unit direction to it
  bool is_direction = false;
};

/// The lights of a style, in world space, in the order of the bits of a shadow (image/shadows.h).
/// kOpenscad has none that could cast any.
std::vector<Light> lights(const Camera& camera, const ShadeSettings& settings);

/// The colours of surfaces without color(), and of the background, as a style has them.
ColorScheme effective_scheme(const ShadeSettings& settings);

/// The display value of a surface before any light falls on it: its own colour, else the scheme's.
/// Not in style kOpenscad but for the preview: --render knows the scheme's alone.
Vec3f base_color(const Appearance& appearance, const ColorScheme& scheme);

/// Colours hits of one model seen by one camera. Colours are in the style's averaging space: linear
/// light for kStudio and kPlain, display values for the others; 1 is white, more is clipped when
/// stored. Thread-safe after construction.
class Shader {
 public:
  /// `appearances` is indexed by id; ids beyond it look like uncoloured material. Alpha of color()
  /// is ignored: nothing is known of what stands behind a hit (image/veil.h does).
  Shader(const Camera& camera, std::span<const Appearance> appearances,
         const ShadeSettings& settings);

  /// Writes the pixels of row y, four bytes each. `shadows`: one of each hit, or none at all.
  /// `seen` is scratch space.
  void row(std::span<const Hit> hits, std::span<const uint8_t> shadows, int y, SeenHits& seen,
           uint8_t* rgba) const;
  /// The colours of hits, or of the background, seen through as many picture positions. Alpha is 1,
  /// or 0 where nothing is hit and no background is wanted. `seen` is scratch space.
  void samples(std::span<const Hit> hits, std::span<const PixelPosition> places,
               const Reaching& reaching, SeenHits& seen, Colors& colors) const;
  /// Writes colours as four bytes each.
  void store(const Colors& colors, uint8_t* rgba) const;

 private:
  /// Picture position of hit i: place(i).
  template <class Place>
  void look(std::span<const Hit> hits, const Place& place, const Reaching& reaching,
            SeenHits& seen) const;

  Camera camera_;
  std::optional<CapLook> cap_look_;
  ShadeParameters parameters_;
  uint32_t cut_;               ///< of parameters_.materials: without color(), as last
  const CutFaces* cut_faces_;  ///< kOpenscad
};

/// Colours every pixel, in parallel. A pure function: the same bytes on any number of threads.
/// Precondition: the frame has the camera's size; there is one of `shadows` a pixel, or none.
Picture shade(const Frame& frame, const Camera& camera, std::span<const Appearance> appearances,
              const ShadeSettings& settings, const Workers& workers,
              std::span<const uint8_t> shadows = {});

}  // namespace whittle
