// 3MF models: written with minizip, read back as triangles.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <minizip/zip.h>

#include "passo/surface_file/surface_file.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

using ZippedFiles = std::vector<std::pair<std::string, std::string>>;

std::string zipped(const ZippedFiles& files) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     fmt::format("threemf_file_test_{}.3mf", static_cast<const void*>(&files));
  void* const zip = zipOpen64(path.c_str(), 0);
  for (const auto& [name, text] : files) {
    zipOpenNewFileInZip(zip, name.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, 8, 6);
    zipWriteInFileInZip(zip, text.data(), static_cast<unsigned>(text.size()));
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  std::ifstream file(path, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(file), {});
  std::filesystem::remove(path);
  return bytes;
}

const std::string tetrahedron =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
    "<vertex x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3'/>"
    "<triangle v1='1' v2='2' v3='3'/><triangle v1='0' v2='3' v3='2'/></triangles></mesh>";

std::string model(const std::string& unit, const std::string& resources, const std::string& build) {
  return "<?xml version='1.0' encoding='UTF-8'?><model unit='" + unit +
         "' xmlns='http://schemas.microsoft.com/3dmanufacturing/core/2015/02' "
         "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06'><resources>" +
         resources + "</resources><build>" + build + "</build></model>";
}
std::string one_object(const std::string& unit = "millimeter") {
  return model(unit, "<object id='1' type='model'>" + tetrahedron + "</object>", "<item objectid='1'/>");
}

struct Read3mf {
  std::vector<SurfaceTriangle> faces;
  std::string words;
};
Read3mf read_bytes_of(const std::string& bytes) {
  Diagnostics diagnostics;
  SurfaceFaces faces = read_faces("it.3mf", bytes, diagnostics);
  return {std::move(faces.triangles), render(diagnostics, false)};
}
Read3mf read_model(const std::string& text) {
  return read_bytes_of(zipped({{"[Content_Types].xml", "<Types/>"}, {"3D/3dmodel.model", text}}));
}

struct Box3 {
  SurfacePoint low{1e9, 1e9, 1e9};
  SurfacePoint high{-1e9, -1e9, -1e9};
};
Box3 box_of(const std::vector<SurfaceTriangle>& faces) {
  Box3 box;
  for (const SurfaceTriangle& face : faces) {
    for (const SurfacePoint& p : face) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  }
  return box;
}

TEST(ThreeMfFile, has_its_triangles_in_the_unit_of_the_file) {
  for (const auto& [unit, mm] : std::vector<std::pair<std::string, double>>{{"millimeter", 1},
                                                                            {"micron", 0.001},
                                                                            {"centimeter", 10},
                                                                            {"inch", 25.4},
                                                                            {"foot", 304.8},
                                                                            {"meter", 1000}}) {
    const Read3mf read = read_model(one_object(unit));
    EXPECT_EQ(read.words, "") << unit;
    ASSERT_EQ(read.faces.size(), 4U);
    EXPECT_EQ(open_edges(read.faces), 0U);
    EXPECT_DOUBLE_EQ(box_of(read.faces).high.x, mm);
    EXPECT_DOUBLE_EQ(box_of(read.faces).high.z, mm);
  }
  EXPECT_THAT(read_model(one_object("furlong")).words, HasSubstr("found 'furlong', line 1 column"));
}

TEST(ThreeMfFile, places_components_and_items) {
  // Twice as large and moved by 10 in X; then turned by 90 degrees about Z, and moved by 100 in Y.
  const std::string text =
      model("millimeter",
            "<object id='7'>" + tetrahedron +
                "</object><object id='8'><components><component objectid='7'/>"
                "<component objectid='7' transform='2 0 0 0 2 0 0 0 2 10 0 0'/></components></object>"
                "<object id='9' type='support'>" +
                tetrahedron + "</object>",
            "<item objectid='8' transform='0 1 0 -1 0 0 0 0 1 0 100 0'/><item objectid='9'/>");
  const Read3mf read = read_model(text);
  EXPECT_EQ(read.words, "");
  ASSERT_EQ(read.faces.size(), 8U) << "a support is no part of the model";
  const Box3 box = box_of(read.faces);
  EXPECT_NEAR(box.low.x, -2, 1e-12);
  EXPECT_NEAR(box.high.x, 0, 1e-12);
  EXPECT_NEAR(box.low.y, 100, 1e-12);
  EXPECT_NEAR(box.high.y, 112, 1e-12);
  EXPECT_NEAR(box.high.z, 2, 1e-12);
}

TEST(ThreeMfFile, may_consist_of_several_files) {
  const Read3mf read = read_bytes_of(zipped(
      {{"_rels/.rels",
        "<Relationships><Relationship Target=\"/3D/root.model\" Id=\"rel0\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"},
       {"3D/root.model", model("centimeter",
                               "<object id='2'><components><component p:path='/3D/Objects/part.model' objectid='1'/>"
                               "</components></object>",
                               "<item objectid='2'/>")},
       {"3D/Objects/part.model", one_object("centimeter")}}));
  EXPECT_EQ(read.words, "");
  ASSERT_EQ(read.faces.size(), 4U);
  EXPECT_DOUBLE_EQ(box_of(read.faces).high.y, 10);
}

TEST(ThreeMfFile, that_is_wrong_is_refused_with_a_reason) {
  const auto refused = [](const std::string& text, const std::string& words) {
    const Read3mf read = read_model(text);
    EXPECT_TRUE(read.faces.empty()) << words;
    EXPECT_THAT(read.words, HasSubstr("[surface.3mf]"));
    EXPECT_THAT(read.words, HasSubstr(words));
  };
  const auto with = [](std::string from, const std::string& to) {
    std::string text = one_object();
    return text.replace(text.find(from), from.size(), to);
  };
  refused(with("v1='0'", "v1='4'"), "v1: expected the number of a vertex, found '4'");
  refused(with("v1='0'", "v1='-1'"), "v1: expected the number of a vertex");
  refused(with("x='1'", "x='one'"), "x: expected a number, found 'one'");
  refused(with("x='1'", "x='1e300'"), "a triangle is too far away");
  refused(with("objectid='1'", "objectid='3'"), "object '3' is missing");
  refused(with("objectid='1'", "objectid='1' transform='1 2 3'"), "transform: expected 12 numbers");
  refused(with("</build>", "</built>"), "mismatched tag");
  refused(with("<model", "<!DOCTYPE m [<!ENTITY a 'b'>]><model"), "it declares an entity");
  refused(model("millimeter", "<object id='1'><components><component objectid='1'/></components></object>",
                "<item objectid='1'/>"),
          "its components contain each other");
  refused(model("millimeter", "", ""), "has no triangle");
  const Read3mf none = read_bytes_of(zipped({{"3D/other.model", one_object()}}));
  EXPECT_THAT(none.words, HasSubstr("'3D/3dmodel.model' is missing"));
}

// 2 to the power of 16 copies by nested components: rejected before they are created.
TEST(ThreeMfFile, that_grows_by_its_components_is_refused) {
  std::string resources = "<object id='0'>" + tetrahedron + "</object>";
  for (int i = 1; i <= 12; ++i) {
    resources += fmt::format("<object id='{}'><components>", i);
    for (int k = 0; k < 8; ++k) resources += fmt::format("<component objectid='{}'/>", i - 1);
    resources += "</components></object>";
  }
  const Read3mf read = read_model(model("millimeter", resources, "<item objectid='12'/>"));
  EXPECT_TRUE(read.faces.empty());
  EXPECT_THAT(read.words, HasSubstr("[surface.3mf]"));
}

TEST(ThreeMfFile, that_is_cut_off_or_changed_anywhere_is_refused_or_read) {
  const std::string whole = zipped({{"3D/3dmodel.model", one_object()}});
  for (std::size_t size = 0; size + 22 < whole.size(); size += 7) {
    EXPECT_TRUE(read_bytes_of(whole.substr(0, size)).faces.empty()) << size;
  }
  for (std::size_t at = 4; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x21);
    const Read3mf read = read_bytes_of(changed);
    EXPECT_EQ(read.faces.empty(), !read.words.empty()) << at;
  }
}

}  // namespace
}  // namespace passo
