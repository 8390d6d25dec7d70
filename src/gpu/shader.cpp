#include "gpu/shader.h"

#include <unordered_set>

namespace whittle::gpu {
namespace {

// From the SPIR-V specification, sections 2.3, 3.20 and 3.32.
constexpr size_t kHeaderWords = 5;
constexpr uint32_t kOpDecorate = 71, kOpTypeVoid = 19, kOpTypeForwardPointer = 39;
constexpr uint32_t kNoContraction = 42;

bool computes_with_floats(uint32_t op) {
  constexpr uint32_t kOpFNegate = 127, kOpFAdd = 129, kOpFSub = 131, kOpFMul = 133, kOpFDiv = 136,
                     kOpVectorTimesScalar = 142, kOpDot = 148;
  return op == kOpFNegate || op == kOpFAdd || op == kOpFSub || op == kOpFMul || op == kOpFDiv ||
         (op >= kOpVectorTimesScalar && op <= kOpDot);
}

}  // namespace

std::vector<uint32_t> without_contraction(std::span<const uint32_t> words) {
  std::vector<uint32_t> computed;  // result ids
  std::unordered_set<uint32_t> decorated;
  size_t first_type = 0;  // decorations stand before all types
  for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16) {
    const uint32_t op = words[at] & 0xffff;
    if (op == kOpDecorate && words[at + 2] == kNoContraction) decorated.insert(words[at + 1]);
    if (first_type == 0 && op >= kOpTypeVoid && op <= kOpTypeForwardPointer) first_type = at;
    if (computes_with_floats(op)) computed.push_back(words[at + 2]);
  }
  std::vector<uint32_t> result(words.begin(), words.begin() + std::ptrdiff_t(first_type));
  for (const uint32_t id : computed)
    if (!decorated.contains(id))
      result.insert(result.end(), {3u << 16 | kOpDecorate, id, kNoContraction});
  result.insert(result.end(), words.begin() + std::ptrdiff_t(first_type), words.end());
  return result;
}

Result<Owned<VkShaderModule>> make_shader(const Device& device, std::span<const uint32_t> words) {
  const std::vector<uint32_t> code = without_contraction(words);
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.size() * sizeof(uint32_t);
  info.pCode = code.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  const VkResult result = vkCreateShaderModule(device.handle(), &info, nullptr, &shader);
  if (result != VK_SUCCESS) return device.error(result, "load a shader");
  return Owned<VkShaderModule>(device.handle(), shader, vkDestroyShaderModule);
}

}  // namespace whittle::gpu
