// whittle devices: what the vulkan backends can work on.
#include "gpu/devices.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "option_group.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle devices", "Lists Vulkan's devices: what --device can name, the best first.",
    "[options]",
    "Examples:\n"
    "  whittle devices\n"
    "  whittle part.csg -o part.png --backend vulkan-raster --device 0\n\n"
    "Exit codes: 0 done, 2 bad usage, 3 no Vulkan on this machine."};

std::string describe_text(const std::vector<gpu::DeviceInfo>& devices) {
  std::string text;
  for (size_t i = 0; i < devices.size(); ++i) {
    const gpu::DeviceInfo& d = devices[i];
    fmt::format_to(std::back_inserter(text), "{}  {}: {}, Vulkan {}.{}, {}{}\n", i, d.name,
                   gpu::name_of(d.type), d.api_major, d.api_minor, d.driver,
                   d.float64 ? ", double precision" : "");
    if (!d.shortcoming.empty())
      fmt::format_to(std::back_inserter(text), "   cannot be used: {}\n", d.shortcoming);
  }
  return text;
}

std::string describe_json(const std::vector<gpu::DeviceInfo>& devices) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const gpu::DeviceInfo& d : devices) {
    nlohmann::ordered_json one;
    one["name"] = d.name;
    one["type"] = gpu::name_of(d.type);
    one["vulkan"] = fmt::format("{}.{}", d.api_major, d.api_minor);
    one["driver"] = d.driver;
    one["double_precision"] = d.float64;
    one["usable"] = d.shortcoming.empty();
    one["shortcoming"] = d.shortcoming;
    all.push_back(std::move(one));
  }
  return all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

int devices_command(Arguments arguments) {
  CommandLine line(kHelp);
  bool wants_json = false;
  OptionGroup(line.app(), "Output")
      .add_flag("--json", wants_json, "an array with one object a device");
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  const Result<std::vector<gpu::DeviceInfo>> devices = gpu::list_devices();
  if (!devices) return report(devices.error());
  return print(wants_json ? describe_json(*devices) : describe_text(*devices));
}

}  // namespace whittle
