#include "coincident/answer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/instances.h"
#include "support/adapted_tracer.h"
#include "support/read_text.h"

namespace whittle {
namespace {

constexpr uint32_t kUnsure = UINT32_MAX;  ///< the id where a formula does not know

class FormulaTracer final : public Tracer {
 public:
  explicit FormulaTracer(RayFormula formula) : formula_(std::move(formula)) {}
  const char* name() const override { return "formula"; }
  Frame render(const Camera& camera, const RenderControl&) override {
    Frame frame(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) frame.at(x, y) = trace(camera.ray(x + 0.5, y + 0.5));
    return frame;
  }
  void probe(const Camera& camera, std::span<const PixelPosition> positions,
             std::span<Hit> hits) override {
    for (size_t i = 0; i < hits.size(); ++i)
      hits[i] = trace(camera.ray(double(positions[i].x), double(positions[i].y)));
  }
  void cast(std::span<const Ray> rays, std::span<Hit> hits) override {
    for (size_t i = 0; i < hits.size(); ++i) hits[i] = trace(rays[i]);
  }

 private:
  Hit trace(const Ray& ray) const {
    return formula_(ray).value_or(Hit{.distance = 0, .id = kUnsure, .normal = {}});
  }
  RayFormula formula_;
};

}  // namespace

SubdivideSettings leaf_size(uint32_t k) {
  SubdivideSettings settings;
  settings.leaf_size = k;
  return settings;
}

Answer::Answer(const CoincidentScene& scene, const Model& model, int size)
    : scene_(scene), model_(model) {
  if (scene.formula)
    formula_ = std::make_unique<FormulaTracer>(scene.formula);
  else
    equal_ = std::make_unique<CpuSubject>(model_of(scene.equal, scene.name), leaf_size(6));
  reference_ = formula_ ? formula_.get() : equal_->tracer.get();
  slack_ = 2e-5 * max_component(bounds(model).box.size());
  if (!scene.only_looks) {
    cameras_ = cameras_for(model, size, size);
    if (!scene.looks.empty()) cameras_.pop_back();
  }
  for (const Look& look : scene.looks) {
    Camera camera = camera_along(look.eye, look.target - look.eye);
    camera.half_height = look.half_height;
    camera.width = camera.height = size;
    cameras_.push_back(camera);
  }
  for (const Camera& camera : cameras_) expected_.push_back(reference_->render(camera));
}

void Answer::expect_seen_by(Tracer& tracer, const Affine& turn) {
  AdaptedTracer subject(
      tracer,
      [&](Camera camera) {
        camera.eye = turn.point(camera.eye);
        camera.right = turn.vector(camera.right);
        camera.up = turn.vector(camera.up);
        camera.forward = turn.vector(camera.forward);
        return camera;
      },
      [&](Hit hit) {
        const Vec3 n = turn.transposed_vector(
            {double(hit.normal.x), double(hit.normal.y), double(hit.normal.z)});
        hit.normal = {float(n.x), float(n.y), float(n.z)};
        return hit;
      });
  for (size_t i = 0; i < cameras_.size(); ++i) {
    SCOPED_TRACE(testing::Message() << tracer.name() << ", view " << i);
    Frame seen = subject.render(cameras_[i], {}), expected = expected_[i];
    for (size_t p = 0; p < seen.hits.size(); ++p)
      if (expected.hits[p].id == kUnsure) seen.hits[p] = expected.hits[p] = Hit{};
    const AgreementReport report = check_pictures(
        model_, seen, *reference_, expected, cameras_[i],
        [&](const Ray& ray, const Hit& hit, uint32_t id) { return may_be_seen_as(ray, hit, id); });
    EXPECT_EQ(report.unexplained, 0) << report.first_difference;
    EXPECT_EQ(report.ambiguous_unmatched, 0) << report.first_difference;
    // So few edges run through a pixel's very centre; more would let faults hide.
    EXPECT_LE(report.ambiguous, cameras_[i].width / 4);
  }
}

double Answer::least_share_of_hits() const {
  double least = 1;
  for (const Frame& frame : expected_) {
    const auto hits = std::ranges::count_if(frame.hits, [](const Hit& h) { return h.hit(); });
    least = std::min(least, double(hits) / double(frame.hits.size()));
  }
  return least;
}

bool Answer::may_be_seen_as(const Ray& ray, const Hit& hit, uint32_t id) const {
  bool listed = false;
  const Vec3 p = ray.origin + ray.direction * double(hit.distance);
  for (const Owner& owner : scene_.owners) {
    if (owner.face != hit.id) continue;
    listed = true;
    if (owner.owner == id && (!owner.where || is_near(owner.where, p))) return true;
  }
  return !listed && hit.id == id;
}

// Is the point in the place, or so near that rounding may put it there?
bool Answer::is_near(const Where& where, Vec3 p) const {
  if (where(p)) return true;
  for (int corner = 0; corner < 8; ++corner)
    if (where(p + Vec3{corner & 1 ? slack_ : -slack_, corner & 2 ? slack_ : -slack_,
                       corner & 4 ? slack_ : -slack_}))
      return true;
  return false;
}

}  // namespace whittle
