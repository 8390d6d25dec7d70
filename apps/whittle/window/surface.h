// Pixels on the screen: an X11 window's, by memory that is shared with the server where it can be.
#pragma once

#include <memory>

#include "viewer/triangles.h"
#include "window_calls.h"

namespace whittle {

class WindowSurface {
 public:
  /// Null if the screen's colours are not 8 bits of red, green and blue each. `calls` must outlive
  /// it, and the window too.
  static std::unique_ptr<WindowSurface> make(const WindowCalls& calls, Display* display,
                                             Window window);
  ~WindowSurface();
  WindowSurface(const WindowSurface&) = delete;
  WindowSurface& operator=(const WindowSurface&) = delete;

  /// What put() shows, of that size; what is in it then is not said.
  Pixels pixels(int width, int height);
  /// When it returns, the server has them.
  void put();

 private:
  struct State;
  explicit WindowSurface(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace whittle
