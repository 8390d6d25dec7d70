// The scene on the device: the buffers that the shaders read half-spaces, cells and literals from.
#pragma once

#include "gpu/commands.h"
#include "trace/vulkan/bindings.h"
#include "trace/vulkan/flatten.h"

namespace whittle {

class SceneData {
 public:
  /// Sends all that shaders read of `flat` and binds it. A kMachine error if the device has no room
  /// for it, or if its cells cannot be told apart by their ranks.
  static Result<SceneData> make(const RasterDevice& device, gpu::Commands& commands,
                                const Bindings& bindings, const FlatCells& flat);

 private:
  ReadBuffer half_spaces_, cells_, words_;
};

}  // namespace whittle
