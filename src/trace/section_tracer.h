// What is seen of a model that is cut open: a hit on a plane that cuts says whose material it is.
#pragma once

#include <functional>

#include "base/workers.h"
#include "model/model.h"
#include "trace/tracer.h"

namespace whittle {

/// The statement that owns the material behind a point of a cap, world space; 0: nobody does. Is
/// called from many threads.
using CapOwner = std::function<uint32_t(Vec3 point, Vec3 outward)>;

/// Any backend that sees the model, where caps have the ids that Cut::cap_of says.
class SectionTracer final : public Tracer {
 public:
  /// Tracer and workers must outlive this.
  SectionTracer(Tracer& model, Cut ids, CapOwner owner, const Workers& workers);

  const char* name() const override { return model_.name(); }
  /// What control is told while it runs has the planes' ids.
  Frame render(const Camera& camera, const RenderControl& control = {}) override;
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override;
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override;
  void cast_through(std::span<const Ray> rays, RayCrossings& found) override;
  Status status() const override { return model_.status(); }

 private:
  uint32_t id_at(uint32_t plane, const Ray& ray, double distance, Vec3 normal) const;
  /// Names the caps among hits of rays, of which ray_of(i) is one.
  template <class RayOf>
  void name_caps(const RayOf& ray_of, std::span<Hit> hits) const;

  Tracer& model_;
  const Cut ids_;
  const CapOwner owner_;
  const Workers& workers_;
};

}  // namespace whittle
