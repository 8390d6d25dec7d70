// Facts as pictures for people: distance, normal, owner. Background is opaque black.
#pragma once

#include "image/picture.h"
#include "trace/frame.h"

namespace whittle {

/// Distance as grey, the nearest hit white and the farthest a dark grey, linear between (no gamma).
Picture depth_pass(const Frame& frame);

/// The world-space normal as 0.5 + 0.5 n: x red, y green, z blue.
Picture normal_pass(const Frame& frame);

/// A distinct colour for each id, the same in every picture.
Picture id_pass(const Frame& frame);

}  // namespace whittle
