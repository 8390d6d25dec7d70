#include "flat/font_calls.h"

#include <dlfcn.h>

#include <type_traits>

namespace whittle {

bool FontCalls::load() {
  // They stay open for as long as the program runs: they keep tables of their own that must not go.
  void* const free_type = dlopen("libfreetype.so.6", RTLD_LAZY | RTLD_LOCAL);
  void* const harf_buzz = dlopen("libharfbuzz.so.0", RTLD_LAZY | RTLD_LOCAL);
  void* const font_config = dlopen("libfontconfig.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (free_type == nullptr || harf_buzz == nullptr || font_config == nullptr) return false;
  bool all = true;
  const auto find = [&all](void* library, const char* name, auto& function) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
    all &= function != nullptr;
  };
#define WHITTLE_FIND(name) find(library, #name, this->name);
  void* library = free_type;
  WHITTLE_FREETYPE_CALLS(WHITTLE_FIND)
  library = harf_buzz;
  WHITTLE_HARFBUZZ_CALLS(WHITTLE_FIND)
  library = font_config;
  WHITTLE_FONTCONFIG_CALLS(WHITTLE_FIND)
#undef WHITTLE_FIND
  return all;
}

}  // namespace whittle
