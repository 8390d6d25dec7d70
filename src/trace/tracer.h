// The contract of all backends: facts for rays, nothing else.
#pragma once

#include <functional>
#include <span>

#include "base/result.h"
#include "trace/camera.h"
#include "trace/frame.h"

namespace whittle {

/// A position in the picture, in pixels (see Camera::ray).
struct PixelPosition {
  float x = 0, y = 0;
};

/// Told the share of the work that is done, 0..1, now and then, from any thread; may be empty.
using Progress = std::function<void(double)>;

/// A backend bound to one model. Backends do not know one another; the model and everything made
/// from it must outlive the tracer. Calls may come from one thread at a time.
class Tracer {
 public:
  virtual ~Tracer() = default;
  virtual const char* name() const = 0;
  /// Facts at every pixel centre.
  virtual Frame render(const Camera& camera, const Progress& progress = {}) = 0;
  /// Facts at any positions; hits.size() == positions.size().
  virtual void probe(const Camera& camera, std::span<const PixelPosition> positions,
                     std::span<Hit> hits) = 0;
  /// What the machine refused, if it did; then all facts since are of no use.
  virtual Status status() const { return Done{}; }
};

}  // namespace whittle
