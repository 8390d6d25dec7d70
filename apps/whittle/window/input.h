// What happens to a window.
#pragma once

#include <string>
#include <vector>

#include "viewer/actions.h"

namespace whittle {

struct InputEvent {
  enum class Kind { kKey, kCharacter, kMove, kButton, kWheel, kDrop, kResize, kRefresh, kClose };
  Kind kind;
  int code = 0;            ///< GLFW's, of a key or a button
  Modifiers with;          ///< of keys and buttons
  bool is_down = false;    ///< keys and buttons: pressed, or held so long that it repeats
  unsigned character = 0;  ///< Unicode
  double x = 0, y = 0;     ///< pixels from the top left corner; of the wheel notches
  std::vector<std::string> files;
};

/// The key of GLFW's code and name, as the keyboard's layout has it; the name may be null.
std::optional<Key> key_of_glfw(int code, const char* name);

}  // namespace whittle
