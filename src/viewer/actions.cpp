#include "viewer/actions.h"

#include <array>
#include <vector>

namespace whittle {
namespace {

constexpr Modifiers kPlain{}, kControl{.control = true}, kShift{.shift = true},
    kBoth{.control = true, .shift = true};
constexpr HelpGroup kView = HelpGroup::kView, kLook = HelpGroup::kLook, kFile = HelpGroup::kFile,
                    kEdit = HelpGroup::kEdit, kWindow = HelpGroup::kWindow;

constexpr KeyBinding kBindings[] = {
    {key_of('1'), kPlain, Action::kFront, kView, "1", "from the front"},
    {key_of('1'), kControl, Action::kBack, kView, "Ctrl+1", "from the back"},
    {key_of('3'), kPlain, Action::kRight, kView, "3", "from the right"},
    {key_of('3'), kControl, Action::kLeft, kView, "Ctrl+3", "from the left"},
    {key_of('7'), kPlain, Action::kTop, kView, "7", "from the top"},
    {key_of('7'), kControl, Action::kBottom, kView, "Ctrl+7", "from the bottom"},
    {key_of('9'), kPlain, Action::kIsometric, kView, "9", "isometric"},
    {key_of('0'), kPlain, Action::kDiagonal, kView, "0", "diagonal, OpenSCAD's view"},
    {key_of('4'), kPlain, Action::kTurnLeft, kView, "4", "turn by 15 degrees to the left"},
    {key_of('6'), kPlain, Action::kTurnRight, kView, "6", "to the right"},
    {key_of('8'), kPlain, Action::kTurnUp, kView, "8", "towards the top"},
    {key_of('2'), kPlain, Action::kTurnDown, kView, "2", "towards the bottom"},
    {Key::kPlus, kPlain, Action::kZoomIn, kView, "+", "closer"},
    {Key::kMinus, kPlain, Action::kZoomOut, kView, "-", "farther away"},
    {key_of('5'), kPlain, Action::kProjection, kView, "5", "perspective or orthographic"},
    {key_of('F'), kPlain, Action::kFit, kView, "F", "all of it, as it is turned"},
    {Key::kEnter, kPlain, Action::kReset, kView, "Enter", "the first view again"},

    {key_of('S'), kPlain, Action::kStyle, kLook, "S", "next style: studio, plain, blinn, openscad"},
    {key_of('T'), kPlain, Action::kQuality, kLook, "T", "next quality: draft, good, best"},
    {key_of('L'), kPlain, Action::kShadows, kLook, "L", "shadows of the lights"},
    {key_of('G'), kPlain, Action::kGround, kLook, "G", "shadow on the ground"},
    {key_of('P'), kPlain, Action::kPass, kLook, "P", "next pass: color, depth, normal, id"},
    {key_of('C'), kPlain, Action::kCells, kLook, "C", "cells: none, their edges, their faces"},
    {key_of('K'), kPlain, Action::kColors, kLook, "K", "next colour scheme"},

    {Key::kRight, kPlain, Action::kNextFile, kFile, "Right", "next file"},
    {Key::kLeft, kPlain, Action::kPreviousFile, kFile, "Left", "the file before"},
    {Key::kUp, kPlain, Action::kReload, kFile, "Up", "read the file again"},
    {Key::kF5, kPlain, Action::kReload, kFile, "F5", ""},
    {Key::kF12, kPlain, Action::kSave, kFile, "F12", "save the picture as .png"},
    {Key::kF12, kControl, Action::kSaveWithoutBackground, kFile, "Ctrl+F12",
     "without its background"},

    {key_of('E'), kPlain, Action::kTreePanel, kEdit, "E", "panel: the statements of a .csg"},
    {key_of('Z'), kControl, Action::kUndo, kEdit, "Ctrl+Z", "undo"},
    {key_of('Z'), kBoth, Action::kRedo, kEdit, "Ctrl+Shift+Z", "redo"},
    {key_of('Y'), kControl, Action::kRedo, kEdit, "Ctrl+Y", ""},
    {key_of('S'), kControl, Action::kSaveText, kEdit, "Ctrl+S", "save the .csg"},

    {key_of('C'), kControl, Action::kCopyCamera, kWindow, "Ctrl+C",
     "copy and print the camera, for --camera"},
    {key_of('C'), kBoth, Action::kCopyCommand, kWindow, "Ctrl+Shift+C",
     "copy and print the command for this"},
    {Key::kTab, kPlain, Action::kLookPanel, kWindow, "Tab", "panel: how it looks"},
    {key_of('I'), kPlain, Action::kPickPanel, kWindow, "I", "panel: what was clicked at"},
    {key_of('X'), kPlain, Action::kClearPicks, kWindow, "X", "forget what was clicked at"},
    {key_of('H'), kPlain, Action::kHelp, kWindow, "H", "this help"},
    {Key::kF1, kPlain, Action::kHelp, kWindow, "F1", ""},
    {key_of('Q'), kPlain, Action::kQuit, kWindow, "Q", "quit"},
    {key_of('Q'), kControl, Action::kQuit, kWindow, "Ctrl+Q", ""},
    {Key::kEscape, kPlain, Action::kQuit, kWindow, "Esc", ""},
};

std::vector<HelpLine> make_help_lines() {
  constexpr HelpGroup kMouse = HelpGroup::kMouse;
  std::vector<HelpLine> lines{
      {kMouse, "Left drag", "turn"},
      {kMouse, "Right, middle or Shift+left drag", "move"},
      {kMouse, "Wheel", "closer and farther, where it points"},
      {kMouse, "Double click", "turn about this point"},
      {kMouse, "Click", "what is it; two clicks: how far apart"},
      {kMouse, "Files dropped", "open them"},
  };
  for (const KeyBinding& binding : kBindings) {
    if (*binding.does == '\0')
      lines.back().keys += std::string(", ") + binding.shown;
    else
      lines.push_back({binding.group, binding.shown, binding.does});
  }
  return lines;
}

}  // namespace

std::span<const KeyBinding> key_bindings() {
  return kBindings;
}

std::optional<Action> action_of(Key key, Modifiers with) {
  for (const KeyBinding& binding : kBindings)
    if (binding.key == key && binding.with == with) return binding.action;
  // Where a sign stands above another one depends on the keyboard.
  if ((key == Key::kPlus || key == Key::kMinus) && with == kShift) return action_of(key, kPlain);
  return std::nullopt;
}

const char* title_of(HelpGroup group) {
  switch (group) {
    case HelpGroup::kMouse:
      return "Mouse";
    case HelpGroup::kView:
      return "View";
    case HelpGroup::kLook:
      return "Look";
    case HelpGroup::kFile:
      return "Files";
    case HelpGroup::kEdit:
      return "Editing";
    case HelpGroup::kWindow:
      break;
  }
  return "Window";
}

std::span<const HelpLine> help_lines() {
  static const std::vector<HelpLine> lines = make_help_lines();
  return lines;
}

}  // namespace whittle
