// The paper's models rendered by POV-Ray must look like ours: the same silhouette, and with Blinn
// shading the same colours. POV-Ray shares no code and no idea with whittle but the ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>

#include "agreement/cpu_subject.h"
#include "base/folder_for_test.h"
#include "csg/read_csg.h"
#include "generate/generate.h"
#include "image/edge_pixels.h"
#include "image/png.h"
#include "image/pov.h"
#include "model/instances.h"
#include "trace/view.h"

namespace whittle {
namespace {

struct Scene {
  const char* name;
  int n;  ///< 0: the model has no size
  bool orthographic;
  bool own_light;  ///< a light beside the eye instead of at it
};

std::ostream& operator<<(std::ostream& out, const Scene& s) {
  return out << s.name;
}

/// POV-Ray's picture of the scene text. HOME is the folder, as POV-Ray wants a place for settings.
Result<Picture> run_povray(const std::string& scene, const Camera& camera) {
  const TestFolder folder;
  std::ofstream(folder / "scene.pov") << scene;
  const std::string command = "cd '" + (folder / "") + "' && HOME='" + (folder / "") +
                              "' '" WHITTLE_POVRAY "' +Iscene.pov +Opicture.png +FN8 -A -D +W" +
                              std::to_string(camera.width) + " +H" + std::to_string(camera.height) +
                              " >log 2>&1 </dev/null";
  if (std::system(command.c_str()) != 0) {
    std::ifstream log(folder / "log");
    return Error{ErrorKind::kMachine, std::string((std::istreambuf_iterator<char>(log)), {})};
  }
  return read_png(folder / "picture.png");
}

class PovAgreement : public testing::TestWithParam<Scene> {};

TEST_P(PovAgreement, TheSameSilhouetteAndTheSameColors) {
  const Scene& scene = GetParam();
  const std::optional<int> n = scene.n > 0 ? std::optional(scene.n) : std::nullopt;
  const Result<std::string> text = generate_model(scene.name, n, kDefaultSeed);
  ASSERT_TRUE(text) << text.error().message;
  const Result<Read> read = read_csg(*text, scene.name);
  ASSERT_TRUE(read) << read.error().message;
  const Model& model = read->model;

  const Box box = bounds(model).box;
  ViewOptions view;
  view.width = 256;
  view.height = 192;
  view.orthographic = scene.orthographic;
  const Camera camera = make_camera(view, {}, box);
  ShadeSettings settings;
  settings.style = Style::kBlinn;
  if (scene.own_light) {
    settings.light = box.center() + Vec3{-0.7, -0.9, 1.3} * box.diagonal();
  }

  const Result<std::string> pov = write_pov(model, camera, settings);
  ASSERT_TRUE(pov) << pov.error().message;
  const Result<Picture> theirs = run_povray(*pov, camera);
  ASSERT_TRUE(theirs) << theirs.error().message;
  ASSERT_EQ(theirs->width, camera.width);
  ASSERT_EQ(theirs->height, camera.height);

  const CpuSubject cpu(model, {});
  const Frame frame = cpu.tracer->render(camera, {});
  const Workers workers(0);
  const Picture ours = shade(frame, camera, appearances(model), settings, workers);
  const std::vector<uint8_t> edges = edge_mask(frame, camera, workers);
  size_t hits = 0, silhouette = 0, inner = 0, off_at_edges = 0;
  int largest = 0;
  for (size_t i = 0; i < frame.hits.size(); ++i) {
    const uint8_t *a = &ours.rgba[4 * i], *b = &theirs->rgba[4 * i];
    const bool hit = frame.hits[i].hit(), their_hit = !(b[0] == 255 && b[1] == 255 && b[2] == 255);
    hits += hit;
    silhouette += hit != their_hit;
    if (!hit) continue;
    int difference = 0;
    for (int k = 0; k < 3; ++k) difference = std::max(difference, std::abs(a[k] - b[k]));
    if (edges[i]) {
      off_at_edges += difference > 1;
    } else {
      ++inner;
      largest = std::max(largest, difference);
    }
  }
  RecordProperty("pixels_hit", int(hits));
  RecordProperty("silhouette_differs", int(silhouette));
  RecordProperty("largest_difference", largest);
  RecordProperty("differs_at_edges", int(off_at_edges));
  std::printf(
      "%s: %zu pixels hit; the silhouette differs in %zu; %zu pixels away from edges differ by at "
      "most %d levels; %zu pixels at edges differ by more than 1\n",
      scene.name, hits, silhouette, inner, largest, off_at_edges);
  EXPECT_GT(inner, 300u);
  EXPECT_LE(largest, 1);
  // At edges rounding decides which of two surfaces a ray meets.
  EXPECT_LE(silhouette, hits / 1000);
  EXPECT_LE(off_at_edges, hits / 1000);
}

INSTANTIATE_TEST_SUITE_P(
    Paper, PovAgreement,
    testing::Values(Scene{"widget", 0, false, true}, Scene{"r9", 0, false, false},
                    Scene{"cheese", 100, false, true}, Scene{"cyl", 100, true, false},
                    Scene{"cone", 100, false, true}, Scene{"tube", 300, true, true}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace whittle
