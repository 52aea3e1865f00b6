#include "passo/tool_import/tool_import.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "passo/tooling/tool_library.hpp"
#include "passo/tooling/tool_library_text.hpp"

namespace passo {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string example(const std::string& name) {
  return file_text(std::string(PASSO_SOURCE_DIR) + "/examples/tools/" + name);
}

std::optional<ImportedTools> import_text(const std::string& text, const ToolImportOptions& options = {}) {
  Diagnostics findings;
  auto imported = import_tools(text, "t", options, findings);
  EXPECT_TRUE(imported) << render(findings, false);
  EXPECT_TRUE(findings.all().empty());
  return imported;
}

std::string refusal(const std::string& text, const ToolImportOptions& options = {}) {
  Diagnostics findings;
  EXPECT_FALSE(import_tools(text, "t", options, findings));
  return render(findings, false);
}

// One tool of Fusion with these members in "geometry".
std::string fusion(const std::string& type, const std::string& geometry, const std::string& more = "") {
  return fmt::format(R"({{"data": [{{"type": "{}", "unit": "millimeters", "post-process": {{"number": 4}},
    "geometry": {{{}}}{}}}]}})",
                     type, geometry, more);
}

std::string freecad(const std::string& shape, const std::string& parameters) {
  return fmt::format(R"({{"version": 2, "name": "b", "shape": "{}.fcstd", "parameter": {{{}}}}})", shape, parameters);
}

double degrees(Radians angle) {
  return angle.value * 180 / std::numbers::pi;
}

TEST(FusionTools, have_shapes_sizes_and_chip_loads_in_mm) {
  const auto imported = import_text(example("fusion-export.json"));
  ASSERT_EQ(imported->tools.size(), 5U);
  const CuttingTool& flat = imported->tools[0];
  EXPECT_EQ(flat.number, 1);
  EXPECT_EQ(flat.name, "6 mm flat [2 flutes]");
  EXPECT_EQ(flat.diameter, Mm(6));
  EXPECT_EQ(flat.flute_length, Mm(22));
  EXPECT_EQ(flat.stick_out, Mm(30));
  ASSERT_EQ(flat.chip_loads.size(), 1U);
  EXPECT_EQ(flat.chip_loads.at(WorkMaterial::plywood), Mm(0.08));
  const CuttingTool& ball = imported->tools[1];
  EXPECT_EQ(ball.shape, CuttingShape::ball);
  EXPECT_EQ(ball.diameter, Mm(3.175));
  EXPECT_EQ(ball.flute_length, Mm(12.7));
  const CuttingTool& vee = imported->tools[2];
  EXPECT_EQ(vee.shape, CuttingShape::vee);
  EXPECT_NEAR(degrees(vee.angle), 90, 1e-9) << "TA is the angle of one side";
  EXPECT_EQ(vee.tip, Mm(0.2));
  EXPECT_EQ(vee.material, ToolMaterial::hss);
  const CuttingTool& drill = imported->tools[3];
  EXPECT_EQ(drill.shape, CuttingShape::drill);
  EXPECT_NEAR(degrees(drill.angle), 118, 1e-9) << "SIG is the whole angle";
  const CuttingTool& taper = imported->tools[4];
  EXPECT_EQ(taper.number, 6) << "T3 is used already";
  EXPECT_EQ(taper.tip, Mm(1));
  EXPECT_NEAR(taper.diameter.value(), 1 + 2 * 20 * std::tan(5 * std::numbers::pi / 180), 1e-8);
}

TEST(FusionTools, list_what_was_changed_left_out_and_not_used) {
  const auto imported = import_text(example("fusion-export.json"));
  ASSERT_EQ(imported->left_out.size(), 1U);
  EXPECT_EQ(imported->left_out[0].place, "/data/5");
  EXPECT_THAT(imported->left_out[0].text, HasSubstr("slot mill"));
  EXPECT_THAT(imported->changed, Contains(Field(&ToolImportNote::text, "T3 is used already")));
  EXPECT_THAT(imported->changed, Contains(Field(&ToolImportNote::text, "it got the free number T6")));
  const auto of = [&](const std::string& field) {
    const auto found = std::ranges::find(imported->unused, field, &UnusedField::field);
    return found == imported->unused.end() ? UnusedField{} : *found;
  };
  EXPECT_EQ(of("/data/*/geometry/HAND").count, 1U);
  EXPECT_EQ(of("/data/*/geometry/HAND").first, "/data/0/geometry/HAND");
  EXPECT_EQ(of("/data/*/start-values/presets/*/n").count, 2U);
  EXPECT_EQ(of("/data/*/geometry/DC").count, 0U);
  EXPECT_EQ(of("/version").count, 1U);
}

TEST(FusionTools, of_a_zip_archive_are_those_of_its_json) {
  // Stored, not compressed: local header, central directory, end. APPNOTE.TXT of PKWARE.
  const std::string text = fusion("flat end mill", "\"DC\": 3");
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  crc = ~crc;
  const auto word = [](std::uint32_t value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i));
    return out;
  };
  const auto size = static_cast<std::uint32_t>(text.size());
  const std::string name = "tools.json";
  const std::string about = word(20, 2) + word(0, 2) + word(0, 2) + word(0, 4) + word(crc, 4) + word(size, 4) +
                            word(size, 4) + word(10, 2) + word(0, 2);
  const std::string local = "PK\x03\x04" + about + name + text;
  const std::string central =
      "PK\x01\x02" + word(20, 2) + about + word(0, 2) + word(0, 2) + word(0, 2) + word(0, 4) + word(0, 4) + name;
  const std::string end = "PK\x05\x06" + word(0, 4) + word(1, 2) + word(1, 2) +
                          word(static_cast<std::uint32_t>(central.size()), 4) +
                          word(static_cast<std::uint32_t>(local.size()), 4) + word(0, 2);
  const auto imported = import_text(local + central + end);
  ASSERT_EQ(imported->tools.size(), 1U);
  EXPECT_EQ(imported->tools[0].diameter, Mm(3));
  EXPECT_THAT(refusal(local), HasSubstr("[tool-import.zip]"));
  EXPECT_THAT(refusal("PK\x03\x04" + std::string(40, 'x')), HasSubstr("[tool-import.zip]"));
}

TEST(FusionTools, are_left_out_if_something_would_have_to_be_guessed) {
  const auto why = [](const std::string& text) {
    const auto imported = import_text(text);
    EXPECT_THAT(imported->tools, IsEmpty());
    return imported->left_out.empty() ? std::string() : imported->left_out[0].text;
  };
  EXPECT_THAT(why(R"({"data": [{"type": "flat end mill", "geometry": {"DC": 3}}]})"), HasSubstr("unit"));
  EXPECT_THAT(why(fusion("drill", "\"DC\": 3")), HasSubstr("SIG"));
  EXPECT_THAT(why(fusion("flat end mill", "\"LCF\": 3")), HasSubstr("DC"));
  EXPECT_THAT(why(fusion("bull nose end mill", "\"DC\": 3")), HasSubstr("corner_radius_mm"));
  EXPECT_THAT(why(fusion("bull nose end mill", "\"DC\": 3, \"RE\": 2")), HasSubstr("not a valid tool"));
  EXPECT_THAT(why(fusion("chamfer mill", "\"DC\": 3")), HasSubstr("angle_deg"));
  EXPECT_THAT(why(fusion("tapered mill", "\"DC\": 3, \"TA\": 5, \"LCF\": 9, \"RE\": 0.5")), HasSubstr("neither"));
  EXPECT_THAT(why(fusion("lollipop mill", "\"DC\": 3")), HasSubstr("lollipop mill"));
  EXPECT_THAT(why(fusion("flat end mill", "\"DC\": -3")), HasSubstr("diameter_mm"));
  EXPECT_THAT(why(fusion("flat end mill", "\"DC\": 3, \"NOF\": 2.5")), HasSubstr("flutes"));
}

TEST(FusionTools, get_the_chip_load_of_a_preset_from_its_feed_and_speed) {
  const auto imported = import_text(fusion("flat end mill", "\"DC\": 3, \"NOF\": 2",
                                           R"(, "start-values": {"presets": [
      {"name": "a", "material": {"query": "Aluminum 6061"}, "n": 20000, "v_f": 1000},
      {"name": "MDF", "f_z": 0.1}, {"name": "MDF finishing", "f_z": 0.2}, {"name": "steel", "f_z": 0.01}]})"));
  const auto& loads = imported->tools[0].chip_loads;
  ASSERT_EQ(loads.size(), 2U);
  EXPECT_EQ(loads.at(WorkMaterial::aluminium), Mm(0.025));
  EXPECT_EQ(loads.at(WorkMaterial::mdf), Mm(0.1));
  EXPECT_THAT(imported->changed, ElementsAre(Field(&ToolImportNote::text, HasSubstr("several presets for mdf"))));
}

TEST(FreecadTools, of_a_library_are_read_from_their_files) {
  ToolImportOptions options;
  options.read_tool_bit = [](const std::string& name) -> std::optional<std::string> {
    const std::string text = example("freecad/Bit/" + name);
    return text.empty() ? std::nullopt : std::optional(text);
  };
  const auto imported = import_text(example("freecad/Library/Router.fctl"), options);
  ASSERT_EQ(imported->tools.size(), 2U);
  EXPECT_EQ(imported->tools[0].shape, CuttingShape::flat);
  EXPECT_EQ(imported->tools[0].flute_length, Mm(22));
  const CuttingTool& vee = imported->tools[1];
  EXPECT_EQ(vee.number, 2);
  EXPECT_EQ(vee.diameter, Mm(6.35)) << "a decimal comma";
  EXPECT_NEAR(degrees(vee.angle), 60, 1e-9) << "both sides";
  EXPECT_EQ(vee.tip, Mm(0.1));
  EXPECT_EQ(vee.flute_length, Mm(5.08)) << "inches";
  EXPECT_EQ(vee.material, ToolMaterial::hss);
  ASSERT_EQ(imported->left_out.size(), 1U);
  EXPECT_EQ(imported->left_out[0].place, "/tools/2");
  EXPECT_THAT(imported->left_out[0].text, HasSubstr("missing.fctb"));
  EXPECT_THAT(imported->unused, Contains(Field(&UnusedField::field, "/parameter/Length")));
}

TEST(FreecadTools, of_a_library_never_lead_out_of_its_folder) {
  ToolImportOptions options;
  std::vector<std::string> asked;
  options.read_tool_bit = [&](const std::string& name) -> std::optional<std::string> {
    asked.push_back(name);
    return std::nullopt;
  };
  const auto imported = import_text(R"({"version": 1, "tools": [{"nr": 1, "path": "../../etc/passwd.fctb"},
    {"nr": 2, "path": "/etc/x.fctb"}, {"nr": 3, "path": "a\\b.fctb"}, {"nr": 4, "path": "a\u0000.fctb"},
    {"nr": 5, "path": "passwd"}, {"nr": 6}, {"nr": 7, "path": "good.fctb"}]})",
                                    options);
  EXPECT_THAT(asked, ElementsAre("good.fctb"));
  EXPECT_EQ(imported->left_out.size(), 7U);
}

TEST(FreecadTools, need_units_and_a_known_shape) {
  const auto why = [](const std::string& text) {
    const auto imported = import_text(text);
    EXPECT_THAT(imported->tools, IsEmpty());
    return imported->left_out.empty() ? std::string() : imported->left_out[0].text;
  };
  EXPECT_THAT(why(freecad("endmill", R"("Diameter": "6")")), HasSubstr("with a unit"));
  EXPECT_THAT(why(freecad("endmill", R"("Diameter": 6)")), HasSubstr("with a unit"));
  EXPECT_THAT(why(freecad("endmill", R"("Diameter": "6 parsec")")), HasSubstr("with a unit"));
  EXPECT_THAT(why(freecad("endmill", R"("Diameter": "1.2.3 mm")")), HasSubstr("with a unit"));
  EXPECT_THAT(why(freecad("drill", R"("Diameter": "3 mm")")), HasSubstr("TipAngle"));
  EXPECT_THAT(why(freecad("bullnose", R"("Diameter": "3 mm", "FlatRadius": "1 mm")")), HasSubstr("corner_radius_mm"));
  EXPECT_THAT(why(freecad("slittingsaw", R"("Diameter": "3 mm")")), HasSubstr("slittingsaw"));
}

TEST(LinuxcncTools, need_units_and_a_shape) {
  const std::string table = example("linuxcnc.tbl");
  EXPECT_THAT(refusal(table), HasSubstr("[tool-import.no-units]"));
  ToolImportOptions options{.units = LengthUnits::mm};
  const auto shapeless = import_text(table, options);
  EXPECT_THAT(shapeless->tools, IsEmpty());
  EXPECT_EQ(shapeless->left_out.size(), 2U);
  options.shape = CuttingShape::flat;
  const auto imported = import_text(table, options);
  ASSERT_EQ(imported->tools.size(), 2U);
  EXPECT_EQ(imported->tools[1].diameter, Mm(3.175));
  EXPECT_EQ(imported->tools[1].name, "1/8 inch");
  EXPECT_THAT(imported->unused, ElementsAre(Field(&UnusedField::field, "Z")));
  EXPECT_EQ(imported->unused[0].count, 2U);
  EXPECT_THAT(refusal("T1 P1 D6 K3\n", options), HasSubstr("t:1:10: error"));
  options.units = LengthUnits::inch;
  EXPECT_EQ(import_text("T1 P1 D0.25\n", options)->tools[0].diameter, Mm(6.35));
}

TEST(ToolImport, refuses_damaged_and_foreign_files_with_their_place) {
  EXPECT_THAT(refusal("{\"data\": [\n  1,\n  }"), HasSubstr("t:3:3: error: the file is not valid JSON"));
  EXPECT_THAT(refusal("{\"data\": 1e999}"), HasSubstr("[tool-import.json]"));
  EXPECT_THAT(refusal(std::string(100'000, '[')), HasSubstr("[tool-import.json]"));
  EXPECT_THAT(refusal(std::string(1000, '[') + std::string(1000, ']')), HasSubstr("[tool-import.too-deep]"));
  EXPECT_THAT(refusal("{\"a\": 1}"), HasSubstr("[tool-import.format]"));
  EXPECT_THAT(refusal("[1]"), HasSubstr("[tool-import.format]"));
  EXPECT_THAT(refusal("SQLite format 3" + std::string(10, '\0')), HasSubstr("[tool-import.database]"));
  EXPECT_THAT(refusal(std::string("\x01\0\x02", 3)), HasSubstr("[tool-import.format]"));
  EXPECT_THAT(refusal(" \n"), HasSubstr("[tool-import.empty]"));
  EXPECT_THAT(refusal(R"({"format": "passo-tool-library", "version": 2, "tools": []})"),
              HasSubstr("[tool-import.version]"));
}

TEST(ToolExport, of_json_is_read_again_without_a_loss) {
  Diagnostics findings;
  for (const std::string name : {"router-tools.toml"}) {
    const auto library = ToolLibrary::parse(example(name), name, findings);
    ASSERT_TRUE(library);
    const auto again = import_text(tool_library_json(library->tools(), "router-tools.toml"));
    EXPECT_EQ(again->format, ToolFileFormat::passo);
    EXPECT_EQ(tool_library_text(again->tools), tool_library_text(library->tools()));
    EXPECT_THAT(again->unused, IsEmpty());
    EXPECT_THAT(again->left_out, IsEmpty());
    EXPECT_THAT(again->changed, IsEmpty());
  }
}

TEST(ToolExport, for_linuxcnc_is_a_tool_table) {
  Diagnostics findings;
  const auto library = ToolLibrary::parse(example("router-tools.toml"), "t", findings);
  const std::string table = linuxcnc_tool_table(library->tools(), LengthUnits::mm);
  EXPECT_THAT(table, testing::StartsWith("T1 P1 D6 ; \"roughing\", flat end, 6 mm\n"));
  const auto again = import_text(table, {.units = LengthUnits::mm, .shape = CuttingShape::flat});
  ASSERT_EQ(again->tools.size(), library->tools().size());
  for (std::size_t i = 0; i < again->tools.size(); ++i) {
    EXPECT_EQ(again->tools[i].number, library->tools()[i].number);
    EXPECT_EQ(again->tools[i].diameter, library->tools()[i].diameter);
  }
  const std::string inches = linuxcnc_tool_table(library->tools(), LengthUnits::inch);
  EXPECT_THAT(inches, HasSubstr("D0.23622"));
}

}  // namespace
}  // namespace passo
