#include "sheet/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "sheet/dimension_lines.h"
#include "trace/view.h"

namespace whittle {
namespace {

/// Spaces, in heights of letters.
constexpr double kMargin = 2, kBetween = 3, kForDimension = 3.8, kForLabel = 2.2, kForFoot = 2.4;
/// The height of letters: on paper as ISO 3098 has it; of a picture a share of its shorter side,
/// but readable.
constexpr double kLettersOnPaper = 3.5, kSharesOfPicture = 45, kLeastLetters = 6;

const char* label_of(NamedView view) {
  switch (view) {
    case NamedView::kFront:
      return "FRONT";
    case NamedView::kBack:
      return "BACK";
    case NamedView::kLeft:
      return "LEFT";
    case NamedView::kRight:
      return "RIGHT";
    case NamedView::kTop:
      return "TOP";
    case NamedView::kBottom:
      return "BOTTOM";
    case NamedView::kIso:
      return "ISO";
  }
  return "";
}

/// Column and row, counted from the view from the front.
struct Place {
  int column = 0, row = 0;
  bool operator==(const Place&) const = default;
};

Place place_of(NamedView view, ProjectionAngle angle) {
  const int side = angle == ProjectionAngle::kThird ? 1 : -1;
  switch (view) {
    case NamedView::kLeft:
      return {-side, 0};
    case NamedView::kRight:
      return {side, 0};
    case NamedView::kTop:
      return {0, -side};
    case NamedView::kBottom:
      return {0, side};
    case NamedView::kBack:
      return {2, 0};
    default:
      return {0, 0};
  }
}

/// A free corner between the other views, else beside them.
Place place_of_iso(const std::vector<Place>& others, ProjectionAngle angle) {
  if (others.empty()) return {};
  const auto has = [&](const auto& matches) { return std::ranges::any_of(others, matches); };
  const int row = angle == ProjectionAngle::kThird ? -1 : 1;
  for (const Place corner : {Place{1, row}, Place{-1, row}, Place{1, -row}, Place{-1, -row}}) {
    if (has([&](Place p) { return p.column == corner.column; }) &&
        has([&](Place p) { return p.row == corner.row; }) &&
        !has([&](Place p) { return p == corner; }))
      return corner;
  }
  const Place last =
      *std::ranges::max_element(others, [](Place a, Place b) { return a.column < b.column; });
  return {last.column + 1, last.row};
}

std::vector<Place> places_of(const SheetSettings& settings) {
  std::vector<Place> others;
  for (const NamedView view : settings.views)
    if (view != NamedView::kIso) others.push_back(place_of(view, settings.angle));
  std::vector<Place> places;
  for (const NamedView view : settings.views)
    places.push_back(view == NamedView::kIso ? place_of_iso(others, settings.angle)
                                             : place_of(view, settings.angle));
  return places;
}

/// How large the box is in a view, model units.
Vec2 seen_size(NamedView view, const Box& box) {
  const Camera camera = sheet_camera(view, box, 1, 1, 1);
  const std::array<double, 4> reach =
      box_reach(box, {camera.right, camera.right * -1, camera.up, camera.up * -1});
  return {reach[0] + reach[1], reach[2] + reach[3]};
}

/// Which edge of the box a view's width or height is, 0 to 2; none of the isometric one.
std::optional<int> axis_of(NamedView view, bool vertical) {
  switch (view) {
    case NamedView::kIso:
      return std::nullopt;
    case NamedView::kTop:
    case NamedView::kBottom:
      return vertical ? 1 : 0;
    case NamedView::kLeft:
    case NamedView::kRight:
      return vertical ? 2 : 1;
    default:
      return vertical ? 2 : 0;
  }
}

/// Which views tell how long the box is: each edge in one of them, in which it is expected.
struct Dimensioned {
  size_t view = 0;
  bool vertical = false;
  int axis = 0;
};

std::vector<Dimensioned> dimensioned(const std::vector<NamedView>& views) {
  using V = NamedView;
  constexpr std::array<V, 6> kOrder = {V::kFront, V::kTop,  V::kRight,
                                       V::kLeft,  V::kBack, V::kBottom};
  std::vector<Dimensioned> found;
  for (int axis = 0; axis < 3; ++axis) {
    const auto take = [&](V view) {
      const auto at = std::ranges::find(views, view);
      if (at == views.end()) return false;
      for (const bool vertical : {false, true}) {
        if (axis_of(view, vertical) != axis) continue;
        found.push_back({size_t(at - views.begin()), vertical, axis});
        return true;
      }
      return false;
    };
    std::ranges::any_of(kOrder, take);
  }
  return found;
}

/// One column or row of the sheet.
struct Lane {
  double content = 0;  ///< the largest of its views, model units
  double before = 0;   ///< room for dimensions on the left
  double after = 0;    ///< room below, for dimensions and labels
  double start = 0, size = 0;
};
using Lanes = std::map<int, Lane>;

/// Where views, dimensions and words go.
class Layout {
 public:
  Layout(const SheetSettings& settings, const Box& box, double letters)
      : settings_(settings),
        box_(box),
        letters_(letters),
        places_(places_of(settings)),
        dimensions_(dimensioned(settings.views)) {
    for (size_t i = 0; i < places_.size(); ++i) {
      seen_.push_back(seen_size(settings.views[i], box));
      Lane& column = columns_[places_[i].column];
      Lane& row = rows_[places_[i].row];
      column.content = std::max(column.content, seen_[i].x);
      row.content = std::max(row.content, seen_[i].y);
      row.after = std::max(row.after, kForLabel * letters_);
    }
    for (const Dimensioned& d : dimensions_) {
      if (d.vertical)
        columns_[places_[d.view].column].before = kForDimension * letters_;
      else
        rows_[places_[d.view].row].after = (kForDimension + kForLabel) * letters_;
    }
  }

  /// Room that grows with no scale; `slack` for each lane.
  double fixed(bool vertical, double slack) const {
    const Lanes& lanes = vertical ? rows_ : columns_;
    double sum = 2 * kMargin * letters_ + (vertical ? kForFoot * letters_ : 0) +
                 double(lanes.size() - 1) * kBetween * letters_;
    for (const auto& [at, lane] : lanes) sum += lane.before + lane.after + slack;
    return sum;
  }
  double content(bool vertical) const {
    double sum = 0;
    for (const auto& [at, lane] : vertical ? rows_ : columns_) sum += lane.content;
    return sum;
  }

  /// Whole lengths have room for pixels at the border of a view. No `size`: as large as is needed.
  Sheet finish(double scale, double slack, std::optional<Vec2> size) {
    const bool whole = slack > 0;
    const auto rounded = [&](double length) { return whole ? std::ceil(length) + 2 : length; };
    Vec2 used;
    for (const bool vertical : {false, true}) {
      Lanes& lanes = vertical ? rows_ : columns_;
      double sum = fixed(vertical, 0);
      for (auto& [at, lane] : lanes) sum += lane.size = rounded(lane.content * scale);
      (vertical ? used.y : used.x) = sum;
    }
    const Vec2 sheet_size = size.value_or(used);
    for (const bool vertical : {false, true}) {
      const double left = vertical ? (sheet_size.y - used.y) / 2 : (sheet_size.x - used.x) / 2;
      double at = left + kMargin * letters_;
      for (auto& [number, lane] : vertical ? rows_ : columns_) {
        lane.start = whole ? std::floor(at + lane.before) : at + lane.before;
        at += lane.before + lane.size + lane.after + kBetween * letters_;
      }
    }
    Sheet sheet{.size = sheet_size, .scale = scale, .views = {}, .lines = {}};
    for (size_t i = 0; i < places_.size(); ++i) {
      const Lane &column = columns_[places_[i].column], &row = rows_[places_[i].row];
      sheet.views.push_back({.view = settings_.views[i],
                             .corner = {column.start, row.start},
                             .size = {column.size, row.size},
                             .drawn = seen_[i] * scale});
    }
    add_words(sheet);
    return sheet;
  }

 private:
  void add_words(Sheet& sheet) const {
    const auto add = [&sheet](const std::vector<Stroke>& strokes) {
      sheet.lines.insert(sheet.lines.end(), strokes.begin(), strokes.end());
    };
    const Vec3 edges = box_.size();
    const double longest = std::max({edges.x, edges.y, edges.z});
    for (const Dimensioned& d : dimensions_) {
      const SheetView& view = sheet.views[d.view];
      const Vec2 half = view.drawn * 0.5, middle = view.middle();
      const std::string text = length_text(edges[d.axis], longest);
      const Vec2 low{middle.x - half.x, middle.y + half.y};
      // From left to right below, from the top down on the left.
      add(d.vertical ? dimension_lines({low.x, middle.y - half.y}, low, true, text, letters_)
                     : dimension_lines(low, {middle.x + half.x, low.y}, false, text, letters_));
    }
    for (size_t i = 0; i < sheet.views.size(); ++i) {
      const SheetView& view = sheet.views[i];
      const std::string_view label = label_of(view.view);
      const Lane& row = rows_.at(places_[i].row);
      const double x = view.middle().x - text_width(label, letters_) / 2;
      add(text_strokes(label, {x, row.start + row.size + row.after - 0.4 * letters_}, letters_));
    }
    const double foot = sheet.size.y - kMargin * letters_;
    add(text_strokes(settings_.title, {kMargin * letters_, foot}, letters_));
    const std::string_view angle =
        settings_.angle == ProjectionAngle::kThird ? "third angle" : "first angle";
    const double x = sheet.size.x - kMargin * letters_ - text_width(angle, letters_);
    add(text_strokes(angle, {x, foot}, letters_));
  }

  const SheetSettings& settings_;
  const Box& box_;
  double letters_;
  std::vector<Place> places_;
  std::vector<Dimensioned> dimensions_;
  std::vector<Vec2> seen_;  ///< by view
  Lanes columns_, rows_;
};

}  // namespace

Result<Sheet> sheet_of_pixels(const SheetSettings& settings, const Box& box, int width,
                              int height) {
  const double letters =
      std::max(kLeastLetters, std::round(std::min(width, height) / kSharesOfPicture));
  Layout layout(settings, box, letters);
  // A column or row is rounded up, and has a pixel at each border.
  constexpr double kSlack = 3;
  const double room_x = width - layout.fixed(false, kSlack);
  const double room_y = height - layout.fixed(true, kSlack);
  // What is flat has no height in some views.
  const double scale =
      std::min(layout.content(false) > 0 ? room_x / layout.content(false) : kInfinity,
               layout.content(true) > 0 ? room_y / layout.content(true) : kInfinity);
  constexpr double kLeastRoom = 16;
  if (room_x < kLeastRoom || room_y < kLeastRoom || !std::isfinite(scale)) {
    return Error{
        ErrorKind::kUsage,
        fmt::format("a sheet of these views does not fit {} x {} pixels; it wants at least "
                    "{} x {}",
                    width, height, std::ceil(layout.fixed(false, kSlack) + kLeastRoom),
                    std::ceil(layout.fixed(true, kSlack) + kLeastRoom))};
  }
  return layout.finish(scale, kSlack, Vec2{double(width), double(height)});
}

Sheet sheet_to_scale(const SheetSettings& settings, const Box& box, double scale) {
  return Layout(settings, box, kLettersOnPaper).finish(scale, 0, std::nullopt);
}

Camera sheet_camera(NamedView view, const Box& box, double scale, int width, int height) {
  ViewOptions options;
  options.named = view;
  options.orthographic = true;
  options.width = width;
  options.height = height;
  Camera camera = make_camera(options, {}, box);
  camera.half_height = height / (2 * scale);
  return camera;
}

std::string length_text(double length, double longest) {
  constexpr int kDigits = 5;
  const int first = longest > 0 ? int(std::floor(std::log10(longest))) : 0;
  const int decimals = std::clamp(kDigits - 1 - first, 0, 300);
  std::string text = fmt::format("{:.{}f}", length, decimals);
  if (text.find('.') == std::string::npos) return text;
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace whittle
