// Files that are XML, or archives of it.
#include <gtest/gtest.h>

#include "base/box.h"
#include "base/xml_scanner.h"
#include "mesh/close_mesh.h"
#include "mesh/mesh_files.h"
#include "mesh/zip_archive.h"
#include "mesh/zip_for_test.h"

namespace whittle {
namespace {

constexpr size_t kMany = 1000;

std::string error(std::string_view content, std::string_view name, size_t most = kMany) {
  const Result<RawMesh> mesh = read_mesh(content, name, most);
  return mesh ? "none" : mesh.error().message;
}

/// The volume and the box of what a file says.
struct Measure {
  double volume = 0;
  Box box;
};

Measure measure(std::string_view content, std::string_view name) {
  const Result<RawMesh> raw = read_mesh(content, name, kMany);
  EXPECT_TRUE(raw) << raw.error().message;
  Measure measure;
  if (!raw) return measure;
  const TriangleMesh mesh = close_mesh(*raw, 6).mesh;
  measure.volume = volume(mesh);
  for (const Vec3& p : mesh.points) measure.box.include(p);
  return measure;
}

// XML.

/// All events of a text, in a few letters.
std::string events(std::string_view text) {
  XmlScanner scanner(text);
  std::string all;
  for (;;) {
    const XmlScanner::Event event = scanner.next();
    if (event == XmlScanner::Event::kEnd) return all;
    if (event == XmlScanner::Event::kMistake) return all + "!";
    if (event == XmlScanner::Event::kText) {
      all += "'" + std::string(scanner.text()) + "' ";
      continue;
    }
    all += event == XmlScanner::Event::kOpen ? "" : "/";
    all += scanner.name();
    if (event == XmlScanner::Event::kOpen)
      for (XmlScanner::Attribute a; scanner.next_attribute(a);)
        all += " " + std::string(a.name) + "=" + std::string(a.value);
    all += " ";
  }
}

TEST(XmlScanner, TagsTextsAndAttributes) {
  EXPECT_EQ(events("<a><b>12</b> <c/>\n</a>"), "a b '12' /b c /c /a ");
  EXPECT_EQ(events("<a x = '1>2' q:y=\"3\"\n/>"), "a x=1>2 y=3 /a ");
  EXPECT_EQ(events("<n:a xmlns:n='u'></n:a >"), "a n=u /a ");
  EXPECT_EQ(events("\xEF\xBB\xBF<?xml version='1.0'?><!DOCTYPE a [<!ENTITY b '>'>]><a/>"), "a /a ");
  EXPECT_EQ(events("<!DOCTYPE a>\n<a><!-- <b> -- --><![CDATA[ <x> ]]></a>"), "a ' <x> ' /a ");
  EXPECT_EQ(events(""), "");
}

TEST(XmlScanner, Mistakes) {
  for (const char* text : {"<", "<a", "<a>", "<a x", "<a x=", "<a x=1/>", "<a x='1/>", "</a>",
                           "<a/ >", "<a>< /a>", "<!-- ", "<? ", "<![CDATA[", "<!x", "<a></a x>"})
    EXPECT_EQ(events(text).back(), '!') << text;
  // After a mistake there is nothing more.
  XmlScanner scanner("</a><b/>");
  EXPECT_EQ(scanner.next(), XmlScanner::Event::kMistake);
  EXPECT_EQ(scanner.next(), XmlScanner::Event::kMistake);
}

// Archives.

std::string unpacked(const std::string& zip, std::string_view name, uint64_t most = 1 << 20) {
  const Result<ZipArchive> archive = ZipArchive::open(zip);
  if (!archive) return archive.error().message;
  const ZipArchive::Entry* const entry = archive->find(name);
  if (entry == nullptr) return "not there";
  const Result<std::string> bytes = archive->unpack(*entry, most);
  return bytes ? *bytes : bytes.error().message;
}

TEST(ZipArchive, StoredDeflatedAndZip64) {
  const std::string long_text(300'000, 'x');
  for (const bool zip64 : {false, true}) {
    const std::string zip =
        make_zip({{"A/b.txt", "hello", false}, {"c", long_text}, {"d", ""}}, zip64);
    EXPECT_TRUE(is_zip_archive(zip));
    EXPECT_EQ(unpacked(zip, "a/B.TXT"), "hello");
    EXPECT_EQ(unpacked(zip, "c"), long_text);
    EXPECT_EQ(unpacked(zip, "d"), "");
    EXPECT_EQ(unpacked(zip, "e"), "not there");
    EXPECT_EQ(unpacked(zip + "a comment", "a/b.txt"), "hello");
  }
}

TEST(ZipArchive, WhatUnpacksToMoreThanTheLimitIsRefused) {
  std::string zip = make_zip({{"c", std::string(100'000, 'x')}});
  EXPECT_EQ(unpacked(zip, "c", 99'999), "it unpacks to more than the limit of 99999 bytes");
  // One that says it were less: in the list, 22 bytes before its name's end and the archive's.
  const size_t list = zip.rfind("PK\1\2");
  zip[list + 24] = 10;
  zip[list + 25] = zip[list + 26] = 0;
  EXPECT_EQ(unpacked(zip, "c", 99'999), "its zip archive is damaged");
}

TEST(ZipArchive, DamagedOnesAreSaidToBe) {
  const std::string zip = make_zip({{"a", "hello hello hello"}, {"b", "stored", false}});
  for (size_t size = 0; size < zip.size(); ++size)
    EXPECT_NE(unpacked(zip.substr(0, size), "a"), "hello hello hello");
  // Any byte of it may be another; nothing but the true bytes comes out.
  for (size_t i = 0; i < zip.size(); ++i)
    for (const char value : {'\0', '\xff', 'P', char(zip[i] + 1)}) {
      std::string damaged = zip;
      damaged[i] = value;
      // A name may have become the other.
      for (const std::string& bytes : {unpacked(damaged, "a"), unpacked(damaged, "b")})
        EXPECT_TRUE(bytes == "hello hello hello" || bytes == "stored" || bytes == "not there" ||
                    bytes.starts_with("it"))
            << bytes;
    }
}

// AMF.

std::string amf_cube(double at) {
  std::string text = "<object id='1'><metadata type='x'>v1</metadata><mesh><vertices>";
  for (int k = 0; k < 8; ++k)
    text += "<vertex><coordinates><x>" + std::to_string(at + (k & 1)) + "</x><y> " +
            std::to_string(k >> 1 & 1) + " </y><z>" + std::to_string(k >> 2) +
            "</z></coordinates><normal><nx>0</nx></normal></vertex>";
  text += "</vertices><volume>";
  for (const auto& [a, b, c] : std::vector<std::array<int, 3>>{{0, 2, 1},
                                                               {1, 2, 3},
                                                               {4, 5, 6},
                                                               {5, 7, 6},
                                                               {0, 1, 4},
                                                               {1, 5, 4},
                                                               {2, 6, 3},
                                                               {3, 6, 7},
                                                               {0, 4, 2},
                                                               {2, 4, 6},
                                                               {1, 3, 5},
                                                               {3, 7, 5}})
    text += "<triangle><v1>" + std::to_string(a) + "</v1><v2>" + std::to_string(b) + "</v2><v3>" +
            std::to_string(c) + "</v3><color><r>0.5</r></color></triangle>";
  return text + "</volume></mesh></object>";
}

std::string amf(const std::string& body) {
  return "<?xml version=\"1.0\"?>\n<amf unit='inch'>" + body + "</amf>\n";
}

TEST(Amf, AllObjectsWhereTheyWereMade) {
  const std::string constellation =
      "<constellation id='3'><instance objectid='1'><deltax>9</deltax></instance></constellation>";
  const Measure two = measure(amf(amf_cube(0) + amf_cube(5) + constellation), "x.AMF");
  EXPECT_NEAR(two.volume, 2, 1e-12);
  EXPECT_EQ(two.box.hi, (Vec3{6, 1, 1}));
  const Measure packed = measure(make_zip({{"y.png", "no"}, {"x.amf", amf(amf_cube(2))}}), "x.amf");
  EXPECT_NEAR(packed.volume, 1, 1e-12);
  EXPECT_EQ(packed.box.lo, (Vec3{2, 0, 0}));
}

TEST(Amf, Mistakes) {
  EXPECT_EQ(error("", "x.amf"), "this is no AMF file");
  EXPECT_EQ(error("<svg></svg>", "x.amf"), "this is no AMF file");
  EXPECT_EQ(error("hello", "x.amf"), "this is no AMF file");
  EXPECT_EQ(error("<amf><object>", "x.amf"), "its XML is damaged or was cut off");
  EXPECT_EQ(error("<amf><coordinates><x>1</x><y>q</y><z>1</z></coordinates></amf>", "x.amf"),
            "a vertex is not three numbers");
  EXPECT_EQ(error("<amf><coordinates><x>1</x><y>2</y></coordinates></amf>", "x.amf"),
            "a vertex is not three numbers");
  for (const char* corners : {"<v1>0</v1><v2>0</v2>", "<v1>0</v1><v2>0</v2><v3>1</v3>",
                              "<v1>0</v1><v2>0</v2><v3>-1</v3>"})
    EXPECT_EQ(error(std::string("<amf><mesh><coordinates><x>1</x><y>2</y><z>3</z></coordinates>"
                                "<triangle>") +
                        corners + "</triangle></mesh></amf>",
                    "x.amf"),
              "a triangle has a corner that is no vertex");
  EXPECT_NE(error(amf(amf_cube(0)), "x.amf", 11).find("more triangles than the limit of 11"),
            std::string::npos);
  EXPECT_EQ(error("PK\3\4", "x.amf"), "it is no zip archive, or was cut off");
  EXPECT_EQ(error(make_zip({}), "x.amf"), "its zip archive is empty");
}

// 3MF.

std::string object_3mf(int id, const std::string& body) {
  return "<object id='" + std::to_string(id) + "' type='model'>" + body + "</object>";
}

std::string cube_3mf() {
  std::string text = "<mesh><vertices>";
  for (int k = 0; k < 8; ++k)
    text += "<vertex x='" + std::to_string(k & 1) + "' y='" + std::to_string(k >> 1 & 1) + "' z='" +
            std::to_string(k >> 2) + "'/>";
  text += "</vertices><triangles>";
  for (const char* t :
       {"021", "123", "456", "576", "014", "154", "263", "367", "042", "246", "135", "375"})
    text += std::string("<triangle v1='") + t[0] + "' v2='" + t[1] + "' v3='" + t[2] +
            "' p1='0' pid='7'/>";
  return text + "</triangles></mesh>";
}

std::string model_3mf(const std::string& resources, const std::string& build) {
  return "<?xml version=\"1.0\"?><model unit='inch' xmlns='u' xmlns:p='v'><resources>" + resources +
         "</resources><build>" + build + "</build></model>";
}

std::string package(const std::string& model) {
  return make_zip({{"3D/3dmodel.model", model}});
}

TEST(ThreeMf, WhatIsBuiltWhereItIsPlaced) {
  const std::string resources =
      object_3mf(1, cube_3mf()) +
      object_3mf(2,
                 "<components><component objectid='1' transform='1 0 0 0 1 0 0 0 1 5 0 0'/>"
                 "<component objectid='1'/></components>");
  // Rows are the images of the axes: x becomes y, three times as long.
  const Measure turned = measure(
      package(model_3mf(resources, "<item objectid='1' transform='0 3 0 -1 0 0 0 0 1 10 20 30'/>")),
      "x.3mf");
  EXPECT_NEAR(turned.volume, 3, 1e-12);
  EXPECT_EQ(turned.box.lo, (Vec3{9, 20, 30}));
  EXPECT_EQ(turned.box.hi, (Vec3{10, 23, 31}));
  // A component is placed in its object, and then with it.
  const Measure both = measure(
      package(model_3mf(resources, "<item objectid='2' transform='0 1 0 -1 0 0 0 0 1 0 7 0'/>")),
      "x.3mf");
  EXPECT_NEAR(both.volume, 2, 1e-12);
  EXPECT_EQ(both.box.lo, (Vec3{-1, 7, 0}));
  EXPECT_EQ(both.box.hi, (Vec3{0, 13, 1}));
  // A mirror turns faces, which are turned back.
  const Result<RawMesh> mirrored = read_mesh(
      package(model_3mf(resources, "<item objectid='1' transform='-1 0 0 0 1 0 0 0 1 0 0 0'/>")),
      "x.3mf", kMany);
  ASSERT_TRUE(mirrored);
  double volume = 0;
  for (const auto& [a, b, c] : mirrored->triangles)
    volume += dot(mirrored->points[a], cross(mirrored->points[b], mirrored->points[c])) / 6;
  EXPECT_NEAR(volume, 1, 1e-12);
  // Where nothing is to be built, all meshes are taken.
  EXPECT_NEAR(measure(package(model_3mf(resources, "")), "x.3mf").volume, 1, 1e-12);
}

TEST(ThreeMf, PartsOfThePackage) {
  const std::string relations =
      "<Relationships><Relationship Target='/Metadata/thumbnail.png' Type='http://x/thumbnail'/>"
      "<Relationship Target='/a/Root.model' Type='http://x/3dmodel'/></Relationships>";
  const std::string root = model_3mf(
      object_3mf(8, "<components><component p:path='/3D/part.model' objectid='1'/></components>"),
      "<item objectid='8' transform='1 0 0 0 1 0 0 0 1 0 0 4'/>");
  const std::string part = model_3mf(object_3mf(1, cube_3mf()), "<item objectid='99'/>");
  const Measure cube = measure(
      make_zip({{"_rels/.rels", relations}, {"a/root.model", root}, {"3D/part.model", part}}),
      "x.3mf");
  EXPECT_NEAR(cube.volume, 1, 1e-12);
  EXPECT_EQ(cube.box.lo, (Vec3{0, 0, 4}));
}

TEST(ThreeMf, Mistakes) {
  const auto error_of = [](const std::string& resources, const std::string& build) {
    return error(package(model_3mf(resources, build)), "x.3mf");
  };
  EXPECT_EQ(error("", "x.3mf"), "it is no zip archive, or was cut off");
  EXPECT_EQ(error(make_zip({{"x", "y"}}), "x.3mf"), "there is no 3D model in it");
  EXPECT_EQ(error(package("<model"), "x.3mf"), "its XML is damaged or was cut off");
  EXPECT_EQ(error(package("\xFF\xFE<"), "x.3mf"), "its XML is not UTF-8");
  EXPECT_EQ(error_of("<object/>", ""), "an object has no number");
  EXPECT_EQ(error_of("", "<item/>"), "an object is placed that has no number");
  EXPECT_EQ(error_of("", "<item objectid='1'/>"), "an object is placed that there is not");
  EXPECT_EQ(error_of("", "<item objectid='1' transform='1 0 0'/>"),
            "a transform is not twelve numbers");
  EXPECT_EQ(error_of("", "<item objectid='1' path='/q'/>"),
            "an object is in a part that there is not");
  EXPECT_EQ(error_of(object_3mf(1, "<vertex x='1' y='2'/>"), ""), "a vertex is not three numbers");
  EXPECT_EQ(
      error_of(object_3mf(1, "<vertex x='1' y='2' z='3'/><triangle v1='0' v2='0' v3='1'/>"), ""),
      "a triangle has a corner that is no vertex");
  // Circles, and objects of two of the one before.
  EXPECT_NE(error_of(object_3mf(1, "<component objectid='1'/>"), "<item objectid='1'/>")
                .find("limit of 1000"),
            std::string::npos);
  std::string doubling = object_3mf(1, cube_3mf());
  for (int id = 2; id < 60; ++id) {
    const std::string half = "<component objectid='" + std::to_string(id - 1) + "'/>";
    doubling += object_3mf(id, half + half);
  }
  EXPECT_NE(error_of(doubling, "<item objectid='59'/>").find("limit of 1000"), std::string::npos);
  // An archive of a few kilobytes that would fill the memory.
  const std::string bomb = package(std::string(4'000'000, ' '));
  EXPECT_LT(bomb.size(), 10'000u);
  EXPECT_EQ(error(bomb, "x.3mf"), "it unpacks to more than the limit of 1548576 bytes");
}

}  // namespace
}  // namespace whittle
