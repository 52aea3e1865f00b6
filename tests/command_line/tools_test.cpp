// passo tools, and the cutters of a library in passo cam, from the command line.
#include <algorithm>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::json;
using passo::test::checkout;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

const std::string tool_library = checkout + "/examples/tools/router-tools.toml";
const std::string bracket_drawing = checkout + "/examples/parts/bracket.svg";

class Tools : public passo::test::CommandLine {
 protected:
  json json_of(const std::string& arguments) const {
    const Outcome done = passo(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    return json::parse(done.out);
  }
  std::vector<std::string> warnings_of(const std::string& arguments) const {
    std::vector<std::string> codes;
    const json made = json_of(arguments + " --json -o " + path("part.ngc"));
    for (const json& one : made.at("warnings")) codes.push_back(one["code"]);
    return codes;
  }
  const std::string pocket = "cam pocket " + bracket_drawing + " --layer pocket --tool-table " + tool_library;
};

TEST_F(Tools, are_listed_as_a_table_and_as_json) {
  const Outcome done = passo("tools list " + tool_library);
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("\nT1     flat           6      2       22        28   24000  carbide  roughing\n"));
  EXPECT_THAT(done.out, HasSubstr("(does not plunge)\n"));
  const json all = json_of("tools list --json " + tool_library)["tools"];
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all[5]["chip_load_mm"]["acrylic"], 0.08);
  EXPECT_EQ(all[6]["centre_cutting"], false);
  EXPECT_NEAR(all[7]["angle_deg"], 118, 1e-9);
}

TEST_F(Tools, have_feeds_with_reasons_within_the_limits_of_a_machine) {
  const json free = json_of("tools feeds " + tool_library + " -t T1 --material plywood --json");
  EXPECT_NEAR(free["feed_mm_min"], free["rpm"].get<double>() * 2 * free["chip_load_mm"].get<double>(), 20);
  const std::string machine = checkout + "/examples/machines/pantograph.toml";
  const json limited = json_of("tools feeds " + tool_library + " -t 1 --material plywood --json -m " + machine);
  EXPECT_LT(limited["feed_mm_min"], free["feed_mm_min"]);
  EXPECT_LT(limited["rpm"], free["rpm"]);
  const Outcome words = passo("tools feeds " + tool_library + " -t 1 --material plywood -m " + machine);
  EXPECT_THAT(words.out, HasSubstr("https://www.asttooling.com/"));
  EXPECT_THAT(words.out, HasSubstr("the limit of the machine"));
}

TEST_F(Tools, of_a_bad_library_or_number_are_refused) {
  const std::string bad = write("bad.toml", "[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\nflute = 9\n");
  const Outcome listed = passo("tools list " + bad);
  EXPECT_EQ(listed.code, 2);
  EXPECT_THAT(listed.err, HasSubstr("bad.toml:4:1: error: a tool library has no key tool.1.flute [tools.unknown-key]"));
  for (const std::string tool : {"9", "T", "x", "-1"}) {
    const Outcome none = passo("tools feeds " + tool_library + " --tool=" + tool + " --material mdf");
    EXPECT_EQ(none.code, 2);
    EXPECT_THAT(none.err, HasSubstr("expected one of T1, T2")) << tool;
  }
  EXPECT_EQ(passo("tools feeds " + tool_library + " -t 1 --material steel").code, 2);
  EXPECT_EQ(passo("tools feeds " + tool_library + " -t 1 --material mdf --min-rpm 9000 --max-rpm 8000").code, 2);
  EXPECT_EQ(passo("tools list " + path("none.toml")).code, 2);
}

TEST_F(Tools, of_a_library_give_a_pocket_its_feeds_and_are_named_in_the_program) {
  EXPECT_TRUE(warnings_of(pocket + " --tool T6 --material hdpe --depth -3").empty());
  const std::string program = read(path("part.ngc"));
  EXPECT_THAT(program, HasSubstr("(tool: T6 \"one flute, for plastics and aluminium\", flat end, 3 mm; "));
  EXPECT_THAT(program, HasSubstr(" mm per tooth in hdpe)\n"));
  EXPECT_THAT(program, HasSubstr("\nM3 S18000\n"));
  const json feeds = json_of("tools feeds " + tool_library + " -t 6 --material hdpe --json");
  EXPECT_THAT(program, HasSubstr("F" + std::to_string(feeds["feed_mm_min"].get<int>()) + "\n"));
  const Outcome cut =
      passo("simulate " + path("part.ngc") + " --tool-table " + tool_library + " --tool flat:3 --cell 0.2");
  EXPECT_EQ(cut.code, 0) << cut.err;
}

TEST_F(Tools, give_way_to_options_of_the_command_line) {
  const Outcome made =
      passo(pocket + " --tool T6 --material hdpe --depth -3 --feed 1500 --spindle 12000 -o " + path("a.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(read(path("a.ngc")), HasSubstr("F1500\n"));
  EXPECT_THAT(read(path("a.ngc")), HasSubstr("M3 S12000\n"));
}

TEST_F(Tools, warn_about_their_use_with_advice_that_helps) {
  const std::string deep = pocket + " --tool T6 --material hardwood --depth -14 --spindle 12000 ";
  EXPECT_THAT(warnings_of(deep + "--feed 100"), testing::ElementsAre("tool.depth-over-flutes", "tool.chip-small"));
  const Outcome shown = passo(deep + "--feed 100 -o " + path("a.ngc"));
  EXPECT_THAT(shown.err,
              HasSubstr("warning: T6 cuts 14 mm deep, but its flutes are 12 mm long [tool.depth-over-flutes]"));
  EXPECT_THAT(shown.err, HasSubstr("= expected: a feed of 576 mm/min"));
  EXPECT_TRUE(warnings_of(pocket + " --tool T6 --material hardwood --depth -12 --spindle 12000 --feed 576").empty());
}

TEST_F(Tools, that_cannot_plunge_get_a_ramp) {
  const std::string profile = "cam profile " + bracket_drawing + " --layer cut --tool-table " + tool_library +
                              " --tool T7 --depth -2 --step 1 ";
  EXPECT_TRUE(warnings_of(profile + "--material fr4").empty());
  EXPECT_THAT(warnings_of(profile + "--material fr4 --ramp 0"), testing::ElementsAre("tool.plunge"));
}

TEST_F(Tools, of_other_shapes_or_without_a_library_are_refused) {
  const auto refusal = [&](const std::string& arguments) {
    const Outcome made = passo(arguments + " -o " + path("none.ngc"));
    EXPECT_EQ(made.code, 2) << arguments;
    EXPECT_FALSE(std::filesystem::exists(path("none.ngc")));
    return made.err;
  };
  EXPECT_THAT(refusal(pocket + " --tool T3"), HasSubstr("expected a tool of shape flat, ball or bull, found T3"));
  EXPECT_THAT(refusal(pocket + " --tool T77"), HasSubstr("[tool.unknown]"));
  EXPECT_THAT(refusal(pocket), HasSubstr("[tool.none-chosen]"));
  EXPECT_THAT(refusal("cam pocket " + bracket_drawing + " --tool T1"), HasSubstr("[tool.no-library]"));
  EXPECT_THAT(refusal("cam pocket " + bracket_drawing + " --material mdf"), HasSubstr("[tool.no-library]"));
}

TEST_F(Tools, of_a_library_chamfer_with_their_own_angle_and_tip) {
  const std::string chamfer = "cam profile " + bracket_drawing + " --layer cut --chamfer 0.5 -o " + path("v.ngc");
  const std::string with = " --tool-table " + tool_library + " --tool T3";
  const Outcome by_hand = passo(chamfer + " --angle 60 --tip 0.1");
  const Outcome made = passo(chamfer + with);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("the tip is at Z-1.039 mm, its centre 0.15 mm beside the edge\n"));
  EXPECT_EQ(made.out, by_hand.out);
  EXPECT_THAT(read(path("v.ngc")), HasSubstr("(tool: T3 \"lettering\", V of 60 degrees, 6 mm, tip 0.1 mm)"));
  EXPECT_THAT(passo(chamfer + with + " --angle 90 --tip 0.2").out, HasSubstr("Z-0.6 mm, its centre 0.2 mm beside"));
}

TEST_F(Tools, of_the_wrong_shape_do_not_cut_profiles_or_chamfers) {
  const std::string profile = "cam profile " + bracket_drawing + " --layer cut -o " + path("none.ngc") +
                              " --tool-table " + tool_library + " --tool ";
  for (const std::string tool : {"T3", "T5", "T8"}) {
    const Outcome made = passo(profile + tool);
    EXPECT_EQ(made.code, 2) << tool;
    EXPECT_THAT(made.err, HasSubstr("expected a tool of shape flat, ball or bull, found " + tool));
  }
  for (const std::string tool : {"T1", "T2", "T5", "T8"}) {
    const Outcome made = passo(profile + tool + " --chamfer 0.5");
    EXPECT_EQ(made.code, 2) << tool;
    EXPECT_THAT(made.err, HasSubstr("expected a tool of shape vee, found " + tool));
    EXPECT_THAT(made.err, HasSubstr("[tool.wrong-shape]"));
  }
  EXPECT_FALSE(std::filesystem::exists(path("none.ngc")));
}

TEST_F(Tools, of_the_wrong_shape_do_not_engrave_drill_or_carve) {
  const std::string with = " -o " + path("none.ngc") + " --tool-table " + tool_library;
  const std::string board = "cam drill " + checkout + "/examples/boards/timer.drl --route-steps 0";
  const auto refused = [&](const std::string& command, const std::string& expected) {
    const Outcome made = passo(command + with);
    EXPECT_EQ(made.code, 2) << command;
    EXPECT_THAT(made.err, HasSubstr(expected));
    EXPECT_THAT(made.err, HasSubstr("[tool.wrong-shape]"));
  };
  refused("cam engrave " + bracket_drawing + " --on-line --tool T8", "--tool: expected a tool of shape vee, found T8");
  refused("cam engrave " + bracket_drawing + " --on-line --tool T1", "--tool: expected a tool of shape vee, found T1");
  refused(board + " --drill T2", "--drill: expected a tool of shape drill, flat, bull or vee, found T2");
  refused(board + " --drill T5", "--drill: expected a tool of shape drill, flat, bull or vee, found T5");
  const std::string heights = write("map.csv", "0,0,0\n10,0,1\n0,10,1\n10,10,0\n");
  refused("cam relief " + heights + " --depth -2 --cutter T8", "found T8");
  EXPECT_FALSE(std::filesystem::exists(path("none.ngc")));
}

TEST_F(Tools, cut_no_chamfer_that_is_wider_than_their_flank) {
  const std::string chamfer = "cam profile " + bracket_drawing + " --layer cut -o " + path("c.ngc") + " --chamfer ";
  const std::string with = " --tool-table " + tool_library + " --tool T3";
  const std::string limit = "--chamfer: expected at most 2.85 mm with a cutter of 6 mm and a tip of 0.1 mm, found '";
  EXPECT_THAT(passo(chamfer + "2.9" + with).err, HasSubstr(limit + "2.9' [tool.chamfer-width]"));
  EXPECT_THAT(passo(chamfer + "100" + with).err, HasSubstr(limit + "100'"));
  EXPECT_THAT(passo(chamfer + "3 --tool 6 --tip 0.1").err, HasSubstr(limit + "3'"));
  EXPECT_THAT(passo(chamfer + "100").err, HasSubstr("--chamfer: expected at most 24.9 mm, with a cutter of 50 mm"));
  EXPECT_THAT(passo(chamfer + "1 --tool 2 --tip 2").err, HasSubstr("expected a wider cutter or a narrower tip"));
  EXPECT_FALSE(std::filesystem::exists(path("c.ngc")));
  EXPECT_EQ(passo(chamfer + "2.85" + with).code, 0);
}

TEST_F(Tools, warn_about_a_pass_that_is_deeper_than_the_flutes) {
  const std::string feeds = "tools feeds " + tool_library + " -t 6 --material hdpe --depth ";
  const Outcome deep = passo(feeds + "30");
  EXPECT_EQ(deep.code, 0);
  EXPECT_THAT(deep.err,
              HasSubstr("warning: T6 cuts 30 mm deep, but its flutes are 12 mm long [tool.depth-over-flutes]"));
  EXPECT_EQ(json_of(feeds + "30 --json")["warnings"][0]["code"], "tool.depth-over-flutes");
  EXPECT_EQ(passo(feeds + "12").err, "");
  EXPECT_TRUE(json_of(feeds + "12 --json")["warnings"].empty());
}

TEST_F(Tools, of_a_library_isolate_and_cut_boards_out) {
  const std::string library = " --tool-table " + tool_library + " -o " + path("b.ngc");
  const std::string pads = write("pads.gbr",
                                 "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,2*%\nD10*\nX5000000Y5000000D03*\n"
                                 "X12000000Y5000000D03*\nM02*\n");
  EXPECT_EQ(passo("cam isolate " + pads + " --tool T3 --depth -0.1 --material fr4" + library).code, 0);
  // A V-bit of 60 degrees with a tip of 0.1 mm is 0.215 mm wide at 0.1 mm.
  EXPECT_THAT(read(path("b.ngc")), HasSubstr("V 60 degrees, tip 0.1 mm: 0.2155 mm at the face"));
  EXPECT_THAT(read(path("b.ngc")), HasSubstr("mm per tooth in fr4"));
  EXPECT_THAT(read(path("b.ngc")), Not(HasSubstr("F200\n"))) << "the feed follows from the tool";
  EXPECT_EQ(passo("cam isolate " + pads + " --tool T7,0.3" + library).code, 0);
  EXPECT_THAT(passo("cam isolate " + pads + " --tool T3,T3" + library).err, HasSubstr("[tool.wrong-shape]"));
  EXPECT_THAT(passo("cam isolate " + pads + " --tool T2" + library).err, HasSubstr("[tool.wrong-shape]"));
  const std::string edge = checkout + "/examples/boards/timer-Edge_Cuts.gbr";
  const Outcome cut = passo("cam outline " + edge + " --tool T7 --material fr4" + library);
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(read(path("b.ngc")), HasSubstr("(tool: T7 \"fine corn cutter, for boards\""));
}

TEST_F(Tools, are_the_rack_of_a_drill_program) {
  const std::string library = write("rack.toml",
                                    "[tool.1]\nshape = \"drill\"\ndiameter_mm = 0.8\n[tool.2]\nshape = \"drill\"\n"
                                    "diameter_mm = 1\n[tool.3]\nshape = \"drill\"\ndiameter_mm = 3\n[tool.4]\n"
                                    "shape = \"flat\"\ndiameter_mm = 2\n");
  const std::string drill = "cam drill " + checkout + "/examples/boards/timer.drl --mill 1 --tool-table " + library;
  const Outcome all = passo(drill + " --tools all --material fr4 -o " + path("all.ngc"));
  EXPECT_EQ(all.code, 0) << all.err;
  const std::string program = read(path("all.ngc"));
  EXPECT_THAT(program, HasSubstr("(drill: T1 drill, 0.8 mm"));
  EXPECT_THAT(program, Not(HasSubstr("0.75 mm"))) << "the rack has no such drill";
  const auto feed_after = [&](const std::string& message) {
    const std::size_t at = program.find("\nF", program.find("MSG, " + message));
    return std::stod(program.substr(at + 2));
  };
  EXPECT_LT(feed_after("tool 1: drill 0.8"), feed_after("tool 2: drill 1")) << "each drill has its own feed";
  EXPECT_EQ(passo(drill + " --tools T1,T2,3 -o " + path("some.ngc")).code, 0);
  EXPECT_THAT(passo(drill + " --tools T9").err, HasSubstr("[tool.unknown]"));
  EXPECT_THAT(passo("cam drill " + checkout + "/examples/boards/timer.drl --tools all").err,
              HasSubstr("[tool.no-library]"));
  const std::string profile =
      write("profile.toml", "[drill]\nmill = \"1\"\n[outline]\ntool = \"T4\"\nfeed = \"333\"\n");
  const Outcome board = passo("cam board " + checkout + "/examples/boards --accept-joined --profile " + profile +
                              " --material fr4 --tool-table " + library + " -o " + path("job"));
  EXPECT_EQ(board.code, 0) << board.err;
  EXPECT_THAT(read(path("job/1-drill.ngc")), HasSubstr("(drill: T1 drill, 0.8 mm"));
  EXPECT_THAT(read(path("job/3-outline.ngc")), HasSubstr("(tool: T4 flat end, 2 mm"));
  EXPECT_THAT(read(path("job/3-outline.ngc")), HasSubstr("F333\n")) << "the profile takes precedence";
}

TEST_F(Tools, of_a_library_engrave_drill_and_carve) {
  const std::string with = " --tool-table " + tool_library + " -o " + path("made.ngc") + " ";
  const Outcome letters = passo("cam engrave --text Hi --tool T3 --material hardwood" + with);
  EXPECT_EQ(letters.code, 0) << letters.err;
  EXPECT_THAT(read(path("made.ngc")), HasSubstr("(tool: T3 \"lettering\", V of 60 degrees, 6 mm, tip 0.1 mm; "));
  const Outcome holes =
      passo("cam drill " + checkout + "/examples/boards/timer.drl --drill T8 --material fr4 --route-steps 0" + with);
  EXPECT_EQ(holes.code, 0) << holes.err;
  EXPECT_THAT(read(path("made.ngc")), HasSubstr("(drill: T8 \"pilot holes\", drill, 3 mm; "));
  const std::string heights = write("map.csv", "0,0,0\n10,0,1\n0,10,1\n10,10,0\n");
  const Outcome relief =
      passo("cam relief " + heights + " --cutter T2 --rough T1 --material hardwood --depth -2 --scallop 0.2" + with);
  EXPECT_EQ(relief.code, 0) << relief.err;
  EXPECT_THAT(read(path("made.ngc")), HasSubstr("(roughing: T1 \"roughing\", flat end, 6 mm; "));
  // A feed that is far too low: the warning is shown, and stands once in the summary.
  for (const std::string& command : {"drill " + checkout + "/examples/boards/timer.drl --drill T8 --route-steps 0",
                                     "relief " + heights + " --cutter T2 --depth -2 --scallop 0.2"}) {
    const Outcome slow = passo("cam " + command + " --material fr4 --feed 2 --json" + with);
    EXPECT_EQ(slow.code, 0) << slow.err;
    const json summary = json::parse(slow.out);
    ASSERT_EQ(summary["warnings"].size(), 1U) << slow.out;
    EXPECT_THAT(slow.err, HasSubstr("[" + summary["warnings"][0].at("code").get<std::string>() + "]"));
  }
}

const std::string tool_files = checkout + "/examples/tools/";

TEST_F(Tools, of_other_programs_are_imported_with_a_list_of_what_was_not) {
  const std::string made = path("made.toml");
  const json fusion = json_of("tools import " + tool_files + "fusion-export.json --json -o " + made);
  EXPECT_EQ(fusion["format"], "fusion");
  EXPECT_EQ(fusion["tools"].size(), 5U);
  EXPECT_EQ(fusion["left_out"][0]["place"], "/data/5");
  EXPECT_EQ(json_of("tools list --json " + made)["tools"][1]["diameter_mm"], 3.175);
  const Outcome twice = passo("tools import " + tool_files + "fusion-export.json -o " + made);
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("[tools.exists]"));
  const Outcome library = passo("tools import --force " + tool_files + "freecad/Library/Router.fctl -o " + made);
  EXPECT_EQ(library.code, 0) << library.err;
  EXPECT_THAT(library.out, HasSubstr("2 tools of "));
  EXPECT_THAT(library.out, HasSubstr("missing.fctb is missing next to the library"));
  const Outcome shapeless = passo("tools import " + tool_files + "linuxcnc.tbl --units mm -o " + path("none.toml"));
  EXPECT_EQ(shapeless.code, 2);
  EXPECT_THAT(shapeless.err, HasSubstr("[tool-import.none]"));
  EXPECT_FALSE(std::filesystem::exists(path("none.toml")));
  EXPECT_EQ(passo("tools import " + tool_files + "linuxcnc.tbl --units mm --shape flat -o " + path("mill.toml")).code,
            0);
}

TEST_F(Tools, are_exported_to_linuxcnc_and_json_and_read_again) {
  EXPECT_EQ(passo("tools export " + tool_library + " -o " + path("tools.json")).code, 0);
  EXPECT_EQ(passo("tools import " + path("tools.json") + " -o " + path("again.toml")).code, 0);
  EXPECT_EQ(json_of("tools list --json " + path("again.toml"))["tools"],
            json_of("tools list --json " + tool_library)["tools"]);
  EXPECT_EQ(passo("tools export " + tool_library + " -o " + path("tool.tbl")).code, 2) << "units";
  EXPECT_EQ(passo("tools export " + tool_library + " --units inch -o " + path("tool.tbl")).code, 0);
  EXPECT_THAT(read(path("tool.tbl")), HasSubstr("T1 P1 D0.23622 ; "));
  EXPECT_EQ(passo("tools export " + tool_library + " -o " + path("tools.xyz")).code, 2);
}

TEST_F(Tools, wear_and_a_check_warns_where_a_life_ends) {
  const std::string library = write("life.toml",
                                    "[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\nlife_m = 0.25\n"
                                    "[tool.2]\nshape = \"flat\"\ndiameter_mm = 3\nlife_min = 600\n");
  const std::string job = write("job.ngc", "G21\nT1 M6\nM3 S1000\nG1 X100 F600\nX0\nX100\nT2 M6\nM3\nG1 X0\nM5\nM2\n");
  const std::string machine = " -m " + checkout + "/examples/machines/router.toml ";
  const std::string records = " --tool-records " + path("tools.sqlite");
  const Outcome fresh = passo("check " + job + machine + "--tool-table " + library + records);
  EXPECT_THAT(fresh.err, HasSubstr("job.ngc:6: warning: the life of T1 ends here: the program cuts 0.3 m with it"));
  EXPECT_THAT(fresh.err, Not(HasSubstr("T2")));
  const Outcome run = passo("run " + job + machine + "--yes -q --tool-table " + library + records);
  ASSERT_EQ(run.code, 0) << run.err;
  const json tools = json_of("tools life " + library + records + " --json")["tools"];
  EXPECT_NEAR(tools[0]["cut_m"], 0.3, 1e-6);
  EXPECT_NEAR(tools[1]["cut_m"], 0.1, 1e-6);
  EXPECT_GE(tools[1]["cut_min"], 100.0 / 600);
  EXPECT_LT(tools[1]["cut_min"], 100.0 / 600 + 0.05) << "with its ramps";
  EXPECT_EQ(passo("tools life --replaced T1" + records).code, 0);
  const json anew = json_of("tools life " + library + records + " --json")["tools"];
  EXPECT_EQ(anew[0]["cut_m"], 0);
  EXPECT_GT(anew[0]["replaced_at"], 1e9);
  EXPECT_NEAR(anew[1]["cut_m"], 0.1, 1e-6);
  EXPECT_EQ(passo("tools life --replaced T0" + records).code, 2);
}

}  // namespace
