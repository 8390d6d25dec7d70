// Integrals over a scene's solid, whatever its surfaces are, with bounds that are proved.
#pragma once

#include <cstdint>
#include <functional>

#include "base/workers.h"
#include "lower/scene.h"
#include "measure/moments.h"

namespace whittle {

struct IntegrateSettings {
  double within = 1e-6;  ///< of the volume: what its bound may be
  /// Parts of cells that may be looked at, one time through. With fewer than are needed the bound
  /// is what is reached.
  uint64_t most_parts = 60'000'000;
  std::function<void(double)> progress{};  ///< is told the share that is done
};

struct Integrated {
  Integral integral;   ///< local coordinates: about the scene's origin
  uint64_t parts = 0;  ///< that were looked at, the last time through
  bool is_within = false;
};

/// The same whatever the number of threads. Precondition: the scene is bounded. How it is done:
/// docs/decisions/0044-mass.md.
Integrated integrate(const Scene& scene, const Workers& workers,
                     const IntegrateSettings& settings = {});

}  // namespace whittle
