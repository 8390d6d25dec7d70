// Holds a picture of whittle's to one of OpenSCAD's (look_rule.h), for benchmarks/compare_openscad:
//
//   openscad_check THEIRS.png OURS.png FACTS.exr
//
// Ours and the facts are of one run of `whittle --style openscad`. Prints a JSON object; exit code
// 0 if they show the same, 1 if not, 2 if there is nothing to compare.
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "image/exr.h"
#include "image/png.h"
#include "look_rule.h"

namespace whittle {
namespace {

int fail(const std::string& message) {
  std::fprintf(stderr, "openscad_check: %s\n", message.c_str());
  return 2;
}

int check(const std::string& theirs, const std::string& ours, const std::string& facts) {
  Result<Picture> their_picture = read_png(theirs);
  if (!their_picture) return fail(their_picture.error().message);
  Result<Picture> our_picture = read_png(ours);
  if (!our_picture) return fail(our_picture.error().message);
  Result<Frame> frame = read_exr(facts);
  if (!frame) return fail(frame.error().message);
  const int width = their_picture->width, height = their_picture->height;
  if (our_picture->width != width || our_picture->height != height || frame->width != width ||
      frame->height != height)
    return fail("the pictures differ in size");
  const Differences d =
      compare({std::move(*their_picture), std::move(*our_picture), std::move(*frame)});
  const nlohmann::json report = {{"same", d.same()},
                                 {"same_drawing", d.same_drawing()},
                                 {"enough_seen", d.enough_seen()},
                                 {"enough_compared", d.enough_compared()},
                                 {"pixels", d.pixels},
                                 {"hits", d.hits},
                                 {"hits_compared", d.inner_hits},
                                 {"edges", d.edges},
                                 {"wrong", d.wrong},
                                 {"unequal", d.unequal},
                                 {"unexplained", d.unexplained},
                                 {"first_wrong", d.first_wrong}};
  std::printf("%s\n", report.dump().c_str());
  return d.same() ? 0 : 1;
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  if (argc != 4) return whittle::fail("THEIRS.png OURS.png FACTS.exr");
  return whittle::check(argv[1], argv[2], argv[3]);
}
