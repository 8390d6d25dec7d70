// The contract of all backends: facts for rays, nothing else.
#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "base/result.h"
#include "trace/camera.h"
#include "trace/frame.h"
#include "trace/pixel_rect.h"

namespace whittle {

/// A position in the picture, in pixels (see Camera::ray).
struct PixelPosition {
  float x = 0, y = 0;
};

/// Told the share of the work that is done, 0..1, now and then, from any thread; may be empty.
using Progress = std::function<void(double)>;

/// Told that the frame's hits within the rectangle are known, or more of them: one that hits stays
/// what it is, one that does not may become one until render() returns. From any thread, several
/// at a time. Nothing outside of the rectangle may be read.
using PartSeen = std::function<void(const Frame&, const PixelRect&)>;

/// What render() is told, and tells, while it runs. All of it may be left out.
struct RenderControl {
  /// Once a stop is requested, render() returns soon, and its frame is of no use.
  std::stop_token stop{};
  Progress progress{};
  PartSeen part_seen{};
};

/// A backend bound to one model. Backends do not know one another; the model and everything made
/// from it must outlive the tracer. Calls may come from one thread at a time.
class Tracer {
 public:
  virtual ~Tracer() = default;
  virtual const char* name() const = 0;
  /// Facts at every pixel centre.
  virtual Frame render(const Camera& camera, const RenderControl& control = {}) = 0;
  /// Facts at any positions; hits.size() == positions.size().
  virtual void probe(const Camera& camera, std::span<const PixelPosition> positions,
                     std::span<Hit> hits) = 0;
  /// Facts for any rays; hits.size() == rays.size(). The fastest are those whose neighbours in the
  /// row go nearly the same way.
  virtual void cast(std::span<const Ray> rays, std::span<Hit> hits) = 0;
  /// All points at which rays enter or leave the solid, not only the first. Entering and leaving
  /// take turns; a ray that starts in the solid first leaves it. Points at which it would leave and
  /// enter again within the rounding of the ray are none. Not to be asked of tracers that are made
  /// for pictures alone.
  virtual void cast_through(std::span<const Ray>, RayCrossings&) { WHITTLE_CHECK(false); }
  /// What the machine refused, if it did; then all facts since are of no use.
  virtual Status status() const { return Done{}; }
};

}  // namespace whittle
