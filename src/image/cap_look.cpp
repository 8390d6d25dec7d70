#include "image/cap_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "image/style.h"

namespace whittle {
namespace {

/// The share of light that a cap reflects of what falls on it: about that of a face that is seen
/// straight. Display values hold more of it.
constexpr float kLinearLight = 0.80f, kDisplayLight = 0.92f;
/// What a hatch's line leaves of that.
constexpr float kLinearInk = 0.30f, kDisplayInk = 0.55f;
/// How much of the light comes from surroundings that something may hide.
constexpr float kFromAround = 0.4f;

constexpr float kSpacings = 50, kLeastSpacing = 6, kLineShare = 0.16f, kLeastLine = 1.1f;

constexpr std::array<float, 8> kDegrees = {45, 135, 20, 110, 70, 160, 0, 90};

}  // namespace

float hatch_line(PixelPosition place, uint32_t kind, float spacing, float line) {
  const double angle = double(kDegrees[kind % kDegrees.size()]) * std::acos(-1.0) / 180;
  // Across the lines. The picture's y points down.
  const double across = double(place.x) * std::sin(angle) + double(place.y) * std::cos(angle);
  const double step = across / double(spacing);
  const float off = float(std::fabs(step - std::round(step))) * spacing;
  return std::clamp(line / 2 + 0.5f - off, 0.0f, std::min(line, 1.0f));
}

CapLook::CapLook(const Cut& ids, Style style) : ids_(ids), is_linear_(is_linear(style)) {}

void CapLook::hatch(std::span<const Appearance> looks, int width, int height) {
  spacing_ = std::max(kLeastSpacing, float(std::min(width, height)) / kSpacings);
  line_ = std::max(kLeastLine, kLineShare * spacing_);
  std::map<std::array<float, 3>, uint8_t> kind_of;
  kinds_.assign(ids_.first_plane, 0);
  for (uint32_t id = 1; id < ids_.first_plane && id < looks.size(); ++id) {
    const Rgba& c = looks[id].color;
    const std::array<float, 3> color =
        c.is_valid() ? std::array{c.r, c.g, c.b} : std::array{-1.0f, -1.0f, -1.0f};
    kinds_[id] = kind_of.emplace(color, uint8_t(kind_of.size() % kDegrees.size())).first->second;
  }
}

bool CapLook::any(std::span<const Hit> hits) const {
  return std::ranges::any_of(hits, [&](const Hit& hit) { return ids_.is_cap(hit.id); });
}

void CapLook::paint(std::span<const Hit> hits, std::span<const PixelPosition> places,
                    std::span<const float> openness, const ShadeParameters& shader,
                    Colors& colors) const {
  for (size_t i = 0; i < hits.size(); ++i) {
    const uint32_t id = hits[i].id;
    if (!ids_.is_cap(id)) continue;
    const float open = openness.empty() ? 1 : openness[i];
    float light = (is_linear_ ? kLinearLight : kDisplayLight) *
                  (1 - kFromAround + kFromAround * std::min(open, 1.0f));
    if (!kinds_.empty()) {
      const float ink = is_linear_ ? kLinearInk : kDisplayInk;
      const uint32_t statement = ids_.statement_of(id);
      const uint32_t kind = statement < kinds_.size() ? kinds_[statement] : 0;
      const float line = hatch_line(places[i], kind, spacing_, line_);
      light *= 1 - (1 - ink) * line;
    }
    const Vec3f color = shader.materials[std::min(id, shader.last)] * light;
    colors.r[i] = color.x, colors.g[i] = color.y, colors.b[i] = color.z;
  }
}

}  // namespace whittle
