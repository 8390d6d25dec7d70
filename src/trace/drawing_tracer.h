// What is seen of a drawing: the plane z = 0 where the drawing's slab meets it.
//
// Any backend can draw it. A ray of the camera meets the plane at one point; whether something is
// there, and whose it is, the backend says when it looks at the slab straight from above.
#pragma once

#include <vector>

#include "base/box.h"
#include "base/workers.h"
#include "trace/tracer.h"

namespace whittle {

class DrawingTracer final : public Tracer {
 public:
  /// `slab` is bound to a model that is a drawing, `box` holds that; tracer and workers must
  /// outlive this.
  DrawingTracer(Tracer& slab, const Box& box, const Workers& workers);

  const char* name() const override { return slab_.name(); }
  /// Normals point to the eye's side of the plane.
  Frame render(const Camera& camera, const Progress& progress = {}) override;
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override;
  Status status() const override { return slab_.status(); }

 private:
  /// Of a ray: where it meets the plane.
  struct Meeting {
    Vec2 point;
    float distance = 0;
    float normal = 0;  ///< its z; 0: it does not meet the plane where the drawing is
  };

  void meet(const Camera& camera, std::span<const PixelPosition> positions);
  Camera look_down() const;

  Tracer& slab_;
  const Box box_;
  const Workers& workers_;
  // Scratch space.
  std::vector<Meeting> meetings_;
  std::vector<PixelPosition> places_;  ///< seen from above
  std::vector<Hit> found_;
};

}  // namespace whittle
