// Facts and colours as an OpenEXR file, and back.
//
// Channels: R G B A (half; linear light, premultiplied, as EXR has them), Z (float; distance along
// the ray, infinity where nothing is hit), N.X N.Y N.Z (float; world space), id (uint; 0 is
// background).
#pragma once

#include <string>

#include "base/result.h"
#include "base/workers.h"
#include "image/picture.h"
#include "trace/frame.h"

namespace whittle {

/// The bytes of a file with frame and picture, the same with any number of workers. Facts are
/// stored bit by bit; the picture's sRGB bytes are decoded to linear light. A kMachine error if
/// there is no OpenEXR. Precondition: frame and picture have the same, positive size.
Result<std::string> encode_exr(const Frame& frame, const Picture& picture,
                               const Workers* workers = nullptr);

/// Reads the facts back. Anything that is not a readable file with the channels Z, N.X, N.Y, N.Z
/// (float) and id (uint) is a kInput error that says why. Never throws.
Result<Frame> read_exr(const std::string& path);

}  // namespace whittle
