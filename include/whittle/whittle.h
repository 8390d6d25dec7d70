// whittle as a library: exact pictures, and the facts behind them, of Constructive Solid Geometry.
//
//     whittle::Solid solid = whittle::Solid::load("part.csg");
//     whittle::Rendering picture = solid.render({.width = 800, .height = 600});
//     picture.write("part.png");
//
// This is the whole of it; it needs nothing but the standard library. Coordinates, distances, ids
// and cameras are as docs/conventions.md says.
//
// What fails throws whittle::Failure; where memory runs out, std::bad_alloc. Nothing is printed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "whittle/options.h"

namespace whittle {

/// Something from outside is not as it must be. what() is one line for a person.
class Failure : public std::runtime_error {
 public:
  /// Why, in the words of the program's exit codes.
  enum class Cause {
    kInput = 1,    ///< the file or its content
    kUsage = 2,    ///< an option: a size that is not possible, a name that does not exist
    kMachine = 3,  ///< device, memory, disk
  };

  Failure(Cause cause, const std::string& message) : std::runtime_error(message), cause_(cause) {}
  Cause cause() const noexcept { return cause_; }

 private:
  Cause cause_;
};

using Point = std::array<double, 3>;

struct LoadOptions {
  Curves curves = Curves::kAuto;
  /// That of pictures that ask for none. With kOpenscad curves are kOpenscad2021, unless they are
  /// to be smooth, and drawings get outlines.
  Style style = Style::kStudio;
  /// Rotations get back what printing them with six digits took; false: they are as written.
  bool polish_matrices = true;
  ReadLimits limits{};
  int threads = 0;  ///< 0: all. The result does not depend on it.
};

/// What is rendered.
struct RenderOptions {
  int width = 512, height = 512;  ///< pixels; each 1 to 65535, together at most 2^28

  // The view is OpenSCAD's. With none of the first five set, all of the solid is framed: tightly in
  // style kStudio, as OpenSCAD does it in the others.
  std::optional<Point> eye{}, center{};     ///< vector form: from eye to center, +z up
  std::optional<Point> target{};            ///< gimbal form: the point looked at,
  std::optional<Point> rotation_degrees{};  ///< Euler angles,
  std::optional<double> distance{};         ///< from the eye to the target, model units
  bool view_all = false;                    ///< choose the distance so that the solid fits
  bool auto_center = false;                 ///< with view_all: look at the middle of the solid
  bool orthographic = false;
  std::optional<double>
      fov_degrees{};  ///< vertical, between 0 and 180; unset: the file's, else 22.5

  std::optional<Style> style{};      ///< unset: that of LoadOptions
  std::string color_scheme{};        ///< one of OpenSCAD's; empty: the style's own
  std::optional<Point> light{};      ///< Style::kBlinn: where the light stands; unset: at the eye
  bool shadows = false;              ///< lights reach only what they see; not with Style::kOpenscad
  Quality quality = Quality::kGood;  ///< Style::kStudio
  bool ground = true;                ///< Style::kStudio: a soft shadow below the solid
  bool hatch = false;                ///< what Solid::cut_open() cuts through is hatched
  bool xray = false;       ///< all walls at once, the outer ones faint; of the look only the colour
                           ///< scheme, background and antialias count
  bool background = true;  ///< false: what is not hit is transparent
  int antialias = 0;       ///< n * n rays a pixel at edges, 1 to 16; 0: what suits the style
};

/// What renders it.
struct SessionOptions {
  Backend backend = Backend::kAuto;
  std::string device{};  ///< kVulkanRaster: number or part of a name; empty: the best
  ShaderCases shaders = ShaderCases::kSpecialised;  ///< kVulkanRaster
  int threads = 0;                                  ///< 0: all. The result does not depend on it.
  /// What the cells that space is cut into may take, bytes; with less every ray takes more time.
  /// The result does not depend on it.
  std::size_t cell_memory = std::size_t(1) << 30;
};

/// A ray from a point on; the direction's length does not count, but must be positive.
struct WorldRay {
  Point from, direction;
};

/// Where a ray first enters or leaves the solid.
struct Seen {
  std::uint32_t id = 0;  ///< the primitive statement whose surface it is; 0: nothing is met
  double distance = 0;   ///< from where the ray starts, model units
  Point point{};
  Point normal{};  ///< unit, outward
  /// It is where Solid::cut_open() cuts, and `id` is the statement whose material it cuts through.
  /// Beyond statement_count() if that is too thin to be told.
  bool is_cap = false;

  explicit operator bool() const { return id != 0; }
};

/// A part of a picture that is being traced, and what its pixels show so far: some that show
/// nothing may show something when the part is told again. Rows from the top, each from the left.
struct Part {
  int x = 0, y = 0;           ///< its first pixel
  int width = 0, height = 0;  ///< pixels
  std::vector<std::uint32_t> id;
  std::vector<float> distance;  ///< along the ray from the eye; infinity where nothing is hit
};

/// What long work is told, and tells, while it runs. All of it may be left out. The functions are
/// called from any thread, several at a time, and must not throw.
struct Control {
  /// Once a stop is requested, the call returns soon, and without a result.
  std::stop_token stop{};
  /// Of a picture's tracing, or of a boundary, the share that is done, 0 to 1.
  std::function<void(double share)> progress{};
  std::function<void(const Part&)> part{};  ///< of pictures, before antialiasing and colours
};

/// A picture and its facts; width * height entries each, rows from the top, each from the left.
struct Rendering {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;   ///< four bytes a pixel: sRGB, straight alpha
  std::vector<float> distance;      ///< along the ray from the eye; infinity where nothing is hit
  std::vector<float> normal;        ///< three floats a pixel: unit, outward; zero: nothing hit
  std::vector<std::uint32_t> id;    ///< the primitive statement that is seen; 0: nothing hit
  Backend backend = Backend::kCpu;  ///< the one that was used
  bool transparent = false;         ///< made without background

  /// Writes a .png (the picture) or an .exr (picture and facts), as the name ends. The file is
  /// there whole or not at all.
  void write(const std::string& path) const;
};

/// Where something stands in a text; both count from 1, columns in bytes.
struct Place {
  std::uint32_t line = 0, column = 0;
  bool operator==(const Place&) const = default;
};

/// The boundary of a solid: what `whittle part.csg -o part.off` writes, and whose it is. Closed,
/// oriented and manifold by number of corner: every edge of a triangle is there exactly once each
/// way. Where a solid touches itself, corners are there more than once, at one place.
struct BoundaryMesh {
  /// Runs of corners, the last of which is joined to the first. Seen from outside what is solid
  /// lies to their left: outer loops run counter-clockwise, those of holes clockwise.
  using Loop = std::vector<std::uint32_t>;
  /// What a primitive statement has of the boundary in one plane, or several of them if they have
  /// one colour: in one part or many.
  struct Face {
    std::uint32_t id = 0;  ///< the statement, of several the first
    Point normal{};        ///< unit, outward
    /// That of the outermost color() above it, red, green, blue and alpha, 0 to 1; none: no colour.
    std::optional<std::array<float, 4>> color{};
    std::vector<Loop> loops{};                             ///< into corners
    std::uint32_t first_triangle = 0, triangle_count = 0;  ///< the same as triangles
  };
  std::vector<Point> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<Face> faces;

  /// Writes a .stl (binary), .off, .obj, .3mf (with colours) or .amf, as the name ends. The file is
  /// there whole or not at all.
  void write(const std::string& path) const;
};

class Csg;

/// What lies beyond it is taken away: the points p with normal . p >= offset.
struct CuttingPlane {
  Point normal{};  ///< of any length but zero
  double offset = 0;
};

/// A loaded model. Copies share it; all uses of one object or its copies from several threads at a
/// time are safe, as nothing changes it.
class Solid {
 public:
  /// Reads a .csg file, or a .scad file by means of the openscad program; "-" is standard input.
  static Solid load(const std::string& path, const LoadOptions& options = {});
  /// Reads .csg text; `name` is what messages call it.
  static Solid parse(std::string_view text, const std::string& name = "<text>",
                     const LoadOptions& options = {});
  /// What was made in code. Its primitives are numbered in the order in which a text would hold
  /// them.
  static Solid make(const Csg& csg, const LoadOptions& options = {});

  /// `file:line:column: warning: ...`, in the order of the file.
  const std::vector<std::string>& warnings() const;
  /// False if something in the file is not supported, so that it may not be what was meant.
  bool is_complete() const;
  /// The number of primitive statements in the file; ids are 1 to this.
  std::uint32_t statement_count() const;
  /// Where the statement of that id stands in the text; none if it does not, or was left out.
  std::optional<Place> place(std::uint32_t id) const;
  /// The box that holds the solid, {lowest corner, highest corner}; none if the solid is empty or
  /// unbounded.
  std::optional<std::array<Point, 2>> bounds() const;

  /// The boundary. A kInput failure if the solid is empty, without end or flat, or has true curves:
  /// with LoadOptions::curves kFacets or kOpenscad2021 it has none, but for more than 2048 facets
  /// around. `threads` 0: all; the result does not depend on it.
  BoundaryMesh boundary(int threads = 0) const;
  /// None if it was stopped.
  std::optional<BoundaryMesh> boundary(const Control& control, int threads = 0) const;

  /// The solid cut open. Each section takes away what lies beyond all of its planes: with one that
  /// is a half of space, with two a quarter. Parts that have one of the colours `kept` (red, green
  /// and blue, 0 to 1) stay whole. Pictures are framed as of the whole solid. A kUsage failure if
  /// it is flat, or a plane is none.
  Solid cut_open(const std::vector<std::vector<CuttingPlane>>& sections,
                 const std::vector<std::array<float, 3>>& kept = {}) const;

  /// One picture; for several, a Session keeps what they share.
  Rendering render(const RenderOptions& options = {}, const SessionOptions& session = {}) const;

 private:
  friend class Session;
  struct State;
  explicit Solid(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

/// Keeps what pictures of one solid have in common: surfaces, cells and the device. Its calls may
/// come from one thread at a time. Pictures are those that Solid::render() makes.
class Session {
 public:
  explicit Session(const Solid& solid, const SessionOptions& options = {});
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  Rendering render(const RenderOptions& options = {});
  /// None if it was stopped.
  std::optional<Rendering> render(const RenderOptions& options, const Control& control);

  /// What is seen at a position of the picture that render() would make: in pixels, (0, 0) is its
  /// top left corner, and the middle of the first pixel is (0.5, 0.5).
  Seen pick(const RenderOptions& options, double x, double y);
  /// What rays see, as many as there are. The fastest are those whose neighbours go nearly the same
  /// way. Precondition: all numbers are finite.
  std::vector<Seen> cast(std::span<const WorldRay> rays);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A solid in the making, for models that are made in code:
///
///     Csg plate = Csg::cube({40, 20, 5}) - Csg::cylinder(7, 3).moved({20, 10, -1});
///
/// A value: what is made of it leaves it as it is, and shares it. Numbers must be finite.
class Csg {
 public:
  static Csg cube(const Point& size, bool centered = false);
  /// `facets` 0: a true sphere; 3 to 2048: OpenSCAD's polyhedron for that $fn.
  static Csg sphere(double r, int facets = 0);
  /// Along z from 0 to h, or about 0. `facets` as above.
  static Csg cylinder(double h, double r, bool centered = false, int facets = 0);
  /// With r1 below and r2 above; one of them may be 0.
  static Csg cone(double h, double r1, double r2, bool centered = false, int facets = 0);
  /// Faces are loops of indices of points, clockwise seen from outside.
  static Csg polyhedron(std::vector<Point> points, std::vector<std::vector<std::uint32_t>> faces);
  /// The points p with normal . p <= offset.
  static Csg half_space(const Point& normal, double offset);
  /// The inside of an outline in the plane z = 0, carried up to h.
  static Csg extrusion(std::vector<std::array<double, 2>> outline, double h);

  static Csg union_of(std::vector<Csg> operands);
  static Csg intersection_of(std::vector<Csg> operands);
  /// The first without all others.
  static Csg difference_of(std::vector<Csg> operands);
  /// The convex hull of all of them.
  static Csg hull_of(std::vector<Csg> operands);
  friend Csg operator|(const Csg& a, const Csg& b) { return union_of({a, b}); }
  friend Csg operator&(const Csg& a, const Csg& b) { return intersection_of({a, b}); }
  friend Csg operator-(const Csg& a, const Csg& b) { return difference_of({a, b}); }

  Csg moved(const Point& by) const;
  /// About x, then y, then z, as OpenSCAD's rotate().
  Csg turned(const Point& degrees) const;
  Csg scaled(const Point& by) const;
  /// Three rows of four: the point (x, y, z, 1) is mapped.
  Csg transformed(const std::array<std::array<double, 4>, 3>& rows) const;
  /// Each 0 to 1.
  Csg colored(float r, float g, float b, float a = 1) const;

 private:
  friend class Solid;
  struct Node;
  explicit Csg(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

}  // namespace whittle
