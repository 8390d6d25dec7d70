#include <imgui.h>

#include <algorithm>
#include <span>

#include "panels.h"

namespace whittle {
namespace {

/// Between what stands side by side, letters.
constexpr float kGap = 2;

/// The widest keys of a group, pixels.
float keys_width(HelpGroup group) {
  float width = 0;
  for (const HelpLine& line : help_lines())
    if (line.group == group) width = std::max(width, ImGui::CalcTextSize(line.keys.c_str()).x);
  return width;
}

/// Groups below one another.
void draw_groups(std::span<const HelpGroup> groups) {
  ImGui::BeginGroup();
  for (const HelpGroup group : groups) {
    if (group != groups.front()) ImGui::Spacing();
    ImGui::TextColored({1, 0.85f, 0.3f, 1}, "%s", title_of(group));
    // Counted from where the groups begin.
    const float meaning = keys_width(group) + kGap * ImGui::GetFontSize() / 2;
    for (const HelpLine& line : help_lines()) {
      if (line.group != group) continue;
      ImGui::TextUnformatted(line.keys.c_str());
      ImGui::SameLine(meaning);
      ImGui::TextUnformatted(line.does.c_str());
    }
  }
  ImGui::EndGroup();
}

}  // namespace

void draw_help_panel(PanelContext& context) {
  const auto width = float(context.size.width), height = float(context.size.height);
  ImGui::SetNextWindowPos({width / 2, height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width, height});
  ImGui::SetNextWindowFocus();
  constexpr int kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove;
  if (ImGui::Begin("Help", nullptr, kFlags)) {
    const std::span<const HelpGroup> groups = kHelpGroups;
    constexpr size_t kOnTheLeft = 2;
    draw_groups(groups.first(kOnTheLeft));
    ImGui::SameLine(0, kGap * ImGui::GetFontSize());
    draw_groups(groups.subspan(kOnTheLeft));
  }
  ImGui::End();
}

}  // namespace whittle
