#include "panels.h"

namespace whittle {

bool has_panels(const PanelContext& context) {
  const ViewerState& state = context.state;
  return state.shows_help || (state.shows_tree && context.editing != nullptr) || state.shows_look ||
         (state.shows_picks && !state.picks.empty()) || context.work || !context.notices.is_empty();
}

void draw_panels(PanelContext& context) {
  const ViewerState& state = context.state;
  if (state.shows_tree && context.editing != nullptr) draw_tree_panel(context);
  if (state.shows_look) draw_look_panel(context);
  if (state.shows_picks && !state.picks.empty()) draw_picks_panel(context);
  if (context.work || !context.notices.is_empty()) draw_notices_panel(context);
  if (state.shows_help) draw_help_panel(context);
}

}  // namespace whittle
