#include "trace/vulkan/pipelines.h"

#include <cstddef>
#include <utility>

#include "gpu/shader.h"
#include "trace/vulkan/shaders.h"

namespace whittle {
namespace {

using gpu::Device;
using gpu::Owned;

Status make_layouts(const Device& device, bool storage, Pipelines& p) {
  std::array<VkDescriptorSetLayoutBinding, shader::kBindings> bindings{};
  for (uint32_t i = 0; i < shader::kBindings; ++i) {
    bindings[i].binding = i;
    bindings[i].descriptorType = descriptor_type(i, storage);
    bindings[i].descriptorCount = 1;
    bindings[i].stageFlags = i >= shader::kSeenBinding
                                 ? VkShaderStageFlags(VK_SHADER_STAGE_COMPUTE_BIT)
                                 : VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT |
                                       VK_SHADER_STAGE_COMPUTE_BIT;
  }
  VkDescriptorSetLayoutCreateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set_info.bindingCount = shader::kBindings;
  set_info.pBindings = bindings.data();
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkResult result = vkCreateDescriptorSetLayout(device.handle(), &set_info, nullptr, &set_layout);
  if (result != VK_SUCCESS) return device.error(result, "lay out bindings");
  p.set_layout = {device.handle(), set_layout, vkDestroyDescriptorSetLayout};

  VkPipelineLayoutCreateInfo layout_info{};
  layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  result = vkCreatePipelineLayout(device.handle(), &layout_info, nullptr, &layout);
  if (result != VK_SUCCESS) return device.error(result, "lay out bindings");
  p.layout = {device.handle(), layout, vkDestroyPipelineLayout};

  return Done{};
}

VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, VkShaderModule shader) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = shader;
  info.pName = "main";
  return info;
}

Result<Owned<VkPipeline>> make_compute(const Device& device, VkPipelineLayout layout,
                                       std::span<const uint32_t> words) {
  Result<Owned<VkShaderModule>> shader = gpu::make_shader(device, words);
  if (!shader) return shader.error();
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags = VK_PIPELINE_CREATE_DISPATCH_BASE_BIT;
  info.stage = stage_of(VK_SHADER_STAGE_COMPUTE_BIT, shader->get());
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  if (result != VK_SUCCESS) return device.error(result, "compile shaders");
  return Owned<VkPipeline>(device.handle(), pipeline, vkDestroyPipeline);
}

}  // namespace

VkDescriptorType descriptor_type(uint32_t binding, bool storage) {
  switch (binding) {
    case shader::kViewBinding:
      return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case shader::kSeenBinding:
    case shader::kDepthsBinding:
      return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    case shader::kHalfSpacesBinding:
    case shader::kCellsBinding:
    case shader::kWordsBinding:
    case shader::kPositionsBinding:
      return storage ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    default:
      return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  }
}

Result<Pipelines> make_pipelines(const Device& device, bool doubles, bool storage) {
  Pipelines p;
  if (Status made = make_layouts(device, storage, p); !made) return made.error();
  const ShaderSet code = shaders(doubles, storage);
  for (auto [words, to] : {std::pair(code.cells, &p.cells), std::pair(code.visible, &p.visible)}) {
    Result<Owned<VkShaderModule>> made = gpu::make_shader(device, words);
    if (!made) return made.error();
    *to = *std::move(made);
  }
  for (auto [words, to] : {std::pair(code.resolve, &p.resolve), std::pair(code.pyramid, &p.pyramid),
                           std::pair(code.hidden, &p.hidden)}) {
    Result<Owned<VkPipeline>> made = make_compute(device, p.layout.get(), words);
    if (!made) return made.error();
    *to = *std::move(made);
  }
  return p;
}

Status add_draw(const Device& device, LeafCase leaf, Pipelines& p) {
  const uint32_t constants[] = {uint32_t(formula_case(leaf)), uint32_t(surface_case(leaf))};
  const VkSpecializationMapEntry entries[] = {
      {shader::kFormulasConstant, 0, sizeof(uint32_t)},
      {shader::kSurfacesConstant, sizeof(uint32_t), sizeof(uint32_t)}};
  const VkSpecializationInfo special{2, entries, sizeof(constants), constants};
  VkPipelineShaderStageCreateInfo stages[] = {
      stage_of(VK_SHADER_STAGE_VERTEX_BIT, p.cells.get()),
      stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, p.visible.get())};
  stages[1].pSpecializationInfo = &special;
  const VkVertexInputBindingDescription instances{0, sizeof(CellInstance),
                                                  VK_VERTEX_INPUT_RATE_INSTANCE};
  const VkVertexInputAttributeDescription attributes[] = {
      {0, 0, VK_FORMAT_R32_UINT, offsetof(CellInstance, cell)},
      {1, 0, VK_FORMAT_R32_SFLOAT, offsetof(CellInstance, depth)}};
  VkPipelineVertexInputStateCreateInfo vertices{};
  vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  vertices.vertexBindingDescriptionCount = 1;
  vertices.pVertexBindingDescriptions = &instances;
  vertices.vertexAttributeDescriptionCount = 2;
  vertices.pVertexAttributeDescriptions = attributes;
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{};
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{};
  samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth{};
  depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_LESS;
  VkPipelineColorBlendAttachmentState no_blending{};
  no_blending.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = 1;
  blend.pAttachments = &no_blending;
  const VkDynamicState dynamic_states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = 2;
  dynamic.pDynamicStates = dynamic_states;
  VkPipelineRenderingCreateInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachmentFormats = &kSeenFormat;
  rendering.depthAttachmentFormat = kDepthFormat;
  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &rendering;
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &vertices;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = p.layout.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult result =
      vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  if (result != VK_SUCCESS) return device.error(result, "compile shaders");
  p.draw[leaf] = {device.handle(), pipeline, vkDestroyPipeline};
  return Done{};
}

}  // namespace whittle
