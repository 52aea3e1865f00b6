// The published numbers behind feeds_of(), each with the address of its page. Private to tooling/.
//
// Chip loads are ranges in mm per tooth at ascending diameters. Between two diameters they are interpolated. Below the
// smallest one they are proportional to the diameter, as in the table of SGS for 1.6, 3 and 6 mm; above the largest one
// they stay. The charts hold for cuts as deep as the diameter.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "passo/tooling/cutting_tool.hpp"

namespace passo::chips {

inline constexpr std::string_view ast = "https://www.asttooling.com/pages/speeds-and-feeds-charts";
inline constexpr std::string_view cutter_shop = "http://www.cutter-shop.com/main.asp?sitepages=feeds_and_speeds";
inline constexpr std::string_view harvey = "http://harveytool.com/cms/GeneralMachiningGuidelines_17.aspx";
inline constexpr std::string_view formula_factory =
    "https://formulafactory.tools/reference-charts/recommended-chip-loads/";
inline constexpr std::string_view sgs =
    "https://docs.steelcam.org/sgs/katalog-monolitnyj-instrument-iz-kompozitnyh-materialov-page13";
inline constexpr std::string_view pcb_gcode = "http://forscience.nl/?p=119";
inline constexpr std::string_view foam_milling = "https://ypmfg.com/?p=6954";
inline constexpr std::string_view yeti =
    "https://www.yetitool.com/Support/KNOWLEDGE-BASE/smartbench-material-processing-cutting-strategy-key-parameters";
inline constexpr std::string_view shopbot = "http://shopbotwiki.com/index.php?title=3dMachiningMain";
inline constexpr std::string_view protocutter = "https://protocutter.com/speds-and-feeds-for-carbide-end-mills/";
inline constexpr std::string_view sherline = "https://www.hitpages.com/doc/4508049750360064/41/";
inline constexpr std::string_view hss_speeds = "https://docslib.org/doc/5103932/machine-tool-speeds-and-feeds";
inline constexpr std::string_view router_bits = "http://woodworking.about.com/od/safetyfirst/a/RouterBitSpeeds.htm";
inline constexpr std::string_view thinning = "https://machinecalcs.com/radial-chip-thinning-calculator";

struct ChipRow {
  double diameter;  // mm
  double least;     // mm per tooth
  double most;
};

struct MaterialTable {
  std::span<const ChipRow> rows;
  bool is_per_turn = false;  // the rows are mm per revolution, shared by the flutes
  std::string_view source;
  std::string_view second_source = {};  // of the upper ends of the ranges; empty: the same
  double surface_speed = 0;             // m/min for carbide; 0: not limited
  std::string_view speed_source = {};
  double usual_rpm = 0;   // the charts are for router spindles near this speed; 0: as fast as surface speed permits
  double pass_share = 1;  // depth of a pass as a share of the diameter
  std::string_view pass_source = {};
};

// inch × 25.4
inline constexpr std::array<ChipRow, 4> softwood{
    {{3.175, 0.0762, 0.127}, {6.35, 0.1524, 0.2032}, {9.525, 0.381, 0.4318}, {12.7, 0.4826, 0.5334}}};
inline constexpr std::array<ChipRow, 4> hardwood{
    {{3.175, 0.0508, 0.1016}, {6.35, 0.127, 0.1778}, {9.525, 0.3302, 0.381}, {12.7, 0.4318, 0.4826}}};
inline constexpr std::array<ChipRow, 4> plywood{
    {{3.175, 0.0762, 0.127}, {6.35, 0.1524, 0.2286}, {9.525, 0.381, 0.4572}, {12.7, 0.4572, 0.5334}}};
inline constexpr std::array<ChipRow, 4> mdf{
    {{3.175, 0.1016, 0.1778}, {6.35, 0.3048, 0.381}, {9.525, 0.4318, 0.4826}, {12.7, 0.508, 0.635}}};
inline constexpr std::array<ChipRow, 4> acrylic{
    {{3.175, 0.0762, 0.127}, {6.35, 0.2032, 0.254}, {9.525, 0.254, 0.3048}, {12.7, 0.3048, 0.381}}};
inline constexpr std::array<ChipRow, 4> hdpe{
    {{3.175, 0.0762, 0.127}, {6.35, 0.1524, 0.2286}, {9.525, 0.2286, 0.2794}, {12.7, 0.2794, 0.3556}}};
// mm per revolution: from 1 % of the diameter (pcb-gcode) to the table of SGS for fibreglass.
inline constexpr std::array<ChipRow, 5> fr4{
    {{1.6, 0.016, 0.03}, {3, 0.03, 0.06}, {6, 0.06, 0.12}, {10, 0.1, 0.23}, {12, 0.12, 0.305}}};
// 60 in/min at 12,000 rpm to 200 in/min at 20,000 rpm with one flute. The page names no diameter: a router's 6 mm.
inline constexpr std::array<ChipRow, 1> foam{{{6, 0.127, 0.254}}};
// From end mills of Harvey to the lower ends of the router bits of Cutter Shop.
inline constexpr std::array<ChipRow, 4> aluminium{
    {{3.175, 0.0254, 0.0762}, {6.35, 0.0508, 0.127}, {9.525, 0.0762, 0.1524}, {12.7, 0.1016, 0.2032}}};
inline constexpr std::array<ChipRow, 4> brass{
    {{3.175, 0.0254, 0.0381}, {6.35, 0.0508, 0.0762}, {9.525, 0.0635, 0.1016}, {12.7, 0.0762, 0.127}}};
// Drills: mm per revolution.
inline constexpr std::array<ChipRow, 4> drilling{
    {{3.175, 0.0254, 0.0762}, {6.35, 0.0508, 0.1524}, {12.7, 0.1016, 0.254}, {25.4, 0.1778, 0.381}}};

inline constexpr double router_rpm = 18000;
// The chart permits 18,000 rpm up to 2 inches, 12,000 rpm up to 3.5 inches: 48 and 56 m/s at the rim.
inline constexpr double router_rim_speed = 2870;  // m/min

// In the order of the enumerators.
inline constexpr std::array<MaterialTable, 10> tables{{
    {.rows = softwood,
     .source = ast,
     .surface_speed = router_rim_speed,
     .speed_source = router_bits,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = hardwood,
     .source = ast,
     .surface_speed = router_rim_speed,
     .speed_source = router_bits,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = plywood,
     .source = ast,
     .surface_speed = router_rim_speed,
     .speed_source = router_bits,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = mdf,
     .source = ast,
     .surface_speed = router_rim_speed,
     .speed_source = router_bits,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = acrylic,
     .source = cutter_shop,
     .surface_speed = 183,
     .speed_source = harvey,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = hdpe,
     .source = ast,
     .surface_speed = 245,
     .speed_source = sgs,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = fr4,
     .is_per_turn = true,
     .source = pcb_gcode,
     .second_source = sgs,
     .surface_speed = 100,
     .speed_source = sgs,
     .pass_source = sgs},
    {.rows = foam,
     .source = foam_milling,
     .surface_speed = router_rim_speed,
     .speed_source = router_bits,
     .usual_rpm = router_rpm,
     .pass_source = ast},
    {.rows = aluminium,
     .source = harvey,
     .second_source = cutter_shop,
     .surface_speed = 305,
     .speed_source = harvey,
     .pass_share = 0.16,
     .pass_source = sherline},
    {.rows = brass,
     .source = harvey,
     .second_source = formula_factory,
     .surface_speed = 305,
     .speed_source = harvey,
     .pass_share = 0.16,
     .pass_source = sherline},
}};

inline const MaterialTable& table_of(WorkMaterial material) {
  return tables[static_cast<std::size_t>(material)];
}

}  // namespace passo::chips
