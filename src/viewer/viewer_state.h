// What a window shows, and what its keys change of it, without any window.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "viewer/actions.h"
#include "viewer/painter.h"

namespace whittle {

/// What was clicked at, and whose it is.
struct PickedPoint {
  PickAnswer answer;
  std::string place;      ///< file:line:column; empty if the text is not the user's
  std::string statement;  ///< its beginning; empty if it is not known
};

struct ViewerState {
  std::optional<OrbitView> view;  ///< none until the first picture says it
  PictureSize size;
  Look look;
  std::vector<std::string> files;
  size_t file = 0;                 ///< of them, the one that is shown
  std::vector<PickedPoint> picks;  ///< at most two, the latest last
  bool shows_tree = false, shows_help = false, shows_look = false, shows_picks = false;
};

/// What is to be done after an action, beside drawing the window again.
enum class Effect {
  kNone,
  kMove,   ///< show the view, which may go on moving
  kPaint,  ///< show the look
  kFit,    ///< frame the solid as it is turned
  kReset,  ///< show the view that the command line asked for
  kLoad,   ///< read the file
  kSave,
  kSaveWithoutBackground,
  kOpenText,  ///< if it is not open
  kUndo,
  kRedo,
  kSaveText,
  kCopyCamera,
  kCopyCommand,
  kQuit,
};

/// Changes the state as a key asks for.
Effect act(Action action, ViewerState& state);

/// A click: what is there is kept, or all is forgotten where nothing is.
void add_pick(PickedPoint picked, ViewerState& state);

/// A pick as a line that is printed: where it is written, and where it is.
std::string pick_text(const PickedPoint& picked);

/// What the panel says of the picks: of each where it is, of two how far they are apart.
std::vector<std::string> pick_lines(const ViewerState& state);

}  // namespace whittle
