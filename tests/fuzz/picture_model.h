// Any bytes as a model: every sequence of bytes is one, none is refused, and most are interesting.
//
// The model is built of few sizes, places and angles, so that faces lie on one another often, and
// of copies that are displaced by about the tolerance, so that they nearly do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace whittle {

struct PictureInput {
  std::string text;          ///< .csg
  int primitives = 0;        ///< statements in it, 1 to kMostPrimitives
  bool uses_nearly = false;  ///< `nearly` made a difference
  uint32_t leaf_size = 6;    ///< to subdivide with
  double least_use = 0;      ///< so too
  int view = 0;              ///< number of the camera, 0 to kViews - 1
};

inline constexpr int kMostPrimitives = 24;
inline constexpr int kViews = 6;

/// `nearly` is what offsets are multiples of (kNearly): the model's tolerance, which depends on the
/// model's size; decode with 0 to learn it.
PictureInput decode_picture(std::span<const uint8_t> bytes, double nearly);

/// Odd, so that no two of them, with the decoder's scales, differ by just the tolerance.
inline constexpr double kNearly[] = {0.13, 0.45, 0.9, 1.12, 2.3, 11, 130};

}  // namespace whittle
