// whittle measure FILE --at X,Y --at X,Y: distances, angles, diameters and thicknesses.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "commands.h"
#include "console.h"
#include "inquiry.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle measure",
    "Measures a model where one points at it: distance and angle between two places,\n"
    "thickness of the material behind each, diameter of a round wall.",
    "FILE --at X,Y [--at X,Y] [options]",
    "X,Y are pixels of the picture that whittle FILE makes with the same view and\n"
    "style.\n\n"
    "Examples:\n"
    "  whittle measure part.csg --at 200,256 --at 300,256\n"
    "  whittle measure part.csg --at 256,256 --json | jq .places[0].thickness\n\n"
    "Exit codes: 0 done, 1 bad input, nothing seen at a place, or something in FILE is\n"
    "not shown (--lenient: 0), 2 bad usage, 3 refused by the machine."};

struct Place {
  Position at;
  Picked picked;
  std::optional<double> diameter, thickness;
};

Result<Place> look(Inquiry& inquiry, const Position& at) {
  const Result<std::optional<Picked>> picked = inquiry.pick(at);
  if (!picked) return picked.error();
  if (!*picked) {
    return Error{ErrorKind::kInput,
                 fmt::format("{}: nothing is seen at {},{}", inquiry.model().file, text_of(at.x),
                             text_of(at.y))};
  }
  Place place{at, **picked, inquiry.diameter_at(**picked), {}};
  const Result<std::optional<double>> thickness = inquiry.thickness_at(**picked);
  if (!thickness) return thickness.error();
  place.thickness = *thickness;
  place.picked.hit.id = inquiry.statement_of(place.picked.hit.id);
  return place;
}

/// Between the normals, degrees; exact where they are nearly parallel, too.
double angle_between(Vec3 a, Vec3 b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

std::string describe_text(const std::vector<Place>& places) {
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "{:<10} {}\n", name, value);
  };
  for (const Place& place : places) {
    add("place", fmt::format("{},{}", text_of(place.at.x), text_of(place.at.y)));
    add("point", text_of(place.picked.point));
    add("normal", text_of(place.picked.hit.normal));
    if (place.diameter) add("diameter", text_of(*place.diameter));
    if (place.thickness) add("thickness", text_of(*place.thickness));
    text += '\n';
  }
  if (places.size() == 2) {
    const Vec3 way = places[1].picked.point - places[0].picked.point;
    add("distance", text_of(length(way)));
    add("along", text_of(way));
    add("angle", text_of(angle_between(places[0].picked.hit.normal, places[1].picked.hit.normal)));
  } else {
    text.pop_back();
  }
  return text;
}

std::string describe_json(const std::vector<Place>& places) {
  using Json = nlohmann::ordered_json;
  const auto number_or_null = [](const std::optional<double>& number) {
    return number ? Json(*number) : Json();
  };
  Json json;
  for (const Place& place : places) {
    json["places"].push_back({{"at", {place.at.x, place.at.y}},
                              {"id", place.picked.hit.id},
                              {"point", json_of(place.picked.point)},
                              {"normal", json_of(place.picked.hit.normal)},
                              {"diameter", number_or_null(place.diameter)},
                              {"thickness", number_or_null(place.thickness)}});
  }
  if (places.size() == 2) {
    const Vec3 way = places[1].picked.point - places[0].picked.point;
    json["distance"] = length(way);
    json["along"] = json_of(way);
    json["angle"] = angle_between(places[0].picked.hit.normal, places[1].picked.hit.normal);
  }
  return json.dump() + "\n";
}

}  // namespace

int measure_command(Arguments arguments) {
  CommandLine line(kHelp);
  InquiryArguments a;
  std::vector<Position> positions;
  line.add_required("FILE", a.file);
  OptionGroup(line.app(), "What is measured")
      .add_each("--at", "X,Y", "a place in the picture, pixels; once or twice",
                [&](const std::string& text) { positions.push_back(parse_position(text)); });
  add_picture_options(line, a);
  add_inquiry_options(line, a);
  if (const std::optional<int> code = line.parse(arguments)) return *code;
  if (positions.empty() || positions.size() > 2) {
    return report(
        {ErrorKind::kUsage,
         fmt::format("measure needs one place or two (--at X,Y), not {}", positions.size())});
  }
  if (Status inside = check_positions(positions, a.view); !inside) return report(inside.error());
  settle_picture(a);

  const Result<std::unique_ptr<Inquiry>> opened = Inquiry::open(a);
  if (!opened) return report(opened.error());
  Inquiry& inquiry = **opened;
  std::vector<Place> places;
  for (const Position& at : positions) {
    const Result<Place> place = look(inquiry, at);
    if (!place) return report(place.error());
    places.push_back(*place);
  }
  const int printed = print(a.wants_json ? describe_json(places) : describe_text(places));
  return printed != kExitDone ? printed : inquiry.code();
}

}  // namespace whittle
