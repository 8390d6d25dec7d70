#include <imgui.h>

#include <string>

#include "panels.h"

namespace whittle {
namespace {

/// A line that says what is chosen; a click asks for the next, as the key does.
void draw_choice(PanelContext& context, Action action, const char* what,
                 const std::string& chosen) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(what);
  ImGui::TableNextColumn();
  const std::string label = chosen + "##" + what;
  if (ImGui::Selectable(label.c_str())) context.wanted = action;
}

const char* on_or_off(bool is_on) {
  return is_on ? "on" : "off";
}

}  // namespace

void draw_look_panel(PanelContext& context) {
  const Look& look = context.state.look;
  const ShadeSettings& shading = look.shading;
  const auto margin = float(10 * context.scale), width = float(250 * context.scale);
  ImGui::SetNextWindowPos({margin, margin}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({width, 0}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Look", &context.state.shows_look, ImGuiWindowFlags_NoSavedSettings)) {
    if (ImGui::BeginTable("look", 2)) {
      const bool is_studio = shading.style == Style::kStudio;
      draw_choice(context, Action::kStyle, "S  style", name_of(style_choices(), shading.style));
      if (is_studio)
        draw_choice(context, Action::kQuality, "T  quality",
                    name_of(quality_choices(), shading.quality));
      if (shading.style != Style::kOpenscad)
        draw_choice(context, Action::kShadows, "L  shadows", on_or_off(shading.shadows));
      if (is_studio) draw_choice(context, Action::kGround, "G  ground", on_or_off(shading.ground));
      draw_choice(context, Action::kPass, "P  pass", name_of(pass_choices(), look.pass));
      draw_choice(context, Action::kCells, "C  cells",
                  look.cells ? name_of(cell_view_choices(), *look.cells) : "off");
      draw_choice(context, Action::kColors, "K  colours",
                  shading.scheme != nullptr ? std::string(shading.scheme->name) : "the style's");
      if (context.state.view)
        draw_choice(context, Action::kProjection, "5  projection",
                    name_of(projection_choices(), context.state.view->orthographic));
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace whittle
