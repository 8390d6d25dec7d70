#include "image/exr_calls.h"

#include <dlfcn.h>

#include <type_traits>

namespace whittle {

bool ExrCalls::load() {
  // It stays open for as long as the program runs.
  void* const library = dlopen(WHITTLE_OPENEXR, RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) return false;
  bool all = true;
  const auto find = [&](const char* name, auto& function) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    all &= function != nullptr;
  };
#define WHITTLE_FIND(name) find(#name, this->name);
  WHITTLE_EXR_CALLS(WHITTLE_FIND)
#undef WHITTLE_FIND
  return all;
}

}  // namespace whittle
