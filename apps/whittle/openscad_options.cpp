#include "openscad_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "host/scad.h"
#include "whittle/export_format.h"

namespace whittle {
namespace {

constexpr int kMostFrames = 99'999;

void add_animation(OptionGroup& group, Animation& animation) {
  group.add_count("--animate", "N", animation.frames, 1, kMostFrames,
                  "of a .scad: N pictures, OUT with a number in its name,\n"
                  "$t from 0 to before 1");
  group.add_text("--animate_sharding", "I/K", "with --animate: only the I-th of K parts of them",
                 [&](const std::string& text) {
                   const size_t slash = text.find('/');
                   if (slash == std::string::npos) {
                     refuse("--animate_sharding", "wants I/K, as in 2/3, not " + text);
                   }
                   const auto count = [&](const std::string& number, int64_t most) {
                     return int(parse_count("--animate_sharding", number, 1, most));
                   };
                   animation.shards = count(text.substr(slash + 1), kMostFrames);
                   animation.shard = count(text.substr(0, slash), animation.shards);
                 });
}

std::string describe_program() {
  const std::optional<std::string> openscad = find_openscad();
  return fmt::format("whittle {}\nopenscad, for .scad files: {}", WHITTLE_VERSION,
                     openscad ? *openscad : "not found");
}

}  // namespace

std::string frame_path(const std::string& path, int frame) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() /
          fmt::format("{}{:05}{}", whole.stem().string(), frame, whole.extension().string()))
      .string();
}

void add_openscad_options(CommandLine& line, OpenscadArguments& openscad) {
  OptionGroup shown(line.app(), "Output"), hidden(line.app(), "");
  add_animation(shown, openscad.animation);
  shown.add_text("-d", "FILE", "a dependency file for make",
                 [&](const std::string& path) { openscad.dependency_file = path; });
  hidden.add_each("--view", "VALUE", "", [](const std::string&) {
    refuse("--view",
           "axes, crosshairs, edges, scales and the wireframe are not drawn as openscad does; "
           "--axes and --grid are whittle's own");
  });
  for (const char* name : {"-s", "-x"}) {
    hidden.add_each(name, "FILE", "", [name](const std::string&) {
      refuse(name, "the ending of -o FILE says what is written");
    });
  }
  hidden.add_flag(
      "--info", [] { answer(describe_program()); }, "");
  // A preview's limit, which no picture of whittle's has; and what openscad says of itself.
  for (const char* name : {"--csglimit", "--debug"}) {
    hidden.add_each(name, "VALUE", "", [](const std::string&) {});
  }
}

std::optional<std::string> refusal_of_format(const std::string& name_or_path) {
  constexpr std::array<std::string_view, 11> kFormats = {
      "wrl", "csg", "param", "pdf", "pov", "ast", "term", "echo", "nef3", "nefdbg", "scad"};
  const std::string lower = to_lower(name_or_path);
  const std::string ending = lower.substr(lower.rfind('.') + 1);
  if (std::ranges::find(kFormats, ending) == kFormats.end()) return std::nullopt;
  return fmt::format("'{}' asks for .{}, which whittle does not write; it writes {}", name_or_path,
                     ending, export_endings());
}

}  // namespace whittle
