// A tracer made of another one by changing the camera that goes in and the hits that come out: for
// laws ("move model and camera together") and for tracers that are wrong on purpose.
#pragma once

#include <functional>

#include "trace/tracer.h"

namespace whittle {

class AdaptedTracer final : public Tracer {
 public:
  using ChangeCamera = std::function<Camera(Camera)>;
  using ChangeHit = std::function<Hit(Hit)>;

  /// `inner` must outlive it. An empty function changes nothing.
  AdaptedTracer(Tracer& inner, ChangeCamera camera, ChangeHit hit)
      : inner_(&inner), change_camera_(std::move(camera)), change_hit_(std::move(hit)) {}

  const char* name() const override { return "adapted"; }
  Frame render(const Camera& camera, const RenderControl& control) override {
    Frame frame = inner_->render(change_camera_ ? change_camera_(camera) : camera, control);
    change(frame.hits);
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    inner_->probe(change_camera_ ? change_camera_(camera) : camera, positions, hits);
    change(hits);
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    inner_->cast(rays, hits);
    change(hits);
  }

 private:
  void change(std::span<Hit> hits) const {
    if (!change_hit_) return;
    for (Hit& hit : hits)
      if (hit.hit()) hit = change_hit_(hit);
  }

  Tracer* inner_;
  ChangeCamera change_camera_;
  ChangeHit change_hit_;
};

}  // namespace whittle
