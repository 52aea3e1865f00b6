#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/cam/board_layer.hpp"
#include "passo/cam/excellon.hpp"
#include "passo/cam/kicad_board.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

const fs::path kicad_boards = fs::path(PASSO_SOURCE_DIR) / "src/cam/cam/tests/boards";

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

DesignBoard good_board(const std::string& text) {
  Diagnostics found;
  DesignBoard board = read_kicad_board("board.kicad_pcb", text, found);
  EXPECT_TRUE(found.all().empty()) << render(found, false);
  return board;
}

// A board with these items.
std::string board_with(const std::string& items) {
  return "(kicad_pcb (version 20211014)\n(layers (0 \"F.Cu\" signal) (31 \"B.Cu\" signal) (44 \"Edge.Cuts\" user))\n" +
         items + ")\n";
}

std::string refusal_of(const std::string& text) {
  Diagnostics found;
  read_kicad_board("board.kicad_pcb", text, found);
  if (found.all().empty()) return "";
  const Diagnostic& first = found.all().front();
  return fmt::format("{} {}:{}", first.code, first.place.line, first.place.column);
}

GerberLayer gerber_of(const char* name) {
  Diagnostics found;
  GerberLayer layer = read_gerber(name, bytes_of(kicad_boards / name), found);
  EXPECT_FALSE(found.any_error()) << render(found, false);
  return layer;
}

// What differs is nowhere thicker than 10 um: KiCad makes pads of their own shape of polygons, with fewer chords.
void expect_same_face(const Region& ours, const Region& theirs, const std::string& name) {
  EXPECT_FALSE(theirs.empty()) << name;
  EXPECT_TRUE(grown(subtracted(ours, theirs), {-5'000}).empty()) << name;
  EXPECT_TRUE(grown(subtracted(theirs, ours), {-5'000}).empty()) << name;
}

// The Gerber and drill files beside it were plotted by KiCad 6.0.11.
TEST(KicadBoard, is_what_kicad_plots) {
  const DesignBoard board = good_board(bytes_of(kicad_boards / "shapes.kicad_pcb"));
  ASSERT_EQ(board.copper.size(), 2U);
  EXPECT_EQ(board.copper[0].name, "F.Cu");
  expect_same_face(board.copper[0].layer.dark, gerber_of("shapes-F_Cu.gbr").dark, "F.Cu");
  expect_same_face(board.copper[1].layer.dark, gerber_of("shapes-B_Cu.gbr").dark, "B.Cu");
  expect_same_face(board.edge.dark, gerber_of("shapes-Edge_Cuts.gbr").dark, "Edge.Cuts");

  Diagnostics found;
  const BoardEdge edge = board_edge({board.edge.dark, board.edge.strokes}, {1'000}, found);
  EXPECT_FALSE(found.any_error()) << render(found, false);
  EXPECT_EQ(edge.loops.loops.size(), 2U);

  for (const std::uint32_t kind : {0U, 1U}) {
    const char* const name = kind == 0 ? "shapes-PTH.drl" : "shapes-NPTH.drl";
    const Drawing theirs = read_excellon(name, bytes_of(kicad_boards / name), {}, found);
    std::size_t holes = 0;
    for (const DrawnHole& hole : board.drills.holes) {
      if (hole.layer != kind) continue;
      ++holes;
      const auto is_near = [&](const DrawnHole& other) {
        constexpr double last_digit = 1000;  // nm
        return distance_nm(hole.at, other.at) < last_digit && hole.diameter == other.diameter;
      };
      EXPECT_TRUE(std::ranges::any_of(theirs.holes, is_near)) << hole.line;
    }
    EXPECT_EQ(holes, theirs.holes.size()) << name;
    const auto slots = std::ranges::count(board.drills.paths, kind, &DrawnPath::layer);
    EXPECT_EQ(static_cast<std::size_t>(slots), theirs.paths.size()) << name;
  }
}

// What KiCad 6.0.11 plots of the boards of Debian's package kicad-demos that have no texts on copper, in mm2.
TEST(KicadBoard, boards_of_kicad_have_the_copper_that_kicad_plots) {
  struct Known {
    const char* file;
    const char* layer;
    double mm2;
  };
  constexpr Known known[] = {
      {"ecc83/ecc83-pp.kicad_pcb", "F.Cu", 219.101},
      {"ecc83/ecc83-pp.kicad_pcb", "B.Cu", 1614.715},
      {"ecc83/ecc83-pp_v2.kicad_pcb", "B.Cu", 1423.238},
      {"microwave/microwave.kicad_pcb", "F.Cu", 1273.120},
      {"stickhub/StickHub.kicad_pcb", "F.Cu", 420.406},
      {"stickhub/StickHub.kicad_pcb", "B.Cu", 488.379},
      {"test_pads_inside_pads/test_pads_inside_pads.kicad_pcb", "B.Cu", 62.212},
  };
  const fs::path demos = "/usr/share/kicad/demos";
  if (!fs::exists(demos)) GTEST_SKIP() << "no " << demos << ": the Debian package kicad-demos";
  for (const Known& one : known) {
    const DesignBoard board = good_board(bytes_of(demos / one.file));
    const auto layer = std::ranges::find(board.copper, one.layer, &DesignLayer::name);
    ASSERT_NE(layer, board.copper.end()) << one.file;
    EXPECT_NEAR(area_mm2(layer->layer.dark) / one.mm2, 1, 1e-4) << one.file << " " << one.layer;
  }
}

TEST(KicadBoard, reads_what_older_programs_wrote) {
  const DesignBoard board = good_board(
      "(kicad_pcb (version 20171130) (host pcbnew 5.0)\n"
      "(layers (0 Component signal) (1 Ground power) (31 Copper signal) (44 Edge.Cuts user))\n"
      "(segment (start 0 0) (end 10 0) (width 1) (layer Copper) (net 0))\n"
      "(module M (layer Component) (at 20 10 90) (pad 1 smd rect (at 1 0 90) (size 2 1) (layers Component)))\n"
      "(gr_arc (start 50 50) (end 60 50) (angle 90) (layer Edge.Cuts) (width 0.1))\n"
      "(gr_circle (center 50 50) (end 51 50) (layer Copper) (width 0))\n"
      "(zone (net 0) (layer Copper) (min_thickness 0.5) (filled_polygon (pts (xy 30 0) (xy 40 0) (xy 40 10) (xy 30 "
      "10))))\n"
      "(zone (net 0) (layer Component) (min_thickness 0.5) (fill_segments (pts (xy 30 0) (xy 40 0))))\n"
      ")");
  ASSERT_EQ(board.copper.size(), 3U);
  EXPECT_EQ(board.copper[0].name, "F.Cu");
  EXPECT_EQ(board.copper[1].name, "In1.Cu");
  const double pi = 3.14159265358979;
  // A track, a disc, and a zone with its line around it.
  const double zone = 100 + 4 * 10 * 0.25 + pi * 0.0625;
  EXPECT_NEAR(area_mm2(board.copper[2].layer.dark), 10 + pi / 4 + pi + zone, 0.02);
  EXPECT_NEAR(area_mm2(board.copper[0].layer.dark), 2 + 10 * 0.5 + pi / 16, 0.01);
  // The pad lies above the footprint's middle, and is upright.
  const Region pad = parts_of(board.copper[0].layer.dark).front();
  const DrawnBox box =
      *bounds(pad.rings.front().front().y.count < -5'000'000 ? pad : parts_of(board.copper[0].layer.dark)[1]);
  EXPECT_EQ(box.least, (DrawnPoint{{19'500'000}, {-10'000'000}}));
  EXPECT_EQ(box.most, (DrawnPoint{{20'500'000}, {-8'000'000}}));
  // Clockwise from the right to below.
  const std::vector<PathPoint>& arc = board.edge.strokes.paths.at(0).points;
  EXPECT_EQ(arc.front().at, (DrawnPoint{{60'000'000}, {-50'000'000}}));
  EXPECT_EQ(arc.back().at, (DrawnPoint{{50'000'000}, {-60'000'000}}));
  EXPECT_LT(arc.front().bulge, 0);
}

TEST(KicadBoard, notes_what_it_leaves_out) {
  const DesignBoard board = good_board(board_with(
      "(gr_text \"(c) me\" (at 0 0) (layer \"F.Cu\") (effects (font (size 1 1))))\n"
      "(zone (net 1) (layers \"F.Cu\" \"B.Cu\") (min_thickness 0.2) (polygon (pts (xy 0 0) (xy 1 0) (xy 1 1))))\n"
      "(zone (net 0) (layers \"F.Cu\" \"B.Cu\") (keepout (tracks not_allowed)) (polygon (pts (xy 0 0) (xy 1 0))))\n"
      "(footprint \"a\" (layer \"F.Cu\") (at 0 0) (property \"Reference\" \"R1\" (at 0 0) (layer \"F.Cu\") (hide "
      "yes)))"));
  EXPECT_EQ(board.copper[0].layer.strokes.notes.size(), 2U);
  EXPECT_EQ(board.copper[1].layer.strokes.notes.size(), 1U);
}

TEST(KicadBoard, a_pad_may_have_another_shape_on_another_layer) {
  const DesignBoard board = good_board(board_with(
      "(footprint \"a\" (layer \"F.Cu\") (at 0 0) (pad \"1\" thru_hole circle (at 0 0) (size 2 2) (drill 1)\n"
      "(layers \"*.Cu\") (padstack (mode front_inner_back) (layer \"B.Cu\" (shape rect) (size 3 1)))))"));
  EXPECT_NEAR(area_mm2(board.copper[0].layer.dark), 3.1416, 0.01);
  EXPECT_NEAR(area_mm2(board.copper[1].layer.dark), 3, 1e-6);
}

TEST(KicadBoard, an_arc_whose_three_points_lie_on_a_line_is_a_line) {
  const DesignBoard board =
      good_board(board_with("(gr_arc (start 1 1) (mid 5 1) (end 3 1) (layer \"Edge.Cuts\") (width 0.1))"
                            "(gr_arc (start 1 2) (mid 5 2.0000001) (end 3 2) (layer \"Edge.Cuts\") (width 0.1))"));
  ASSERT_EQ(board.edge.strokes.paths.size(), 2U);
  for (const DrawnPath& path : board.edge.strokes.paths) {
    EXPECT_EQ(path.points.size(), 2U);
    EXPECT_EQ(path.points.front().bulge, 0);
  }
}

TEST(KicadBoard, wrong_files_are_refused_with_their_place) {
  EXPECT_EQ(refusal_of("(kicad_sch (version 1))"), "kicad.no-board 1:1");
  EXPECT_EQ(refusal_of("(kicad_pcb (version 1)"), "kicad.cut-off 1:23");
  EXPECT_EQ(refusal_of("(kicad_pcb (version 1))"), "kicad.no-board 0:0");
  EXPECT_EQ(refusal_of(board_with("(segment (start 0 zero) (end 1 1) (width 1) (layer \"F.Cu\"))")),
            "kicad.bad-number 3:19");
  EXPECT_EQ(refusal_of(board_with("(via (at 0) (size 1) (layers \"F.Cu\" \"B.Cu\"))")), "kicad.bad-number 3:6");
  EXPECT_EQ(refusal_of(board_with("(via (at 0 1e9) (size 1) (layers \"F.Cu\" \"B.Cu\"))")), "kicad.bad-number 3:12");
  EXPECT_EQ(refusal_of(board_with("(net 1 \"open)")), "kicad.cut-off 3:8");
  EXPECT_EQ(refusal_of(board_with(std::string(100, '(') + std::string(100, ')'))), "kicad.too-deep 3:66");
  EXPECT_EQ(
      refusal_of(board_with("(footprint \"a\" (at 0 0)\n (pad \"1\" smd star (at 0 0) (size 1 1) (layers F.Cu)))")),
      "kicad.bad-pad 4:2");
}

}  // namespace
}  // namespace passo
