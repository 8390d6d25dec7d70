#include "image/shade.h"

#include <algorithm>

#include "base/result.h"
#include "image/srgb.h"

namespace whittle {
namespace {

Vec3f linear(Vec3f srgb) {
  return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

/// The studio's own colours: a light backdrop, and for material the light grey of sprayed plastic,
/// a little warmer where it is cut: a photograph knows no cutters.
constexpr ColorScheme kStudioScheme{"",
                                    {252, 252, 253},
                                    {228, 231, 235},
                                    {204, 210, 218},
                                    {216, 211, 204},
                                    {204, 210, 218},
                                    {216, 211, 204},
                                    {86, 112, 146}};
/// The plain style's: a cool light grey for material, a warm one for cuts. A drawing has one tone,
/// and must stand out by that.
constexpr ColorScheme kPlainScheme{"",
                                   {250, 251, 252},
                                   {218, 222, 228},
                                   {196, 206, 218},
                                   {231, 199, 165},
                                   {196, 206, 218},
                                   {231, 199, 165},
                                   {86, 112, 146}};
/// As in the studio, but flat white behind: the paper's pictures stand on white.
constexpr ColorScheme kBlinnScheme{"",
                                   {255, 255, 255},
                                   {255, 255, 255},
                                   {196, 206, 218},
                                   {231, 199, 165},
                                   {196, 206, 218},
                                   {231, 199, 165},
                                   {86, 112, 146}};

ColorScheme own_scheme(const ShadeSettings& settings) {
  if (settings.scheme != nullptr) return *settings.scheme;
  switch (settings.style) {
    case Style::kStudio:
      return kStudioScheme;
    case Style::kPlain:
      return kPlainScheme;
    case Style::kBlinn:
      return kBlinnScheme;
    case Style::kOpenscad:
      break;
  }
  return color_schemes().front();
}

// The lights of studio and plain: directions in eye space (right, up, towards the viewer).
constexpr Vec3f kKeyDirection{-0.5f, 0.6f, 0.85f}, kFillDirection{0.85f, 0.05f, 0.55f},
    kRimDirection{0.35f, 0.45f, -0.85f};

}  // namespace

ColorScheme effective_scheme(const ShadeSettings& settings) {
  ColorScheme scheme = own_scheme(settings);
  if (settings.is_preview) scheme.front = scheme.lone, scheme.back = scheme.preview_back;
  if (settings.is_drawing) scheme.front = scheme.back = scheme.lone = scheme.plane;
  return scheme;
}

std::vector<Light> lights(const Camera& camera, const ShadeSettings& settings) {
  const auto direction = [&](Vec3f eye) {
    const Vec3 world =
        camera.right * double(eye.x) + camera.up * double(eye.y) - camera.forward * double(eye.z);
    return Light{normalize(world), true};
  };
  switch (settings.style) {
    case Style::kStudio:
    case Style::kPlain:
      return {direction(kKeyDirection), direction(kFillDirection), direction(kRimDirection)};
    case Style::kBlinn:
      return {{settings.light.value_or(camera.eye)}};
    case Style::kOpenscad:
      break;
  }
  return {};
}

Vec3f base_color(const Appearance& appearance, const ColorScheme& scheme) {
  const Rgba& own = appearance.color;
  if (!own.is_valid()) return to_unit(appearance.cut ? scheme.back : scheme.front);
  return {std::min(own.r, 1.0f), std::min(own.g, 1.0f), std::min(own.b, 1.0f)};
}

Shader::Shader(const Camera& camera, std::span<const Appearance> appearances,
               const ShadeSettings& settings)
    : camera_(camera), parameters_(camera), cut_faces_(settings.cut_faces) {
  ShadeParameters& p = parameters_;
  p.style = settings.style;
  p.has_background = settings.background;
  p.has_shadows = settings.shadows;
  p.inverse_height = 1 / float(camera.height);
  p.light_from_eye = PixelRays::to_float(settings.light.value_or(camera.eye) - camera.eye);
  const auto world_from_eye = [&](Vec3f v) {
    return normalize(p.rays.right * v.x + p.rays.up * v.y - p.rays.forward * v.z);
  };
  if (settings.is_drawing)
    p.ambient = 1;
  else
    p.headlight = world_from_eye({-1, 1, 1});
  p.key = world_from_eye(kKeyDirection);
  p.fill = world_from_eye(kFillDirection);
  p.rim = world_from_eye(kRimDirection);

  const ColorScheme scheme = effective_scheme(settings);
  const auto decode = [&](Vec3f c) { return is_linear(p.style) ? linear(c) : c; };
  p.top = decode(to_unit(scheme.background_top));
  p.bottom = decode(to_unit(scheme.background_bottom));
  const Vec3f material = decode(to_unit(scheme.front)), cut = decode(to_unit(scheme.back));
  p.materials.reserve(appearances.size() + 3);
  for (const Appearance& a : appearances) {
    const bool has_color =
        (p.style != Style::kOpenscad || settings.is_preview) && a.color.is_valid();
    p.materials.push_back(has_color ? decode(base_color(a, scheme)) : a.cut ? cut : material);
  }
  if (p.style == Style::kOpenscad && settings.lone_primitive &&
      *settings.lone_primitive < p.materials.size())
    p.materials[*settings.lone_primitive] = to_unit(scheme.lone);
  if (p.materials.empty()) p.materials.push_back({});  // the background's
  p.last = uint32_t(p.materials.size());
  cut_ = p.last + 1;
  p.materials.insert(p.materials.end(), {material, cut});
  if (settings.cut) {
    cap_look_.emplace(*settings.cut, settings.style);
    if (settings.hatch) cap_look_->hatch(appearances, camera.width, camera.height);
  }
}

template <class Place>
void Shader::look(std::span<const Hit> hits, const Place& place, const Reaching& reaching,
                  SeenHits& seen) const {
  const auto copy = [&](const auto& from, auto& to) {
    WHITTLE_CHECK(from.empty() || from.size() == hits.size());
    if (from.empty()) return;
    to.assign(hits.size() + kMostFloatLanes, 0);
    std::ranges::copy(from, to.begin());
  };
  seen.hits = hits;
  copy(reaching.shadows, seen.shadows);
  copy(reaching.openness, seen.openness);
  if (cut_faces_ == nullptr) return;
  seen.looks.resize(hits.size() + kMostFloatLanes);
  std::fill(seen.looks.begin() + std::ptrdiff_t(hits.size()), seen.looks.end(), 0);
  for (size_t i = 0; i < hits.size(); ++i) seen.looks[i] = std::min(hits[i].id, parameters_.last);
  for (size_t i = 0; i < hits.size(); ++i) {
    if (!hits[i].hit() || !cut_faces_->is_contested(hits[i].id)) continue;
    const PixelPosition at = place(i);
    const Ray ray = camera_.ray(at.x, at.y);
    const Vec3 point = ray.origin + ray.direction * double(hits[i].distance);
    seen.looks[i] = cut_faces_->is_cut(hits[i].id, point) ? cut_ : parameters_.last;
  }
}

void Shader::row(std::span<const Hit> hits, std::span<const uint8_t> shadows, int y, SeenHits& seen,
                 uint8_t* rgba) const {
  const auto place = [y](size_t x) { return PixelPosition{float(x) + 0.5f, float(y) + 0.5f}; };
  if (cap_look_ && cap_look_->any(hits)) {
    std::vector<PixelPosition> places;
    for (size_t x = 0; x < hits.size(); ++x) places.push_back(place(x));
    Colors colors;
    samples(hits, places, {shadows, {}}, seen, colors);
    return store(colors, rgba);
  }
  look(hits, place, {shadows, {}}, seen);
  shade_row(parameters_, seen, y, rgba);
}

void Shader::samples(std::span<const Hit> hits, std::span<const PixelPosition> places,
                     const Reaching& reaching, SeenHits& seen, Colors& colors) const {
  look(
      hits, [&](size_t i) { return places[i]; }, reaching, seen);
  shade_samples(parameters_, seen, places, colors);
  if (cap_look_) cap_look_->paint(hits, places, reaching.openness, parameters_, colors);
}

void Shader::store(const Colors& colors, uint8_t* rgba) const {
  store_colors(parameters_, colors, rgba);
}

Picture shade(const Frame& frame, const Camera& camera, std::span<const Appearance> appearances,
              const ShadeSettings& settings, const Workers& workers,
              std::span<const uint8_t> shadows) {
  WHITTLE_CHECK(shadows.empty() || shadows.size() == frame.hits.size());
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  const Shader shader(camera, appearances, settings);
  Picture picture = Picture::unfilled(frame.width, frame.height);
  constexpr size_t kRowsPerTask = 16;
  workers.for_parts(size_t(frame.height), kRowsPerTask, [&](size_t first, size_t last, size_t) {
    SeenHits seen;
    for (size_t y = first; y < last; ++y) {
      const std::span<const Hit> hits(&frame.at(0, int(y)), size_t(frame.width));
      const std::span<const uint8_t> row =
          shadows.empty() ? shadows : shadows.subspan(y * hits.size(), hits.size());
      shader.row(hits, row, int(y), seen, picture.at(0, int(y)));
    }
  });
  return picture;
}

}  // namespace whittle
