#include "lines/bodies.h"

#include <algorithm>

namespace whittle {

std::vector<uint32_t> bodies_of_parts(const Model& model, std::span<const Instance> instances) {
  std::vector<uint32_t> bodies(instances.size(), 0);
  uint32_t node = 0, end = 0;
  for (size_t i = 0; i < instances.size(); ++i) {
    for (; node <= instances[i].node; ++node)
      if (model.nodes[node].kind == NodeKind::kBody) end = std::max(end, model.nodes[node].end);
    if (instances[i].node < end) bodies[i] = model.primitives[instances[i].primitive].id;
  }
  return bodies;
}

}  // namespace whittle
