// whittle info FILE: what is in a file.
#include <fmt/format.h>

#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/printable.h"
#include "command_line.h"
#include "commands.h"
#include "console.h"
#include "json_of.h"
#include "lower/lower.h"
#include "mass.h"
#include "model/instances.h"
#include "option_group.h"
#include "subdivide/solid_bounds.h"

namespace whittle {
namespace {

constexpr CommandHelp kHelp = {
    "whittle info", "Says what is in a model: counts, bounds, warnings.", "FILE [options]",
    "Examples:\n"
    "  whittle info part.csg\n"
    "  whittle info part.csg --json | jq .half_spaces\n"
    "  whittle info part.csg --density 1.24\n\n"
    "Exit codes: 0 done, 1 bad input, 2 bad usage, 3 refused by the machine."};

constexpr std::array<std::string_view, 7> kNodeNames = {
    "union", "difference", "intersection", "transform", "color", "primitive", "body"};

struct Info {
  std::array<size_t, kNodeNames.size()> nodes{};
  std::array<size_t, kShapeNames.size()> shapes{};
  size_t curved = 0;    ///< spheres and cylinders that are true curves
  size_t in_solid = 0;  ///< primitives that are not background
  size_t empty = 0;     ///< of those
  size_t faces = 0, half_spaces = 0;
  Bounds bounds;
  SolidBounds solid;
  double tolerance = 0;
  std::optional<Measures> measures;
};

Result<Info> gather(const Model& model) {
  Info info;
  for (const Node& node : model.nodes) ++info.nodes[size_t(node.kind)];
  for (const Primitive& primitive : model.primitives) {
    ++info.shapes[primitive.shape.index()];
    info.curved += !is_flat(primitive.shape);
  }
  for (const Instance& instance : instances(model)) {
    ++info.in_solid;
    info.empty += instance.empty;
  }
  const Result<Scene> scene = lower(model);
  if (!scene) return scene.error();
  info.faces = scene->faces.size();
  info.half_spaces = scene->half_spaces.size();
  info.bounds = bounds(model);
  info.tolerance = tolerance(info.bounds);
  info.bounds.box = seen_box(model, info.bounds.box);
  if (info.bounds.bounded && !info.bounds.box.is_empty()) {
    info.solid = solid_bounds(*scene, 0);
    info.solid.box = seen_box(model, info.solid.box);
  }
  return info;
}

nlohmann::ordered_json to_json(const Box& box) {
  if (box.is_empty()) return nullptr;
  return {{"lo", json_of(box.lo)}, {"hi", json_of(box.hi)}};
}

std::string describe_json(const Read& read, const Info& info, const MassArguments& mass) {
  nlohmann::ordered_json json;
  json["file"] = read.model.file;
  json["statements"] = read.model.statement_count;
  json["nodes"] = nlohmann::ordered_json::object();
  for (const WordCount& word : read.counts.words) json["nodes"][word.word] = word.count;
  json["background_nodes"] = read.counts.background;
  json["highlight_nodes"] = read.counts.highlight;
  json["root_nodes"] = read.counts.root;
  json["disabled_nodes"] = read.counts.disabled;
  json["drawing"] = read.model.drawing.has_value();
  for (size_t i = 0; i < kNodeNames.size(); ++i) {
    json["model_nodes"][kNodeNames[i]] = info.nodes[i];
  }
  for (size_t i = 0; i < kShapeNames.size(); ++i) {
    json["primitives"][kShapeNames[i]] = info.shapes[i];
  }
  json["curved_primitives"] = info.curved;
  json["empty_primitives"] = info.empty;
  json["faces"] = info.faces;
  json["half_spaces"] = info.half_spaces;
  json["merged_faces"] = info.faces - info.half_spaces;
  json["bounded"] = info.bounds.bounded;
  json["bounds"] = to_json(info.bounds.box);
  json["solid_box"] = to_json(info.solid.box);
  json["tolerance"] = info.tolerance;
  if (info.measures) json["mass"] = mass_json(*info.measures, mass);
  json["supported"] = !read.unsupported;
  json["warnings"] = read.warnings;
  // A file name may be any bytes; JSON may not.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Names with their numbers, but for zeros.
class CountList {
 public:
  void add(std::string_view name, size_t number) {
    if (number == 0) return;
    fmt::format_to(std::back_inserter(text_), "{}{} {}", text_.empty() ? "" : ", ", name, number);
  }
  std::string text() const { return text_.empty() ? "none" : text_; }

 private:
  std::string text_;
};

template <size_t count>
std::string list(const std::array<std::string_view, count>& names,
                 const std::array<size_t, count>& numbers) {
  CountList counts;
  for (size_t i = 0; i < count; ++i) counts.add(names[i], numbers[i]);
  return counts.text();
}

std::string list(const std::vector<WordCount>& words) {
  CountList counts;
  for (const WordCount& word : words) counts.add(word.word, word.count);
  return counts.text();
}

std::string list_marks(const StatementCounts& counts) {
  CountList marks;
  marks.add("background (%)", counts.background);
  marks.add("highlighted (#)", counts.highlight);
  marks.add("root (!)", counts.root);
  marks.add("disabled (*)", counts.disabled);
  return marks.text();
}

std::string describe(const Box& box) {
  if (box.is_empty()) return "empty";
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}]", box.lo.x, box.lo.y,
                     box.lo.z, box.hi.x, box.hi.y, box.hi.z);
}

/// What the boxes of the parts allow.
std::string describe_bounds(const Bounds& bounds) {
  const bool is_open = !bounds.bounded && !bounds.box.is_empty();
  return describe(bounds.box) + (is_open ? ", and unbounded beyond" : "");
}

/// What is left after all subtractions.
std::string describe_solid(const Info& info) {
  if (!info.bounds.bounded) return "without end";
  return describe(info.solid.box) + (info.solid.exact ? "" : ", or less");
}

std::string describe_text(const Read& read, const Info& info, const MassArguments& mass) {
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "{:<12} {}\n", name, printable(value));
  };
  add("file", read.model.file);
  add("statements", fmt::format("{}", read.model.statement_count));
  add("nodes", list(read.counts.words));
  const StatementCounts& counts = read.counts;
  if (counts.background + counts.highlight + counts.root + counts.disabled > 0) {
    add("marked", list_marks(counts));
  }
  add("evaluated",
      fmt::format("{}{}", list(kNodeNames, info.nodes), read.model.drawing ? "; a drawing" : ""));
  add("primitives", fmt::format("{}; {} curved", list(kShapeNames, info.shapes), info.curved));
  add("in the solid", fmt::format("{} primitives, {} of them empty", info.in_solid, info.empty));
  add("half-spaces", fmt::format("{} for {} faces, {} merged", info.half_spaces, info.faces,
                                 info.faces - info.half_spaces));
  add("bounds", describe_bounds(info.bounds));
  add("solid's box", describe_solid(info));
  add("tolerance", fmt::format("{:.3g}", info.tolerance));
  if (info.measures) text += describe_mass(*info.measures, mass);
  add("warnings", fmt::format("{}{}", read.warnings.size(),
                              read.unsupported ? ", and not everything is supported" : ""));
  return text;
}

}  // namespace

int info_command(Arguments arguments) {
  CommandLine line(kHelp);
  std::string file;
  bool wants_json = false;
  Loading loading;
  line.add_required("FILE", file);
  OptionGroup(line.app(), "Output")
      .add_flag("--json", wants_json, "one JSON object, warnings in it");
  MassArguments mass;
  add_mass_options(line.app(), mass, loading);
  add_loading_options(line, loading);
  if (const std::optional<int> code = line.parse(arguments)) return *code;

  if (wants_json) loading.quiet = true;
  const Result<Read> read = load(file, loading);
  if (!read) return report(read.error());
  Result<Info> info = gather(read->model);
  if (!info) return report(info.error());
  if (mass.is_wanted) {
    Result<Measures> measures = measure_solid(read->model, mass, loading.quiet);
    if (!measures) return report(measures.error());
    info->measures = *std::move(measures);
  }
  return print(wants_json ? describe_json(*read, *info, mass) : describe_text(*read, *info, mass));
}

}  // namespace whittle
