// Values as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "base/vec.h"

namespace whittle {

inline nlohmann::ordered_json json_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

}  // namespace whittle
