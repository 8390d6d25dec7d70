// What is seen of a drawing: the plane z = 0 where the drawing's slab meets it.
//
// Any backend can draw it. A ray meets the plane at one point. What is there, a ray of the backend
// says that comes straight from above.
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
  Frame render(const Camera& camera, const RenderControl& control = {}) override;
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override;
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override;
  /// Passing the plane where the drawing is counts as entering; nothing is left.
  void cast_through(std::span<const Ray> rays, RayCrossings& found) override;
  Status status() const override { return slab_.status(); }

 private:
  /// Where a ray meets the plane.
  struct Meeting {
    Vec2 point;
    float distance = 0;
    float normal = 0;  ///< its z; 0: it does not meet the plane where the drawing is
  };

  Meeting meet(const Ray& ray) const;
  /// Hits of `count` rays, of which ray_of(i) is one.
  template <class RayOf>
  void look(size_t count, const RayOf& ray_of, std::span<Hit> hits);

  Tracer& slab_;
  const Box box_;
  const Workers& workers_;
  // Scratch space.
  std::vector<Meeting> meetings_;
  std::vector<Ray> down_;  ///< one for each meeting on the plane
  std::vector<Hit> found_;
};

}  // namespace whittle
