// One picture: from a camera to what its files show.
#pragma once

#include <string>
#include <vector>

#include "progress.h"
#include "render_arguments.h"

namespace whittle {

/// Facts, and the colours if any output shows them.
struct Drawn {
  Frame frame;
  Picture picture;
  std::string note{};  ///< how the colours are not what was asked for; empty: they are
};

/// Traces and shades, and lays over it what is asked for. Precondition: prepare() was called.
Result<Drawn> draw_picture(const RenderArguments& a, const std::vector<Output>& outputs,
                           const Camera& camera, Renderer& renderer, ProgressLine& progress);

/// What a PNG or a film shows.
Picture shown(const RenderArguments& a, const Frame& frame, const Picture& picture);

/// The outputs that are pictures.
Status write_pictures(const RenderArguments& a, const std::vector<Output>& outputs,
                      const Drawn& drawn);

}  // namespace whittle
