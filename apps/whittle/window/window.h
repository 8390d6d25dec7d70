// A window on the screen, by GLFW: what happens to it, and the pixels in it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "input.h"
#include "viewer/orbit_view.h"
#include "viewer/triangles.h"

namespace whittle {

class ScreenWindow {
 public:
  /// Opens one. Without a size it is as large as suits the screen. Errors are kMachine: there is no
  /// display, or what opens windows is not installed.
  static Result<std::unique_ptr<ScreenWindow>> open(const std::string& title,
                                                    std::optional<PictureSize> size);
  ~ScreenWindow();
  ScreenWindow(const ScreenWindow&) = delete;
  ScreenWindow& operator=(const ScreenWindow&) = delete;

  PictureSize size() const;
  /// Screen pixels for what is one elsewhere.
  double scale() const;
  void set_title(const std::string& title);

  /// Waits until something happens or wake() is called, but no longer than `seconds`, if given; 0
  /// does not wait. What happened since the last time.
  std::vector<InputEvent> wait(std::optional<double> seconds);
  /// From any thread: ends a wait.
  void wake() const;

  /// What show() shows.
  Pixels pixels();
  void show();

  void copy(const std::string& text);
  std::string copied() const;

 private:
  struct State;
  explicit ScreenWindow(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace whittle
