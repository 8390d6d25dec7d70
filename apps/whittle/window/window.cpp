#include "window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "surface.h"
#include "window_calls.h"

namespace whittle {
namespace {

using Kind = InputEvent::Kind;

constexpr PictureSize kUsualSize{1024, 768};

Modifiers modifiers_of(int bits) {
  return {(bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_SHIFT) != 0};
}

Error no_window(const std::string& why) {
  return {ErrorKind::kMachine, why};
}

}  // namespace

struct ScreenWindow::State {
  const WindowCalls& calls;
  bool is_open = false;  ///< GLFW is
  GLFWwindow* window = nullptr;
  std::unique_ptr<WindowSurface> surface;
  PictureSize size;
  double factor_x = 1, factor_y = 1;  ///< pixels of the picture for one of GLFW's
  std::vector<InputEvent> events;

  explicit State(const WindowCalls& calls_) : calls(calls_) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    surface.reset();
    if (window != nullptr) calls.glfwDestroyWindow(window);
    if (is_open) calls.glfwTerminate();
  }
  void listen();
  void measure();
};

void ScreenWindow::State::measure() {
  int width = 0, height = 0;
  calls.glfwGetFramebufferSize(window, &size.width, &size.height);
  calls.glfwGetWindowSize(window, &width, &height);
  factor_x = width > 0 ? double(size.width) / width : 1;
  factor_y = height > 0 ? double(size.height) / height : 1;
}

void ScreenWindow::State::listen() {
  calls.glfwSetWindowUserPointer(window, this);
  static constexpr auto state = [](GLFWwindow* w) -> State& {
    return *static_cast<State*>(window_calls()->glfwGetWindowUserPointer(w));
  };
  static constexpr auto tell = [](GLFWwindow* w, InputEvent event) {
    state(w).events.push_back(std::move(event));
  };
  calls.glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int, int action, int bits) {
    tell(w, {.kind = Kind::kKey,
             .code = code,
             .with = modifiers_of(bits),
             .is_down = action != GLFW_RELEASE,
             .files = {}});
  });
  calls.glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
    tell(w, {.kind = Kind::kCharacter, .with = {}, .character = character, .files = {}});
  });
  calls.glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    const State& s = state(w);
    tell(w,
         {.kind = Kind::kMove, .with = {}, .x = x * s.factor_x, .y = y * s.factor_y, .files = {}});
  });
  calls.glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int bits) {
    tell(w, {.kind = Kind::kButton,
             .code = button,
             .with = modifiers_of(bits),
             .is_down = action == GLFW_PRESS,
             .files = {}});
  });
  calls.glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    tell(w, {.kind = Kind::kWheel, .with = {}, .x = x, .y = y, .files = {}});
  });
  calls.glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    tell(w, {.kind = Kind::kDrop, .with = {}, .files = {paths, paths + count}});
  });
  calls.glfwSetWindowCloseCallback(
      window, [](GLFWwindow* w) { tell(w, {.kind = Kind::kClose, .with = {}, .files = {}}); });
  calls.glfwSetWindowRefreshCallback(
      window, [](GLFWwindow* w) { tell(w, {.kind = Kind::kRefresh, .with = {}, .files = {}}); });
  calls.glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) {
    state(w).measure();
    tell(w, {.kind = Kind::kResize, .with = {}, .files = {}});
  });
}

Result<std::unique_ptr<ScreenWindow>> ScreenWindow::open(const std::string& title,
                                                         std::optional<PictureSize> size) {
  const char* const display = std::getenv("DISPLAY");
  if (display == nullptr || *display == '\0') return no_window("there is no display for a window");
  const WindowCalls* const calls = window_calls();
  if (calls == nullptr)
    return no_window("what opens windows is not installed (apt-get install libglfw3 libxext6)");
  auto state = std::make_unique<State>(*calls);
  State& s = *state;
  s.is_open = s.calls.glfwInit() == GLFW_TRUE;
  if (!s.is_open) return no_window(std::string("the display '") + display + "' cannot be opened");
  s.calls.glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  s.calls.glfwWindowHintString(GLFW_X11_CLASS_NAME, "whittle");
  s.calls.glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "whittle");
  PictureSize wanted = size.value_or(kUsualSize);
  if (GLFWmonitor* const monitor = size ? nullptr : s.calls.glfwGetPrimaryMonitor()) {
    float x = 1, y = 1;
    s.calls.glfwGetMonitorContentScale(monitor, &x, &y);
    if (x >= 1 && y >= 1)
      wanted = {int(std::lround(float(wanted.width) * x)),
                int(std::lround(float(wanted.height) * y))};
  }
  s.window = s.calls.glfwCreateWindow(wanted.width, wanted.height, title.c_str(), nullptr, nullptr);
  if (s.window == nullptr) {
    const char* why = nullptr;
    s.calls.glfwGetError(&why);
    return no_window(std::string("no window can be opened: ") + (why != nullptr ? why : "unknown"));
  }
  s.surface =
      WindowSurface::make(s.calls, s.calls.glfwGetX11Display(), s.calls.glfwGetX11Window(s.window));
  if (!s.surface)
    return no_window(std::string("the display '") + display + "' has no 24-bit colours");
  s.measure();
  s.listen();
  return std::unique_ptr<ScreenWindow>(new ScreenWindow(std::move(state)));
}

ScreenWindow::ScreenWindow(std::unique_ptr<State> state) : state_(std::move(state)) {}
ScreenWindow::~ScreenWindow() = default;

PictureSize ScreenWindow::size() const {
  return {std::max(state_->size.width, 1), std::max(state_->size.height, 1)};
}

double ScreenWindow::scale() const {
  float x = 1, y = 1;
  state_->calls.glfwGetWindowContentScale(state_->window, &x, &y);
  return x >= 1 ? double(x) : 1;
}

void ScreenWindow::set_title(const std::string& title) {
  state_->calls.glfwSetWindowTitle(state_->window, title.c_str());
}

std::vector<InputEvent> ScreenWindow::wait(std::optional<double> seconds) {
  State& s = *state_;
  if (!seconds)
    s.calls.glfwWaitEvents();
  else if (*seconds > 0)
    s.calls.glfwWaitEventsTimeout(*seconds);
  else
    s.calls.glfwPollEvents();
  return std::exchange(s.events, {});
}

void ScreenWindow::wake() const {
  state_->calls.glfwPostEmptyEvent();
}

Pixels ScreenWindow::pixels() {
  return state_->surface->pixels(size().width, size().height);
}

void ScreenWindow::show() {
  state_->surface->put();
}

void ScreenWindow::copy(const std::string& text) {
  state_->calls.glfwSetClipboardString(state_->window, text.c_str());
}

std::string ScreenWindow::copied() const {
  const char* const text = state_->calls.glfwGetClipboardString(state_->window);
  return text != nullptr ? text : "";
}

}  // namespace whittle
