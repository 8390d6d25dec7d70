#include "draw_picture.h"

#include <algorithm>
#include <utility>

namespace whittle {

Result<Drawn> draw_picture(const RenderArguments& a, const std::vector<Output>& outputs,
                           const Camera& camera, Renderer& renderer, ProgressLine& progress) {
  Drawn drawn;
  progress.stage("tracing");
  Result<Frame> traced = renderer.trace(camera, {.progress = progress.share()});
  if (!traced) return traced.error();
  drawn.frame = *std::move(traced);
  const bool shows_color =
      a.pass == Pass::kColor || std::ranges::any_of(outputs, [](const Output& output) {
        return output.is(FileFormat::kExr);
      });
  if (!shows_color) return drawn;
  progress.stage("shading");
  const int rays =
      a.antialias > 0 ? a.antialias : default_antialias(a.shading.style, a.shading.quality);
  Result<Picture> shaded = a.xray ? renderer.xray(camera, a.shading, rays)
                                  : renderer.shade(drawn.frame, camera, a.shading, rays);
  if (!shaded) return shaded.error();
  const bool has_colors = !a.xray && (a.shading.style != Style::kOpenscad || a.shading.is_preview);
  if (has_colors) drawn.note = renderer.picture_note();
  drawn.picture = *std::move(shaded);
  if (a.overlays.any())
    draw_overlays(a.overlays, camera, drawn.frame, renderer.framed_box(), drawn.picture);
  return drawn;
}

Picture shown(const RenderArguments& a, const Frame& frame, const Picture& picture) {
  return a.pass == Pass::kColor ? picture : pass_picture(frame, a.pass, !a.no_background);
}

Status write_pictures(const RenderArguments& a, const std::vector<Output>& outputs,
                      const Drawn& drawn) {
  for (const Output& output : outputs) {
    if (!output.is_picture()) continue;
    const Result<std::string> bytes =
        encode(std::get<FileFormat>(output.format), drawn.frame,
               output.is(FileFormat::kPng) ? shown(a, drawn.frame, drawn.picture) : drawn.picture,
               a.no_background, output.path, a.renderer.threads);
    if (!bytes) return bytes.error();
    if (Status written = write_output(output.path, *bytes); !written) return written;
  }
  return Done{};
}

}  // namespace whittle
