// The layers of a model whose parts are see-through, each with a tracer of its own, and what
// pictures are made of from them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "base/result.h"
#include "image/shade.h"
#include "image/veil.h"
#include "model/layers.h"
#include "whittle/renderer.h"

namespace whittle {

class SeeThrough {
 public:
  /// Layers are seen by the oracle if that is the backend, and else by the CPU, whose pictures are
  /// the same as a device's. `layers` must have some to be seen through.
  static Result<std::unique_ptr<SeeThrough>> make(const Model& model,
                                                  std::shared_ptr<const Layers> layers,
                                                  std::span<const Appearance> looks,
                                                  const RendererSettings& settings);

  /// What the camera sees of each layer. Where the whole solid is opaque, `whole` and `frame` are
  /// it: they must live as long as what this returns does.
  struct Sight {
    Tracer* opaque = nullptr;
    const Frame* frame = nullptr;
    std::unique_ptr<Veil> veil;
  };
  Result<Sight> look_from(const Camera& camera, const ShadeSettings& settings, Tracer& whole,
                          const Frame& frame);

 private:
  struct Part {
    uint32_t first_look = 0;
    bool is_ghost = false;
    std::optional<Renderer> renderer;
    bool is_prepared = false;
  };
  SeeThrough() = default;
  Result<Frame> trace(Part& part, const Camera& camera);

  std::shared_ptr<const Layers> layers_;
  std::vector<Appearance> looks_;  ///< the solid's, the ghosts' and the highlights'
  double tolerance_ = 0;
  Part opaque_;
  std::vector<Part> parts_;
  Frame frame_;  ///< of what is opaque
};

}  // namespace whittle
