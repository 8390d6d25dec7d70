#include <imgui.h>

#include "panels.h"

namespace whittle {
namespace {

void draw_group(HelpGroup group) {
  ImGui::TextColored({1, 0.85f, 0.3f, 1}, "%s", title_of(group));
  if (!ImGui::BeginTable(title_of(group), 2, ImGuiTableFlags_SizingFixedFit)) return;
  for (const HelpLine& line : help_lines()) {
    if (line.group != group) continue;
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.keys.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.does.c_str());
  }
  ImGui::EndTable();
}

}  // namespace

void draw_help_panel(PanelContext& context) {
  const auto middle = ImVec2(float(context.size.width) / 2, float(context.size.height) / 2);
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0},
                                      {float(context.size.width), float(context.size.height)});
  constexpr int kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Help", nullptr, kFlags)) {
    if (ImGui::BeginTable("columns", 2, ImGuiTableFlags_SizingFixedFit)) {
      ImGui::TableNextColumn();
      draw_group(HelpGroup::kMouse);
      draw_group(HelpGroup::kView);
      ImGui::TableNextColumn();
      for (const HelpGroup group : {HelpGroup::kLook, HelpGroup::kFile, HelpGroup::kWindow})
        draw_group(group);
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace whittle
