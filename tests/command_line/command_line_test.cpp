// The program itself, as a user starts it: what it prints, what it leaves behind, and how it exits.
#include "kit/command_line.hpp"

#include <cstdio>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using passo::test::checkout;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;

const std::string engrave = checkout + "/examples/engrave.ngc";

class CommandLine : public passo::test::CommandLine {
 protected:
  // Runs a program text on the router.
  Outcome run_text(const std::string& text, const std::string& options = "") const {
    return passo("run " + write("p.ngc", text) + on_router + options);
  }
};

TEST_F(CommandLine, help_teaches_with_examples_and_exits_well) {
  const Outcome outcome = passo("--help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("passo run part.ngc --machine router.toml"), std::string::npos);
  EXPECT_EQ(passo("--version").code, 0);
}

TEST_F(CommandLine, a_wrong_command_line_exits_with_2) {
  EXPECT_EQ(passo("").code, 2);
  EXPECT_EQ(passo("fly").code, 2);
  EXPECT_EQ(passo("run " + engrave).code, 2);
  EXPECT_EQ(passo("run " + engrave + on_router + "--colour").code, 2);
}

TEST_F(CommandLine, json_tells_time_steps_and_position_of_each_axis) {
  const Outcome outcome = run_text("G21 G90 G1 X10 Y-2.5 F600\nM2\n", "--json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["steps"]["X"]["net"], 6400);
  EXPECT_EQ(json["steps"]["Y"]["net"], -1600);
  EXPECT_EQ(json["steps"]["Y"]["total"], 1600);
  EXPECT_EQ(json["steps"]["Z"]["total"], 0);
  EXPECT_DOUBLE_EQ(json["position_mm"]["X"], 10.0);
  EXPECT_DOUBLE_EQ(json["position_mm"]["Y"], -2.5);
  EXPECT_GT(json["time_s"], 10.3078 / 10);
}

TEST_F(CommandLine, a_there_and_back_counts_all_steps_and_ends_at_zero) {
  const Outcome outcome = run_text("G21 G90 G1 X3 F600\nX0\nM2\n", "--json");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["steps"]["X"]["net"], 0);
  EXPECT_EQ(json["steps"]["X"]["total"], 2 * 3 * 640);
}

TEST_F(CommandLine, pictures_traces_and_reports_are_written_where_they_were_asked_for) {
  const Outcome outcome =
      run_text("G21 G1 X1 F600\nM2\n", "--picture " + path("a.png") + " --picture " + path("a.svg") + " --trace " +
                                           path("a.vcd") + " --trace " + path("a.csv") + " --report " + path("a.json"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(read(path("a.png")).substr(1, 3), "PNG");
  EXPECT_NE(read(path("a.svg")).find("<svg"), std::string::npos);
  EXPECT_NE(read(path("a.vcd")).find("$timescale"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(read(path("a.json")))["steps"]["X"]["net"], 640);
}

TEST_F(CommandLine, the_csv_trace_adds_up_to_the_steps_counted) {
  ASSERT_EQ(run_text("G21 G2 X10 Y0 I5 F600\nG1 Z-1\nM2\n", "-q --trace " + path("t.csv")).code, 0);
  std::ifstream file(path("t.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line, "t,x,y,z");
  long x = 0;
  long y = 0;
  long z = 0;
  double last = -1;
  while (std::getline(file, line)) {
    double t = 0;
    int dx = 0;
    int dy = 0;
    int dz = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%d,%d,%d", &t, &dx, &dy, &dz), 4) << line;
    EXPECT_GT(t, last);
    EXPECT_TRUE(dx != 0 || dy != 0 || dz != 0);
    last = t;
    x += dx;
    y += dy;
    z += dz;
  }
  EXPECT_EQ(x, 6400);
  EXPECT_EQ(y, 0);
  EXPECT_EQ(z, -640);
}

TEST_F(CommandLine, a_hold_stops_for_good_or_for_as_long_as_was_said) {
  const std::string program = "G21 G1 X50 F600\nM2\n";
  const auto whole = nlohmann::json::parse(run_text(program, "--json").out);
  const auto stopped = nlohmann::json::parse(run_text(program, "--json --hold-at 1").out);
  EXPECT_LT(stopped["steps"]["X"]["total"], whole["steps"]["X"]["total"]);
  const auto paused = nlohmann::json::parse(run_text(program, "--json --hold-at 1:2 --override 150@3.5").out);
  EXPECT_EQ(paused["steps"]["X"]["total"], whole["steps"]["X"]["total"]);
  EXPECT_EQ(paused["holds"].size(), 1);
}

TEST_F(CommandLine, a_hold_or_an_override_that_makes_no_sense_is_refused) {
  for (const char* option :
       {"--hold-at inf", "--hold-at -1", "--hold-at nan", "--hold-at 1:inf", "--hold-at 1:1e300",
        "--hold-at 1:", "--override 100", "--override -1@1", "--override 201@1", "--override 50@inf"}) {
    const Outcome outcome = run_text("G21 G1 X1 F600\nM2\n", option);
    EXPECT_EQ(outcome.code, 2) << option;
    EXPECT_NE(outcome.err.find("expected --"), std::string::npos) << option << outcome.err;
  }
}

// Measured from the steps of X: 640 steps/mm, at F600 6400 steps/s. A change takes effect within 0.1 s.
TEST_F(CommandLine, adaptive_feed_scales_the_speed_where_the_program_enables_it) {
  write("load.csv", "time_s,factor\n0,1\n1,0.25\n3,0\n4,1\n");
  const std::string options = "-q --adaptive-feed " + path("load.csv") + " --trace " + path("t.csv");
  const auto steps_between = [&](double from, double to) {
    std::istringstream lines(read(path("t.csv")));
    std::string line;
    int steps = 0;
    while (std::getline(lines, line)) {
      const double t = std::strtod(line.c_str(), nullptr);
      if (t > from && t < to) ++steps;
    }
    return steps;
  };
  EXPECT_EQ(run_text("G21 M52 P1\nG1 X20 F600\nM2\n", options).code, 0);
  EXPECT_NEAR(steps_between(0.2, 0.9), 0.7 * 6400, 2);
  EXPECT_NEAR(steps_between(1.2, 2.9), 1.7 * 1600, 2);
  EXPECT_EQ(steps_between(3.2, 3.9), 0);
  EXPECT_NEAR(steps_between(4.2, 4.4), 0.2 * 6400, 2);
  EXPECT_EQ(steps_between(0, 9), 12800);
  EXPECT_EQ(run_text("G21 G1 X20 F600\nM2\n", options).code, 0);
  EXPECT_NEAR(steps_between(1.2, 1.9), 0.7 * 6400, 2);
}

TEST_F(CommandLine, a_wrong_file_of_adaptive_feed_is_refused) {
  write("load.csv", "0,1\n1,-0.5\n");
  const Outcome wrong = run_text("G21 G1 X20 F600\nM2\n", "--adaptive-feed " + path("load.csv"));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("load.csv:2:1: error"), std::string::npos) << wrong.err;
  EXPECT_NE(wrong.err.find("adaptive-feed.bad-line"), std::string::npos) << wrong.err;
  EXPECT_EQ(run_text("G21 G1 X20 F600\nM2\n", "--adaptive-feed " + path("none.csv")).code, 2);
}

TEST_F(CommandLine, an_existing_picture_survives_a_program_that_is_wrong) {
  write("a.png", "precious");
  const Outcome outcome = run_text("G21 G1 X1\nM2\n", "--picture " + path("a.png"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(read(path("a.png")), "precious");
}

TEST_F(CommandLine, a_file_that_cannot_be_written_is_said_before_the_run) {
  const Outcome outcome = run_text("G21 G1 X1 F600\nM2\n", "--picture /nonexistent/dir/a.png");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("/nonexistent/dir/a.png"), std::string::npos);
  EXPECT_EQ(run_text("G21 G1 X1 F600\nM2\n", "--picture " + path("a.jpeg")).code, 2);
  EXPECT_EQ(run_text("G21 G1 X1 F600\nM2\n", "--trace " + path("a.xls")).code, 2);
}

struct BadProgram {
  const char* name;
  std::string text;
  const char* code;   // that must be named
  const char* place;  // file:line:column that must be named, after the file's name
};

void PrintTo(const BadProgram& bad, std::ostream* out) {
  *out << bad.name;
}

class BadPrograms : public CommandLine, public testing::WithParamInterface<BadProgram> {};

TEST_P(BadPrograms, are_refused_with_their_place_and_leave_nothing_behind) {
  const BadProgram& bad = GetParam();
  const Outcome outcome =
      run_text(bad.text, "--picture " + path("a.png") + " --trace " + path("a.csv") + " --report " + path("a.json"));
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find(std::string("[") + bad.code + "]"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(std::string("p.ngc") + bad.place), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), std::vector<std::string>());
  EXPECT_EQ(outcome.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    All, BadPrograms,
    testing::Values(
        BadProgram{"empty", "", "file.empty", ": error"},
        BadProgram{"binary",
                   "\x7f"
                   "ELF\0\0\0\1\2\3\0\0\0\0\0\0\0\0"s,
                   "file.binary", ""},
        BadProgram{"nul", "G21 G90 (a comment that is long enough to be text)\nG0 X1\0Y2\nM2\n"s, "gcode.nul-byte",
                   ":2:6"},
        BadProgram{"megabyte", "G21\n(" + std::string(1'000'000, 'x') + ")\nM2\n", "gcode.line-too-long", ":2"},
        BadProgram{"missing_feed", "G21\nG1 X1\nM2\n", "gcode.missing-feed", ":2:1"},
        BadProgram{"exponent", "G21\nG0 X1e999\nM2\n", "gcode.unused-word", ":2:6"},
        BadProgram{"huge_number", "G21\nG0 X1" + std::string(400, '0') + "\nM2\n", "gcode.number-out-of-range", ":2:"},
        BadProgram{"past_travel", "G21\nG0 Y1 X401 (too far)\nM2\n", "travel.exceeded", ":2:7"},
        BadProgram{"unknown_code", "G21\nG123 X1\nM2\n", "gcode.unknown-code", ":2:1"},
        BadProgram{"cr_only_counts_lines", "G21\rG1 X1\rM2\r", "gcode.missing-feed", ":2:1"},
        BadProgram{"crlf_counts_lines", "G21\r\nG1 X1\r\nM2\r\n", "gcode.missing-feed", ":2:1"},
        BadProgram{"bom_is_no_column", "\xEF\xBB\xBFG1 X1\nM2\n", "gcode.missing-feed", ":1:1"},
        BadProgram{"impossible_radius", "G21 F100\nG2 X10 Y0 R2\nM2\n", "gcode.impossible-arc", ":2:11"}),
    [](const testing::TestParamInfo<BadProgram>& param_info) { return param_info.param.name; });

TEST_F(CommandLine, all_errors_of_a_program_come_in_one_go) {
  const Outcome outcome = run_text("G21\nG1 X1\nG123\nG0 X9999\nM2\n");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("p.ngc:2:"), std::string::npos);
  EXPECT_NE(outcome.err.find("p.ngc:3:"), std::string::npos);
  EXPECT_NE(outcome.err.find("p.ngc:4"), std::string::npos);
  EXPECT_NE(outcome.err.find("3 errors"), std::string::npos) << outcome.err;
}

TEST_F(CommandLine, findings_tell_their_rule_and_the_calls_as_text_and_as_data) {
  const std::string text = "G21\no<slot> call\nM2\no<slot> sub\nG4\no<slot> endsub\n";
  const Outcome outcome = run_text(text);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("= rule: RS274/NGC 3.5.4, dwell\n"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("= in o<slot>, called at " + path("p.ngc") + ":2\n"), std::string::npos) << outcome.err;
  const Outcome data = passo("check --json " + path("p.ngc") + on_router);
  const auto finding = nlohmann::json::parse(data.out)["findings"][0];
  EXPECT_EQ(finding["rule"], "RS274/NGC 3.5.4, dwell");
  EXPECT_EQ(finding["calls"].size(), 1U);
  EXPECT_EQ(finding["calls"][0]["sub"], "o<slot>");
  EXPECT_EQ(finding["calls"][0]["line"], 2);
}

TEST_F(CommandLine, a_loop_that_does_nothing_is_stopped_at_its_o_word_after_as_many_passes_as_are_allowed) {
  const std::string program = write("p.ngc", "#1=0\no7 while [#1 LT 50]\n#1=[#1+1]\no7 endwhile\nM2\n");
  EXPECT_EQ(passo("canon " + program).code, 0);
  EXPECT_EQ(passo("canon --loop-limit 50 " + program).code, 0);
  for (const std::string& command : {"canon "s, "explain "s, "check" + on_router, "run" + on_router}) {
    const Outcome outcome = passo(command + "--loop-limit 49 " + program);
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_NE((outcome.out + outcome.err).find(":2:1: error: the loop ran 49 times"), std::string::npos) << command;
  }
  EXPECT_EQ(passo("canon --loop-limit 0 " + program).code, 2);
}

TEST_F(CommandLine, a_program_that_never_ends_is_an_error_wherever_it_is_read) {
  const std::string typo = write("typo.ngc", "#1=0\no1 while [#1 LT 5]\nG0 X#1\n#1=[#1+1\no1 endwhile\nM2\n");
  const std::string moving = write("moving.ngc", "o1 while [1]\nG0 X1\nG0 X2\no1 endwhile\nM2\n");
  for (const std::string& command : {"canon "s, "explain "s, "check" + on_router, "run" + on_router}) {
    const Outcome bad = passo(command + typo);
    EXPECT_EQ(bad.code, 2) << command;
    EXPECT_NE((bad.out + bad.err).find(":4:4: error: the bracket that opens here is not closed"), std::string::npos)
        << command;
    const Outcome endless = passo(command + "--step-limit 3000 " + moving);
    EXPECT_EQ(endless.code, 2) << command;
    EXPECT_NE((endless.out + endless.err).find(":1:1: error: the loop reached 3000 passes, calls and operations"),
              std::string::npos)
        << command;
  }
}

TEST_F(CommandLine, crlf_cr_and_a_byte_order_mark_are_fine) {
  for (const char* text : {"G21 F600\r\nG1 X1\r\nM2\r\n", "G21 F600\rG1 X1\rM2\r", "\xEF\xBB\xBFG21 F600\nG1 X1\nM2"}) {
    EXPECT_EQ(run_text(text).code, 0);
  }
}

TEST_F(CommandLine, a_missing_program_exits_with_2_and_a_missing_machine_with_3) {
  EXPECT_EQ(passo("run " + path("none.ngc") + on_router).code, 2);
  EXPECT_EQ(passo("run " + engrave + " -m " + path("none.toml")).code, 3);
  EXPECT_EQ(passo("run " + dir_.string() + on_router).code, 2);
}

TEST_F(CommandLine, a_mistake_in_the_machine_file_names_line_and_nearest_key) {
  std::string text = read(checkout + "/examples/machines/router.toml");
  text.replace(text.find("max_velocity_mm_s"), 17, "max_velocty_mm_s");
  const Outcome outcome = passo("run " + engrave + " -m " + write("m.toml", text));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("m.toml:"), std::string::npos);
  EXPECT_NE(outcome.err.find("max_velocity_mm_s"), std::string::npos) << outcome.err;
}

TEST_F(CommandLine, a_program_from_standard_input_runs) {
  const Outcome outcome = passo("run -" + on_router + "--json", "printf 'G21 F600\\nG1 X1\\nM2\\n' |");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["steps"]["X"]["net"], 640);
}

TEST_F(CommandLine, check_finds_what_run_would_refuse_and_runs_nothing) {
  EXPECT_EQ(passo("check " + engrave + on_router).code, 0);
  EXPECT_EQ(passo("check " + write("p.ngc", "G1 X1\n") + on_router).code, 2);
}

TEST_F(CommandLine, parameters_go_from_one_run_to_the_next) {
  const std::string parameters = "--parameters " + path("machine.var");
  ASSERT_EQ(run_text("G21 G90\nG0 X5\nG10 L20 P2 X0\nM2\n", parameters).code, 0);
  EXPECT_NE(read(path("machine.var")).find("5241\t5.000000\n"), std::string::npos);
  const Outcome second = run_text("G21 G55 G0 X1\nM2\n", "--json " + parameters);
  ASSERT_EQ(second.code, 0) << second.err;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(second.out)["position_mm"]["X"], 6.0);
}

TEST_F(CommandLine, a_run_that_fails_leaves_the_parameters_as_they_were) {
  const std::string file = write("machine.var", "5221\t1.5\n");
  EXPECT_EQ(run_text("G0 X5\nG10 L2 P1 X7\nG12\nM2\n", "--parameters " + file).code, 2);
  EXPECT_EQ(read(file), "5221\t1.5\n");
  EXPECT_EQ(run_text("M2\n", "--parameters /no/such/folder/m.var").code, 1);
}

TEST_F(CommandLine, a_tool_table_counts_in_the_units_of_the_machine) {
  const std::string table = write("shop.tbl", "T1 P1 Z2 D3\n");
  const std::string program = write("t.ngc", "G21\nT1 M6 G43\nG0 Z1\nM2\n");
  EXPECT_NE(passo("canon " + program + " -t " + table).out.find("OFFSET(0.0000 0.0000 50.8000,"), std::string::npos);
  EXPECT_NE(passo("canon " + program + " -t " + table + " --machine-units mm").out.find("OFFSET(0.0000 0.0000 2.0000,"),
            std::string::npos);
  const Outcome run = passo("run " + program + on_router + "--json --tools " + table);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(run.out)["position_mm"]["Z"], 3.0);
}

TEST_F(CommandLine, a_good_run_writes_the_tools_that_it_set) {
  const std::string table = write("shop.tbl", "; my tools\nT2 P1 Z2 ; drill\nT1 P7 D3\n");
  ASSERT_EQ(run_text("G21\nG10 L1 P2 Z3.25\nM2\n", "--tools " + table).code, 0);
  EXPECT_EQ(read(table), "; my tools\nT2 P1 Z3.25 ; drill\nT1 P7 D3\n");
  EXPECT_EQ(run_text("G21\nG10 L1 P2 Z4\nG12\nM2\n", "--tools " + table).code, 2);
  EXPECT_EQ(passo("check " + write("t.ngc", "G21\nG10 L1 P2 Z5\nM2\n") + on_router + "--tools " + table).code, 0);
  EXPECT_EQ(read(table), "; my tools\nT2 P1 Z3.25 ; drill\nT1 P7 D3\n");
}

TEST_F(CommandLine, canon_alone_has_the_example_tools_of_rs274) {
  const std::string program = write("t.ngc", "G20\nG43 H1\nM2\n");
  const Outcome canon = passo("canon " + program);
  EXPECT_NE(canon.out.find("OFFSET(0.0000 0.0000 0.5110,"), std::string::npos) << canon.out;
  EXPECT_NE(canon.err.find("the offset of tool 1 is that of an example"), std::string::npos) << canon.err;
  EXPECT_NE(passo("check " + program + on_router).err.find("taken as zero"), std::string::npos);
}

TEST_F(CommandLine, what_is_wrong_in_a_file_of_the_machine_is_told_with_its_place) {
  const std::string program = write("t.ngc", "M2\n");
  const std::string table = write("shop.tbl", "T1 P1\nT2 P1 Zx\n");
  const Outcome outcome = passo("canon " + program + " -t " + table);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("shop.tbl:2:7: error:"), std::string::npos) << outcome.err;
  EXPECT_EQ(passo("canon " + program + " -v no.var").code, 2);
  EXPECT_EQ(passo("canon " + program + " -i no.ini").code, 2);
}

TEST_F(CommandLine, canon_prints_canonical_calls) {
  const Outcome outcome = passo("canon " + write("p.ngc", "G21 F600\nG1 X1 Y2\nM2\n"));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("STRAIGHT_FEED(1.0000, 2.0000, 0.0000, 0.0000, 0.0000, 0.0000)"), std::string::npos);
}

TEST_F(CommandLine, no_colour_and_no_progress_reach_a_pipe) {
  const Outcome outcome = run_text("G21 F600 M3 S1000\nG1 X100\nX0\nM2\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
  EXPECT_EQ(outcome.err, "");
}

}  // namespace
