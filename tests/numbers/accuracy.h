// The accuracy that docs/numerics.md promises, as a check of whole pictures against known answers.
//
// A ray is as exact as its pixel's centre is known: the answer must be that of some ray within
// kPixels of a pixel and kSideways of the largest length that occurs. Where all such rays see one
// surface, the answer must be that surface; elsewhere (an edge) it must be one of theirs.
#pragma once

#include <string>

#include "numbers/known.h"

namespace whittle {

inline constexpr Exact kPixels = 1e-6L;       ///< of a pixel
inline constexpr Exact kSideways = 1e-15L;    ///< of the largest length; lengths across the ray
inline constexpr Exact kDistance = 0x1p-23L;  ///< of the distance: it is handed on as a float
inline constexpr Exact kNormal = 2e-7L;       ///< as a sine; normals are floats too

/// Looks from `eye` towards `target`; z is up unless that is the way one looks.
Camera look(Vec3 eye, Vec3 target, double fov_degrees, int width = 64, int height = 48);
/// The same direction; a picture `tall` model units high.
Camera look_parallel(Vec3 eye, Vec3 target, double tall, int width = 64, int height = 48);

struct PictureCounts {
  int pixels = 0;
  int hits = 0;
  int undecided = 0;  ///< pixels on an edge, within the accuracy
};

/// Renders `text` with the cpu backend at leaf sizes 1, 2, 6 and 16. Every pixel must show what
/// `answer` says, to the accuracy above, and no two cells may disagree. The oracle must
/// agree with leaf size 6 (but on parts that are so small in their model that agreement.h asks for
/// more than doubles can tell). What does not hold is reported to gtest. Counts are those of one
/// picture.
PictureCounts expect_known(const std::string& text, const Camera& camera, const Answer& answer);

}  // namespace whittle
