// Rays from standard input, a line each, as they come.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/workers.h"
#include "trace/frame.h"

namespace whittle {

/// Six numbers, separated by commas or blanks: where a ray starts and which way it goes. Fails, in
/// words that go on from the name of the place, if they are none, or the way has no length.
Result<Ray> parse_ray(std::string_view text);

/// Reads lines to the end of the input, empty ones left out, and calls `take` for the rays of all
/// that has come: no line waits for more input. Ends with the first failure of `take`, or at the
/// first line that is no ray, a kInput error that names it; what stands before that is taken.
Status for_ray_lines(int descriptor, const Workers& workers,
                     const std::function<Status(const std::vector<Ray>&)>& take);

}  // namespace whittle
