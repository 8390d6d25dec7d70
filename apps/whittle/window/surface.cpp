#include "surface.h"

#include <sys/ipc.h>
#include <sys/shm.h>

#include <atomic>
#include <vector>

namespace whittle {
namespace {

/// Set by X11's handler of errors, which is told nothing of who wants to know.
std::atomic<bool> was_refused;

int note_refusal(Display*, XErrorEvent*) {
  was_refused = true;
  return 0;
}

}  // namespace

struct WindowSurface::State {
  const WindowCalls& calls;
  Display* display;
  Window window;
  Visual* visual;
  unsigned depth;
  GC context = nullptr;
  bool can_share = false;
  XImage* image = nullptr;
  XShmSegmentInfo shared{};
  bool is_shared = false;
  std::vector<uint32_t> own;  ///< where nothing is shared

  void release();
  bool share(int width, int height);
  void make(int width, int height);
};

void WindowSurface::State::release() {
  if (image == nullptr) return;
  if (is_shared) {
    calls.XShmDetach(display, &shared);
    calls.XSync(display, False);
    ::shmdt(shared.shmaddr);
  }
  image->data = nullptr;
  XDestroyImage(image);
  image = nullptr;
  is_shared = false;
}

bool WindowSurface::State::share(int width, int height) {
  image = calls.XShmCreateImage(display, visual, depth, ZPixmap, nullptr, &shared, unsigned(width),
                                unsigned(height));
  if (image == nullptr) return false;
  const size_t size = size_t(image->bytes_per_line) * size_t(height);
  constexpr int kOnlyMine = 0600;
  shared.shmid = ::shmget(IPC_PRIVATE, size, IPC_CREAT | kOnlyMine);
  void* const at =
      shared.shmid < 0 ? reinterpret_cast<void*>(-1) : ::shmat(shared.shmid, nullptr, 0);
  bool done = at != reinterpret_cast<void*>(-1);
  if (done) {
    shared.shmaddr = image->data = static_cast<char*>(at);
    shared.readOnly = False;
    // A server elsewhere says that it can, and then cannot.
    was_refused = false;
    const XErrorHandler before = calls.XSetErrorHandler(note_refusal);
    calls.XShmAttach(display, &shared);
    calls.XSync(display, False);
    calls.XSetErrorHandler(before);
    done = !was_refused;
    if (!done) ::shmdt(at);
  }
  // Gone when both have let go of it.
  if (shared.shmid >= 0) ::shmctl(shared.shmid, IPC_RMID, nullptr);
  if (!done) {
    image->data = nullptr;
    XDestroyImage(image);
    image = nullptr;
  }
  return done;
}

void WindowSurface::State::make(int width, int height) {
  release();
  can_share = can_share && share(width, height);
  is_shared = can_share;
  if (is_shared) return;
  own.resize(size_t(width) * size_t(height));
  constexpr int kBits = 32;
  image =
      calls.XCreateImage(display, visual, depth, ZPixmap, 0, reinterpret_cast<char*>(own.data()),
                         unsigned(width), unsigned(height), kBits, 0);
}

std::unique_ptr<WindowSurface> WindowSurface::make(const WindowCalls& calls, Display* display,
                                                   Window window) {
  constexpr unsigned long kRed = 0xff0000, kGreen = 0xff00, kBlue = 0xff;
  XWindowAttributes about;
  if (calls.XGetWindowAttributes(display, window, &about) == 0) return nullptr;
  const Visual* const visual = about.visual;
  if (visual->red_mask != kRed || visual->green_mask != kGreen || visual->blue_mask != kBlue)
    return nullptr;
  auto state = std::make_unique<State>(
      State{calls, display, window, about.visual, unsigned(about.depth), {}, {}, {}, {}, {}, {}});
  state->context = calls.XCreateGC(display, window, 0, nullptr);
  state->can_share = calls.XShmQueryExtension(display) != 0;
  return std::unique_ptr<WindowSurface>(new WindowSurface(std::move(state)));
}

WindowSurface::WindowSurface(std::unique_ptr<State> state) : state_(std::move(state)) {}

WindowSurface::~WindowSurface() {
  state_->release();
  state_->calls.XFreeGC(state_->display, state_->context);
}

Pixels WindowSurface::pixels(int width, int height) {
  State& s = *state_;
  if (s.image == nullptr || s.image->width != width || s.image->height != height)
    s.make(width, height);
  return {reinterpret_cast<uint32_t*>(s.image->data), width, height, s.image->bytes_per_line / 4};
}

void WindowSurface::put() {
  State& s = *state_;
  const auto width = unsigned(s.image->width), height = unsigned(s.image->height);
  if (s.is_shared)
    s.calls.XShmPutImage(s.display, s.window, s.context, s.image, 0, 0, 0, 0, width, height, False);
  else
    s.calls.XPutImage(s.display, s.window, s.context, s.image, 0, 0, 0, 0, width, height);
  s.calls.XSync(s.display, False);
}

}  // namespace whittle
