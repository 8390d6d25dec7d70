// What else the command line of openscad has: what whittle cannot do is refused, and an option is
// ignored only if the picture is the same without it.
#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "option_group.h"

namespace whittle {

/// --animate and --animate_sharding.
struct Animation {
  int frames = 0;  ///< 0: one picture, without a number
  int shard = 1, shards = 1;

  /// The frames of this shard: from the first to before the last.
  int first() const { return at(shard - 1); }
  int last() const { return at(shard); }

 private:
  int at(int shards_before) const {
    return static_cast<int>(int64_t(frames) * shards_before / shards);
  }
};

/// `name.png` as `name00012.png`.
std::string frame_path(const std::string& path, int frame);

struct OpenscadArguments {
  Animation animation;
  std::optional<std::string> dependency_file;  ///< -d
};
void add_openscad_options(CommandLine& line, OpenscadArguments& openscad);

/// If openscad writes a format that whittle does not: why whittle refuses it.
std::optional<std::string> refusal_of_format(const std::string& name_or_path);

}  // namespace whittle
