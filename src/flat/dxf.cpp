// DXF as OpenSCAD reads it: lines, light polylines, circles, arcs, ellipses and inserted blocks,
// all as straight lines that are then joined at their ends.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "flat/outlines.h"
#include "flat/sweep_work.h"
#include "shape/fragments.h"

namespace whittle {
namespace {

struct Line {
  Vec2 from, to;
};

/// More lines than this are no drawing; blocks that are inserted again and again can ask for any
/// number.
constexpr size_t kMostLines = 4'000'000;

/// Ends that are no farther apart are joined.
constexpr double kJoined = 1e-5;

/// A file is pairs of lines: what kind of thing follows, and the thing.
class Groups {
 public:
  explicit Groups(std::string_view text) : rest_(text) {}

  int code = 0;
  std::string_view value;

  /// False at the end, or where there is no number.
  bool next() {
    if (rest_.empty()) return false;
    const std::string_view number = trimmed(line());
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), code);
    if (error != std::errc() || end != number.data() + number.size()) return false;
    value = trimmed(line());
    return true;
  }

 private:
  std::string_view line() {
    const size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return found;
  }
  static std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
  }

  std::string_view rest_;
};

/// What stands between one entity and the next.
struct Entity {
  std::string type, layer, name;
  std::vector<double> x, y;                      ///< codes 10 and 20, in their order
  std::array<std::optional<double>, 80> number;  ///< the last of each other code
  double get(size_t code, double otherwise) const { return number[code].value_or(otherwise); }
};

class DxfReader {
 public:
  DxfReader(const Import& how, const Remark& remark) : how_(how), remark_(remark) {}

  Result<std::vector<Line>> read(std::string_view content) {
    Groups groups(content);
    std::string section, block;
    Entity entity;
    bool expects_section = false, any = false;
    while (groups.next()) {
      any = true;
      if (groups.code != 0) {
        if (groups.code == 2 && expects_section) section = groups.value;
        expects_section = false;
        add(groups, entity);
        continue;
      }
      finish(section, entity, block);
      if (too_many_) return Error{ErrorKind::kInput, "it has more lines than can be drawn"};
      entity = {};
      entity.type = groups.value;
      expects_section = entity.type == "SECTION";
      if (entity.type == "ENDSEC") section.clear();
    }
    finish(section, entity, block);
    if (!any) return Error{ErrorKind::kInput, "this is no DXF file"};
    if (too_many_) return Error{ErrorKind::kInput, "it has more lines than can be drawn"};
    return std::move(lines_);
  }

 private:
  void add(const Groups& groups, Entity& entity) {
    if (groups.code == 8) entity.layer = groups.value;
    if (groups.code == 2) entity.name = groups.value;
    if (groups.code < 10 || groups.code >= 80) return;
    std::string_view text = groups.value;
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return;
    if (groups.code == 10) {
      entity.x.push_back(number);
      // A point's y may be missing.
      entity.y.resize(entity.x.size() - 1, 0);
    } else if (groups.code == 20) {
      entity.y.push_back(number);
    } else {
      entity.number[size_t(groups.code)] = number;
    }
  }

  void finish(const std::string& section, Entity& entity, std::string& block) {
    entity.y.resize(entity.x.size(), 0);
    if (section == "BLOCKS" && entity.type == "BLOCK") block = entity.name;
    if (section == "BLOCKS" && entity.type == "ENDBLK") block.clear();
    if (section != "ENTITIES" && (section != "BLOCKS" || block.empty())) return;
    if (how_.layer && !how_.layer->empty() && entity.layer != *how_.layer) return;
    std::vector<Line>& into = section == "BLOCKS" ? blocks_[block] : lines_;
    draw(entity, into);
    too_many_ |= into.size() > kMostLines;
  }

  Vec2 placed(Vec2 p) const { return (p - how_.origin) * how_.scale; }

  void draw(const Entity& e, std::vector<Line>& into) {
    const auto line = [&](Vec2 from, Vec2 to) { into.push_back({from, to}); };
    const auto point = [&](size_t i) { return placed({e.x[i], e.y[i]}); };
    if (e.type == "LINE") {
      if (!e.x.empty()) line(point(0), placed({e.get(11, 0), e.get(21, 0)}));
    } else if (e.type == "LWPOLYLINE") {
      for (size_t i = 0; i + 1 < e.x.size(); ++i) line(point(i), point(i + 1));
      const bool is_closed = std::fmod(e.get(70, 0), 2) == 1;
      if (is_closed && e.x.size() > 1) line(point(e.x.size() - 1), point(0));
    } else if (e.type == "CIRCLE" && !e.x.empty()) {
      ellipse(point(0), {e.get(40, 0) * how_.scale, 0}, 1, 0, 2 * std::numbers::pi, into);
    } else if (e.type == "ARC" && !e.x.empty()) {
      const double start = e.get(50, 0);
      double end = e.get(51, 0);
      if (start > end) end += 360 * std::ceil((start - end) / 360);
      ellipse(point(0), {e.get(40, 0) * how_.scale, 0}, 1, start * std::numbers::pi / 180,
              end * std::numbers::pi / 180, into);
    } else if (e.type == "ELLIPSE" && !e.x.empty()) {
      const double start = e.get(41, 0), turn = 2 * std::numbers::pi;
      double end = e.get(42, turn);
      if (start > end) end += turn * std::ceil((start - end) / turn);
      ellipse(point(0), Vec2{e.get(11, 0), e.get(21, 0)} * how_.scale, e.get(40, 1), start, end,
              into);
    } else if (e.type == "INSERT" && !e.x.empty()) {
      insert(e, into);
    } else if (is_drawn(e.type) && unread_.insert(e.type).second) {
      remark_("DXF entities are left out", "DXF entities of type " + e.type + " are left out");
    }
  }

  /// What is there to be seen, but not read.
  static bool is_drawn(const std::string& type) {
    constexpr const char* kSilent[] = {"LINE",   "LWPOLYLINE", "CIRCLE", "ARC",       "ELLIPSE",
                                       "INSERT", "SECTION",    "ENDSEC", "DIMENSION", "EOF",
                                       "BLOCK",  "ENDBLK",     ""};
    return std::ranges::find(kSilent, type) == std::end(kSilent);
  }

  /// An arc from one angle to another (radians) about `center`, `major` being the way to its end.
  void ellipse(Vec2 center, Vec2 major, double ratio, double start, double end,
               std::vector<Line>& into) {
    const double r = length(major), sweep = end - start;
    if (!(r > 0) || !std::isfinite(sweep)) return;
    const double share = std::min(1.0, sweep / (2 * std::numbers::pi));
    const int n = int(std::ceil(std::min(fragments(r, how_.fragments), kMaxFacets) * share - 1e-9));
    const Vec2 minor = Vec2{-major.y, major.x} * ratio;
    const auto at = [&](int i) {
      const double angle = start + sweep * i / n;
      return center + major * std::cos(angle) + minor * std::sin(angle);
    };
    for (int i = 0; i < n; ++i) into.push_back({at(i), at(i + 1)});
  }

  /// Blocks hold only what stands before them, so that none can hold itself.
  void insert(const Entity& e, std::vector<Line>& into) {
    const auto found = blocks_.find(e.name);
    if (found == blocks_.end() || &found->second == &into) return;
    const double angle = e.get(50, 0) * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle), sx = e.get(41, 1), sy = e.get(42, 1);
    const Vec2 at = placed({e.x[0], e.y[0]});
    if (into.size() + found->second.size() > kMostLines) {
      too_many_ = true;
      return;
    }
    const auto moved = [&](Vec2 p) {
      const Vec2 q = {p.x * sx, p.y * sy};
      return Vec2{c * q.x - s * q.y, s * q.x + c * q.y} + at;
    };
    for (const Line& line : found->second) into.push_back({moved(line.from), moved(line.to)});
  }

  const Import& how_;
  const Remark& remark_;
  std::vector<Line> lines_;
  std::map<std::string, std::vector<Line>> blocks_;
  std::set<std::string> unread_;
  bool too_many_ = false;
};

/// Numbers points, those that are joined the same.
class Ends {
 public:
  uint32_t number_of(Vec2 p) {
    const auto cell = [](double x) { return std::floor(x / (2 * kJoined)); };
    for (const double dx : {-kJoined, kJoined})
      for (const double dy : {-kJoined, kJoined}) {
        const auto found = cells_.find({cell(p.x + dx), cell(p.y + dy)});
        if (found == cells_.end()) continue;
        for (const uint32_t i : found->second)
          if (std::fabs(points[i].x - p.x) <= kJoined && std::fabs(points[i].y - p.y) <= kJoined)
            return i;
      }
    cells_[{cell(p.x), cell(p.y)}].push_back(uint32_t(points.size()));
    points.push_back(p);
    return uint32_t(points.size() - 1);
  }
  std::vector<Vec2> points;

 private:
  std::map<std::pair<double, double>, std::vector<uint32_t>> cells_;
};

/// Lines end to end: first from ends that nothing else meets, then the rings that are left. What
/// stays open is closed by one more line.
std::vector<Contour> joined(const std::vector<Line>& lines) {
  Ends ends;
  struct Joined {
    uint32_t from, to;
    bool used = false;
  };
  std::vector<Joined> all;
  for (const Line& line : lines) {
    if (!is_finite(line.from) || !is_finite(line.to)) continue;
    const uint32_t from = ends.number_of(line.from), to = ends.number_of(line.to);
    if (from != to) all.push_back({from, to});
  }
  std::vector<std::vector<uint32_t>> at(ends.points.size());
  for (uint32_t i = 0; i < all.size(); ++i) {
    at[all[i].from].push_back(i);
    at[all[i].to].push_back(i);
  }
  std::vector<Contour> contours;
  const auto follow = [&](uint32_t point) {
    Contour contour{ends.points[point]};
    while (!at[point].empty()) {
      const uint32_t i = at[point].back();
      at[point].pop_back();
      if (all[i].used) continue;
      all[i].used = true;
      point = all[i].from == point ? all[i].to : all[i].from;
      contour.push_back(ends.points[point]);
    }
    if (contour.size() > 1 && contour.front() == contour.back()) contour.pop_back();
    if (contour.size() >= 3) contours.push_back(std::move(contour));
  };
  for (uint32_t point = 0; point < at.size(); ++point)
    if (at[point].size() == 1) follow(point);
  for (const Joined& line : all)
    if (!line.used) follow(line.from);
  return contours;
}

}  // namespace

Result<Polygons> read_dxf(std::string_view content, const Import& how, const Remark& remark) {
  const Result<std::vector<Line>> lines = DxfReader(how, remark).read(content);
  if (!lines) return lines.error();
  const std::vector<Contour> contours = joined(*lines);
  if (estimate_sweep_work(contours) > kMostSweepWork) return Error{ErrorKind::kInput, kTooTangled};
  return even_odd(contours);
}

}  // namespace whittle
