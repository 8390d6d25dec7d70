#include "input.h"

#include "window_calls.h"

namespace whittle {

std::optional<Key> key_of_glfw(int code, const char* name) {
  switch (code) {
    case GLFW_KEY_ESCAPE:
      return Key::kEscape;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return Key::kEnter;
    case GLFW_KEY_TAB:
      return Key::kTab;
    case GLFW_KEY_SPACE:
      return Key::kSpace;
    case GLFW_KEY_LEFT:
      return Key::kLeft;
    case GLFW_KEY_RIGHT:
      return Key::kRight;
    case GLFW_KEY_UP:
      return Key::kUp;
    case GLFW_KEY_DOWN:
      return Key::kDown;
    case GLFW_KEY_KP_ADD:
      return Key::kPlus;
    case GLFW_KEY_KP_SUBTRACT:
      return Key::kMinus;
    case GLFW_KEY_F1:
      return Key::kF1;
    case GLFW_KEY_F5:
      return Key::kF5;
    case GLFW_KEY_F12:
      return Key::kF12;
    default:
      break;
  }
  if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9)
    return key_of(char('0' + code - GLFW_KEY_KP_0));
  if (code >= GLFW_KEY_0 && code <= GLFW_KEY_9) return key_of(char(code));
  // Letters and signs stand elsewhere on other keyboards.
  const char printed = name != nullptr && name[0] != '\0' && name[1] == '\0' ? name[0] : '\0';
  if (printed >= 'a' && printed <= 'z') return key_of(char(printed - 'a' + 'A'));
  if (printed == '+' || printed == '=') return Key::kPlus;
  if (printed == '-') return Key::kMinus;
  if (printed == '\0' && code >= GLFW_KEY_A && code <= GLFW_KEY_Z) return key_of(char(code));
  return std::nullopt;
}

}  // namespace whittle
