#include <cmath>

#include "base/xml_scanner.h"
#include "mesh/formats.h"
#include "mesh/text_scanner.h"
#include "mesh/zip_archive.h"

namespace whittle {
namespace {

/// Which of three numbers an element is: `x y z`, `v1 v2 v3`; 3: none.
size_t place_of(std::string_view name, const std::string_view (&names)[3]) {
  size_t i = 0;
  while (i < 3 && name != names[i]) ++i;
  return i;
}

constexpr std::string_view kAxes[3] = {"x", "y", "z"}, kCorners[3] = {"v1", "v2", "v3"};

class AmfReader {
 public:
  AmfReader(std::string_view text, size_t most_triangles)
      : scanner_(text), most_triangles_(most_triangles) {}

  Result<RawMesh> run() {
    using Event = XmlScanner::Event;
    bool is_amf = false;
    for (Event event = scanner_.next(); event != Event::kEnd; event = scanner_.next()) {
      if (event == Event::kMistake)
        return mesh_error(is_amf ? "its XML is damaged or was cut off" : "this is no AMF file");
      if (event == Event::kOpen) {
        if (!is_amf && scanner_.name() != "amf") return mesh_error("this is no AMF file");
        is_amf = true;
        open(scanner_.name());
      } else if (event == Event::kText) {
        if (!number(scanner_.text())) return mistake();
      } else if (!close(scanner_.name())) {
        return mistake();
      }
      if (mesh_.points.size() > 3 * most_triangles_ || mesh_.triangles.size() > most_triangles_)
        return too_many_triangles(most_triangles_);
    }
    if (!is_amf) return mesh_error("this is no AMF file");
    return std::move(mesh_);
  }

 private:
  enum class In { kNothing, kCoordinates, kTriangle };

  void open(std::string_view name) {
    element_ = name;
    if (name == "mesh") {
      first_ = mesh_.points.size();
    } else if (name == "coordinates" || name == "triangle") {
      in_ = name == "triangle" ? In::kTriangle : In::kCoordinates;
      seen_ = 0;
    }
  }

  bool number(std::string_view text) {
    if (in_ == In::kNothing) return true;
    const size_t place = place_of(element_, in_ == In::kTriangle ? kCorners : kAxes);
    if (place == 3) return true;
    seen_ |= 1u << place;
    if (in_ == In::kCoordinates) {
      const auto value = TextScanner::as_number<double>(text);
      point_[int(place)] = value.value_or(0);
      return value.has_value();
    }
    const auto value = TextScanner::as_number<uint32_t>(text);
    corners_[place] = value.value_or(0);
    return value.has_value();
  }

  bool close(std::string_view name) {
    element_ = {};
    constexpr unsigned kAll = 7;
    if (in_ == In::kCoordinates && name == "coordinates") {
      in_ = In::kNothing;
      mesh_.points.push_back(point_);
      return seen_ == kAll;
    }
    if (in_ == In::kTriangle && name == "triangle") {
      const size_t count = mesh_.points.size() - first_;
      for (uint32_t& corner : corners_) {
        if (corner >= count) return false;
        corner += uint32_t(first_);
      }
      mesh_.triangles.push_back(corners_);
      if (seen_ != kAll) return false;
      in_ = In::kNothing;
    }
    return true;
  }

  Error mistake() const {
    return mesh_error(in_ == In::kTriangle ? "a triangle has a corner that is no vertex"
                                           : "a vertex is not three numbers");
  }

  XmlScanner scanner_;
  size_t most_triangles_;
  RawMesh mesh_;
  size_t first_ = 0;      ///< of the points of the mesh that is being read; its numbers begin there
  In in_ = In::kNothing;  ///< what is being read, or was when there was a mistake
  std::string_view element_;  ///< the innermost, if nothing was closed since
  unsigned seen_ = 0;         ///< which of the three numbers
  Vec3 point_;
  std::array<uint32_t, 3> corners_{};
};

}  // namespace

Result<RawMesh> read_amf(std::string_view content, size_t most_triangles) {
  if (!is_zip_archive(content)) return AmfReader(content, most_triangles).run();
  const Result<ZipArchive> archive = ZipArchive::open(content);
  if (!archive) return archive.error();
  if (archive->entries().empty()) return mesh_error("its zip archive is empty");
  // There is only one, or the others are pictures and the like.
  const ZipArchive::Entry* chosen = &archive->entries().front();
  for (const ZipArchive::Entry& entry : archive->entries())
    if (entry.name.ends_with(".amf") || entry.name.ends_with(".AMF")) {
      chosen = &entry;
      break;
    }
  const Result<std::string> text = archive->unpack(*chosen, most_unpacked(most_triangles));
  if (!text) return text.error();
  return AmfReader(*text, most_triangles).run();
}

}  // namespace whittle
