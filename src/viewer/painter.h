// The thread that makes pictures of a model for a window, which never waits for it: of what is
// asked for, only the latest counts.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "csg/read_csg.h"
#include "viewer/frame_plan.h"
#include "viewer/orbit_view.h"
#include "whittle/choices.h"
#include "whittle/renderer.h"

namespace whittle {

/// A model, and what is made of it. The one way from a model to pictures in a window.
struct Drawable {
  Read read;
  std::optional<Renderer> renderer;  ///< of read.model
};

/// Fails as Renderer::make().
Result<std::unique_ptr<Drawable>> make_drawable(Read read, const RendererSettings& settings);

/// What a picture shows of what is seen.
struct Look {
  ShadeSettings shading;
  int antialias = 0;  ///< as on the command line; 0: what suits the style
  Pass pass = Pass::kColor;
  std::optional<CellView> cells{};  ///< those that were made so far, over the picture

  int rays() const {
    return antialias > 0 ? antialias : default_antialias(shading.style, shading.quality);
  }
};

struct PaintRequest {
  std::optional<OrbitView> view;  ///< none: what `framing` says, which is then told
  ViewOptions framing;
  PictureSize size;
  Look look;
  bool is_moving = false;  ///< there will be another one soon
  uint64_t number = 0;     ///< told of its pictures
};

struct Painted {
  Picture picture;  ///< of the size that was asked for
  Frame frame;      ///< what `camera` sees, which may be coarser
  Camera camera;
  OrbitView view;
  FrameStep step;
  uint64_t number = 0;
  double milliseconds = 0;

  /// The point that is seen at a position of the picture, pixels; none if nothing is hit.
  std::optional<Vec3> point_at(double x, double y) const;
};

struct PickQuestion {
  OrbitView view;
  PictureSize size;
  double x = 0, y = 0;  ///< pixels
};

struct PickAnswer {
  PickQuestion question;
  uint32_t id = 0;  ///< as in Hit; 0: nothing is there, and the rest is of no use
  Vec3 point, normal;
  double distance = 0;
  SourceLocation place;  ///< of its statement; none where the text is not the user's
};

struct SaveRequest {
  OrbitView view;
  PictureSize size;
  Look look;
  std::string path;  ///< .png
};

class Painter {
 public:
  /// `notify` is called from the painter's thread whenever there is something to take.
  explicit Painter(std::function<void()> notify);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Another model from now on, and what to show of it.
  void use(std::unique_ptr<Drawable> drawable, PaintRequest request);
  /// Another picture; the one that is refined is given up.
  void show(PaintRequest request);
  void ask(const PickQuestion& question);
  /// Writes the final picture: the bytes that the command line would write.
  void save(SaveRequest request);

  struct News {
    std::optional<Painted> painted;  ///< the latest
    std::vector<PickAnswer> answers;
    std::vector<Result<std::string>> saved;  ///< the path of each
    std::optional<Error> failure;            ///< why there is no picture
  };
  News take();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whittle
