// How fast are rays through an exact difference, beside the same rays through Embree's union of the
// spheres alone? Both see one model (a body minus spheres) through one camera, in turns, in one
// run.
//
//     embree_union [--model cheese] [--n 1000] [--size 512] [--threads 2] [--repeat 21]
//
// Prints one JSON object. Embree's hits are checked against formulas first; if they are wrong,
// nothing is measured. The sphere is Embree's own primitive; rays come in packets of 1, 4, 8 and
// 16, with both of its hints about coherence, and the fastest counts.
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/timing.h"
#include "base/workers.h"
#include "csg/read_csg.h"
#include "generate/generate.h"
#include "model/instances.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

struct Ball {
  Vec3 center;
  double radius;
};

struct Options {
  std::string model = "cheese";
  int n = 1000, size = 512, threads = 2, repeat = 21;
};

std::vector<Ball> balls_of(const Model& model) {
  std::vector<Ball> balls;
  for (const Instance& instance : instances(model)) {
    const auto* sphere = std::get_if<Sphere>(&model.primitives[instance.primitive].shape);
    if (sphere == nullptr || instance.empty) continue;
    const Affine& a = instance.world_from_object;
    balls.push_back({a.point({}), sphere->r * length(a.point({1, 0, 0}) - a.point({}))});
  }
  return balls;
}

/// Rays of a camera in single precision, not of unit length: distances count in `direction`s.
struct FloatCamera {
  Vec3f eye, right, up, corner;  ///< direction = corner + x * right + y * up

  explicit FloatCamera(const Camera& c) : eye(to_float(c.eye)) {
    const double s = c.units_per_pixel();
    right = to_float(c.right * s);
    up = to_float(c.up * -s);
    corner = to_float(c.forward - c.right * (0.5 * c.width * s) + c.up * (0.5 * c.height * s));
  }
  static Vec3f to_float(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }
  Vec3f direction(int x, int y) const {
    return corner + right * (float(x) + 0.5f) + up * (float(y) + 0.5f);
  }
};

/// A frame of Embree's: the distance along every ray's direction, infinity where nothing is hit.
/// Other facts stay in the packet: writing less can only help Embree.
using Distances = std::vector<float>;

class EmbreeUnion {
 public:
  EmbreeUnion(const std::vector<Ball>& balls, int threads)
      : device_(rtcNewDevice(fmt::format("threads={},set_affinity=0", threads).c_str())),
        scene_(rtcNewScene(device_)),
        workers_(threads) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* at = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), balls.size()));
    for (const Ball& ball : balls) {
      *at++ = float(ball.center.x);
      *at++ = float(ball.center.y);
      *at++ = float(ball.center.z);
      *at++ = float(ball.radius);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_);
  }
  ~EmbreeUnion() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeUnion(const EmbreeUnion&) = delete;
  EmbreeUnion& operator=(const EmbreeUnion&) = delete;

  bool is_ready() const { return rtcGetDeviceError(device_) == RTC_ERROR_NONE; }

  /// Precondition: width and height are multiples of 16.
  void render(const Camera& camera, int packet, bool coherent, Distances& out) const {
    out.resize(size_t(camera.width) * size_t(camera.height));
    switch (packet) {
      case 1:
        return render_tiles<1, 1, RTCRayHit>(camera, coherent, out, intersect1);
      case 4:
        return render_tiles<2, 2, RTCRayHit4>(camera, coherent, out, rtcIntersect4);
      case 8:
        return render_tiles<4, 2, RTCRayHit8>(camera, coherent, out, rtcIntersect8);
      default:
        return render_tiles<4, 4, RTCRayHit16>(camera, coherent, out, rtcIntersect16);
    }
  }

 private:
  static void intersect1(const int*, RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
    rtcIntersect1(scene, context, ray);
  }

  /// One packet is kColumns x kRows pixels. In all packet types the fields of a ray are arrays.
  template <int kColumns, int kRows, class Packet, class Intersect>
  void render_tiles(const Camera& camera, bool coherent, Distances& out,
                    Intersect intersect) const {
    constexpr int kRays = kColumns * kRows;
    const FloatCamera rays(camera);
    const int columns = camera.width / kColumns, rows = camera.height / kRows;
    workers_.for_parts(size_t(rows), 4, [&](size_t first, size_t last, size_t) {
      // As Embree's manual asks for.
      _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags =
          coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
      alignas(64) int valid[kRays];
      std::fill_n(valid, kRays, -1);
      for (size_t row = first; row < last; ++row) {
        for (int column = 0; column < columns; ++column) {
          Packet packet;
          for (int i = 0; i < kRays; ++i) {
            const int x = column * kColumns + i % kColumns;
            const int y = int(row) * kRows + i / kColumns;
            const Vec3f d = rays.direction(x, y);
            at(packet.ray.org_x, i) = rays.eye.x;
            at(packet.ray.org_y, i) = rays.eye.y;
            at(packet.ray.org_z, i) = rays.eye.z;
            at(packet.ray.dir_x, i) = d.x;
            at(packet.ray.dir_y, i) = d.y;
            at(packet.ray.dir_z, i) = d.z;
            at(packet.ray.tnear, i) = 0;
            at(packet.ray.tfar, i) = std::numeric_limits<float>::infinity();
            at(packet.ray.time, i) = 0;
            at(packet.ray.mask, i) = ~0u;
            at(packet.ray.id, i) = unsigned(i);
            at(packet.ray.flags, i) = 0;
            at(packet.hit.geomID, i) = RTC_INVALID_GEOMETRY_ID;
            at(packet.hit.instID[0], i) = RTC_INVALID_GEOMETRY_ID;
          }
          intersect(valid, scene_, &context, &packet);
          for (int i = 0; i < kRays; ++i) {
            const size_t x = size_t(column * kColumns + i % kColumns);
            const size_t y = row * kRows + size_t(i / kColumns);
            out[y * size_t(camera.width) + x] = at(packet.ray.tfar, i);
          }
        }
      }
    });
  }
  template <class T>
  static T& at(T& field, int) {
    return field;
  }
  template <class T, size_t n>
  static T& at(T (&field)[n], int i) {
    return field[i];
  }

  RTCDevice device_;
  RTCScene scene_;
  Workers workers_;
};

struct PictureCheck {
  size_t looked_at = 0, hits = 0, wrong = 0;
};

/// Every third pixel of every third row against all the balls, in double precision.
PictureCheck check(const std::vector<Ball>& balls, const Camera& camera, const Distances& seen,
                   const Workers& workers) {
  constexpr int kStep = 3;
  constexpr double kRelative = 1e-3;  // single precision, far from the eye
  std::atomic<size_t> looked_at = 0, hits = 0, wrong = 0;
  const auto rows = size_t((camera.height + kStep - 1) / kStep);
  workers.for_parts(rows, 1, [&](size_t first, size_t last, size_t) {
    for (size_t row = first; row < last; ++row) {
      const int y = int(row) * kStep;
      for (int x = 0; x < camera.width; x += kStep) {
        const Ray ray = camera.ray(x + 0.5, y + 0.5);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Ball& ball : balls) {
          const Vec3 to = ball.center - ray.origin;
          const double along = dot(to, ray.direction);
          const double rest = ball.radius * ball.radius - dot(to, to) + along * along;
          if (rest < 0) continue;
          const double half = std::sqrt(rest);
          const double t = along - half > 0 ? along - half : along + half;
          if (t > 0) nearest = std::min(nearest, t);
        }
        const size_t pixel = size_t(y) * size_t(camera.width) + size_t(x);
        const Vec3f d = FloatCamera(camera).direction(x, y);
        const double t = double(seen[pixel]) * std::sqrt(double(dot(d, d)));
        const bool same = std::isinf(nearest) || std::isinf(t)
                              ? std::isinf(nearest) == std::isinf(t)
                              : std::fabs(t - nearest) <= kRelative * nearest;
        ++looked_at;
        hits += !std::isinf(nearest);
        wrong += !same;
      }
    }
  });
  return {looked_at, hits, wrong};
}

template <class Work>
double milliseconds(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.milliseconds();
}

[[noreturn]] void fail(const std::string& why) {
  fmt::print(stderr, "embree_union: {}\n", why);
  std::exit(1);
}

Options read_options(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    if (i + 1 == argc) fail(fmt::format("{} wants a value", name));
    if (name == "--model") {
      o.model = argv[i + 1];
      continue;
    }
    int* number = name == "--n"         ? &o.n
                  : name == "--size"    ? &o.size
                  : name == "--threads" ? &o.threads
                  : name == "--repeat"  ? &o.repeat
                                        : nullptr;
    if (number == nullptr || (*number = std::atoi(argv[i + 1])) <= 0) {
      fail(fmt::format("{} {}: not understood", name, argv[i + 1]));
    }
  }
  if (o.size % 16 != 0) fail("--size must be a multiple of 16");
  return o;
}

int compare(const Options& o) {
  const Result<std::string> text = generate_model(o.model, o.n, kDefaultSeed);
  if (!text) fail(text.error().message);
  const Result<Read> read = read_csg(*text, o.model);
  if (!read) fail(read.error().message);
  RendererSettings settings;
  settings.threads = o.threads;
  Result<Renderer> renderer = Renderer::make(read->model, settings);
  if (!renderer) fail(renderer.error().message);
  ViewOptions view;
  view.width = view.height = o.size;
  const Camera camera = renderer->camera(view);
  if (const Status done = renderer->prepare(camera); !done) fail(done.error().message);
  if (const Result<Frame> frame = renderer->trace(camera); !frame) fail(frame.error().message);

  const std::vector<Ball> balls = balls_of(read->model);
  const EmbreeUnion embree(balls, o.threads);
  if (!embree.is_ready()) fail("Embree could not make its scene");

  struct Variant {
    int packet;
    bool coherent;
    std::vector<double> times = {};
  };
  std::vector<Variant> variants;
  for (const int packet : {1, 4, 8, 16})
    for (const bool coherent : {false, true}) variants.push_back({packet, coherent});

  const Workers workers(o.threads);
  Distances seen;
  PictureCheck checked;
  for (const Variant& v : variants) {
    embree.render(camera, v.packet, v.coherent, seen);
    checked = check(balls, camera, seen, workers);
    // Rays that only just touch a ball are decided by rounding, so a few may differ.
    constexpr size_t kMostWrong = 1000;
    if (checked.wrong * kMostWrong > checked.looked_at) {
      fail(fmt::format("Embree, packets of {}: wrong at {} of {} pixels; nothing was measured",
                       v.packet, checked.wrong, checked.looked_at));
    }
  }
  std::vector<double> ours;
  for (int i = 0; i < o.repeat; ++i) {
    ours.push_back(milliseconds([&] { WHITTLE_CHECK(renderer->trace(camera)); }));
    for (Variant& v : variants) {
      v.times.push_back(milliseconds([&] { embree.render(camera, v.packet, v.coherent, seen); }));
    }
  }

  const double rays = double(o.size) * double(o.size);
  nlohmann::ordered_json json;
  json["model"] = fmt::format("{}{}", o.model, o.n);
  json["spheres"] = balls.size();
  json["size"] = o.size;
  json["threads"] = o.threads;
  json["repeat"] = o.repeat;
  json["checked"] = checked.looked_at;
  json["union_hits"] = checked.hits;
  json["wrong"] = checked.wrong;
  double best = std::numeric_limits<double>::infinity();
  for (const Variant& v : variants) {
    const double ms = median(v.times);
    json["embree"].push_back({{"packet", v.packet},
                              {"coherent", v.coherent},
                              {"ms", ms},
                              {"million_rays_per_second", rays / ms / 1000}});
    if (ms >= best) continue;
    best = ms;
    json["embree_best_packet"] = v.packet;
  }
  json["embree_ms"] = best;
  json["embree_million_rays_per_second"] = rays / best / 1000;
  json["whittle_ms"] = median(ours);
  json["whittle_million_rays_per_second"] = rays / median(ours) / 1000;
  json["ratio"] = best / median(ours);
  fmt::print("{}\n", json.dump(2));
  return 0;
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  return whittle::compare(whittle::read_options(argc, argv));
}
