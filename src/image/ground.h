// The soft shadow of what stands on the ground: the plane through the solid's lowest point.
//
// The ground itself is not seen. From where it is, through a lattice of pixels (every third one of
// every third row at 800 x 600), one ray goes to the sky and one to a large lamp, in directions
// that change from one to the next as those of occlusion.h. The mean over 8 x 8 of them, and over 8
// x 8 of those means, is the shadow; where the solid hides the ground nearby, over as many on the
// other side.
#pragma once

#include <cstddef>
#include <stop_token>
#include <vector>

#include "base/box.h"
#include "base/workers.h"
#include "image/shade.h"
#include "trace/camera.h"
#include "trace/frame.h"
#include "trace/tracer.h"

namespace whittle {

class Ground {
 public:
  /// `settings.solid` says where the ground is. One that the eye is not above is not there. Once a
  /// stop is requested it returns soon, and is of no use.
  Ground(Tracer& tracer, const Camera& camera, const Frame& frame, const ShadeSettings& settings,
         const Workers& workers, const std::stop_token& stop);

  /// The share of the light that the solid keeps from what is seen through a picture position, 0 to
  /// 1; of the ground around where the solid itself is seen.
  float shadow(float px, float py) const;

 private:
  size_t step_ = 1;                ///< pixels from one place of the lattice to the next
  size_t columns_ = 0, rows_ = 0;  ///< of the lattice; 0: there is no shadow
  std::vector<float> shadows_;     ///< of its places
};

}  // namespace whittle
