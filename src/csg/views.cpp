#include "csg/views.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "csg/arguments.h"

namespace whittle {

void assign_view(std::string_view name, const Value& value, SourceLocation where, FileView& view,
                 Warnings& warnings) {
  const std::optional<Vec3> vector = as_vec3(value);
  const bool is_vector = vector && is_finite(*vector);
  const bool is_number = value.kind == Value::Kind::kNumber && std::isfinite(value.number);
  const bool is_angle = is_number && value.number > 0 && value.number < 180;
  if (name == "$vpt" && is_vector) {
    view.target = *vector;
  } else if (name == "$vpr" && is_vector) {
    view.rotation_degrees = *vector;
  } else if (name == "$vpd" && is_number) {
    view.distance = value.number;
  } else if (name == "$vpf" && is_angle) {
    view.fov_degrees = value.number;
  } else if (name == "$vpt" || name == "$vpr" || name == "$vpd" || name == "$vpf") {
    const std::string message = fmt::format("{} is not {}; it is ignored", name,
                                            name == "$vpd"   ? "a number"
                                            : name == "$vpf" ? "a number between 0 and 180"
                                                             : "three numbers");
    warnings.add(message, where, message);
  }
}

}  // namespace whittle
