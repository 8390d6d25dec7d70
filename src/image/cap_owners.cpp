#include "image/cap_owners.h"

#include "lower/evaluate.h"

namespace whittle {
namespace {

/// How far below a cap its material is looked for, in tolerances: a face that lies in the cap's
/// plane may have moved by one, and hits have distances in floats.
constexpr double kBelow = 4;

}  // namespace

uint32_t CapOwners::owner(Vec3 point, Vec3 outward) const {
  const Vec3 p = point - scene_.origin - outward * (kBelow * scene_.tolerance);
  const std::optional<uint32_t> unit = formula_.owner_at(p, scene_.tolerance, [&](uint32_t number) {
    const Unit& u = scene_.units[number];
    if (!u.is_conjunction()) return scene_.boundaries[u.boundary].winding(p) != 0;
    for (uint32_t f = u.first_face; f < u.first_face + u.face_count; ++f)
      if (!contains(scene_, scene_.faces[f].literal, p)) return false;
    return true;
  });
  return unit ? scene_.units[*unit].id : 0;
}

}  // namespace whittle
