#include "summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "json_of.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;

/// Openscad's words; of a cache and of areas whittle has nothing to say.
constexpr std::array<std::string_view, 7> kParts = {"all",      "cache",        "time", "camera",
                                                    "geometry", "bounding-box", "area"};

bool has(const SummaryArguments& summary, std::string_view part) {
  const auto among = [&](std::string_view name) {
    return std::ranges::find(summary.parts, name) != summary.parts.end();
  };
  return summary.parts.empty() || among("all") || among(part);
}

bool is_told(const Box& box) {
  return !box.is_empty() && box.is_finite();
}

/// To the digits that are known: the solid's box is found to a millionth of its longest edge.
Box rounded(const Box& box) {
  const Vec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0)) return box;
  const double steps = std::pow(10, std::ceil(-std::log10(longest * 1e-6)));
  const auto round = [&](double x) {
    const double near = std::round(x * steps) / steps;
    return std::isfinite(near) ? near : x;
  };
  return {{round(box.lo.x), round(box.lo.y), round(box.lo.z)},
          {round(box.hi.x), round(box.hi.y), round(box.hi.z)}};
}

struct Clock {
  int64_t total, milliseconds, seconds, minutes, hours;
  explicit Clock(double time)
      : total(std::llround(time)),
        milliseconds(total % 1000),
        seconds(total / 1000 % 60),
        minutes(total / 60'000 % 60),
        hours(total / 3'600'000) {}
  std::string text() const {
    return fmt::format("{}:{:02}:{:02}.{:03}", hours, minutes, seconds, milliseconds);
  }
};

}  // namespace

void add_summary_options(CLI::App& app, SummaryArguments& summary) {
  OptionGroup group(app, "Output");
  group.add_each("--summary", "PART", "says all, time, camera, geometry or bounding-box",
                 [&](const std::string& part) {
                   if (std::ranges::find(kParts, part) == kParts.end()) {
                     refuse("--summary", fmt::format("unknown part '{}'; there are: {}", part,
                                                     fmt::join(kParts, ", ")));
                   }
                   summary.parts.push_back(part);
                 });
  group.add_text("--summary-file", "FILE", "the same as JSON; '-': standard output",
                 [&](const std::string& path) { summary.file = path; });
}

std::string summary_json(const SummaryFacts& facts, const SummaryArguments& summary) {
  Json json = Json::object();
  if (has(summary, "time")) {
    const Clock clock(facts.milliseconds);
    json["time"] = {{"time", clock.text()},
                    {"total", clock.total},
                    {"milliseconds", clock.milliseconds},
                    {"seconds", clock.seconds},
                    {"minutes", clock.minutes},
                    {"hours", clock.hours}};
  }
  const bool tells_geometry = has(summary, "geometry"), tells_box = has(summary, "bounding-box");
  const GeometryFacts& geometry = facts.geometry;
  if (is_told(geometry.box) && (tells_geometry || tells_box)) {
    json["geometry"]["dimensions"] = geometry.dimensions;
    if (tells_geometry) {
      if (geometry.vertices) json["geometry"]["vertices"] = *geometry.vertices;
      if (geometry.facets) json["geometry"]["facets"] = *geometry.facets;
      if (geometry.contours) json["geometry"]["contours"] = *geometry.contours;
    }
    if (tells_box) {
      const Box box = rounded(geometry.box);
      json["geometry"]["bounding_box"] = {
          {"min", json_of(box.lo)}, {"max", json_of(box.hi)}, {"size", json_of(box.size())}};
    }
  }
  if (has(summary, "camera")) {
    json["camera"] = {{"translation", json_of(facts.view.target)},
                      {"rotation", json_of(facts.view.rotation_degrees)},
                      {"distance", facts.view.distance},
                      {"fov", facts.view.fov_degrees}};
  }
  return json.dump() + "\n";
}

std::string summary_lines(const SummaryFacts& facts, const SummaryArguments& summary) {
  std::vector<std::string> lines;
  const auto vector = [&](std::string_view name, Vec3 v) {
    lines.push_back(fmt::format("   {:<13}{:.2f}, {:.2f}, {:.2f}", name, v.x, v.y, v.z));
  };
  const auto number = [&](std::string_view name, double value) {
    lines.push_back(fmt::format("   {:<13}{:.2f}", name, value));
  };
  if (has(summary, "time")) {
    lines.push_back("Total rendering time: " + Clock(facts.milliseconds).text());
  }
  const GeometryFacts& geometry = facts.geometry;
  if (has(summary, "geometry") && (geometry.facets || geometry.contours)) {
    lines.push_back(fmt::format("Top level object is a {}D object:", geometry.dimensions));
    const auto count = [&](std::string_view name, const std::optional<size_t>& n) {
      if (n) lines.push_back(fmt::format("   {:<10} {:>6}", name, *n));
    };
    count("Vertices:", geometry.vertices);
    count("Facets:", geometry.facets);
    count("Contours:", geometry.contours);
  }
  if (has(summary, "bounding-box") && is_told(geometry.box)) {
    lines.emplace_back("Bounding box:");
    vector("Min:", geometry.box.lo);
    vector("Max:", geometry.box.hi);
    vector("Size:", geometry.box.size());
  }
  if (has(summary, "camera")) {
    lines.emplace_back("Camera:");
    vector("Translation:", facts.view.target);
    vector("Rotation:", facts.view.rotation_degrees);
    number("Distance:", facts.view.distance);
    number("FOV:", facts.view.fov_degrees);
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace whittle
