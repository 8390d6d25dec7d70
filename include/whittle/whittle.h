// whittle as a library: exact pictures, and the facts behind them, of Constructive Solid Geometry.
//
//     whittle::Solid solid = whittle::Solid::load("part.csg");
//     whittle::Rendering picture = solid.render({.width = 800, .height = 600});
//     picture.write("part.png");
//
// This is the whole of it: one header, which needs nothing but the standard library. Coordinates,
// distances, ids and cameras are as docs/conventions.md says; choices are made by the names that
// the program has for them (docs/whittle.1.md).
//
// What fails throws whittle::Failure; where memory runs out, std::bad_alloc. Nothing is printed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace whittle {

/// Something from outside is not as it must be. what() is one line for a person.
class Failure : public std::runtime_error {
 public:
  /// Why, in the words of the program's exit codes.
  enum class Cause {
    kInput = 1,    ///< the file or its content
    kUsage = 2,    ///< an option: a name that does not exist, a size that is not possible
    kMachine = 3,  ///< device, memory, disk
  };

  Failure(Cause cause, const std::string& message) : std::runtime_error(message), cause_(cause) {}
  Cause cause() const noexcept { return cause_; }

 private:
  Cause cause_;
};

using Point = std::array<double, 3>;

struct LoadOptions {
  std::string curves = "auto";        ///< "auto", "facets" or "smooth"
  bool outlines = false;              ///< of a drawing, for style "openscad"
  std::string matrices = "polished";  ///< or "as-written": rotations keep the error of six digits

  // What is too much: a file that passes one of these limits is refused.
  std::size_t most_bytes = 500'000'000;  ///< of text, less than 4 GiB
  std::size_t most_depth = 1'000'000;    ///< statements inside statements
  std::size_t most_nodes = 20'000'000;   ///< statements
  std::size_t most_values = 10'000'000;  ///< numbers and other values in one statement
  std::size_t most_facets = 2'100'000;   ///< flat faces, of all bodies together

  int threads = 0;  ///< 0: all. The result does not depend on it.
};

struct RenderOptions {
  int width = 512, height = 512;  ///< pixels; each 1 to 65535, together at most 2^28

  // The view is OpenSCAD's. With none of the first five set, all of the solid is framed.
  std::optional<Point> eye, center;       ///< vector form: from eye to center, +z up
  std::optional<Point> target;            ///< gimbal form: the point looked at,
  std::optional<Point> rotation_degrees;  ///< Euler angles,
  std::optional<double> distance;         ///< from the eye to the target, model units
  bool view_all = false;                  ///< choose the distance so that the solid fits
  bool auto_center = false;               ///< with view_all: look at the middle of the solid
  bool orthographic = false;
  std::optional<double> fov_degrees;  ///< vertical, between 0 and 180; unset: the file's, else 22.5

  std::string style = "studio";  ///< "studio", "blinn" or "openscad"
  std::string color_scheme;      ///< one of OpenSCAD's; empty: the style's own
  std::optional<Point> light;    ///< "blinn": where the light stands; unset: at the eye
  bool shadows = false;          ///< lights reach only what they see; not with "openscad"
  bool background = true;        ///< false: what is not hit is transparent
  int antialias = 0;             ///< n * n rays a pixel at edges, 1 to 16; 0: what suits the style

  std::string backend = "auto";  ///< "auto", "cpu", "vulkan-raster" or "oracle"
  std::string device;            ///< "vulkan-raster": number or part of a name; empty: the best
  std::string shaders = "specialised";  ///< "vulkan-raster": or "unified"; the result is the same
  int threads = 0;                      ///< 0: all. The result does not depend on it.
  /// What the cells that space is cut into may take, bytes; with less every ray takes more time.
  /// The result does not depend on it.
  std::size_t cell_memory = std::size_t(1) << 30;
};

/// A picture and its facts; width * height entries each, rows from the top, each from the left.
struct Rendering {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< four bytes a pixel: sRGB, straight alpha
  std::vector<float> distance;     ///< along the ray from the eye; infinity where nothing is hit
  std::vector<float> normal;       ///< three floats a pixel: unit, outward; zero: nothing hit
  std::vector<std::uint32_t> id;   ///< the primitive statement that is seen; 0: nothing hit
  std::string backend;             ///< the one that was used
  bool transparent = false;        ///< made without background

  /// Writes a .png (the picture) or an .exr (picture and facts), as the name ends. The file is
  /// there whole or not at all.
  void write(const std::string& path) const;
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

  /// `file:line:column: warning: ...`, in the order of the file.
  const std::vector<std::string>& warnings() const;
  /// False if something in the file is not supported, so that it may not be what was meant.
  bool is_complete() const;
  /// The number of primitive statements in the file; ids are 1 to this.
  std::uint32_t statement_count() const;
  /// The box that holds the solid, {lowest corner, highest corner}; none if the solid is empty or
  /// unbounded.
  std::optional<std::array<Point, 2>> bounds() const;

  /// Costs all stages; nothing is kept between calls.
  Rendering render(const RenderOptions& options = {}) const;

 private:
  struct State;
  explicit Solid(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

}  // namespace whittle
