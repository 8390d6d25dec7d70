// SVG as OpenSCAD 2021.01 reads it, and `use`, `id` and `layer` as later versions do: shapes are
// filled whatever their style says, open lines are the areas of their strokes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/box.h"
#include "base/xml_scanner.h"
#include "flat/outlines.h"
#include "flat/svg_pen.h"
#include "flat/svg_values.h"
#include "flat/sweep_work.h"

namespace whittle {
namespace {

constexpr size_t kMostCorners = 1'000'000;

/// `use` within `use`, and how many elements may be drawn by it in all: either could have no end.
constexpr size_t kDeepestUse = 16, kMostUsed = 1'000'000;

constexpr double kDefaultDpi = 72, kLeastDpi = 0.001;

using Event = XmlScanner::Event;

class Attributes {
 public:
  void read(XmlScanner& scanner) {
    all_.clear();
    XmlScanner::Attribute next;
    while (scanner.next_attribute(next)) all_.push_back(next);
  }
  /// By its name with the prefix; empty if there is none.
  std::string_view get(std::string_view name) const {
    const auto found = std::ranges::find(all_, name, &XmlScanner::Attribute::full_name);
    return found == all_.end() ? std::string_view() : found->value;
  }
  /// Of its own, or of the `style` attribute. Spaces are not forgiven there.
  std::string_view style(std::string_view name) const {
    if (const std::string_view own = get(name); !own.empty()) return own;
    std::string_view rest = get("style");
    while (!rest.empty()) {
      const std::string_view one = rest.substr(0, rest.find(';'));
      rest.remove_prefix(std::min(one.size() + 1, rest.size()));
      const size_t colon = one.find(':');
      if (colon == std::string_view::npos || one.find(':', colon + 1) != std::string_view::npos)
        continue;
      if (one.substr(0, colon) == name) return one.substr(colon + 1);
    }
    return {};
  }

 private:
  std::vector<XmlScanner::Attribute> all_;
};

/// The characters that a value stands for. Of references the five of XML are known.
std::string plain(std::string_view value) {
  constexpr std::pair<std::string_view, char> kKnown[] = {
      {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string text;
  while (!value.empty()) {
    const auto* const known = std::ranges::find_if(
        kKnown, [&](const auto& reference) { return value.starts_with(reference.first); });
    const bool is_known = known != std::end(kKnown);
    text += is_known ? known->second : value.front();
    value.remove_prefix(is_known ? known->first.size() : 1);
  }
  return text;
}

SvgStroke stroke_of(const Attributes& attributes) {
  SvgStroke stroke;
  const double width = svg_number(attributes.style("stroke-width"));
  if (width >= 0.01) stroke.width = width;
  const std::string_view cap = attributes.style("stroke-linecap");
  if (cap == "butt") stroke.cap = SvgCap::kButt;
  if (cap == "round") stroke.cap = SvgCap::kRound;
  return stroke;
}

/// With six digits.
double as_printed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

/// The contours of a shape, each of which may cross itself and the others.
using Shape = std::vector<Contour>;

class SvgReader {
 public:
  SvgReader(const Import& how, const Remark& remark) : how_(how), remark_(remark) {
    selects_all_ = !has(how.id) && !has(how.layer);
    dpi_ = how.dpi >= kLeastDpi && std::isfinite(how.dpi) ? how.dpi : kDefaultDpi;
  }

  Result<Polygons> read(std::string_view content) {
    find_defined(content);
    sources_.push_back({XmlScanner(content), 0});
    bool any = false;
    while (!sources_.empty()) {
      XmlScanner& scanner = sources_.back().scanner;
      const Event event = scanner.next();
      if (event == Event::kMistake)
        return Error{ErrorKind::kInput,
                     any ? "its XML is damaged or was cut off" : "this is no SVG file"};
      any |= event == Event::kOpen;
      if (event == Event::kOpen) open(scanner);
      if (event == Event::kClose) close();
      if (event == Event::kEnd) sources_.pop_back();
      if (left_ == 0)
        return Error{ErrorKind::kInput, "it has more elements or corners than can be drawn"};
    }
    if (!any) return Error{ErrorKind::kInput, "this is no SVG file"};
    if (!selects_all_ && !was_selected_)
      remark_("nothing in an imported file has the id or layer asked for",
              "nothing in it has the id or layer asked for; nothing is shown for it");
    return placed();
  }

 private:
  /// An element that is open.
  struct Frame {
    SvgMap map;
    bool is_selected = false, is_in_layer = false, is_hidden = false;
  };
  /// What is being read: the file, or one element of it again. It ends when no more frames are open
  /// than `floor`.
  struct Source {
    XmlScanner scanner;
    size_t floor;
  };

  static bool has(const std::optional<std::string>& name) { return name && !name->empty(); }

  /// Where in the content each element below a `defs` is that has an id. The first of an id counts.
  void find_defined(std::string_view content) {
    if (content.find("<use") == std::string_view::npos &&
        content.find(":use") == std::string_view::npos)
      return;
    XmlScanner scanner(content);
    size_t depth = 0, defs = 0;
    for (Event event = scanner.next();
         event == Event::kOpen || event == Event::kClose || event == Event::kText;
         event = scanner.next()) {
      if (event == Event::kOpen) {
        ++depth;
        const std::string_view from = scanner.from_tag();
        attributes_.read(scanner);
        if (defs != 0 && !attributes_.get("id").empty())
          defined_.emplace(attributes_.get("id"), from);
        if (scanner.name() == "defs" && defs == 0) defs = depth;
      } else if (event == Event::kClose) {
        if (depth-- == defs) defs = 0;
      }
    }
  }

  void open(XmlScanner& scanner) {
    const std::string_view name = scanner.name();
    attributes_.read(scanner);
    const bool is_root = frames_.empty();
    Frame frame;
    frame.is_selected = selects_all_;
    if (!is_root) frame = frames_.back();
    if (sources_.size() > 1 && ++used_ > kMostUsed) left_ = 0;
    frame.is_hidden |= name == "defs";
    select(frame);
    const bool is_shape = is_drawn(name);
    if (!is_root && (is_shape || name == "g" || name == "use"))
      frame.map = frame.map * svg_transform(attributes_.get("transform"));
    if (!frame.is_hidden) {
      // OpenSCAD puts everything onto the last page of a file.
      if (name == "svg") page_ = page();
      if (frame.is_selected && is_shape) draw(name, frame.map);
      if (frame.is_selected && (name == "text" || name == "image"))
        say("text and pictures in an SVG file are left out",
            "text and pictures in it are left out");
      if (name == "use") {
        frame.map = frame.map * SvgMap{.e = number("x"), .f = number("y")};
        frames_.push_back(frame);
        use();  // which is the last: `scanner` may have moved
        return;
      }
    }
    frames_.push_back(frame);
  }

  void close() {
    frames_.pop_back();
    if (sources_.back().floor != 0 && frames_.size() == sources_.back().floor) sources_.pop_back();
  }

  /// Once a file.
  void say(const char* kind, const char* message) {
    if (said_.insert(kind).second) remark_(kind, message);
  }

  void select(Frame& frame) {
    const std::string_view label = attributes_.get("inkscape:label");
    frame.is_in_layer |= has(how_.layer) && attributes_.get("inkscape:groupmode") == "layer" &&
                         plain(label) == *how_.layer;
    if (selects_all_) return;
    const bool has_id = !has(how_.id) || plain(attributes_.get("id")) == *how_.id;
    frame.is_selected |= has_id && (!has(how_.layer) || frame.is_in_layer);
    was_selected_ |= frame.is_selected && !frame.is_hidden;
  }

  void use() {
    std::string_view target = attributes_.get("href");
    if (target.empty()) target = attributes_.get("xlink:href");
    if (!target.starts_with('#') || sources_.size() > kDeepestUse) return;
    const auto found = defined_.find(target.substr(1));
    if (found == defined_.end()) return;
    sources_.push_back({XmlScanner(found->second), frames_.size()});
  }

  static bool is_drawn(std::string_view name) {
    constexpr std::string_view kShapes[] = {"path", "rect",     "circle", "ellipse",
                                            "line", "polyline", "polygon"};
    return std::ranges::find(kShapes, name) != std::end(kShapes);
  }

  double number(std::string_view name) {
    const std::string_view text = attributes_.get(name);
    if (!text.empty() && !is_svg_number(text))
      say("lengths with a unit in an SVG file count as 0, as in OpenSCAD",
          "lengths with a unit in it count as 0, as in OpenSCAD");
    return svg_number(text);
  }

  SvgPage page() const {
    return svg_page({attributes_.get("width"), attributes_.get("height"),
                     attributes_.get("viewBox"), attributes_.get("preserveAspectRatio")},
                    dpi_);
  }

  void draw(std::string_view name, const SvgMap& map) {
    SvgPen pen(stroke_of(attributes_), left_);
    if (name == "path") {
      draw_svg_path(attributes_.get("d"), pen);
    } else if (name == "rect") {
      rectangle(pen);
    } else if (name == "circle") {
      pen.ellipse({number("cx"), number("cy")}, {number("r"), number("r")});
    } else if (name == "ellipse") {
      pen.ellipse({number("cx"), number("cy")}, {number("rx"), number("ry")});
    } else if (name == "line") {
      pen.line_to({number("x1"), number("y1")});
      pen.line_to({number("x2"), number("y2")});
      pen.end_line();
    } else {
      points(pen);
      name == "polygon" ? pen.close() : pen.end_line();
    }
    Shape shape = pen.take();
    for (Contour& contour : shape) {
      for (Vec2& p : contour) p = map(p);
      left_ -= std::min(left_, contour.size());
    }
    if (pen.is_full()) left_ = 0;
    if (!shape.empty()) shapes_.push_back(std::move(shape));
  }

  void rectangle(SvgPen& pen) {
    const Vec2 lo{number("x"), number("y")}, size{number("width"), number("height")};
    const Vec2 hi = lo + size;
    Vec2 r{number("rx"), number("ry")};
    if (!(r.x > 0)) r.x = std::max(r.y, 0.0);
    if (!(r.y > 0)) r.y = r.x;
    r = {std::min(r.x, size.x / 2), std::min(r.y, size.y / 2)};
    const bool is_round = r.x > 0 && r.y > 0;
    if (!is_round) r = {};
    // OpenSCAD writes round ones down as path data first; the number of steps hangs on that.
    const auto written = [&](Vec2 p) {
      return is_round ? Vec2{as_printed(p.x), as_printed(p.y)} : p;
    };
    const auto corner = [&](Vec2 from, Vec2 to) {
      pen.line_to(written(from));
      pen.arc_to({.radii = written(r), .is_positive = true}, written(to));
    };
    corner({hi.x - r.x, lo.y}, {hi.x, lo.y + r.y});
    corner({hi.x, hi.y - r.y}, {hi.x - r.x, hi.y});
    corner({lo.x + r.x, hi.y}, {lo.x, hi.y - r.y});
    corner({lo.x, lo.y + r.y}, {lo.x + r.x, lo.y});
    pen.close();
  }

  void points(SvgPen& pen) const {
    SvgScanner scanner(attributes_.get("points"));
    while (!pen.is_full()) {
      const std::optional<double> x = scanner.number(), y = scanner.number();
      if (!x || !y) break;
      pen.line_to({*x, *y});
    }
  }

  /// All shapes on the page, y up.
  Result<Polygons> placed() {
    Vec2 shift{-page_.align.x, page_.size.y - page_.align.y};
    if (how_.center) shift = center();
    std::vector<Polygons> all;
    all.reserve(shapes_.size());
    Shape outlines;
    uint64_t work = 0;
    const Error too_much{ErrorKind::kInput, kTooTangled};
    for (Shape& shape : shapes_) {
      for (Contour& contour : shape)
        for (Vec2& p : contour)
          p = {page_.scale.x * (p.x - page_.view.x) - shift.x,
               shift.y - page_.scale.y * (p.y + page_.view.y)};
      work += estimate_sweep_work(shape);
      if (work > kMostSweepWork) return too_much;
      all.push_back(even_odd(shape));
      for (const Contour& contour : all.back().contours) outlines.push_back(contour);
    }
    if (work + estimate_sweep_work(outlines) > kMostSweepWork) return too_much;
    return unite(all);
  }

  /// OpenSCAD's middle: the view box does not move it.
  Vec2 center() const {
    Vec2 lo{kInfinity, kInfinity}, hi{-kInfinity, -kInfinity};
    for (const Shape& shape : shapes_)
      for (const Contour& contour : shape)
        for (const Vec2 p : contour) {
          if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
          lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
          hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
        }
    return {page_.scale.x * (lo.x + hi.x) / 2, page_.scale.y * (lo.y + hi.y) / 2};
  }

  const Import& how_;
  const Remark& remark_;
  bool selects_all_ = true, was_selected_ = false;
  double dpi_ = kDefaultDpi;
  std::map<std::string_view, std::string_view> defined_;  ///< by id
  std::vector<Source> sources_;
  std::vector<Frame> frames_;
  Attributes attributes_;  ///< of the element that was opened last
  std::set<std::string> said_;
  size_t used_ = 0, left_ = kMostCorners;
  SvgPage page_;
  std::vector<Shape> shapes_;
};

}  // namespace

Result<Polygons> read_svg(std::string_view content, const Import& how, const Remark& remark) {
  return SvgReader(how, remark).read(content);
}

}  // namespace whittle
