#include "evaluate/files.h"

#include <fmt/format.h>

#include <utility>

#include "base/printable.h"
#include "evaluate/polyhedra.h"
#include "flat/outlines.h"
#include "mesh/close_mesh.h"
#include "mesh/mesh_files.h"

namespace whittle {
namespace {

constexpr std::string_view kKindUnread = "a file cannot be read; nothing is shown for it";

}  // namespace

const std::string* Files::content(const std::string& file, SourceLocation where) {
  if (file.empty()) {
    constexpr std::string_view kUnnamed = "no file is named; nothing is shown for it";
    warnings_.add_unsupported(kUnnamed, where, kUnnamed, "no file is named");
    return nullptr;
  }
  const auto [found, is_new] = flat_.try_emplace(file);
  if (!is_new) return &found->second;
  const auto refuse = [&, place = found](const std::string& why) {
    warnings_.add_unsupported(kKindUnread, where,
                              fmt::format("{}: {}; nothing is shown for it", printable(file), why),
                              fmt::format("{}: {}", printable(file), why));
    flat_.erase(place);
    return nullptr;
  };
  if (!options_.read_file) return refuse("files are not read here");
  Result<std::optional<std::string>> content = options_.read_file(file);
  if (!content) return refuse(content.error().message);
  if (!*content) {
    warnings_.add_missing_file(where, printable(file));
    flat_.erase(file);
    return nullptr;
  }
  found->second = std::move(**content);
  return &found->second;
}

Polygons Files::flat(const Import& import, SourceLocation where) {
  const std::string* const text = content(import.file, where);
  if (!text) return {};
  const Remark remark = [&](const std::string& kind, const std::string& message) {
    warnings_.add(kind, where, fmt::format("{}: {}", printable(import.file), message));
  };
  const bool is_svg = import.file.ends_with("svg") || import.file.ends_with("SVG");
  if (!budget_.work(text->size() / 8)) return {};
  Result<Polygons> read =
      is_svg ? read_svg(*text, import, remark) : read_dxf(*text, import, remark);
  if (read) return std::move(*read);
  warnings_.add_unsupported(
      kKindUnread, where,
      fmt::format("{}: {}; nothing is shown for it", printable(import.file), read.error().message),
      fmt::format("{}: {}", printable(import.file), read.error().message));
  return {};
}

std::shared_ptr<const TriangleMesh> Files::solid(const Leaf& leaf, SourceLocation where) {
  std::string key;
  if (const auto* const map = std::get_if<HeightMap>(&leaf)) {
    key = fmt::format("{}{}{}", map->center, map->invert, map->file);
  } else {
    key = std::get<Import>(leaf).file;
  }
  const auto found = solids_.find(key);
  if (found != solids_.end()) return found->second;
  std::shared_ptr<const TriangleMesh> solid = read_solid(leaf, where);
  solids_.emplace(std::move(key), solid);
  return solid;
}

std::shared_ptr<const TriangleMesh> Files::read_solid(const Leaf& leaf, SourceLocation where) {
  const auto* const map = std::get_if<HeightMap>(&leaf);
  const std::string& file = map ? map->file : std::get<Import>(leaf).file;
  const std::string* const bytes = content(file, where);
  if (!bytes) return nullptr;
  const size_t most = options_.most_facets;
  const auto refuse = [&](const std::string& why) {
    warnings_.add_unsupported(kKindUnread, where,
                              fmt::format("{}: {}; nothing is shown for it", printable(file), why),
                              fmt::format("{}: {}", printable(file), why));
    return nullptr;
  };
  if (!map && !is_mesh_file(file)) {
    flat_.erase(file);
    return refuse("the format is not known by this name");
  }
  Result<RawMesh> raw = map ? read_height_map(*bytes, *map, most) : read_mesh(*bytes, file, most);
  flat_.erase(file);
  if (!raw) return refuse(raw.error().message);
  if (raw->faces.empty() && raw->triangles.empty()) return refuse("there are no faces in it");
  ClosedMesh closed = close_mesh(*raw, map ? 0 : kPrintedDigits);
  if (closed.open_edges > 0) {
    const Vec3 at = closed.first_open;
    const std::string_view part = closed.mesh.triangles.empty() ? "it" : "the open part of it";
    warnings_.add_unsupported(
        "an imported mesh is not closed", where,
        fmt::format("{}: {} edges are open, the first at [{:.6g}, {:.6g}, {:.6g}]; {} is left out",
                    printable(file), closed.open_edges, at.x, at.y, at.z, part),
        fmt::format("{} is not closed", printable(file)));
  }
  if (closed.mesh.triangles.empty()) return nullptr;
  return std::make_shared<const TriangleMesh>(std::move(closed.mesh));
}

}  // namespace whittle
