// How long does OpenCSG take for a frame, beside a frame of the vulkan-raster backend? One model (a
// body minus spheres), one camera, in turns, in one run, and both on Mesa's software rasteriser.
//
//     opencsg_frame [--n 1000] [--size 512] [--segments 32] [--threads 2] [--repeat 5]
//
// Prints one JSON object. OpenCSG's solid is made of polyhedra. Its picture is compared first with
// whittle's of the very same polyhedra, where they must agree but for edges (unless they are too
// many), and with that of the true curves, which is what whittle is then measured with. OpenCSG has
// what serves it best: SCS with occlusion queries, the bounds of every primitive on the screen,
// display lists. A frame goes from the camera to the shaded picture.
#include <GL/glew.h>
// After GLEW, which must come first.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <opencsg.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/box.h"
#include "base/degrees.h"
#include "base/timing.h"
#include "csg/read_csg.h"
#include "generate/generate.h"
#include "model/instances.h"
#include "shape/fragments.h"
#include "whittle/renderer.h"

namespace whittle {
namespace {

struct Options {
  int n = 1000, size = 512, segments = 32, threads = 2, repeat = 5;
};

[[noreturn]] void fail(const std::string& why) {
  fmt::print(stderr, "opencsg_frame: {}\n", why);
  std::exit(1);
}

/// OpenGL without a display, drawing into a buffer of its own.
void open_gl(int size) {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) fail("EGL knows no platforms");
  const EGLDisplay display =
      get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (!eglInitialize(display, nullptr, nullptr)) fail("EGL has no display without a screen");
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_DEPTH_SIZE,
                           24,
                           EGL_STENCIL_SIZE,
                           8,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) fail("no EGL config");
  const EGLint sides[] = {EGL_WIDTH, size, EGL_HEIGHT, size, EGL_NONE};
  const EGLSurface surface = eglCreatePbufferSurface(display, config, sides);
  eglBindAPI(EGL_OPENGL_API);
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
  if (!eglMakeCurrent(display, surface, surface, context)) fail("no OpenGL context");
  // Debian's GLEW then looks for an X display in vain; OpenGL's own functions are there by then.
  if (const GLenum error = glewInit(); error != GLEW_OK && error != GLEW_ERROR_NO_GLX_DISPLAY) {
    fail(reinterpret_cast<const char*>(glewGetErrorString(error)));
  }
}

void load_matrix(GLenum which, const double (&columns)[16]) {
  glMatrixMode(which);
  glLoadMatrixd(columns);
}

/// The camera in OpenGL, the depth range tight about a box.
struct Projection {
  const Camera& camera;
  double near, far;

  Projection(const Camera& c, const Box& box) : camera(c), near(kInfinity), far(0) {
    for (int i = 0; i < 8; ++i) {
      const double depth = dot(box.corner(i) - c.eye, c.forward);
      near = std::min(near, depth), far = std::max(far, depth);
    }
    if (near <= 0) fail("the eye is in the model");
    near *= 0.99, far *= 1.01;
  }
  void load() const {
    const Vec3 r = camera.right, u = camera.up, b = camera.forward * -1, e = camera.eye;
    load_matrix(GL_PROJECTION, {1 / camera.half_height, 0, 0, 0,        //
                                0, 1 / camera.half_height, 0, 0,        //
                                0, 0, (near + far) / (near - far), -1,  //
                                0, 0, 2 * near * far / (near - far), 0});
    load_matrix(GL_MODELVIEW, {r.x, u.x, b.x, 0, r.y, u.y, b.y, 0, r.z, u.z, b.z, 0,  //
                               -dot(r, e), -dot(u, e), -dot(b, e), 1});
  }
  /// Of a point in front of the eye: normalised device coordinates, each -1 to 1.
  Vec3 device(Vec3 world) const {
    const Vec3 p = world - camera.eye;
    const double depth = dot(p, camera.forward);
    return {dot(p, camera.right) / (depth * camera.half_height),
            dot(p, camera.up) / (depth * camera.half_height),
            (far + near - 2 * far * near / depth) / (far - near)};
  }
  /// The depth of what is in the depth buffer at a value below 1.
  double depth_of(double value) const {
    return 2 * far * near / (far + near - (2 * value - 1) * (far - near));
  }
};

/// OpenSCAD's polyhedron of a shape as triangles, for positions alone and with normals.
class Mesh {
 public:
  explicit Mesh(const Shape& shape, int segments)
      : positions_(glGenLists(2)), is_sphere_(std::holds_alternative<Sphere>(shape)) {
    std::vector<Vec3> rings;
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      const int count = (segments + 1) / 2;
      for (int i = 0; i < count; ++i) {
        const double polar = 180.0 * (i + 0.5) / count;
        rings.push_back({sphere->r * sin_degrees(polar), 0, sphere->r * cos_degrees(polar)});
      }
    } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
      const double bottom = cylinder->center ? -cylinder->h / 2 : 0;
      rings = {{cylinder->r2, 0, bottom + cylinder->h}, {cylinder->r1, 0, bottom}};
    } else {
      fail("only spheres and cylinders can be compared");
    }
    for (const bool with_normals : {false, true}) {
      glNewList(positions_ + with_normals, GL_COMPILE);
      draw(rings, segments, with_normals);
      glEndList();
    }
  }

  GLuint list(bool with_normals) const { return positions_ + with_normals; }

 private:
  void draw(const std::vector<Vec3>& rings, int n, bool with_normals) const {
    const auto vertex = [&](Vec3 ring, int k, Vec3 flat) {
      const double x = cos_degrees(360.0 * k / n), y = sin_degrees(360.0 * k / n);
      if (with_normals && flat.z != 0) glNormal3d(0, 0, flat.z);
      if (with_normals && flat.z == 0) glNormal3d(ring.x * x, ring.x * y, is_sphere_ ? ring.z : 0);
      glVertex3d(ring.x * x, ring.x * y, ring.z);
    };
    glBegin(GL_TRIANGLES);
    for (size_t i = 0; i + 1 < rings.size(); ++i) {
      for (int k = 0; k < n; ++k) {
        vertex(rings[i], k, {}), vertex(rings[i + 1], k, {}), vertex(rings[i + 1], k + 1, {});
        vertex(rings[i], k, {}), vertex(rings[i + 1], k + 1, {}), vertex(rings[i], k + 1, {});
      }
    }
    for (int k = 1; k + 1 < n; ++k) {
      vertex(rings[0], 0, {0, 0, 1}), vertex(rings[0], k, {0, 0, 1});
      vertex(rings[0], k + 1, {0, 0, 1});
      vertex(rings.back(), 0, {0, 0, -1}), vertex(rings.back(), k + 1, {0, 0, -1});
      vertex(rings.back(), k, {0, 0, -1});
    }
    glEnd();
  }

  GLuint positions_;
  bool is_sphere_;
};

class Drawn : public OpenCSG::Primitive {
 public:
  Drawn(OpenCSG::Operation operation, const Mesh& mesh, const Affine& world_from_object)
      : Primitive(operation, 1), mesh_(mesh) {
    const Vec3 o = world_from_object.point({});
    const Vec3 x = world_from_object.point({1, 0, 0}) - o;
    const Vec3 y = world_from_object.point({0, 1, 0}) - o;
    const Vec3 z = world_from_object.point({0, 0, 1}) - o;
    const double columns[16] = {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0,
                                z.x, z.y, z.z, 0, o.x, o.y, o.z, 1};
    std::copy(columns, columns + 16, matrix_);
  }
  void render() override { draw(false); }
  void draw(bool with_normals) const {
    glPushMatrix();
    glMultMatrixd(matrix_);
    glCallList(mesh_.list(with_normals));
    glPopMatrix();
  }

 private:
  const Mesh& mesh_;
  double matrix_[16];
};

/// The model, which must be a difference of spheres and cylinders.
class OpencsgScene {
 public:
  OpencsgScene(const Model& model, const Projection& projection, int segments)
      : projection_(projection) {
    const std::vector<Appearance> looks = appearances(model);
    for (const Instance& instance : instances(model)) {
      const Shape& shape = model.primitives[instance.primitive].shape;
      meshes_.push_back(std::make_unique<Mesh>(shape, segments));
      const bool cut = looks[model.primitives[instance.primitive].id].cut;
      drawn_.push_back(std::make_unique<Drawn>(cut ? OpenCSG::Subtraction : OpenCSG::Intersection,
                                               *meshes_.back(), instance.world_from_object));
      const Box box = transform(instance.world_from_object, box_of(shape));
      Box seen;
      for (int i = 0; i < 8; ++i) seen.include(projection.device(box.corner(i)));
      drawn_.back()->setBoundingBox(float(seen.lo.x), float(seen.lo.y), float(seen.lo.z),
                                    float(seen.hi.x), float(seen.hi.y), float(seen.hi.z));
      all_.push_back(drawn_.back().get());
    }
    OpenCSG::setOption(OpenCSG::AlgorithmSetting, OpenCSG::SCS);
    OpenCSG::setOption(OpenCSG::DepthComplexitySetting, OpenCSG::OcclusionQuery);
    OpenCSG::setOption(OpenCSG::OffscreenSetting, OpenCSG::FrameBufferObject);
  }

  /// One frame, to the end.
  void render() const {
    projection_.load();
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    OpenCSG::render(all_);
    glDepthFunc(GL_EQUAL);
    glEnable(GL_LIGHTING);
    glEnable(GL_LIGHT0);
    glEnable(GL_NORMALIZE);
    for (const auto& primitive : drawn_) primitive->draw(true);
    glDisable(GL_LIGHTING);
    glDepthFunc(GL_LESS);
    glFinish();
  }

  /// Distances along the rays, rows from the top; infinity where nothing is.
  std::vector<double> distances() const {
    const Camera& c = projection_.camera;
    std::vector<float> depths(size_t(c.width) * size_t(c.height));
    glReadPixels(0, 0, c.width, c.height, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    std::vector<double> distances(depths.size(), kInfinity);
    for (int y = 0; y < c.height; ++y) {
      for (int x = 0; x < c.width; ++x) {
        const float value = depths[size_t(c.height - 1 - y) * size_t(c.width) + size_t(x)];
        if (value >= 1) continue;
        const Ray ray = c.ray(x + 0.5, y + 0.5);
        distances[size_t(y) * size_t(c.width) + size_t(x)] =
            projection_.depth_of(double(value)) / dot(ray.direction, c.forward);
      }
    }
    return distances;
  }

 private:
  static Box box_of(const Shape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      const double r = sphere->r;
      return {{-r, -r, -r}, {r, r, r}};
    }
    const auto& c = std::get<Cylinder>(shape);
    const double r = std::max(c.r1, c.r2), bottom = c.center ? -c.h / 2 : 0;
    return {{-r, -r, bottom}, {r, r, bottom + c.h}};
  }

  const Projection& projection_;
  std::vector<std::unique_ptr<Mesh>> meshes_;
  std::vector<std::unique_ptr<Drawn>> drawn_;
  std::vector<OpenCSG::Primitive*> all_;
};

/// Shares of the picture.
struct Difference {
  double silhouette = 0;  ///< one hits something, the other does not
  double distance = 0;    ///< both do, more than 1/10,000 of the way apart
};

Difference difference(const std::vector<double>& theirs, const Frame& ours) {
  constexpr double kRelative = 1e-4;
  Difference d;
  for (size_t i = 0; i < theirs.size(); ++i) {
    const double t = double(ours.hits[i].distance);
    if (std::isinf(theirs[i]) != std::isinf(t)) {
      ++d.silhouette;
    } else if (!std::isinf(t) && std::fabs(theirs[i] - t) > kRelative * t) {
      ++d.distance;
    }
  }
  d.silhouette /= double(theirs.size()), d.distance /= double(theirs.size());
  return d;
}

template <class Work>
double milliseconds(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.milliseconds();
}

Options read_options(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    int* number = name == "--n"          ? &o.n
                  : name == "--size"     ? &o.size
                  : name == "--segments" ? &o.segments
                  : name == "--threads"  ? &o.threads
                  : name == "--repeat"   ? &o.repeat
                                         : nullptr;
    if (number == nullptr || i + 1 == argc || (*number = std::atoi(argv[i + 1])) <= 0) {
      fail(fmt::format("{}: not understood", name));
    }
  }
  return o;
}

template <class T>
T checked(Result<T> result) {
  if (!result) fail(result.error().message);
  return *std::move(result);
}

Renderer prepared(const Model& model, RendererSettings settings, const Camera& camera) {
  Renderer renderer = checked(Renderer::make(model, settings));
  if (Status done = renderer.prepare(camera); !done) fail(done.error().message);
  return renderer;
}

void draw_frame(Renderer& renderer, const Camera& camera) {
  ShadeSettings shading;
  shading.style = Style::kBlinn;
  checked(renderer.shade(checked(renderer.trace(camera)), camera, shading, 1));
}

/// Nothing is measured if too much of the picture is wrong.
void accept(double differing_share) {
  constexpr double kMostDiffering = 0.01;
  if (differing_share <= kMostDiffering) return;
  fail(fmt::format("the pictures differ at {:.2f} % of the pixels", 100 * differing_share));
}

int compare(const Options& o) {
  constexpr int64_t kMostFacets = 600'000;
  // Both drivers take it from there, before they are opened.
  ::setenv("LP_NUM_THREADS", std::to_string(o.threads).c_str(), 1);
  const std::string text = checked(generate_model("cheese", o.n, kDefaultSeed));
  const Read smooth = checked(read_csg(text, "cheese"));
  RendererSettings settings;
  settings.threads = o.threads;
  settings.backend = Backend::kVulkanRaster;
  settings.device = "llvmpipe";
  Renderer renderer = checked(Renderer::make(smooth.model, settings));
  ViewOptions view;
  view.width = view.height = o.size;
  const Camera camera = renderer.camera(view);

  open_gl(o.size);
  const Projection projection(camera, bounds(smooth.model).box);
  const OpencsgScene scene(smooth.model, projection, o.segments);
  scene.render();
  const std::vector<double> theirs = scene.distances();
  RendererSettings on_cpu_settings = settings;
  on_cpu_settings.backend = Backend::kCpu;
  std::optional<Difference> of_facets;
  if (int64_t(o.n) * o.segments * o.segments / 2 <= kMostFacets) {
    const Read facets = checked(read_csg(fmt::format("$fn = {};\n", o.segments) + text, "cheese",
                                         {.curves = Curves::kFacets}));
    Renderer of_polyhedra = prepared(facets.model, on_cpu_settings, camera);
    of_facets = difference(theirs, checked(of_polyhedra.trace(camera)));
    accept(of_facets->silhouette + of_facets->distance);
  }
  if (Status done = renderer.prepare(camera); !done) fail(done.error().message);
  const Difference of_curves = difference(theirs, checked(renderer.trace(camera)));

  accept(of_curves.silhouette);

  Renderer on_cpu = prepared(smooth.model, on_cpu_settings, camera);
  draw_frame(on_cpu, camera);
  std::vector<double> opencsg, raster, cpu;
  for (int i = 0; i < o.repeat; ++i) {
    opencsg.push_back(milliseconds([&] { scene.render(); }));
    raster.push_back(milliseconds([&] { draw_frame(renderer, camera); }));
    cpu.push_back(milliseconds([&] { draw_frame(on_cpu, camera); }));
  }
  nlohmann::ordered_json json;
  json["model"] = fmt::format("cheese{}", o.n);
  json["size"] = o.size;
  json["segments"] = o.segments;
  json["threads"] = o.threads;
  json["repeat"] = o.repeat;
  json["opencsg"] = OPENCSG_VERSION_STRING;
  json["opencsg_driver"] = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  json["opencsg_driver_version"] = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  json["whittle_device"] = renderer.backend_note();
  json["differs_from_facets"] = nullptr;
  if (of_facets) json["differs_from_facets"] = of_facets->silhouette + of_facets->distance;
  json["silhouette_differs_from_curves"] = of_curves.silhouette;
  json["opencsg_ms"] = median(opencsg);
  json["whittle_ms"] = median(raster);
  json["whittle_cpu_ms"] = median(cpu);
  json["ratio"] = median(opencsg) / median(raster);
  fmt::print("{}\n", json.dump(2));
  return 0;
}

}  // namespace
}  // namespace whittle

int main(int argc, char** argv) {
  return whittle::compare(whittle::read_options(argc, argv));
}
