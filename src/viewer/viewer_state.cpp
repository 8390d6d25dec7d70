#include "viewer/viewer_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whittle {
namespace {

constexpr double kTurn = 15;    ///< degrees a key
constexpr double kNotches = 2;  ///< of the wheel, a key
constexpr size_t kMostPicks = 2;

template <class T>
T after(Choices<T> choices, T value) {
  for (size_t i = 0; i + 1 < choices.size(); ++i)
    if (choices[i].value == value) return choices[i + 1].value;
  return choices[0].value;
}

const ColorScheme* after(const ColorScheme* scheme) {
  const std::span<const ColorScheme> all = color_schemes();
  if (scheme == nullptr) return all.data();
  return scheme == &all.back() ? nullptr : scheme + 1;
}

std::optional<CellView> after(std::optional<CellView> view) {
  if (!view) return CellView::kEdges;
  return *view == CellView::kEdges ? std::optional(CellView::kFaces) : std::nullopt;
}

std::optional<OrbitView> moved(Action action, const OrbitView& view) {
  switch (action) {
    case Action::kFront:
      return rotated_to(view, rotation_of(NamedView::kFront));
    case Action::kBack:
      return rotated_to(view, rotation_of(NamedView::kBack));
    case Action::kRight:
      return rotated_to(view, rotation_of(NamedView::kRight));
    case Action::kLeft:
      return rotated_to(view, rotation_of(NamedView::kLeft));
    case Action::kTop:
      return rotated_to(view, rotation_of(NamedView::kTop));
    case Action::kBottom:
      return rotated_to(view, rotation_of(NamedView::kBottom));
    case Action::kIsometric:
      return rotated_to(view, rotation_of(NamedView::kIso));
    case Action::kDiagonal:
      return rotated_to(view, kDefaultRotationDegrees);
    case Action::kTurnLeft:
      return turned(view, kTurn, 0);
    case Action::kTurnRight:
      return turned(view, -kTurn, 0);
    case Action::kTurnUp:
      return turned(view, 0, kTurn);
    case Action::kTurnDown:
      return turned(view, 0, -kTurn);
    case Action::kZoomIn:
      return zoomed(view, wheel_factor(kNotches), view.target);
    case Action::kZoomOut:
      return zoomed(view, wheel_factor(-kNotches), view.target);
    case Action::kProjection: {
      OrbitView other = view;
      other.orthographic = !view.orthographic;
      return other;
    }
    default:
      return std::nullopt;
  }
}

/// Whether the action is one that changes the look, which it then does.
bool change_look(Action action, Look& look) {
  ShadeSettings& shading = look.shading;
  switch (action) {
    case Action::kStyle:
      shading.style = after(style_choices(), shading.style);
      if (shading.style == Style::kOpenscad) shading.shadows = false;
      return true;
    case Action::kQuality:
      shading.quality = after(quality_choices(), shading.quality);
      return true;
    case Action::kShadows:
      shading.shadows = !shading.shadows && shading.style != Style::kOpenscad;
      return true;
    case Action::kGround:
      shading.ground = !shading.ground;
      return true;
    case Action::kPass:
      look.pass = after(pass_choices(), look.pass);
      return true;
    case Action::kCells:
      look.cells = after(look.cells);
      return true;
    case Action::kColors:
      shading.scheme = after(shading.scheme);
      return true;
    default:
      return false;
  }
}

Effect step_file(ViewerState& state, size_t by) {
  if (state.files.size() < 2) return Effect::kNone;
  state.file = (state.file + by) % state.files.size();
  state.view.reset();
  state.picks.clear();
  return Effect::kLoad;
}

std::string name_of(const PickedPoint& picked) {
  return picked.place.empty() ? fmt::format("statement {}", picked.answer.id) : picked.place;
}

std::string text_of(Vec3 v) {
  const auto number = [](double x) { return std::fabs(x) < 1e-12 ? 0.0 : x; };
  return fmt::format("{:.6g}, {:.6g}, {:.6g}", number(v.x), number(v.y), number(v.z));
}

}  // namespace

Effect act(Action action, ViewerState& state) {
  if (state.view) {
    if (const std::optional<OrbitView> view = moved(action, *state.view)) {
      state.view = view;
      return Effect::kMove;
    }
  }
  if (change_look(action, state.look)) return Effect::kPaint;
  switch (action) {
    case Action::kFit:
      return state.view ? Effect::kFit : Effect::kNone;
    case Action::kReset:
      return Effect::kReset;
    case Action::kNextFile:
      return step_file(state, 1);
    case Action::kPreviousFile:
      return step_file(state, state.files.size() - 1);
    case Action::kReload:
      return Effect::kLoad;
    case Action::kSave:
      return Effect::kSave;
    case Action::kSaveWithoutBackground:
      return Effect::kSaveWithoutBackground;
    case Action::kTreePanel:
      state.shows_tree = !state.shows_tree;
      return state.shows_tree ? Effect::kOpenText : Effect::kNone;
    case Action::kUndo:
      return Effect::kUndo;
    case Action::kRedo:
      return Effect::kRedo;
    case Action::kSaveText:
      return Effect::kSaveText;
    case Action::kCopyCamera:
      return Effect::kCopyCamera;
    case Action::kCopyCommand:
      return Effect::kCopyCommand;
    case Action::kQuit:
      return Effect::kQuit;
    case Action::kHelp:
      state.shows_help = !state.shows_help;
      break;
    case Action::kLookPanel:
      state.shows_look = !state.shows_look;
      break;
    case Action::kPickPanel:
      state.shows_picks = !state.shows_picks;
      break;
    case Action::kClearPicks:
      state.picks.clear();
      break;
    default:
      break;
  }
  return Effect::kNone;
}

void add_pick(PickedPoint picked, ViewerState& state) {
  if (picked.answer.id == 0) {
    state.picks.clear();
    return;
  }
  if (state.picks.size() == kMostPicks) state.picks.erase(state.picks.begin());
  state.picks.push_back(std::move(picked));
  state.shows_picks = true;
}

std::string pick_text(const PickedPoint& picked) {
  const Vec3 p = picked.answer.point;
  return fmt::format("{}: {:.6g},{:.6g},{:.6g}{}{}", name_of(picked), p.x, p.y, p.z,
                     picked.statement.empty() ? "" : " ", picked.statement);
}

std::vector<std::string> pick_lines(const ViewerState& state) {
  std::vector<std::string> lines;
  for (const PickedPoint& picked : state.picks) {
    if (!lines.empty()) lines.emplace_back();
    lines.push_back(name_of(picked));
    if (!picked.statement.empty()) lines.push_back(picked.statement);
    lines.push_back("point   " + text_of(picked.answer.point));
    lines.push_back("normal  " + text_of(picked.answer.normal));
  }
  if (state.picks.size() == kMostPicks) {
    const PickAnswer &a = state.picks[0].answer, &b = state.picks[1].answer;
    const Vec3 apart = b.point - a.point;
    const double degrees =
        std::acos(std::clamp(dot(a.normal, b.normal), -1.0, 1.0)) * 180 / std::acos(-1.0);
    lines.emplace_back();
    lines.push_back(fmt::format("apart   {:.6g}", length(apart)));
    lines.push_back("along   " + text_of(apart));
    lines.push_back(fmt::format("angle   {:.6g} degrees", degrees));
  }
  return lines;
}

}  // namespace whittle
