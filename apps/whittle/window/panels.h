// What is drawn over the picture, one file a panel. A new one is a function here and a line in
// draw_panels().
#pragma once

#include <optional>
#include <string>

#include "notices.h"
#include "viewer/viewer_state.h"

namespace whittle {

class Editing;

/// Long work, as it is shown.
struct WorkShown {
  std::string what;
  double seconds = 0;  ///< since it began
};

/// What the panels show, and what they ask for by setting `wanted`.
struct PanelContext {
  ViewerState& state;
  Notices& notices;
  Editing* editing = nullptr;  ///< null: no text is open
  std::optional<WorkShown> work;
  PictureSize size;
  double scale = 1;  ///< of lengths in pixels
  /// What is to be done after the frame, as after a key.
  std::optional<Action> wanted{};
};

/// Whether there is anything to draw.
bool has_panels(const PanelContext& context);
/// Between the begin and the end of ImGui's frame.
void draw_panels(PanelContext& context);

/// The keys and what the mouse does.
void draw_help_panel(PanelContext& context);
/// The statements of the file, and how they are edited.
void draw_tree_panel(PanelContext& context);
/// How the picture looks.
void draw_look_panel(PanelContext& context);
/// What was clicked at.
void draw_picks_panel(PanelContext& context);
/// What is wrong, what was done, and what goes on.
void draw_notices_panel(PanelContext& context);

}  // namespace whittle
