#include "trace/vulkan/draw_list.h"

#include <algorithm>
#include <utility>

#include "gpu/commands.h"

namespace whittle {
namespace {

/// Of a picture like no other before it, so many of the cells are drawn in the first pass.
constexpr double kFrontShare = 0.1;

/// Ranks from front to back that a 32-bit float between 0 and 1 tells apart.
constexpr uint32_t kMostRanks = (1u << 24) - 1;

/// Invocations in a workgroup of shaders/hidden.comp.
constexpr uint32_t kTestGroup = shader::kGroupSide * shader::kGroupSide;

/// Makes room in a buffer, half as much again as it has, and binds it.
Status reserve(const RasterDevice& device, const Bindings& bindings, uint32_t binding,
               gpu::Buffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage) {
  if (buffer.bytes() >= bytes) return Done{};
  Result<gpu::Buffer> made =
      gpu::Buffer::make(device.gpu(), std::max(bytes, buffer.bytes() * 3 / 2),
                        usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::Placement::kUpload);
  if (!made) return made.error();
  buffer = *std::move(made);
  bindings.bind(binding, buffer);
  return Done{};
}

}  // namespace

Status DrawList::fill(RasterDevice& device, const Bindings& bindings,
                      std::span<const VisibleCell> cells, uint32_t rank,
                      std::span<const uint32_t> last_seen, uint32_t since, Hiding hiding) {
  if (cells.size() > kMostRanks - rank)
    return Error{ErrorKind::kMachine, "more cells than a depth buffer can tell apart"};
  device_ = &device;
  bindings_ = &bindings;
  hiding_ = hiding;
  if (Status done =
          reserve(device, bindings, shader::kInstancesBinding, instances_,
                  2 * (cells.size() + 1) * sizeof(CellInstance), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
      !done)
    return done;
  // Where the next cell of each pass of each possible draw goes; first, how many there are.
  std::array<std::array<uint32_t, 2>, 2 * kLeafCases> next{};
  const auto was_seen = [&](const VisibleCell& cell) { return last_seen[cell.cell] >= since; };
  const size_t front =
      std::ranges::any_of(cells, was_seen) ? 0 : size_t(kFrontShare * double(cells.size()));
  const auto place_of = [&](size_t i) -> uint32_t& {
    const VisibleCell& cell = cells[i];
    const uint32_t draw = 2u * device.shader_for(cell.leaf_case) + (cell.is_wide ? 0 : 1);
    const bool is_first = hiding == Hiding::kNone || cell.is_wide || i < front || was_seen(cell);
    return next[draw][is_first ? kFirst : kSecond];
  };
  for (size_t i = 0; i < cells.size(); ++i) ++place_of(i);
  draws_.clear();
  uint32_t first = 0;
  for (uint32_t i = 0; i < next.size(); ++i) {
    const auto [in_first, in_second] = next[i];
    next[i] = {first, first + in_first};
    if (in_first + in_second == 0) continue;
    draws_.push_back({LeafCase(i / 2), i % 2 == 0, first, {in_first, in_second}});
    if (Status done = device.need(LeafCase(i / 2)); !done) return done;
    first += in_first + in_second;
  }
  instance_count_ = first;
  // A power of two: every depth is exact.
  constexpr double kStep = 1.0 / (kMostRanks + 1);
  auto* const to = static_cast<CellInstance*>(instances_.mapped());
  for (size_t i = 0; i < cells.size(); ++i)
    to[place_of(i)++] = {cells[i].cell, float(kStep * ++rank)};

  if (Status done =
          reserve(device, bindings, shader::kDrawsBinding, commands_,
                  2 * (draws_.size() + 1) * sizeof(Command), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
      !done)
    return done;
  write_commands();
  return Done{};
}

void DrawList::write_commands() {
  for (const Pass pass : {kFirst, kSecond}) {
    for (size_t i = 0; i < draws_.size(); ++i) {
      const Draw& draw = draws_[i];
      const uint32_t count = draw.count[pass];
      const bool tested = is_tested(draw, pass);
      Command& c = command(pass)[i];
      c.draw = {draw.is_wide ? kSquareIndices : kBoxIndices, tested ? 0 : count,
                draw.is_wide ? kBoxIndices : 0, 0, 0};
      c.first = draw.first + (pass == kSecond ? draw.count[kFirst] : 0);
      c.count = tested ? count : 0;
      c.to = instance_count_ + c.first;
    }
  }
}

uint32_t DrawList::source(const Draw& draw, Pass pass) const {
  const uint32_t first = draw.first + (pass == kSecond ? draw.count[kFirst] : 0);
  return is_tested(draw, pass) ? instance_count_ + first : first;
}

void DrawList::record_test(VkCommandBuffer commands, Pass pass) const {
  uint32_t most = 0;
  for (const Draw& draw : draws_) most = std::max(most, draw.count[pass]);
  if (most == 0) return;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, device_->pipelines().hidden.get());
  vkCmdDispatchBase(commands, 0, uint32_t(pass) * size(), 0, (most + kTestGroup - 1) / kTestGroup,
                    size(), 1);
  gpu::wait_for(
      commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
      VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
      VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT);
}

void DrawList::record(VkCommandBuffer commands, Pass pass) const {
  const VkBuffer instances = instances_.handle();
  for (size_t i = 0; i < draws_.size(); ++i) {
    if (draws_[i].count[pass] == 0) continue;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      device_->pipelines().draw[draws_[i].shader].get());
    // An offset, and not a first instance in the command: that would be one more feature to need.
    const VkDeviceSize first = source(draws_[i], pass) * sizeof(CellInstance);
    vkCmdBindVertexBuffers(commands, 0, 1, &instances, &first);
    vkCmdDrawIndexedIndirect(commands, commands_.handle(),
                             (pass * draws_.size() + i) * sizeof(Command), 1, 0);
  }
}

uint64_t DrawList::drawn(Pass pass) const {
  uint64_t sum = 0;
  for (size_t i = 0; i < draws_.size(); ++i) sum += command(pass)[i].draw.instanceCount;
  return sum;
}

}  // namespace whittle
