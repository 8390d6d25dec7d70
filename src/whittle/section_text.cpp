#include "whittle/section_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>

#include "base/printable.h"

namespace whittle {
namespace {

/// From the model to the eye of the default camera (OpenSCAD's: turned by 55, 0, 25 degrees).
constexpr Vec3 kToEye{0.346, -0.742, 0.574};

/// A text that is read from the left. Spaces do not count.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) { skip(); }

  bool is_at_end() const { return rest_.empty(); }
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    skip();
    return true;
  }
  /// One of these, if it comes next.
  std::optional<char> take_any(std::string_view choices) {
    if (rest_.empty() || choices.find(rest_.front()) == std::string_view::npos) return std::nullopt;
    const char c = rest_.front();
    take(c);
    return c;
  }
  /// A finite number.
  std::optional<double> number() {
    if (rest_.starts_with('+') && !rest_.starts_with("+-")) rest_.remove_prefix(1);
    double value = 0;
    const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (code != std::errc() || !std::isfinite(value)) return std::nullopt;
    rest_.remove_prefix(size_t(end - rest_.data()));
    skip();
    return value;
  }

 private:
  void skip() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
      rest_.remove_prefix(1);
  }
  std::string_view rest_;
};

Error section_error(std::string_view text, const std::string& why) {
  constexpr size_t kShown = 80;
  const std::string shown = printable(std::string(text.substr(0, kShown)));
  return {ErrorKind::kUsage,
          fmt::format("'{}{}': {}", shown, text.size() > kShown ? "..." : "", why)};
}

/// What lies beyond n.p = d on one side.
Result<Plane> plane_of(Vec3 n, double d, char side, std::string_view text) {
  const Result<Plane> plane = cutting_plane(n, d);
  if (!plane) return section_error(text, plane.error().message);
  const bool takes_lesser = side == '<' || (side == '=' && dot(plane->n, kToEye) < 0);
  return takes_lesser ? Plane{-plane->n, -plane->d} : *plane;
}

Result<Plane> parse_term(Reader& reader, std::string_view text) {
  const auto misread = [&](const char* what) {
    return section_error(text,
                         std::string(what) + "; it is like x=0, z>3.5, n=[1,1,0],d=3 or x>0,y<0");
  };
  const std::optional<char> name = reader.take_any("xyzn");
  if (!name) return misread("a plane begins with x, y, z or n");
  Vec3 n{*name == 'x' ? 1.0 : 0.0, *name == 'y' ? 1.0 : 0.0, *name == 'z' ? 1.0 : 0.0};
  if (*name == 'n') {
    if (!reader.take('=') || !reader.take('[')) return misread("after n comes =[x,y,z]");
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<double> value = reader.number();
      if (!value) return misread("n has three finite numbers");
      n[axis] = *value;
      if (!reader.take(axis < 2 ? ',' : ']')) return misread("n has three numbers");
    }
    if (!reader.take(',') || !reader.take('d')) return misread("after n comes ,d=");
  }
  const std::optional<char> side = reader.take_any("=<>");
  if (!side) return misread("before the number comes =, < or >");
  const std::optional<double> d = reader.number();
  if (!d) return misread("where the plane is must be a finite number");
  return plane_of(n, *d, *side, text);
}

}  // namespace

Result<Section> parse_section(std::string_view text) {
  Section section;
  Reader reader(text);
  do {
    if (section.planes.size() == kMostSectionPlanes)
      return section_error(text, fmt::format("has more than {} planes", kMostSectionPlanes));
    Result<Plane> plane = parse_term(reader, text);
    if (!plane) return plane.error();
    section.planes.push_back(*plane);
  } while (reader.take(','));
  if (!reader.is_at_end()) return section_error(text, "there is more than a number after the sign");
  return section;
}

}  // namespace whittle
