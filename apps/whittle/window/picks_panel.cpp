#include <imgui.h>

#include "panels.h"

namespace whittle {

void draw_picks_panel(PanelContext& context) {
  const auto margin = float(10 * context.scale);
  ImGui::SetNextWindowPos({float(context.size.width) - margin, margin}, ImGuiCond_Always, {1, 0});
  constexpr int kFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Picked", &context.state.shows_picks, kFlags))
    for (const std::string& line : pick_lines(context.state)) ImGui::TextUnformatted(line.c_str());
  ImGui::End();
}

}  // namespace whittle
