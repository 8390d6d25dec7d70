// 3MF (the 3MF Consortium's core specification 1.3, and of its production extension 1.1 the paths
// to objects in other parts of the package).
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/affine.h"
#include "base/xml_scanner.h"
#include "mesh/formats.h"
#include "mesh/text_scanner.h"
#include "mesh/zip_archive.h"

namespace whittle {
namespace {

/// An object of a part of the package.
using ObjectName = std::pair<const ZipArchive::Entry*, uint32_t>;

struct Placed {
  ObjectName object;
  Affine to_parent;
};

/// A mesh, or others in their places.
struct Object {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Placed> components;
};

/// Twelve numbers: the images of x, y, z, and of the origin.
std::optional<Affine> map_of(std::string_view text) {
  TextScanner numbers(text);
  Affine map;
  for (int column = 0; column < 4; ++column)
    for (int i = 0; i < 3; ++i) {
      const auto value = numbers.number<double>();
      if (!value) return std::nullopt;
      (column < 3 ? map.row[i][column] : map.translation[i]) = *value;
    }
  return map;
}

std::string_view without_slash(std::string_view path) {
  return path.starts_with('/') ? path.substr(1) : path;
}

class PackageReader {
 public:
  PackageReader(const ZipArchive& archive, size_t most_triangles)
      : archive_(archive),
        most_triangles_(most_triangles),
        unpacked_left_(most_unpacked(most_triangles)) {}

  Result<RawMesh> run() {
    Result<const ZipArchive::Entry*> root = find_root();
    if (!root) return root.error();
    is_read_[*root] = true;
    parts_.push_back(*root);
    // Parts name others, which come behind them.
    for (size_t i = 0; i < parts_.size(); ++i)
      if (const Status status = read_part(parts_[i]); !status) return status.error();
    if (build_.empty())
      for (const auto& [name, object] : objects_)
        if (object.components.empty()) build_.push_back({name, {}});
    return build();
  }

 private:
  Result<std::string> unpack(const ZipArchive::Entry& entry) {
    Result<std::string> text = archive_.unpack(entry, unpacked_left_);
    if (text) unpacked_left_ -= text->size();
    if (text && (text->starts_with("\xFF\xFE") || text->starts_with("\xFE\xFF")))
      return mesh_error("its XML is not UTF-8");
    return text;
  }

  /// The part that the package says is the model.
  Result<const ZipArchive::Entry*> find_root() {
    std::string target = "3D/3dmodel.model";
    if (const ZipArchive::Entry* const relations = archive_.find("_rels/.rels")) {
      const Result<std::string> text = unpack(*relations);
      if (!text) return text.error();
      XmlScanner scanner(*text);
      XmlScanner::Event event = scanner.next();
      for (; event < XmlScanner::Event::kEnd; event = scanner.next()) {
        if (event != XmlScanner::Event::kOpen || scanner.name() != "Relationship") continue;
        std::string_view type, path;
        for (XmlScanner::Attribute a; scanner.next_attribute(a);) {
          if (a.name == "Type") type = a.value;
          if (a.name == "Target") path = a.value;
        }
        if (type.ends_with("/3dmodel")) target = without_slash(path);
      }
    }
    const ZipArchive::Entry* const root = archive_.find(target);
    if (root == nullptr) return mesh_error("there is no 3D model in it");
    return root;
  }

  Status read_part(const ZipArchive::Entry* part) {
    const Result<std::string> text = unpack(*part);
    if (!text) return text.error();
    XmlScanner scanner(*text);
    Object* object = nullptr;
    using Event = XmlScanner::Event;
    for (Event event = scanner.next(); event != Event::kEnd; event = scanner.next()) {
      if (event == Event::kMistake) return mesh_error("its XML is damaged or was cut off");
      if (event == Event::kClose && scanner.name() == "object") object = nullptr;
      if (event != Event::kOpen) continue;
      const std::string_view name = scanner.name();
      if (name == "object") {
        const std::optional<uint32_t> id = id_of(scanner);
        if (!id) return mesh_error("an object has no number");
        object = &objects_[{part, *id}];
      } else if (name == "item" && part == parts_[0]) {
        if (const Status s = add_placed(scanner, part, build_); !s) return s;
      } else if (object == nullptr) {
        continue;
      } else if (name == "component") {
        if (const Status s = add_placed(scanner, part, object->components); !s) return s;
      } else if (name == "vertex") {
        if (!add_vertex(scanner, *object)) return mesh_error("a vertex is not three numbers");
      } else if (name == "triangle") {
        if (!add_triangle(scanner, *object))
          return mesh_error("a triangle has a corner that is no vertex");
      }
      if (++elements_ > 5 * most_triangles_ + 1000) return too_many_triangles(most_triangles_);
    }
    return Done{};
  }

  static std::optional<uint32_t> id_of(XmlScanner& scanner) {
    for (XmlScanner::Attribute a; scanner.next_attribute(a);)
      if (a.name == "id") return TextScanner::as_number<uint32_t>(a.value);
    return std::nullopt;
  }

  static bool add_vertex(XmlScanner& scanner, Object& object) {
    Vec3 point;
    unsigned seen = 0;
    for (XmlScanner::Attribute a; scanner.next_attribute(a);) {
      if (a.name.size() != 1 || a.name[0] < 'x' || a.name[0] > 'z') continue;
      const auto value = TextScanner::as_number<double>(a.value);
      if (!value) return false;
      point[a.name[0] - 'x'] = *value;
      seen |= 1u << (a.name[0] - 'x');
    }
    object.points.push_back(point);
    return seen == 7;
  }

  /// A corner is looked for among all vertices of the object, which come before its triangles.
  static bool add_triangle(XmlScanner& scanner, Object& object) {
    std::array<uint32_t, 3> corners{};
    unsigned seen = 0;
    for (XmlScanner::Attribute a; scanner.next_attribute(a);) {
      if (a.name.size() != 2 || a.name[0] != 'v' || a.name[1] < '1' || a.name[1] > '3') continue;
      const auto value = TextScanner::as_number<uint32_t>(a.value);
      if (!value || *value >= object.points.size()) return false;
      corners[size_t(a.name[1] - '1')] = *value;
      seen |= 1u << (a.name[1] - '1');
    }
    object.triangles.push_back(corners);
    return seen == 7;
  }

  /// An item or a component: an object, where it is, and in which part.
  Status add_placed(XmlScanner& scanner, const ZipArchive::Entry* part,
                    std::vector<Placed>& placed) {
    std::optional<uint32_t> id;
    Affine map;
    for (XmlScanner::Attribute a; scanner.next_attribute(a);) {
      if (a.name == "objectid") {
        id = TextScanner::as_number<uint32_t>(a.value);
      } else if (a.name == "transform") {
        const std::optional<Affine> given = map_of(a.value);
        if (!given) return mesh_error("a transform is not twelve numbers");
        map = *given;
      } else if (a.name == "path") {
        part = archive_.find(without_slash(a.value));
        if (part == nullptr) return mesh_error("an object is in a part that there is not");
        if (!std::exchange(is_read_[part], true)) parts_.push_back(part);
      }
    }
    if (!id) return mesh_error("an object is placed that has no number");
    placed.push_back({{part, *id}, map});
    return Done{};
  }

  Result<RawMesh> build() {
    RawMesh mesh;
    std::vector<Placed> open(build_.rbegin(), build_.rend());
    // Components may name one another in a circle, or double their number each time.
    size_t placed = open.size();
    while (!open.empty()) {
      const auto [name, map] = open.back();
      open.pop_back();
      const auto found = objects_.find(name);
      if (found == objects_.end()) return mesh_error("an object is placed that there is not");
      const Object& object = found->second;
      placed += object.components.size();
      if (placed > most_triangles_ ||
          mesh.triangles.size() + object.triangles.size() > most_triangles_ ||
          mesh.points.size() + object.points.size() > 3 * most_triangles_)
        return too_many_triangles(most_triangles_);
      for (size_t i = object.components.size(); i-- > 0;) {
        const Placed& part = object.components[i];
        open.push_back({part.object, map * part.to_parent});
      }
      const auto first = uint32_t(mesh.points.size());
      for (const Vec3& p : object.points) mesh.points.push_back(map.point(p));
      const bool mirrors = map.determinant() < 0;
      for (const auto& [a, b, c] : object.triangles)
        mesh.triangles.push_back({first + a, first + (mirrors ? c : b), first + (mirrors ? b : c)});
    }
    return mesh;
  }

  const ZipArchive& archive_;
  size_t most_triangles_;
  uint64_t unpacked_left_;
  size_t elements_ = 0;
  std::vector<const ZipArchive::Entry*> parts_;
  std::map<const ZipArchive::Entry*, bool> is_read_;
  std::map<ObjectName, Object> objects_;
  std::vector<Placed> build_;
};

}  // namespace

Result<RawMesh> read_3mf(std::string_view content, size_t most_triangles) {
  const Result<ZipArchive> archive = ZipArchive::open(content);
  if (!archive) return archive.error();
  return PackageReader(*archive, most_triangles).run();
}

}  // namespace whittle
