#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>
#include <vector>

#include "edit/marks.h"
#include "edit/parameters.h"
#include "edit/structure.h"
#include "edit/wraps.h"
#include "editing.h"
#include "panels.h"

namespace whittle {
namespace {

constexpr size_t kMostNumbers = 24;
constexpr double kDragShare = 0.005;  ///< of a number a pixel

void say_unless(PanelContext& context, const Status& done) {
  if (!done) context.notices.tell(done.error().message);
}

/// One statement a line; only those that are seen are made.
void draw_rows(Editing& editing) {
  const std::vector<Editing::Row>& rows = editing.rows();
  if (const std::optional<uint32_t> wanted = editing.take_wanted_node()) {
    const auto row =
        std::lower_bound(rows.begin(), rows.end(), *wanted,
                         [](const Editing::Row& r, uint32_t node) { return r.node < node; });
    ImGui::SetScrollY(float(row - rows.begin()) * ImGui::GetTextLineHeightWithSpacing());
  }
  ImGuiListClipper clipper;
  clipper.Begin(int(rows.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const Editing::Row& row = rows[size_t(i)];
      const SyntaxNode& node = editing.document().node(row.node);
      std::string line(2 * std::min<size_t>(row.depth, 30), ' ');
      for (const Mark mark : {Mark::kDisabled, Mark::kRoot, Mark::kHighlight, Mark::kBackground}) {
        if (has_mark(node, mark)) line += char(mark);
      }
      line += editing.label(row.node);
      ImGui::PushID(int(row.node));
      if (ImGui::Selectable(line.c_str(), editing.is_chosen(row.node))) {
        editing.choose(row.node, ImGui::GetIO().KeyCtrl);
      }
      ImGui::PopID();
    }
  }
}

void draw_mark_button(PanelContext& context, Editing& editing, const char* name, Mark mark) {
  if (!ImGui::Button(name)) return;
  const std::vector<uint32_t> chosen = editing.chosen();
  const bool is_set = has_mark(editing.document().node(chosen.front()), mark);
  for (const uint32_t node : chosen) {
    const Result<uint32_t> marked = set_mark(editing.document(), node, mark, !is_set);
    if (!marked) context.notices.tell(marked.error().message);
  }
}

/// Moves among its siblings.
Result<uint32_t> step_node(SourceDocument& document, uint32_t node, bool is_down) {
  const uint32_t parent = document.node(node).parent;
  size_t position = 0;
  for (uint32_t child = parent + 1; child < node; child = document.node(child).last) ++position;
  if (!is_down && position == 0) return node;
  return move_node(document, node, parent, is_down ? position + 1 : position - 1);
}

void draw_structure_buttons(PanelContext& context, Editing& editing) {
  SourceDocument& document = editing.document();
  const uint32_t node = editing.chosen().front();
  draw_mark_button(context, editing, "Hide", Mark::kDisabled);
  ImGui::SameLine();
  draw_mark_button(context, editing, "Alone", Mark::kRoot);
  ImGui::SameLine();
  if (ImGui::Button("Copy")) say_unless(context, editing.take(duplicate_node(document, node)));
  ImGui::SameLine();
  if (ImGui::Button("Up")) say_unless(context, editing.take(step_node(document, node, false)));
  ImGui::SameLine();
  if (ImGui::Button("Down")) say_unless(context, editing.take(step_node(document, node, true)));
  ImGui::SameLine();
  if (ImGui::Button("Group"))
    say_unless(context, editing.take(group_nodes(document, editing.chosen())));
  ImGui::SameLine();
  if (ImGui::Button("Delete"))
    say_unless(context, editing.take(remove_nodes(document, editing.chosen())));
}

void draw_operations(PanelContext& context, Editing& editing, uint32_t node) {
  SourceDocument& document = editing.document();
  const std::string name(name_of(document.text(), document.node(node)));
  if (!is_operation_name(name) || !ImGui::BeginCombo("operation", name.c_str())) return;
  for (const char* other : {"group", "union", "difference", "intersection", "hull", "minkowski"}) {
    if (ImGui::Selectable(other, name == other))
      say_unless(context, editing.take(change_operation(document, node, other)));
  }
  ImGui::EndCombo();
}

/// How an edit joins the one before: all of one drag are one step.
class DragSteps {
 public:
  explicit DragSteps(const char* name) : id_(ImGui::GetID(name)) {}
  SourceDocument::Step step() const {
    const bool goes_on = ImGui::GetStateStorage()->GetBool(id_);
    ImGui::GetStateStorage()->SetBool(id_, true);
    return goes_on ? SourceDocument::Step::kWithLast : SourceDocument::Step::kOwn;
  }
  void begin() const { ImGui::GetStateStorage()->SetBool(id_, false); }

 private:
  ImGuiID id_;
};

void draw_numbers(PanelContext& context, Editing& editing, uint32_t node) {
  SourceDocument& document = editing.document();
  const DragSteps steps("drag");
  for (const NumberValue& number : numbers_of(document, node, kMostNumbers)) {
    std::string name = number.place.parameter;
    for (const size_t index : number.place.indices) name += "[" + std::to_string(index) + "]";
    double value = number.value;
    const auto speed = float(std::max(std::fabs(value), 1.0) * kDragShare);
    const bool is_edited = ImGui::DragScalar(name.c_str(), ImGuiDataType_Double, &value, speed,
                                             nullptr, nullptr, "%.6g");
    if (ImGui::IsItemActivated()) steps.begin();
    if (is_edited && value != number.value) {
      const Result<uint32_t> set = set_number(document, node, number.place, value, steps.step());
      if (!set) context.notices.tell(set.error().message);
      // The places of the others are those of the text before.
      return;
    }
  }
}

void draw_color(PanelContext& context, Editing& editing, uint32_t node) {
  SourceDocument& document = editing.document();
  std::array<float, 4> color{1, 1, 1, 1};
  if (document.node(node).meaning == Meaning::kColor) {
    for (const NumberValue& number : numbers_of(document, node, 4)) {
      if (number.place.indices.size() == 1 && number.place.indices[0] < 4)
        color[number.place.indices[0]] = float(std::clamp(number.value, 0.0, 1.0));
    }
  }
  const DragSteps steps("colour");
  const bool is_edited = ImGui::ColorEdit4("colour", color.data(), ImGuiColorEditFlags_Float);
  if (ImGui::IsItemActivated()) steps.begin();
  if (is_edited) {
    const auto part = [&](size_t i) {
      return std::round(std::clamp(double(color[i]), 0.0, 1.0) * 1000) / 1000;
    };
    say_unless(context, editing.take(set_color(document, node, {part(0), part(1), part(2), part(3)},
                                               steps.step())));
  }
}

}  // namespace

void draw_tree_panel(PanelContext& context) {
  Editing& editing = *context.editing;
  const auto margin = float(10 * context.scale), width = float(330 * context.scale);
  ImGui::SetNextWindowPos({margin, margin}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({width, float(context.size.height) - 2 * margin},
                           ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Model", &context.state.shows_tree, ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##search", "search", editing.search().data(),
                             editing.search().size());
    const bool has_chosen = !editing.chosen().empty();
    const float below = has_chosen ? ImGui::GetContentRegionAvail().y / 2 : 0;
    ImGui::BeginChild("rows", {0, -below}, true, ImGuiWindowFlags_HorizontalScrollbar);
    draw_rows(editing);
    ImGui::EndChild();
    // After each of them the statement may be another, or none.
    if (!editing.chosen().empty()) draw_structure_buttons(context, editing);
    if (!editing.chosen().empty()) draw_operations(context, editing, editing.chosen().front());
    if (!editing.chosen().empty()) draw_color(context, editing, editing.chosen().front());
    if (!editing.chosen().empty()) draw_numbers(context, editing, editing.chosen().front());
  }
  ImGui::End();
}

}  // namespace whittle
