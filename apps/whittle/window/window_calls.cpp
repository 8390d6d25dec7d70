#include "window_calls.h"

#include <dlfcn.h>

#include <type_traits>

namespace whittle {
namespace {

bool load(WindowCalls& calls) {
  // They stay open for as long as the program runs: they keep tables of their own that must not go.
  void* const glfw = dlopen("libglfw.so.3", RTLD_LAZY | RTLD_LOCAL);
  void* const x11 = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL);
  void* const xext = dlopen("libXext.so.6", RTLD_LAZY | RTLD_LOCAL);
  if (glfw == nullptr || x11 == nullptr || xext == nullptr) return false;
  bool all = true;
  const auto find = [&all](void* library, const char* name, auto& function) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    all &= function != nullptr;
  };
#define WHITTLE_FIND(name) find(library, #name, calls.name);
  void* library = glfw;
  WHITTLE_GLFW_CALLS(WHITTLE_FIND)
  library = x11;
  WHITTLE_X11_CALLS(WHITTLE_FIND)
  library = xext;
  WHITTLE_XEXT_CALLS(WHITTLE_FIND)
#undef WHITTLE_FIND
  return all;
}

}  // namespace

const WindowCalls* window_calls() {
  static WindowCalls calls;
  static const bool are_there = load(calls);
  return are_there ? &calls : nullptr;
}

}  // namespace whittle
