#include "generate/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "generate/models.h"

namespace whittle {
namespace {

struct Entry {
  Generator shown;
  void (*make)(CsgText& out, int n, Chance chance);
  bool random = false;  ///< the seed matters
};

constexpr Entry kEntries[] = {
    {{"cheese", "a cylinder minus N spheres (the paper's CHEESE)", 1000, 1, 1000000, "spheres"},
     generate_cheese,
     true},
    {{"cyl", "a cylinder minus N cylinders (CYL)", 100, 1, 1000000, "drilled holes"},
     generate_cyl,
     true},
    {{"cone", "a cylinder minus N cones (CONE)", 100, 1, 1000000, "cones"}, generate_cone, true},
    {{"tube", "a tube of rods with N holes in all (TUBE)", 300, 1, 1000000, "holes"},
     generate_tube},
    {{"widget", "a sphere minus three cylinders (WIDGET)", 0, 0, 0, ""}, generate_widget},
    {{"r9", "a rod end made of nine primitives (R9)", 0, 0, 0, ""}, generate_r9},
    {{"plate", "a plate with N x N holes", 30, 1, 1000, "holes a side"}, generate_plate},
    {{"menger", "a Menger sponge of level N", 3, 0, 6, "levels"}, generate_menger},
    {{"random", "a random tree of N primitives of every kind", 50, 1, 1000000, "primitives"},
     generate_random,
     true},
    {{"lattice", "a lattice of N x N x N cells of struts and balls", 4, 1, 60, "cells a side"},
     generate_lattice},
};

constexpr auto kShown = [] {
  std::array<Generator, std::size(kEntries)> shown{};
  for (size_t i = 0; i < shown.size(); ++i) shown[i] = kEntries[i].shown;
  return shown;
}();

/// The summary with its N, a word of its own each time, replaced by the number.
std::string summary_of(const Generator& g, int n) {
  std::string text = std::string(" ") + g.summary + " ";
  for (size_t at; (at = text.find(" N ")) != std::string::npos;) {
    text.replace(at + 1, 1, std::to_string(n));
  }
  return text.substr(1, text.size() - 2);
}

}  // namespace

std::span<const Generator> generators() {
  return kShown;
}

Result<std::string> generate_model(std::string_view name, std::optional<int> n, uint64_t seed) {
  const auto* entry = std::ranges::find_if(
      kEntries, [&](const Entry& candidate) { return candidate.shown.name == name; });
  if (entry == std::end(kEntries)) {
    std::string names;
    for (const Generator& g : kShown) names.append(names.empty() ? "" : ", ").append(g.name);
    return Error{ErrorKind::kUsage,
                 fmt::format("there is no model '{}'; there are: {}", name, names)};
  }
  const Generator& g = entry->shown;
  const bool sized = g.max_n != 0;
  if (!sized && n) {
    return Error{ErrorKind::kUsage, fmt::format("model '{}' has one size; leave N out", name)};
  }
  const int size = n.value_or(g.default_n);
  if (size < g.min_n || size > g.max_n) {
    return Error{ErrorKind::kUsage,
                 fmt::format("model '{}': N is the number of {}, {} to {}, not {}", name,
                             g.n_meaning, g.min_n, g.max_n, size)};
  }

  CsgText out;
  const std::string sized_name = sized ? fmt::format("{} {}", name, size) : std::string(name);
  const std::string seed_option = entry->random ? fmt::format(" --seed {}", seed) : std::string();
  out.comment(fmt::format("{}: {}", g.name, summary_of(g, size)));
  out.comment(fmt::format("Made by: whittle model {}{}", sized_name, seed_option));
  entry->make(out, size, Chance(seed));
  return std::move(out).take();
}

}  // namespace whittle
