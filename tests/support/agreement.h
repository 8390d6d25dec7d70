// Two tracers looking at the same model: do they see the same facts?
//
// A threshold on differing pixels would hide real faults and break on silhouettes. Instead the
// oracle looks five times at every pixel: at its centre and at four places kDisplacement pixels
// away. Where the five answers are one surface the pixel is certain, and any tracer must give that
// answer. Elsewhere it is ambiguous: the ray passes an edge so closely that rounding may decide,
// and any of the five answers will do.
//
// What is thinner than the displacement may hide between the five. So where the answer is another,
// the oracle looks again from eyes that are displaced by no more than rounding; if they do not see
// one surface the pixel is ambiguous, and their answers will do too.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/model.h"
#include "trace/tracer.h"

namespace whittle {

inline constexpr double kDisplacement = 1e-3;  ///< pixels, in x and in y

/// How far an answer may be from the oracle's: distance along the ray, relative to the distance of
/// the point from the eye. Beyond it, an answer may stray along the ray as far as the surface it
/// lies on does over the five rays.
inline constexpr double kDistanceAgreement = 1e-5;
/// Nobody knows where a surface is better than where the ray starts: across the surface, this much
/// of the start's distance from the world's origin is forgiven too, some 5 units in its last place.
/// It matters where an eye far from the origin all but touches something. So far an eye may be off
/// to either side as well.
inline constexpr double kOriginRounding = 1e-15;
/// Between normals, as a sine; beyond it, an answer may stray as far as the five answers do.
inline constexpr double kNormalAgreement = 1e-3;
/// Normals of a certain pixel's five answers differ by no more than this, as a sine.
inline constexpr double kCertainNormals = 1e-2;

struct AgreementReport {
  int pixels = 0;
  int hits = 0;                  ///< pixels where the oracle hits
  int ambiguous = 0;             ///< pixels where it does not agree with itself
  int unexplained = 0;           ///< certain pixels where the subject differs
  int ambiguous_unmatched = 0;   ///< ambiguous pixels where it gives none of the five answers
  std::string first_difference;  ///< pixel, ray and both answers; empty if there is none
};

/// Adds up reports; keeps the first difference.
AgreementReport& operator+=(AgreementReport& sum, const AgreementReport& one);

AgreementReport check_agreement(const Model& model, Tracer& subject, Tracer& oracle,
                                const Camera& camera);

/// May the subject show primitive `seen` where the oracle, along `ray`, has the hit `expected`?
using AcceptsId = std::function<bool(const Ray& ray, const Hit& expected, uint32_t seen)>;

/// The same verdict sooner, for many models: looks five times only where the subject's answer is
/// not the oracle's own. So `ambiguous` counts only what was looked at. Without `accepts`, no other
/// primitive will do.
AgreementReport find_differences(const Model& model, Tracer& subject, Tracer& oracle,
                                 const Camera& camera, const AcceptsId& accepts = {});

/// The same for pictures that are there already, may number the primitives differently, and whose
/// surfaces may be the model's tolerance apart.
AgreementReport check_pictures(const Model& model, const Frame& seen, Tracer& oracle,
                               const Frame& expected, const Camera& camera,
                               const AcceptsId& accepts);

/// One byte a pixel, 1 where the oracle does not agree with itself. `frame` is what it rendered.
std::vector<uint8_t> ambiguous_pixels(Tracer& oracle, const Camera& camera, const Frame& frame);

/// Three standard views of a model: in perspective from the front right and above, orthographic
/// from the back left and below, and in wide perspective from inside. Nothing in them is square to
/// an axis. A model without bounds is seen as its finite parts are.
std::vector<Camera> cameras_for(const Model& model, int width = 64, int height = 48);

/// A camera of one pixel, whose centre looks from `eye` along `direction`.
Camera camera_along(Vec3 eye, Vec3 direction);

/// What the tracer sees from `eye` along `direction`.
Hit trace_one(Tracer& tracer, Vec3 eye, Vec3 direction);

}  // namespace whittle
