// Every key of the window, and what it does: the one list that the keyboard, the help in the window
// and docs/viewer.md follow.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace whittle {

/// A key by what is printed on it: letters are 'A' to 'Z', digits '0' to '9'.
enum class Key : int {
  kEscape = 256,
  kEnter,
  kTab,
  kSpace,
  kLeft,
  kRight,
  kUp,
  kDown,
  kPlus,
  kMinus,
  kF1,
  kF5,
  kF12,
};

constexpr Key key_of(char printed) {
  return Key(int(printed));
}

struct Modifiers {
  bool control = false, shift = false;

  bool operator==(const Modifiers&) const = default;
};

enum class Action {
  // Views.
  kFront,
  kBack,
  kRight,
  kLeft,
  kTop,
  kBottom,
  kIsometric,
  kDiagonal,
  kProjection,
  kFit,
  kReset,
  kTurnLeft,
  kTurnRight,
  kTurnUp,
  kTurnDown,
  kZoomIn,
  kZoomOut,
  // What is seen.
  kStyle,
  kQuality,
  kShadows,
  kGround,
  kPass,
  kCells,
  kColors,
  // Files.
  kNextFile,
  kPreviousFile,
  kReload,
  kSave,
  kSaveWithoutBackground,
  // The text.
  kTreePanel,
  kUndo,
  kRedo,
  kSaveText,
  // The window.
  kCopyCamera,
  kCopyCommand,
  kLookPanel,
  kPickPanel,
  kClearPicks,
  kHelp,
  kQuit,
};

/// What keys and gestures are sorted by in the help.
enum class HelpGroup { kMouse, kView, kLook, kFile, kEdit, kWindow };
inline constexpr HelpGroup kHelpGroups[] = {HelpGroup::kMouse, HelpGroup::kView,
                                            HelpGroup::kLook,  HelpGroup::kFile,
                                            HelpGroup::kEdit,  HelpGroup::kWindow};

struct KeyBinding {
  Key key;
  Modifiers with;
  Action action;
  HelpGroup group;
  const char* shown;  ///< the key as the help has it
  const char* does;   ///< empty: the same as the binding before it
};

std::span<const KeyBinding> key_bindings();
std::optional<Action> action_of(Key key, Modifiers with);

/// A line of the help.
struct HelpLine {
  HelpGroup group;
  std::string keys;
  std::string does;
};

const char* title_of(HelpGroup group);
/// What the mouse does, then all keys; those with one meaning share a line.
std::span<const HelpLine> help_lines();

}  // namespace whittle
