#include "boundary/write_xml.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/append_number.h"
#include "mesh/write_zip.h"

namespace whittle {
namespace {

using Color = std::array<uint8_t, 4>;

/// Of what has no colour, beside what has one: OpenSCAD's Cornfield.
constexpr Color kPlain = {0xF9, 0xD7, 0x2C, 0xFF};

Color bytes_of(const Rgba& color) {
  if (!color.is_valid()) return kPlain;
  const auto byte = [](float share) {
    return uint8_t(std::lround(std::clamp(share, 0.0f, 1.0f) * 255));
  };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

/// `name="value"` with a space in front.
template <class Number>
void append_attribute(std::string& out, const char* name, Number value) {
  out += ' ';
  out += name;
  out += "=\"";
  append_number(out, value);
  out += '"';
}

template <class Number>
void append_element(std::string& out, const char* name, Number value) {
  (out += "     <") += name;
  out += '>';
  append_number(out, value);
  (out += "</") += name;
  out += ">\n";
}

/// The colours that there are, and which one each face has; none if no face has a colour.
struct Palette {
  std::vector<Color> colors;
  std::vector<size_t> of_face;

  explicit Palette(const SolidMesh& mesh) {
    const auto has_color = [](const SolidMesh::Face& face) { return face.color.is_valid(); };
    if (std::none_of(mesh.faces.begin(), mesh.faces.end(), has_color)) return;
    for (const SolidMesh::Face& face : mesh.faces) colors.push_back(bytes_of(face.color));
    std::sort(colors.begin(), colors.end());
    colors.erase(std::unique(colors.begin(), colors.end()), colors.end());
    for (const SolidMesh::Face& face : mesh.faces) {
      const auto at = std::lower_bound(colors.begin(), colors.end(), bytes_of(face.color));
      of_face.push_back(size_t(at - colors.begin()));
    }
  }
};

void append_materials(std::string& out, const std::vector<Color>& colors) {
  out += "  <basematerials id=\"2\">\n";
  for (const Color& color : colors) {
    std::string name = "#";
    for (const uint8_t byte : color)
      for (const int digit : {byte >> 4, byte & 15}) name += "0123456789ABCDEF"[digit];
    out += "   <base name=\"" + name + "\" displaycolor=\"" + name + "\"/>\n";
  }
  out += "  </basematerials>\n";
}

std::string model_part(const SolidMesh& mesh) {
  const Palette palette(mesh);
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<model unit=\"millimeter\" xml:lang=\"en-US\""
      " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
      " <metadata name=\"Application\">whittle</metadata>\n"
      " <resources>\n";
  if (!palette.colors.empty()) append_materials(out, palette.colors);
  out += "  <object id=\"1\" name=\"OpenSCAD Model\" type=\"model\"";
  // The default for triangles that name none: each of them does.
  if (!palette.colors.empty()) out += " pid=\"2\" pindex=\"0\"";
  out += ">\n   <mesh>\n    <vertices>\n";
  for (const Vec3& corner : mesh.corners) {
    out += "     <vertex";
    append_attribute(out, "x", corner.x);
    append_attribute(out, "y", corner.y);
    append_attribute(out, "z", corner.z);
    out += "/>\n";
  }
  out += "    </vertices>\n    <triangles>\n";
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    out += "     <triangle";
    append_attribute(out, "v1", triangle.corners[0]);
    append_attribute(out, "v2", triangle.corners[1]);
    append_attribute(out, "v3", triangle.corners[2]);
    if (!palette.colors.empty()) {
      out += " pid=\"2\"";
      append_attribute(out, "p1", palette.of_face[triangle.face]);
    }
    out += "/>\n";
  }
  out +=
      "    </triangles>\n   </mesh>\n  </object>\n </resources>\n"
      " <build>\n  <item objectid=\"1\"/>\n </build>\n</model>\n";
  return out;
}

}  // namespace

std::string write_amf(const SolidMesh& mesh) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<amf unit=\"millimeter\">\n"
      " <metadata type=\"producer\">whittle</metadata>\n"
      " <object id=\"0\">\n  <mesh>\n   <vertices>\n";
  for (const Vec3& corner : mesh.corners) {
    out += "    <vertex><coordinates>\n";
    append_element(out, "x", corner.x);
    append_element(out, "y", corner.y);
    append_element(out, "z", corner.z);
    out += "    </coordinates></vertex>\n";
  }
  out += "   </vertices>\n   <volume>\n";
  for (const SolidMesh::Triangle& triangle : mesh.triangles) {
    out += "    <triangle>\n";
    append_element(out, "v1", triangle.corners[0]);
    append_element(out, "v2", triangle.corners[1]);
    append_element(out, "v3", triangle.corners[2]);
    out += "    </triangle>\n";
  }
  out += "   </volume>\n  </mesh>\n </object>\n</amf>\n";
  return out;
}

Result<std::string> write_3mf(const SolidMesh& mesh, const Workers& workers) {
  return write_zip(
      std::vector<ZipMember>{
          {"[Content_Types].xml",
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
           "<Default Extension=\"rels\" "
           "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
           "<Default Extension=\"model\" "
           "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n"},
          {"_rels/.rels",
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<Relationships "
           "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
           "<Relationship Id=\"rel0\" Target=\"/3D/3dmodel.model\" "
           "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
           "</Relationships>\n"},
          {"3D/3dmodel.model", model_part(mesh)}},
      workers);
}

}  // namespace whittle
