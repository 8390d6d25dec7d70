#include "flat/svg_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/degrees.h"

namespace whittle {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

void skip_space(std::string_view& text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
}

/// Takes a number from the front.
std::optional<double> take_number(std::string_view& text) {
  std::string_view rest = text;
  const bool is_negative = rest.starts_with('-');
  if (is_negative || rest.starts_with('+')) rest.remove_prefix(1);
  // Neither "inf" nor a second sign.
  const size_t first = rest.starts_with('.') ? 1 : 0;
  if (rest.size() <= first || !is_digit(rest[first])) return {};
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::invalid_argument) return {};
  text.remove_prefix(size_t(end - text.data()));
  return is_negative ? -number : number;
}

}  // namespace

bool is_svg_number(std::string_view text) {
  return take_number(text) && text.empty();
}

double svg_number(std::string_view text) {
  const std::optional<double> number = take_number(text);
  return number && text.empty() ? *number : 0;
}

bool SvgScanner::is_at_end() {
  while (!rest_.empty() && (is_space(rest_.front()) || rest_.front() == ',')) skip();
  return rest_.empty();
}

std::optional<double> SvgScanner::number() {
  if (is_at_end()) return {};
  return take_number(rest_);
}

std::optional<bool> SvgScanner::flag() {
  const char c = peek();
  if (c != '0' && c != '1') return {};
  skip();
  return c == '1';
}

std::string_view SvgScanner::word() {
  if (is_at_end()) return {};
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto* const end = std::ranges::find_if_not(rest_, is_letter);
  const std::string_view found = rest_.substr(0, size_t(end - rest_.begin()));
  rest_.remove_prefix(found.size());
  return found;
}

SvgMap SvgMap::operator*(const SvgMap& inner) const {
  return {.a = a * inner.a + c * inner.b,
          .b = b * inner.a + d * inner.b,
          .c = a * inner.c + c * inner.d,
          .d = b * inner.c + d * inner.d,
          .e = a * inner.e + c * inner.f + e,
          .f = b * inner.e + d * inner.f + f};
}

namespace {

/// One step of a transform; none if it is not understood.
std::optional<SvgMap> step(std::string_view name, const std::vector<double>& values) {
  const size_t count = values.size();
  const auto at = [&](size_t i, double otherwise) { return i < count ? values[i] : otherwise; };
  if (name == "matrix" && count == 6)
    return SvgMap{values[0], values[1], values[2], values[3], values[4], values[5]};
  if (name == "translate" && (count == 1 || count == 2))
    return SvgMap{.e = values[0], .f = at(1, 0)};
  if (name == "scale" && (count == 1 || count == 2))
    return SvgMap{.a = values[0], .d = at(1, values[0])};
  if (name == "rotate" && (count == 1 || count == 3)) {
    const double cosine = cos_degrees(values[0]), sine = sin_degrees(values[0]);
    const SvgMap turn{.a = cosine, .b = sine, .c = -sine, .d = cosine};
    return SvgMap{.e = at(1, 0), .f = at(2, 0)} * turn * SvgMap{.e = -at(1, 0), .f = -at(2, 0)};
  }
  if ((name == "skewX" || name == "skewY") && count == 1) {
    const double slope = sin_degrees(values[0]) / cos_degrees(values[0]);
    return name == "skewX" ? SvgMap{.c = slope} : SvgMap{.b = slope};
  }
  return {};
}

}  // namespace

SvgMap svg_transform(std::string_view text) {
  SvgMap map;
  SvgScanner scanner(text);
  while (!scanner.is_at_end()) {
    const std::string_view name = scanner.word();
    if (name.empty() || scanner.peek() != '(') break;
    scanner.skip();
    std::vector<double> values;
    while (const std::optional<double> value = scanner.number()) values.push_back(*value);
    if (scanner.peek() != ')') break;
    scanner.skip();
    if (const std::optional<SvgMap> next = step(name, values)) map = map * *next;
  }
  return map;
}

namespace {

constexpr double kInch = 25.4;  ///< mm

struct Length {
  double number = 0;
  std::string_view unit;
};

/// None if it is missing or not understood.
std::optional<Length> length_of(std::string_view text) {
  skip_space(text);
  const std::optional<double> number = take_number(text);
  if (!number) return {};
  skip_space(text);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  for (const std::string_view unit : {"", "px", "pt", "pc", "in", "cm", "mm", "em", "ex", "%"})
    if (text == unit) return Length{*number, unit};
  return {};
}

/// A side of the page in mm. `view`: of the view box, if there is one.
double in_mm(std::string_view text, std::optional<double> view, double dpi) {
  const std::optional<Length> length = length_of(text);
  if (!length) return view ? kInch * *view / dpi : 0;
  const auto& [number, unit] = *length;
  if (unit.empty()) return kInch * number / dpi;
  if (unit == "px") return kInch * number / 96;
  if (unit == "pt") return kInch * number / 72;
  if (unit == "pc") return kInch * number / 6;
  if (unit == "in") return kInch * number;
  if (unit == "cm") return 10 * number;
  if (unit == "mm") return number;
  // OpenSCAD knows nothing to take a part of, and takes the view box for millimetres.
  return view.value_or(0);
}

struct ViewBox {
  double x, y, width, height;
};

std::optional<ViewBox> view_box_of(std::string_view text) {
  SvgScanner scanner(text);
  double values[4];
  for (double& value : values) {
    const std::optional<double> number = scanner.number();
    if (!number) return {};
    value = *number;
  }
  if (!scanner.is_at_end() || values[2] < 0 || values[3] < 0) return {};
  return ViewBox{values[0], values[1], values[2], values[3]};
}

/// How a view box of another shape lies on its page.
struct Fit {
  double x = 0.5, y = 0.5;  ///< the share of what is left over that is before it
  bool stretch = false, slice = false;
};

std::optional<double> share_of(std::string_view word) {
  if (word == "Min") return 0;
  if (word == "Mid") return 0.5;
  if (word == "Max") return 1;
  return {};
}

Fit fit_of(std::string_view text) {
  SvgScanner scanner(text);
  std::string_view word = scanner.word();
  if (word == "defer") word = scanner.word();
  const std::string_view end = scanner.word();
  if (!scanner.is_at_end() || (!end.empty() && end != "meet" && end != "slice")) return {};
  Fit fit{.slice = end == "slice"};
  if (word == "none") {
    fit.stretch = true;
    return fit;
  }
  if (word.size() != 8 || word[0] != 'x' || word[4] != 'Y') return {};
  const std::optional<double> x = share_of(word.substr(1, 3)), y = share_of(word.substr(5, 3));
  if (!x || !y) return {};
  fit.x = *x;
  fit.y = *y;
  return fit;
}

}  // namespace

SvgPage svg_page(const SvgPageText& text, double dpi) {
  const std::optional<ViewBox> view = view_box_of(text.view_box);
  const auto side = [&](std::string_view length, double ViewBox::*member) {
    return in_mm(length, view ? std::optional((*view).*member) : std::nullopt, dpi);
  };
  SvgPage page;
  page.size = {side(text.width, &ViewBox::width), side(text.height, &ViewBox::height)};
  if (!view) return page;
  page.view = {view->x, view->y};
  page.scale = {page.size.x / view->width, page.size.y / view->height};
  const Fit fit = fit_of(text.aspect_ratio);
  if (fit.stretch) return page;
  const double scale =
      fit.slice ? std::max(page.scale.x, page.scale.y) : std::min(page.scale.x, page.scale.y);
  page.scale = {scale, scale};
  page.align = {fit.x * (page.size.x - scale * view->width),
                fit.y * (page.size.y - scale * view->height)};
  return page;
}

}  // namespace whittle
