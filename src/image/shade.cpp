#include "image/shade.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/result.h"
#include "image/srgb.h"

namespace whittle {
namespace {

Vec3f multiply(Vec3f a, Vec3f b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

Vec3f mix(Vec3f a, Vec3f b, float t) {
  return a + (b - a) * t;
}

float positive(float v) {
  return v > 0 ? v : 0;
}

Vec3f linear(Vec3f srgb) {
  return {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
}

/// The studio's own colours: a light backdrop, a cool light grey for material, a warm one for cuts.
constexpr ColorScheme kStudioScheme{
    "", {250, 251, 252}, {218, 222, 228}, {196, 206, 218}, {231, 199, 165}, {196, 206, 218}};
/// As in the studio, but flat white behind: the paper's pictures stand on white.
constexpr ColorScheme kBlinnScheme{
    "", {255, 255, 255}, {255, 255, 255}, {196, 206, 218}, {231, 199, 165}, {196, 206, 218}};

// The studio. Colours are linear; lights are directions in eye space (right, up, towards the
// viewer).
constexpr Vec3f kKeyDirection{-0.5f, 0.6f, 0.85f}, kKeyColor{0.82f, 0.80f, 0.77f};
constexpr Vec3f kFillDirection{0.85f, 0.05f, 0.55f}, kFillColor{0.11f, 0.12f, 0.14f};
constexpr Vec3f kRimDirection{0.35f, 0.45f, -0.85f}, kRimColor{0.20f, 0.21f, 0.23f};
constexpr Vec3f kSkyColor{0.29f, 0.305f, 0.33f}, kGroundColor{0.11f, 0.105f, 0.10f};
/// The key light is as large as this share of a half-sphere: it reaches a little round the corner.
constexpr float kKeyWrap = 0.15f;
/// Reflection of a dielectric such as plastic, seen straight and at grazing angles.
constexpr float kReflectance = 0.04f, kGrazingReflectance = 0.35f;
constexpr float kHighlight = 0.16f;

}  // namespace

ColorScheme effective_scheme(const ShadeSettings& settings) {
  if (settings.scheme != nullptr) return *settings.scheme;
  switch (settings.style) {
    case Style::kStudio:
      return kStudioScheme;
    case Style::kBlinn:
      return kBlinnScheme;
    case Style::kOpenscad:
      break;
  }
  return color_schemes().front();
}

Vec3f base_color(const Appearance& appearance, const ColorScheme& scheme) {
  const Rgba& own = appearance.color;
  if (!own.is_valid()) return to_unit(appearance.cut ? scheme.back : scheme.front);
  return {std::min(own.r, 1.0f), std::min(own.g, 1.0f), std::min(own.b, 1.0f)};
}

Shader::Shader(const Camera& camera, std::span<const Appearance> appearances,
               const ShadeSettings& settings)
    : style_(settings.style),
      has_background_(settings.background),
      inverse_height_(1 / float(camera.height)),
      camera_(camera),
      rays_(camera),
      light_from_eye_(PixelRays::to_float(settings.light.value_or(camera.eye) - camera.eye)),
      cut_faces_(settings.cut_faces) {
  const auto world_from_eye = [&](Vec3f v) {
    return normalize(rays_.right * v.x + rays_.up * v.y - rays_.forward * v.z);
  };
  headlight_ = world_from_eye({-1, 1, 1});
  key_ = world_from_eye(kKeyDirection);
  fill_ = world_from_eye(kFillDirection);
  rim_ = world_from_eye(kRimDirection);

  const ColorScheme scheme = effective_scheme(settings);
  const auto decode = [&](Vec3f c) { return style_ == Style::kStudio ? linear(c) : c; };
  top_ = decode(to_unit(scheme.background_top));
  bottom_ = decode(to_unit(scheme.background_bottom));
  material_ = decode(to_unit(scheme.front));
  cut_ = decode(to_unit(scheme.back));
  base_.reserve(appearances.size());
  for (const Appearance& a : appearances) {
    const Vec3f openscad = a.cut ? cut_ : material_;
    base_.push_back(style_ == Style::kOpenscad ? openscad : decode(base_color(a, scheme)));
  }
  if (style_ == Style::kOpenscad && settings.lone_primitive &&
      *settings.lone_primitive < base_.size())
    base_[*settings.lone_primitive] = to_unit(scheme.lone);
}

Vec3f Shader::background(float py) const {
  return mix(top_, bottom_, py * inverse_height_);
}

Vec3f Shader::surface(const Hit& hit, float px, float py) const {
  const Vec3f base = hit.id < base_.size() ? base_[hit.id] : material_;
  switch (style_) {
    case Style::kStudio:
      return studio(hit, base, px, py);
    case Style::kBlinn:
      return blinn(hit, base, px, py);
    case Style::kOpenscad:
      break;
  }
  return openscad(hit, base, px, py);
}

// OpenSCAD: rgb = base * (0.2 + |n.l|), two opposite lights fixed to the camera.
Vec3f Shader::openscad(const Hit& hit, Vec3f base, float px, float py) const {
  if (cut_faces_ != nullptr && cut_faces_->is_contested(hit.id)) {
    const Ray ray = camera_.ray(px, py);
    const Vec3 point = ray.origin + ray.direction * double(hit.distance);
    base = cut_faces_->is_cut(hit.id, point) ? cut_ : material_;
  }
  return base * (0.2f + std::fabs(dot(hit.normal, headlight_)));
}

// The paper's algorithm 4, with l from the hit to the light and v from the hit to the eye. Seen
// from inside the solid the normal is turned to the eye, as the inner side is what is seen.
Vec3f Shader::blinn(const Hit& hit, Vec3f base, float px, float py) const {
  const Vec3f d = rays_.direction(px, py);
  const Vec3f n = dot(hit.normal, d) > 0 ? -hit.normal : hit.normal;
  const Vec3f l = normalize(light_from_eye_ - rays_.point(d, hit.distance, px, py));
  const float n_l = dot(n, l);
  if (!(n_l > 0)) return base * kBlinnAmbient;
  float highlight = positive(dot(n, normalize(l - d)));
  static_assert(kBlinnExponent == 16);
  for (int i = 0; i < 4; ++i) highlight *= highlight;
  const float white = kBlinnSpecular * highlight;
  return base * (kBlinnAmbient + kBlinnDiffuse * n_l) + Vec3f{white, white, white};
}

// A key, a fill and a rim light and a sky above a ground, over a smooth dielectric that mirrors sky
// and ground a little, more at grazing angles.
Vec3f Shader::studio(const Hit& hit, Vec3f base, float px, float py) const {
  const Vec3f d = rays_.direction(px, py);
  Vec3f n = hit.normal;
  float n_d = dot(n, d);
  if (n_d > 0) n = -n, n_d = -n_d;

  const float key = positive((dot(n, key_) + kKeyWrap) / (1 + kKeyWrap));
  const float fill = positive(dot(n, fill_)), rim = positive(dot(n, rim_));
  const Vec3f light = mix(kGroundColor, kSkyColor, 0.5f + 0.5f * n.z) + kKeyColor * key +
                      kFillColor * fill + kRimColor * rim;

  const Vec3f mirrored = d - n * (2 * n_d);
  const float grazing = 1 + n_d, grazing2 = grazing * grazing;
  const float reflectance =
      kReflectance + (kGrazingReflectance - kReflectance) * grazing2 * grazing2 * grazing;
  float highlight = positive(dot(mirrored, key_));
  for (int i = 0; i < 5; ++i) highlight *= highlight;
  const Vec3f reflected =
      mix(kGroundColor, kSkyColor, 0.5f + 0.5f * mirrored.z) * (2 * reflectance) +
      kKeyColor * (highlight * kHighlight);
  return multiply(base, light) * (1 - reflectance) + reflected;
}

void Shader::store(Vec3f color, float alpha, uint8_t* rgba) const {
  if (style_ == Style::kStudio) {
    const SrgbEncoder& encode = srgb_encoder();
    rgba[0] = encode(color.x), rgba[1] = encode(color.y), rgba[2] = encode(color.z);
  } else {
    rgba[0] = to_8_bits(color.x), rgba[1] = to_8_bits(color.y), rgba[2] = to_8_bits(color.z);
  }
  rgba[3] = to_8_bits(alpha);
}

Picture shade(const Frame& frame, const Camera& camera, std::span<const Appearance> appearances,
              const ShadeSettings& settings, const Workers& workers) {
  WHITTLE_CHECK(frame.width == camera.width && frame.height == camera.height);
  const Shader shader(camera, appearances, settings);
  Picture picture(frame.width, frame.height);
  const auto shade_row = [&](int y) {
    const float py = float(y) + 0.5f;
    uint8_t behind[4] = {};
    if (shader.has_background()) shader.store(shader.background(py), 1, behind);
    for (int x = 0; x < frame.width; ++x) {
      const Hit& hit = frame.at(x, y);
      if (hit.hit()) {
        shader.store(shader.color(hit, float(x) + 0.5f, py), 1, picture.at(x, y));
      } else {
        std::memcpy(picture.at(x, y), behind, sizeof behind);
      }
    }
  };
  constexpr size_t kRowsPerTask = 16;
  workers.for_parts(size_t(frame.height), kRowsPerTask, [&](size_t first, size_t last, size_t) {
    for (size_t y = first; y < last; ++y) shade_row(int(y));
  });
  return picture;
}

}  // namespace whittle
