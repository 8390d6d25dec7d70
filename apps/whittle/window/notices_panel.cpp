#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "panels.h"

namespace whittle {

void draw_notices_panel(PanelContext& context) {
  const auto margin = float(10 * context.scale);
  const auto width = float(context.size.width), height = float(context.size.height);
  ImGui::SetNextWindowPos({margin, height - margin}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {width - 2 * margin, height});
  constexpr int kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("Notices", nullptr, kFlags)) {
    ImGui::PushTextWrapPos(width - 4 * margin);
    if (!context.notices.error().empty())
      ImGui::TextColored({1, 0.45f, 0.4f, 1}, "%s", context.notices.error().c_str());
    for (const std::string& line : context.notices.lines()) ImGui::TextUnformatted(line.c_str());
    if (context.work) {
      const WorkShown& work = *context.work;
      ImGui::TextUnformatted(fmt::format("{} ({:.1f} s)", work.what, work.seconds).c_str());
    }
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

}  // namespace whittle
