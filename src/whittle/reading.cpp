#include "whittle/reading.h"

#include "lower/lower.h"
#include "model/instances.h"
#include "subdivide/solid_bounds.h"

namespace whittle {

Box tight_box(const Model& model) {
  const Bounds around = bounds(model);
  if (!around.bounded || around.box.is_empty()) return around.box;
  const Result<Scene> scene = lower(model);
  return seen_box(model, scene ? solid_bounds(*scene, 0).box : around.box);
}

}  // namespace whittle
