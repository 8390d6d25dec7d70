// The one way to Vulkan's functions. They are looked up when the program runs (volk), so that it
// starts where no Vulkan is installed.
#pragma once

#define VK_NO_PROTOTYPES
#include <volk.h>
