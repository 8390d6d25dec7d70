#include "window/driven_window.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "image/png.h"
// Last, for the words that it takes.
#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace whittle {
namespace {

constexpr auto kMoment = std::chrono::milliseconds(20);

size_t count_lines(const std::string& text) {
  return size_t(std::ranges::count(text, '\n'));
}

}  // namespace

struct DrivenWindow::Screen {
  ::Display* display;

  explicit Screen(const std::string& name) : display(XOpenDisplay(name.c_str())) {}
  ~Screen() {
    if (display != nullptr) XCloseDisplay(display);
  }
};

DrivenWindow::DrivenWindow() = default;

DrivenWindow::~DrivenWindow() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void DrivenWindow::open(std::vector<std::string> words) {
  ASSERT_NE(display_.name(), "");
  screen_ = std::make_unique<Screen>(display_.name());
  ASSERT_NE(screen_->display, nullptr);
  words.insert(words.begin(), WHITTLE_PROGRAM);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setenv("DISPLAY", display_.name().c_str(), 1);
    const auto open_as = [&](int number, const std::string& name) {
      ::dup2(::open(path(name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), number);
    };
    open_as(STDOUT_FILENO, "out");
    open_as(STDERR_FILENO, "err");
    if (::chdir(folder_.path().c_str()) == 0) ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  const bool is_open = comes_true([&] {
    window_ = shell("xdotool search --onlyvisible --pid " + std::to_string(process_) +
                    " 2>/dev/null | head -1");
    while (!window_.empty() && window_.back() == '\n') window_.pop_back();
    return !window_.empty() || !is_alive();
  });
  ASSERT_TRUE(is_open && is_alive()) << err();
}

bool DrivenWindow::is_alive() const {
  siginfo_t ended{};
  return ::waitid(P_PID, id_t(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         ended.si_pid == 0;
}

int DrivenWindow::quit() {
  key("q");
  const bool has_ended = comes_true([&] { return !is_alive(); });
  EXPECT_TRUE(has_ended);
  if (!has_ended) return -1;
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void DrivenWindow::hand(const std::string& words) const {
  std::string line = words;
  if (const size_t at = line.find('@'); at != std::string::npos)
    line.replace(at, 1, "--window " + window_);
  shell("xdotool " + line);
}

void DrivenWindow::resize(int width, int height) const {
  hand(fmt::format("windowsize {} {} {}", window_, width, height));
}

void DrivenWindow::drag(int button, int x, int y, int right, int down) const {
  hand(
      fmt::format("mousemove --window {0} {1} {2} mousedown {3} mousemove --window {0} {4} {5} "
                  "mouseup {3}",
                  window_, x, y, button, x + right, y + down));
}

bool DrivenWindow::comes_true(const std::function<bool()>& is_true) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!is_true()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(kMoment);
  }
  return true;
}

Picture DrivenWindow::shot() const {
  const auto window = Window(std::stoul(window_));
  XWindowAttributes about;
  if (XGetWindowAttributes(screen_->display, window, &about) == 0) return {};
  XImage* const image = XGetImage(screen_->display, window, 0, 0, unsigned(about.width),
                                  unsigned(about.height), AllPlanes, ZPixmap);
  if (image == nullptr) return {};
  Picture picture(about.width, about.height);
  for (int y = 0; y < about.height; ++y)
    for (int x = 0; x < about.width; ++x) {
      const unsigned long pixel = XGetPixel(image, x, y);
      uint8_t* const to = picture.at(x, y);
      to[0] = uint8_t(pixel >> 16), to[1] = uint8_t(pixel >> 8), to[2] = uint8_t(pixel);
      to[3] = 255;
    }
  XDestroyImage(image);
  return picture;
}

void DrivenWindow::expect_shown(const Picture& expected) const {
  Picture seen;
  const bool is_shown = comes_true([&] {
    seen = shot();
    return std::ranges::equal(seen.rgba, expected.rgba);
  });
  if (is_shown) return;
  ASSERT_EQ(seen.width, expected.width);
  ASSERT_EQ(seen.height, expected.height);
  size_t different = 0;
  for (size_t i = 0; i < seen.rgba.size(); i += 4)
    different += !std::equal(&seen.rgba[i], &seen.rgba[i] + 4, &expected.rgba[i]);
  ADD_FAILURE() << different << " pixels are others";
}

std::string DrivenWindow::answer_to(const std::string& keys) const {
  const size_t before = count_lines(out());
  key(keys);
  EXPECT_TRUE(comes_true([&] { return count_lines(out()) > before; })) << keys;
  std::string text = out();
  if (text.empty()) return text;
  text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

Picture DrivenWindow::command_line(const std::vector<std::string>& words) const {
  std::string line = WHITTLE_PROGRAM;
  for (const std::string& word : words) line += " '" + word + "'";
  shell(line + " -o expected.png");
  Result<Picture> picture = read_png(path("expected.png"));
  EXPECT_TRUE(picture);
  return picture ? *std::move(picture) : Picture();
}

Picture DrivenWindow::of_camera(const std::string& camera,
                                const std::vector<std::string>& more) const {
  std::vector<std::string> words{"part.csg", "--camera=" + camera,
                                 fmt::format("--imgsize={},{}", kWidth, kHeight)};
  words.insert(words.end(), more.begin(), more.end());
  return command_line(words);
}

std::string DrivenWindow::shell(const std::string& line) const {
  const std::string command =
      "cd " + folder_.path().string() + " && export DISPLAY=" + display_.name() + " && " + line;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += char(c);
  ::pclose(pipe);
  return text;
}

void DrivenWindow::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string DrivenWindow::read(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace whittle
