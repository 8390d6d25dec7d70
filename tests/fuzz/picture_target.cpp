// Any bytes as a model (picture_model.h), rendered at 32x32 by the cpu backend and held to the
// oracle pixel by pixel.
#include <algorithm>
#include <string>

#include "agreement/cpu_subject.h"
#include "fuzz/picture_model.h"
#include "fuzz/require.h"
#include "fuzz/target.h"
#include "model/instances.h"
#include "support/read_text.h"
#include "trace/oracle/oracle.h"

namespace whittle {
namespace {

constexpr int kEdge = 32;        ///< pixels
constexpr int kAslantViews = 3;  ///< the standard ones
/// Twenty thin plates in a stack ask for millions of cells: an input must stay small, and the
/// budget is right to be tested.
constexpr size_t kCellsOfOne = size_t(16) << 20;

/// The standard views, then three square to the axes, where rays run along faces and cells.
Camera camera_of(const Model& model, int view) {
  std::vector<Camera> cameras = cameras_for(model, kEdge, kEdge);
  if (view < int(cameras.size())) return cameras[size_t(view)];
  // Orthographic, from the standard view's distance.
  Camera camera = cameras[1];
  const Vec3 center = camera.eye + camera.forward * (camera.half_height / 1.02 * 3);
  const int axis = view - int(cameras.size());
  camera.forward = camera.right = camera.up = {};
  camera.forward[axis] = -1;
  camera.right[(axis + 1) % 3] = 1;
  camera.up = cross(camera.right, camera.forward);
  camera.eye = center - camera.forward * (3 * camera.half_height);
  return camera;
}

/// The largest coordinate that comes into where the model's surfaces are. Half-spaces have no
/// place, and where their feet are need not show through which numbers they were moved.
double largest_coordinate(const Model& model, const Bounds& b) {
  double largest = b.box.is_empty() ? 0 : max_component(max(abs(b.box.lo), abs(b.box.hi)));
  for (const Instance& instance : instances(model))
    if (!instance.empty)
      largest = std::max(largest, max_component(abs(instance.world_from_object.translation)));
  return largest;
}

/// Where the tolerance is less than some hundred units in the last place of the coordinates,
/// rounding decides between surfaces that the tolerance keeps apart: a model of a hundredth at 1e6,
/// or half-spaces that meet far away, or all whose feet are one point but for rounding. There is
/// nothing to agree on. Triangles are off their planes by what their corners' coordinates lose:
/// of thin parts between them nothing can be told sooner.
bool is_noise(const Model& model, const Bounds& b) {
  const bool has_mesh = std::ranges::any_of(
      model.primitives, [](const Primitive& p) { return std::holds_alternative<Mesh>(p.shape); });
  return !b.box.is_empty() &&
         tolerance(b) < (has_mesh ? 1e-10 : 1e-13) * largest_coordinate(model, b);
}

/// Whether planes of a boundary were moved onto others. Cells may differ by the slack that makes
/// (decision 0032), and square to an axis a ray can run along between a wall and its plane.
bool has_moved_walls(const Scene& scene) {
  return std::ranges::any_of(scene.boundaries, [](const Boundary& boundary) {
    return boundary.slack() > 1e3 * boundary.rounding();
  });
}

void check(std::span<const uint8_t> bytes) {
  PictureInput input = decode_picture(bytes, 0);
  Model model = model_of(input.text, "fuzz.csg");
  if (input.uses_nearly) {
    input = decode_picture(bytes, tolerance(bounds(model)));
    model = model_of(input.text, "fuzz.csg");
  }
  if (is_noise(model, bounds(model))) return;
  SubdivideSettings settings;
  settings.leaf_size = input.leaf_size;
  settings.least_use = input.least_use;
  settings.threads = 1;
  settings.memory = kCellsOfOne;
  CpuSubject cpu(model, settings);
  const auto oracle = make_oracle_tracer(model, 1);
  // Square to an axis a ray runs in faces and exactly through edges. What it touches there without
  // entering, rounding decides, and no ray beside it need see the same: only certain pixels count.
  // Where it ends on such an edge, whose surface that is is rounding's word too, and the four
  // places beside it may all show another.
  const bool aslant = input.view < kAslantViews;
  if (!aslant && has_moved_walls(cpu.scene)) return;
  const auto any_owner = [](const Ray&, const Hit&, uint32_t) { return true; };
  const AgreementReport report =
      find_differences(model, *cpu.tracer, *oracle, camera_of(model, input.view),
                       aslant ? AcceptsId{} : AcceptsId(any_owner));
  const auto disagreements = cpu.tracer->stats().disagreements;
  const int unmatched = aslant ? report.ambiguous_unmatched : 0;
  if (report.unexplained == 0 && unmatched == 0 && disagreements == 0) return;
  require(false, "k = " + std::to_string(input.leaf_size) + ", view " + std::to_string(input.view) +
                     ": " + std::to_string(report.unexplained) + " unexplained, " +
                     std::to_string(report.ambiguous_unmatched) + " unmatched, " +
                     std::to_string(disagreements) + " disagreements of cells\n" +
                     report.first_difference + "the model:\n" + input.text);
}

}  // namespace
}  // namespace whittle

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  whittle::check({data, size});
  return 0;
}
