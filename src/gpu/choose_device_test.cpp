// Which device a user means, and what is said where there is none such.
#include <gtest/gtest.h>

#include <array>

#include "gpu/devices.h"

namespace whittle::gpu {
namespace {

std::array<DeviceInfo, 3> three_devices() {
  std::array<DeviceInfo, 3> devices;
  devices[0].name = "Old GPU";
  devices[0].shortcoming = "Vulkan 1.3 is needed, and it has 1.1.0";
  devices[1].name = "Fast GPU 9";
  devices[2].name = "llvmpipe";
  return devices;
}

TEST(ChooseDevice, NobodySaysSoTheFirstThatCanBeUsed) {
  EXPECT_EQ(*choose_device(three_devices(), ""), 1u);
}

TEST(ChooseDevice, ByNumberOrPartOfTheName) {
  EXPECT_EQ(*choose_device(three_devices(), "2"), 2u);
  EXPECT_EQ(*choose_device(three_devices(), "LLVM"), 2u);
  EXPECT_EQ(*choose_device(three_devices(), "gpu 9"), 1u);
}

TEST(ChooseDevice, WhatThereIsNotIsAMistakeOfTheUser) {
  for (const char* wanted : {"3", "voodoo", "-1", "1x"}) {
    const Result<size_t> chosen = choose_device(three_devices(), wanted);
    ASSERT_FALSE(chosen) << wanted;
    EXPECT_EQ(chosen.error().kind, ErrorKind::kUsage);
    EXPECT_EQ(chosen.error().message,
              "no Vulkan device '" + std::string(wanted) +
                  "'; there are: 0 (Old GPU), 1 (Fast GPU 9), 2 (llvmpipe)");
  }
}

TEST(ChooseDevice, WhatCannotBeUsedSaysWhy) {
  for (const char* wanted : {"0", "old"}) {
    const Result<size_t> chosen = choose_device(three_devices(), wanted);
    ASSERT_FALSE(chosen) << wanted;
    EXPECT_EQ(chosen.error().kind, ErrorKind::kMachine);
    EXPECT_EQ(chosen.error().message,
              "Old GPU cannot be used: Vulkan 1.3 is needed, and it has 1.1.0");
  }
  const std::array<DeviceInfo, 3> devices = three_devices();
  const Result<size_t> only = choose_device(std::span(devices).first(1), "");
  ASSERT_FALSE(only);
  EXPECT_EQ(only.error().kind, ErrorKind::kMachine);
}

}  // namespace
}  // namespace whittle::gpu
