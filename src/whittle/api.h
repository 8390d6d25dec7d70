// What the parts of the public API share: how values become exceptions, and what a solid holds.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/vec.h"
#include "model/instances.h"
#include "model/model.h"
#include "whittle/whittle.h"

namespace whittle {

[[noreturn]] inline void fail(const Error& error) {
  throw Failure(Failure::Cause(int(error.kind)), error.message);
}

[[noreturn]] inline void refuse(const std::string& message) {
  fail({ErrorKind::kUsage, message});
}

template <class T>
T value_of(Result<T> result) {
  if (!result) fail(result.error());
  return *std::move(result);
}

inline Vec3 to_vec3(const Point& p) {
  return {p[0], p[1], p[2]};
}

inline Point to_point(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// A kUsage failure if they are not from 0 to kMostThreads.
int threads_of(int threads);

struct Solid::State {
  Model model;
  std::vector<std::string> warnings;
  bool is_complete = true;
  Style style = Style::kStudio;
  Bounds bounds;
  /// By id, nowhere for those that are not in the model; made when one is first asked for.
  mutable std::once_flag places_once;
  mutable std::vector<SourceLocation> places;

  State(Model model_, std::vector<std::string> warnings_, bool is_complete_, Style style_)
      : model(std::move(model_)),
        warnings(std::move(warnings_)),
        is_complete(is_complete_),
        style(style_),
        bounds(whittle::bounds(model)) {}
};

}  // namespace whittle
