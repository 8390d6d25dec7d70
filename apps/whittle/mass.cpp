#include "mass.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "json_of.h"
#include "progress.h"

namespace whittle {
namespace {

using Json = nlohmann::ordered_json;

/// Grams of a cubic millimetre.
double grams(const MassArguments& arguments) {
  return arguments.density.value_or(1000) / 1000;
}

/// A number to the digits that are sure, and one more.
std::string digits(double value, double bound) {
  constexpr int kMost = 15;
  const double size = std::max(std::fabs(value), bound);
  if (!(bound < size) || !(size > 0)) return fmt::format("{:.3g}", value);
  // The quotient may be infinite.
  const double sure = bound > 0 ? std::ceil(std::log10(size / bound)) + 1 : kMost;
  return fmt::format("{:.{}g}", value, int(std::clamp(sure, 1.0, double(kMost))));
}

std::string digits(const Bounded& number, double times = 1) {
  return fmt::format("{} ± {:.1e}", digits(number.value * times, number.bound * times),
                     number.bound * times);
}

std::string digits(Vec3 v, double bound) {
  // What is less than it may be off is 0 as far as anybody knows.
  const auto one = [&](double x) { return std::fabs(x) <= bound ? "0" : digits(x, bound); };
  return fmt::format("{}, {}, {}", one(v.x), one(v.y), one(v.z));
}

bool has_center(const Mass& mass) {
  return std::isfinite(mass.centroid_bound);
}

void describe(const Mass& mass, const MassArguments& arguments, std::string& text) {
  const auto add = [&](const char* name, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "{:<12} {}\n", name, value);
  };
  const double density = grams(arguments);
  const char* within = mass.is_within ? "" : "; no better in as many parts as are allowed";
  add("volume", digits(mass.volume) + within);
  add("surface", digits(mass.area));
  if (arguments.density) add("mass", fmt::format("{} g", digits(mass.volume, density)));
  if (!has_center(mass)) return;
  add("centroid", fmt::format("[{}] ± {:.1e}", digits(mass.centroid, mass.centroid_bound),
                              mass.centroid_bound));
  const double bound = mass.inertia_bound * density;
  add("inertia", fmt::format("[{}] ± {:.1e}{}", digits(mass.moments * density, bound), bound,
                             arguments.density ? " g mm2" : ""));
  add("products", fmt::format("[{}] yz, xz, xy", digits(mass.products * density, bound)));
}

Json to_json(const Mass& mass, const MassArguments& arguments) {
  const double density = grams(arguments);
  Json json;
  json["volume"] = mass.volume.value;
  json["volume_bound"] = mass.volume.bound;
  json["within"] = mass.is_within;
  json["area"] = mass.area.value;
  json["area_bound"] = mass.area.bound;
  if (arguments.density) {
    json["mass"] = mass.volume.value * density;
    json["mass_bound"] = mass.volume.bound * density;
  }
  if (!has_center(mass)) return json;
  json["centroid"] = json_of(mass.centroid);
  json["centroid_bound"] = mass.centroid_bound;
  const Vec3 m = mass.moments * density, p = mass.products * density;
  json["inertia"] = {{m.x, p.z, p.y}, {p.z, m.y, p.x}, {p.y, p.x, m.z}};
  json["inertia_bound"] = mass.inertia_bound * density;
  return json;
}

std::string describe(const std::optional<Rgba>& color) {
  if (!color) return "none";
  const auto level = [](float x) { return int(std::lround(std::clamp(x, 0.0f, 1.0f) * 255)); };
  std::string text =
      fmt::format("#{:02x}{:02x}{:02x}", level(color->r), level(color->g), level(color->b));
  if (color->a < 1) text += fmt::format("{:02x}", level(color->a));
  return text;
}

}  // namespace

void add_mass_options(CLI::App& app, MassArguments& mass, Loading& loading) {
  constexpr double kLeastWithin = 1e-12, kMostDensity = 1e6;
  OptionGroup group(app, "Mass"), machine(app, "Machine");
  group.add_flag("--mass", mass.is_wanted, "volume, surface, centroid and inertia, by colour too");
  group.add_text("--density", "D", "in g/cm3, a unit of length being a millimetre; adds the mass",
                 [&](const std::string& text) {
                   const double density = parse_number("--density", text);
                   if (!(density > 0 && density <= kMostDensity))
                     refuse("--density", fmt::format("wants a number above 0, not {}", text));
                   mass.density = density;
                   mass.is_wanted = true;
                 });
  group.add_number("--within", "X", mass.within, kLeastWithin, 1,
                   "how well to know the volume of true curves, a share of it (1e-6)");
  machine.add_count("--threads", "N", mass.threads, 0, kMostThreads, "0: all there are");
  loading.threads = &mass.threads;
}

Result<Measures> measure_solid(const Model& model, const MassArguments& arguments, bool quiet) {
  ProgressLine progress(!quiet, "measuring");
  MeasureSettings settings;
  settings.within = arguments.within;
  settings.threads = arguments.threads;
  settings.progress = progress.share();
  Result<Measures> measures = measure(model, settings);
  if (!measures && measures.error().kind == ErrorKind::kInput)
    return Error{ErrorKind::kInput, model.file + ": error: " + measures.error().message};
  return measures;
}

std::string describe_mass(const Measures& measures, const MassArguments& arguments) {
  std::string text;
  describe(measures.whole, arguments, text);
  for (const ColorMass& part : measures.colors) {
    fmt::format_to(std::back_inserter(text), "{:<12} {}\n", "color", describe(part.color));
    describe(part.mass, arguments, text);
  }
  if (measures.color_count > kMostColors) text += "colors       more than can be measured apart\n";
  return text;
}

Json mass_json(const Measures& measures, const MassArguments& arguments) {
  Json json = to_json(measures.whole, arguments);
  json["facetted"] = measures.whole.is_facetted;
  if (arguments.density) json["density"] = *arguments.density;
  json["colors"] = Json::array();
  for (const ColorMass& part : measures.colors) {
    Json its;
    its["color"] = part.color ? Json{part.color->r, part.color->g, part.color->b, part.color->a}
                              : Json(nullptr);
    its.update(to_json(part.mass, arguments));
    json["colors"].push_back(its);
  }
  return json;
}

}  // namespace whittle
