// Shaders, as the words of their SPIR-V.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device.h"
#include "gpu/owned.h"

namespace whittle::gpu {

/// The same shader with every sum, product and quotient of floats decorated NoContraction: no
/// driver may fuse or rearrange them, so all shaders that compute the same formula get the same
/// number. `words` is a valid module; a second time changes nothing.
std::vector<uint32_t> without_contraction(std::span<const uint32_t> words);

/// A module of `words`, without contraction.
Result<Owned<VkShaderModule>> make_shader(const Device& device, std::span<const uint32_t> words);

}  // namespace whittle::gpu
