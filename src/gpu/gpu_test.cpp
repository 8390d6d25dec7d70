// The plumbing on the device that is here; in CI that is Mesa's software device. Where there is
// none these tests fail: a build with Vulkan is tested with Vulkan.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "gpu/commands.h"

namespace whittle::gpu {
namespace {

class Gpu : public testing::Test {
 protected:
  void SetUp() override {
    Result<std::unique_ptr<Device>> opened = Device::open({.wanted = "", .validate = true});
    ASSERT_TRUE(opened) << opened.error().message;
    device_ = *std::move(opened);
  }
  void TearDown() override {
    if (!device_) return;
    for (const std::string& message : device_->messages()) ADD_FAILURE() << message;
  }

  std::unique_ptr<Device> device_;
};

TEST_F(Gpu, IsOneOfTheListed) {
  const Result<std::vector<DeviceInfo>> devices = list_devices();
  ASSERT_TRUE(devices) << devices.error().message;
  const size_t chosen = *choose_device(*devices, "");
  EXPECT_EQ((*devices)[chosen].name, device_->info().name);
  EXPECT_FALSE((*devices)[chosen].driver.empty());
  EXPECT_GE((*devices)[chosen].api_minor, 3u);
}

TEST_F(Gpu, BytesComeBackAsTheyWere) {
  const std::array<uint32_t, 4> sent = {1, 2, 3, 0xffffffff};
  Result<Commands> commands = Commands::make(*device_, 2);
  Result<Buffer> there = Buffer::make(
      *device_, sizeof(sent), VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
      Placement::kDevice);
  Result<Buffer> back =
      Buffer::make(*device_, sizeof(sent), VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kRead);
  ASSERT_TRUE(commands && there && back);
  ASSERT_TRUE(upload(*device_, *commands, *there, std::as_bytes(std::span(sent))));
  const Result<VkCommandBuffer> recording = commands->begin();
  ASSERT_TRUE(recording);
  commands->stamp();
  const VkBufferCopy copy{0, 0, sizeof(sent)};
  vkCmdCopyBuffer(*recording, there->handle(), back->handle(), 1, &copy);
  wait_for(*recording, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
           VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  commands->stamp();
  ASSERT_TRUE(commands->run());
  EXPECT_EQ(std::memcmp(back->mapped(), sent.data(), sizeof(sent)), 0);
  if (device_->timestamp_bits() > 0) {
    ASSERT_EQ(commands->intervals().size(), 1u);
    EXPECT_GE(commands->intervals()[0], 0);
  }
}

TEST_F(Gpu, WhatIsTooLargeIsAnErrorThatNamesTheDevice) {
  const Result<Buffer> huge = Buffer::make(*device_, VkDeviceSize(1) << 46,
                                           VK_BUFFER_USAGE_TRANSFER_DST_BIT, Placement::kDevice);
  ASSERT_FALSE(huge);
  EXPECT_EQ(huge.error().kind, ErrorKind::kMachine);
  EXPECT_EQ(huge.error().message, device_->info().name + ": out of memory");
}

TEST_F(Gpu, MistakesReachTheMessages) {
  // A buffer that is used for what it was not made for.
  Result<Commands> commands = Commands::make(*device_, 0);
  Result<Buffer> wrong =
      Buffer::make(*device_, 16, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, Placement::kDevice);
  ASSERT_TRUE(commands && wrong);
  const Result<VkCommandBuffer> recording = commands->begin();
  ASSERT_TRUE(recording);
  vkCmdFillBuffer(*recording, wrong->handle(), 0, 16, 0);
  ASSERT_TRUE(commands->run());
  EXPECT_FALSE(device_->messages().empty());
  *commands = Commands();
  *wrong = Buffer();
  device_.reset();  // these messages were meant
}

TEST(GpuError, IsOneLineThatSaysWhatTheUserCanUnderstand) {
  EXPECT_EQ(error_of(VK_ERROR_DEVICE_LOST, "submit work", "GPU").message,
            "GPU: the device was lost");
  EXPECT_EQ(error_of(VK_ERROR_OUT_OF_DEVICE_MEMORY, "make a buffer", "GPU").message,
            "GPU: out of memory");
  EXPECT_EQ(error_of(VK_ERROR_FEATURE_NOT_PRESENT, "open the device", "GPU").message,
            "GPU: cannot open the device: VkResult -8");
}

TEST(GpuOpen, ADeviceThatIsNotThereIsNamed) {
  const Result<std::unique_ptr<Device>> none =
      Device::open({.wanted = "no such", .validate = false});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::kUsage);
  EXPECT_EQ(none.error().message.find("no Vulkan device 'no such'; there are: 0 ("), 0u);
}

}  // namespace
}  // namespace whittle::gpu
