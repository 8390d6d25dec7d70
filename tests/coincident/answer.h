// What is right for a scene, from all its views, and whether a tracer sees it.
#pragma once

#include <memory>
#include <vector>

#include "agreement/cpu_subject.h"
#include "coincident/scenes.h"

namespace whittle {

SubdivideSettings leaf_size(uint32_t k);

class Answer {
 public:
  /// Renders what is right as `size` by `size` pictures. `model` is the scene's own; both must
  /// outlive this.
  Answer(const CoincidentScene& scene, const Model& model, int size);

  /// Holds a tracer of the scene, or of the scene moved by `turn`, to it: hit, owner, distance and
  /// normal are right at every pixel but those through whose very centre an edge runs, and there
  /// they are those of one side. Anything else is a failure of the test.
  void expect_seen_by(Tracer& tracer, const Affine& turn = {});

  /// Of the pixels of the view that shows least.
  double least_share_of_hits() const;

 private:
  bool may_be_seen_as(const Ray& ray, const Hit& hit, uint32_t id) const;
  bool is_near(const Where& where, Vec3 p) const;

  const CoincidentScene& scene_;
  const Model& model_;
  std::unique_ptr<CpuSubject> equal_;  ///< of the equivalent model, if there is one
  std::unique_ptr<Tracer> formula_;    ///< or else this
  Tracer* reference_;                  ///< whichever it is
  double slack_;                       ///< how far rounding may move a point
  std::vector<Camera> cameras_;
  std::vector<Frame> expected_;  ///< one a camera
};

}  // namespace whittle
