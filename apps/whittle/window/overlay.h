// Dear ImGui over a picture: fed with what happens to the window, drawn without a graphics library.
#pragma once

#include <functional>
#include <memory>

#include "input.h"
#include "viewer/orbit_view.h"
#include "viewer/triangles.h"

namespace whittle {

class ScreenWindow;

class Overlay {
 public:
  /// Letters are as many times as large. Only one at a time. `window` must outlive it: it has the
  /// clipboard.
  Overlay(ScreenWindow& window, double scale);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  void feed(const InputEvent& event);
  /// Whether what is under the mouse is ours, and whether text is being typed.
  bool wants_mouse() const;
  bool wants_keyboard() const;

  /// Calls `build`, which says by ImGui what there is.
  void build(PictureSize size, const std::function<void()>& build);
  /// Draws it.
  void draw(const Pixels& pixels) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace whittle
