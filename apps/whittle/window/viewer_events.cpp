// What happens to the window, and what is drawn of it.
#include <algorithm>
#include <utility>

#include "viewer.h"
#include "window_calls.h"

namespace whittle {
namespace {

using Kind = InputEvent::Kind;

/// Work that takes no longer is not worth a word.
constexpr double kLongMilliseconds = 200;
/// ImGui says what an event did one frame later.
constexpr int kOverlayFrames = 2;
/// Before there is a picture.
constexpr uint32_t kNothingYet = 0xe8e8ec;

MouseButton button_of(int code) {
  return code == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::kLeft
         : code == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::kRight
                                           : MouseButton::kMiddle;
}

/// From what whittle writes to what X11 shows, as far as both reach.
void copy_picture(const Picture& picture, const Pixels& pixels) {
  const int width = std::min(picture.width, pixels.width),
            height = std::min(picture.height, pixels.height);
  for (int y = 0; y < height; ++y) {
    const uint8_t* from = picture.at(0, y);
    uint32_t* to = pixels.at + ptrdiff_t(y) * pixels.stride;
    for (int x = 0; x < width; ++x, from += 4)
      to[x] = uint32_t(from[0]) << 16 | uint32_t(from[1]) << 8 | uint32_t(from[2]);
    std::fill(to + width, to + pixels.width, kNothingYet);
  }
  for (int y = height; y < pixels.height; ++y) {
    uint32_t* const row = pixels.at + ptrdiff_t(y) * pixels.stride;
    std::fill(row, row + pixels.width, kNothingYet);
  }
}

}  // namespace

void Viewer::handle(const std::vector<InputEvent>& events) {
  const std::optional<OrbitView> before = state_.view;
  const PictureSize size_before = state_.size;
  for (const InputEvent& event : events) {
    const bool is_state = event.kind != Kind::kWheel && event.kind != Kind::kCharacter;
    if (overlay_ && (shows_overlay_ || is_state)) overlay_->feed(event);
    handle(event);
  }
  if (overlay_ && !events.empty() && needs_overlay()) {
    overlay_frames_ = kOverlayFrames;
  }
  // All movements at once make one picture.
  const bool is_resized = state_.size != size_before;
  if (state_.view ? state_.view != before || is_resized : is_resized && has_model_) show(true);
}

void Viewer::handle(const InputEvent& event) {
  switch (event.kind) {
    case Kind::kKey:
      if (event.is_down && !(shows_overlay_ && overlay_->wants_keyboard())) handle_key(event);
      break;
    case Kind::kMove: {
      mouse_x_ = event.x, mouse_y_ = event.y;
      if (!state_.view) break;
      const auto point_at = [this](double x, double y) { return this->point_at(x, y); };
      if (const auto view = gestures_->move(event.x, event.y, *state_.view, state_.size, point_at))
        state_.view = view;
      break;
    }
    case Kind::kButton:
      handle_button(event);
      break;
    case Kind::kWheel:
      if (state_.view && !(shows_overlay_ && overlay_->wants_mouse()))
        state_.view = Gestures::wheel(event.y, mouse_x_, mouse_y_, *state_.view, state_.size,
                                      [this](double x, double y) { return point_at(x, y); });
      break;
    case Kind::kDrop:
      if (event.files.empty() || !may_leave()) break;
      // The first of them is shown now.
      state_.file = state_.files.size();
      state_.files.insert(state_.files.end(), event.files.begin(), event.files.end());
      state_.picks.clear();
      load(true);
      break;
    case Kind::kResize:
      handle_resize();
      break;
    case Kind::kRefresh:
      needs_drawing_ = true;
      break;
    case Kind::kClose:
      quits_ = may_leave();
      break;
    case Kind::kCharacter:
      break;
  }
}

std::optional<Vec3> Viewer::point_at(double x, double y) const {
  return painted_ ? painted_->point_at(x, y) : std::nullopt;
}

void Viewer::handle_key(const InputEvent& event) {
  const char* const name = window_calls()->glfwGetKeyName(event.code, 0);
  const std::optional<Key> key = key_of_glfw(event.code, name);
  if (!key) return;
  if (const std::optional<Action> action = action_of(*key, event.with)) act_on(*action);
}

void Viewer::handle_button(const InputEvent& event) {
  const MouseButton button = button_of(event.code);
  if (event.is_down) {
    if (!(shows_overlay_ && overlay_->wants_mouse()))
      gestures_->press(button, event.with.shift, mouse_x_, mouse_y_);
    return;
  }
  const double seconds = watch_.milliseconds() / 1000;
  const std::optional<Click> click = gestures_->release(button, mouse_x_, mouse_y_, seconds);
  if (!click || !state_.view) return;
  if (click->is_double) {
    // Its first click was none.
    state_.picks = picks_before_click_;
    unwanted_ = unanswered_;
    needs_drawing_ = true;
    if (const std::optional<Vec3> point = point_at(click->x, click->y))
      state_.view = pivoted(*state_.view, *point);
    return;
  }
  picks_before_click_ = state_.picks;
  ++unanswered_;
  painter_->ask({rounded(*state_.view), state_.size, click->x, click->y});
}

void Viewer::handle_resize() {
  state_.size = window_->size();
  framing_.width = state_.size.width, framing_.height = state_.size.height;
  needs_drawing_ = true;
}

PanelContext Viewer::panels() {
  std::optional<WorkShown> work;
  if (loader_->is_busy() && stage_->watch.milliseconds() >= kLongMilliseconds)
    work = WorkShown{stage_->what.load(), stage_->watch.milliseconds() / 1000};
  return {.state = state_,
          .notices = notices_,
          .editing = editing_.is_open() ? &editing_ : nullptr,
          .work = std::move(work),
          .size = state_.size,
          .scale = window_->scale()};
}

bool Viewer::needs_overlay() {
  return has_panels(panels());
}

void Viewer::draw() {
  const bool is_changed = std::exchange(needs_drawing_, false);
  const Pixels pixels = window_->pixels();
  copy_picture(painted_ ? painted_->picture : Picture(), pixels);
  const bool has_overlay = needs_overlay();
  if (has_overlay) {
    // Its letters take a while to make, so the first picture does without.
    if (!overlay_) overlay_ = std::make_unique<Overlay>(*window_, window_->scale());
    PanelContext context = panels();
    overlay_->build(state_.size, [&] { draw_panels(context); });
    overlay_->draw(pixels);
    if (context.wanted) act_on(*context.wanted);
  }
  shows_overlay_ = has_overlay;
  // What has changed may need more room, which ImGui sees when it has drawn it.
  overlay_frames_ = !has_overlay ? 0
                    : is_changed ? kOverlayFrames
                                 : std::max(overlay_frames_ - 1, 0);
  window_->show();
  if (painted_ && std::exchange(is_new_, false)) times_.shown(painted_->step);
}

}  // namespace whittle
