// Pictures that show all walls of a solid at once, as an X-ray does: the outer ones are faint, and
// inner ones show through.
//
// Each surface that a ray crosses is a film that holds back a share of the light behind it, more
// the longer the ray's way through it: 1 - exp(-thickness / c), where c is the cosine between ray
// and normal (Beer and Lambert's law). So walls that are seen edge on, silhouettes above all, are
// dark.
#pragma once

#include <span>
#include <stop_token>

#include "image/picture.h"
#include "image/shade.h"
#include "trace/tracer.h"

namespace whittle {

/// The optical thickness of a surface.
inline constexpr double kXrayThickness = 0.12;
/// A film has this share of its surface's colour, in linear light.
inline constexpr float kXrayInk = 0.22f;

/// The share of the light that a surface holds back, 0 to 1.
float xray_opacity(double cosine);

/// The picture: of each film its colour, over what is behind it. Pixels whose neighbours see other
/// surfaces, or another tone, are the mean of n * n rays. Facts come from Tracer::cast_through, so
/// every backend's picture is the same. Of the settings only scheme, style's scheme and background
/// count. Deterministic. Once a stop is requested it returns soon, and the picture is of no use.
Picture xray_picture(Tracer& tracer, const Camera& camera, std::span<const Appearance> appearances,
                     const ShadeSettings& settings, int n, const Workers& workers,
                     const std::stop_token& stop = {});

}  // namespace whittle
