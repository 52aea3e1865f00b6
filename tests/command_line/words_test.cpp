// What a user is told: about the command line, about files that are no programs, about mistakes that programs often
// make, and about the program itself.
#include <algorithm>
#include <array>

#include "kit/command_line.hpp"
#include <nlohmann/json.hpp>
#include <pty.h>

namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using passo::test::contains;
using passo::test::examples;
using passo::test::Outcome;
using passo::test::read;
using passo::test::router_file;
using testing::Test;

const std::string relay_file = (examples / "machines" / "forty-eight.toml").string();

// What a command writes on a terminal of its own.
std::string on_a_terminal(const std::string& command) {
  int master = -1;
  const pid_t child = forkpty(&master, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  std::string shown;
  std::array<char, 4096> part;
  for (ssize_t size = 0; (size = ::read(master, part.data(), part.size())) > 0;) {
    shown.append(part.data(), static_cast<std::size_t>(size));
  }
  close(master);
  waitpid(child, nullptr, 0);
  return shown;
}

class Words : public passo::test::CommandLine {
 protected:
  Outcome check(const std::string& text, const std::string& machine = router_file,
                const std::string& options = "") const {
    return passo("check " + write("p.ngc", text) + " -m " + machine + " " + options);
  }
  Outcome run(const std::string& text, const std::string& options = "") const {
    return passo("run " + write("p.ngc", text) + " -m " + router_file + " " + options);
  }
  nlohmann::json summary(const std::string& text, const std::string& options = "") const {
    const Outcome outcome = run(text, "--json " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
};

// --- the command line
// -------------------------------------------------------------------------------------------------

TEST_F(Words, an_unknown_command_or_option_names_the_one_that_was_meant) {
  const struct {
    const char* line;
    const char* meant;
  } slips[] = {{"rum p.ngc", "did you mean run?"},
               {"chek p.ngc", "did you mean check?"},
               {"board lst", "did you mean list?"},
               {"run p.ngc --machne r.toml", "did you mean --machine?"},
               {"run p.ngc --pict a.png", "did you mean --picture?"},
               {"canon --dialct=grbl p.ngc", "did you mean --dialect?"}};
  for (const auto& slip : slips) {
    const Outcome outcome = passo(slip.line);
    EXPECT_EQ(outcome.code, 2) << slip.line;
    EXPECT_TRUE(contains(outcome.err, slip.meant)) << outcome.err;
  }
  EXPECT_FALSE(contains(passo("qwxyz").err, "did you mean"));
}

TEST_F(Words, help_is_a_command_too) {
  EXPECT_EQ(passo("help").out, passo("--help").out);
  EXPECT_EQ(passo("help run").out, passo("run --help").out);
  EXPECT_EQ(passo("help board list").out, passo("board list --help").out);
  EXPECT_EQ(passo("help run").code, 0);
  EXPECT_EQ(passo("help rum").code, 2);
  for (const char* command : {"canon", "machine", "explain", "check", "run"}) {
    EXPECT_TRUE(contains(passo(command + " --help"s).out, "  passo "s + command + " ")) << command;
  }
}

TEST_F(Words, a_wrong_count_is_refused_in_a_short_line) {
  for (const char* count : {"0", "-1", "1.5", "x", "99999999999999999999999"}) {
    const Outcome outcome = run("G21\nM2\n", "--passes "s + count);
    EXPECT_EQ(outcome.code, 2) << count;
    EXPECT_LT(outcome.err.size(), 200U) << outcome.err;
  }
  EXPECT_TRUE(contains(run("G21\nM2\n", "--passes 0").err, "expected a whole number of 1 or more"));
}

TEST_F(Words, a_full_disk_fails_every_command_that_prints) {
  const std::string program = write("p.ngc", "G21 G1 X1 F600\nM2\n");
  const std::string with_machine = program + " -m " + router_file;
  for (const std::string& line :
       {"--help"s, "help run"s, "--version"s, "machine " + router_file, "check " + with_machine,
        "check --motion " + with_machine, "check --json " + with_machine, "run --json " + with_machine,
        "run " + with_machine, "canon " + program, "explain " + program + ":1",
        "ramp --limit --table-size 9 --accel 10 --steps-per-rev 200"s, "interpolate --method lean --to 9,4"s}) {
    const std::string command = PASSO_PROGRAM " "s + line + " >/dev/full 2>" + path("err");
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << line;
    EXPECT_TRUE(contains(read(path("err")), "standard output")) << line << read(path("err"));
  }
}

TEST_F(Words, colours_are_for_terminals_that_want_them) {
  const std::string line = PASSO_PROGRAM " check " + write("p.ngc", "G21 G1 X1\n") + " -m " + router_file;
  EXPECT_TRUE(contains(on_a_terminal("TERM=xterm " + line), "\x1b["));
  EXPECT_TRUE(contains(on_a_terminal("NO_COLOR= TERM=xterm " + line), "\x1b["));
  EXPECT_FALSE(contains(on_a_terminal("TERM=dumb " + line), "\x1b["));
  EXPECT_FALSE(contains(on_a_terminal("NO_COLOR=1 TERM=xterm " + line), "\x1b["));
}

// --- files that are no programs
// ---------------------------------------------------------------------------------------

TEST_F(Words, a_file_of_another_kind_is_named) {
  const struct {
    const char* name;
    std::string content;
    const char* kind;
  } files[] = {{"a.dxf", "  0\r\nSECTION\r\n  2\r\nHEADER\r\n", "a DXF drawing"},
               {"b.plt", "IN;SP1;PU0,0;PD100,0;\n", "an HPGL plot"},
               {"c.plt", "PU0,0;PD100,0;\n", "an HPGL plot"},
               {"d.gbr", "G04 made by a CAD program*\n%FSLAX46Y46*%\n", "a Gerber file"},
               {"e.gbr", "%FSLAX25Y25*%\n%MOMM*%\n", "a Gerber file"},
               {"f.drl", "M48\nMETRIC,TZ\nT1C0.800\n%\n", "an Excellon drill file"},
               {"g.png", "\x89PNG\r\n\x1A\n\0\0\0\rIHDR"s, "a PNG picture"},
               {"h.jpg", "\xFF\xD8\xFF\xE0\0\x10JFIF"s, "a JPEG picture"},
               {"i.tif", "II*\0\x08\0\0\0"s, "a TIFF picture"},
               {"o.kicad_pcb", "(kicad_pcb (version 20221018)\n", "a KiCad board"},
               {"j.svg", "<?xml version=\"1.0\"?>\n<svg width=\"1\">\n", "an SVG drawing"},
               {"k.stl", "solid part\n  facet normal 0 0 1\n", "an STL model"},
               {"l.stl", std::string(80, '\0') + "\x0C\0\0\0"s, "an STL model"},
               {"m",
                "\x7F"
                "ELF\x02\x01\x01\0\0"s,
                "a program for a computer or a board (ELF)"},
               {"n.ngc.gz", "\x1F\x8B\x08\0\0\0\0\0"s, "a gzip archive"},
               {"p.ttf", "\0\1\0\0\0\x0C\0\x80"s, "a font"},
               {"q.lff", "# Format: LibreCAD Font 1\n# LetterSpacing: 2\n\n[0041] A\n", "a font"},
               {"r.jhf", "  699  1JZ\n  714  9MWRFRT RRYQZR[SZRY\n", "a font"},
               {"s.dat", "NACA 0012\n 1.0 0.00126\n 0.95 0.00807\n 0.9 0.01448\n", "an airfoil file"},
               {"t.svgz", "\x1F\x8B\x08\0\0\0\0\0"s, "a compressed SVG drawing"},
               {"u.pdf", "%PDF-1.4\n", "a PDF document"},
               {"v.eps", "%!PS-Adobe-3.0 EPSF-3.0\n", "a PostScript document"},
               {"w.toml", "name = \"Foam cutter\"\n\n[axis.X]\nscrew_pitch_mm = 8\n",
                "a TOML file, e.g. a machine file or a tool table"},
               {"x.csv", "0,0,0.012\n10,0,0.015\n0,10,0.01\n", "a height map"},
               {"y.obj", "# a cube\nv 0 0 0\nv 1 0 0\n", "a mesh (OBJ, PLY, OFF)"},
               {"z.3mf", "PK\x03\x04\x14\0"s, "a 3MF model"}};
  for (const auto& file : files) {
    const std::string name = write(file.name, file.content);
    for (const std::string& line : {"run " + name + " -m " + router_file, "check " + name + " -m " + router_file,
                                    "canon " + name, "canon - < " + name}) {
      if (contains(line, "- <") && std::string_view("cltyz").find(file.name[0]) != std::string_view::npos) {
        continue;  // known by name alone
      }
      const Outcome outcome = passo(line);
      EXPECT_EQ(outcome.code, 2) << line;
      EXPECT_TRUE(contains(outcome.err, "this is "s + file.kind + ", not G-code")) << line << "\n" << outcome.err;
      EXPECT_TRUE(contains(outcome.err, "= expected: ")) << outcome.err;
      // What Passo reads is told with the command that reads it.
      const bool is_read = std::string_view("mnw").find(file.name[0]) == std::string_view::npos;
      EXPECT_EQ(contains(outcome.err, "passo cam "), is_read) << outcome.err;
    }
  }
}

TEST_F(Words, a_program_is_not_taken_for_another_kind) {
  for (const char* text : {"; **** part ****\nG21\nM2\n", "(**)\nG21\nM2\n", "M48\nG21\nM2\n", "%\nO100\nG21\nM2\n%\n",
                           "0\n", "(<svg)\nG21\nM2\n", "#<a> = 1\nG21\nM2\n", "1 2\nG21\nM2\n",
                           "5161\t1.0\n5162\t2.0\n5163\t3.0\n5164\t4.0\n", "N10 G1 X1\nN20 X2\nN30 X3\nM2\n"}) {
    EXPECT_FALSE(contains(check(text).err, "this is")) << text;
  }
}

// --- usual mistakes
// ---------------------------------------------------------------------------------------------------

TEST_F(Words, a_program_without_units_is_warned_of_at_its_first_move) {
  const Outcome outcome = check("M3 S1000\nF600\nG1 X10\nX20\nM2\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "p.ngc:3:1: warning: ")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "[path.no-units]")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "      | ^")) << outcome.err;
  EXPECT_TRUE(contains(run("M3 S1000\nF600\nG1 X10\nX20\nM2\n").err, "[path.no-units]"));
  EXPECT_FALSE(contains(check("G20 M3 S1000\nF60\nG1 X1\nM2\n").err, "path.no-units"));
  EXPECT_FALSE(contains(check("G21\nM3 S1000\nF600\nG1 X1\nM2\n").err, "path.no-units"));
  EXPECT_FALSE(contains(check("M3 S1000\nF60\nG1 X1\nM2\n", router_file, "--inches").err, "path.no-units"));
}

TEST_F(Words, a_spindle_that_stands_while_the_tool_is_fed_is_warned_of) {
  const Outcome off = check("G21\nF600\nG1 X10\nX20\nM2\n");
  EXPECT_EQ(off.code, 0);
  EXPECT_TRUE(contains(off.err, "p.ngc:3:1: warning: a feed move while the spindle is stopped")) << off.err;
  EXPECT_TRUE(contains(check("G21 M3 S1000\nF600\nM5\nG2 X10 I5\nM2\n").err, "p.ngc:4:"));
  EXPECT_FALSE(contains(check("G21 M3 S1000\nF600\nG1 X10\nM2\n").err, "spindle"));
  EXPECT_FALSE(contains(check("G21\nG0 X10\nF60 G38.2 Z-5\nM2\n").err, "spindle")) << "rapids and probes";
  EXPECT_FALSE(contains(check("G21 F60\nG38.2 Z-5\nG1 Z2\nM2\n").err, "spindle")) << "a probe is drawn back";
  EXPECT_TRUE(contains(check("G21 F60\nG38.2 Z-5\nT1 M6\nG1 Z-2\nM2\n").err, "p.ngc:4:1: warning"));
  EXPECT_FALSE(contains(check("G21\nF60 G1 X1\nM2\n", relay_file).err, "spindle")) << "no spindle with a speed";
}

TEST_F(Words, a_spindle_switched_on_at_zero_is_warned_of_where_it_is_switched_on) {
  const Outcome outcome = check("G21\nM3 S0\nF600\nG1 X10\nM2\n");
  EXPECT_TRUE(contains(outcome.err, "p.ngc:2:1: warning: the spindle is switched on at S0")) << outcome.err;
  EXPECT_FALSE(contains(outcome.err, "spindle-off-in-feed")) << outcome.err;
  EXPECT_TRUE(contains(check("G21\nM3\nF600\nG1 X10\nM2\n").err, "[path.spindle-at-zero]"));
  EXPECT_FALSE(contains(check("G21\nM3\nS1000\nF600\nG1 X10\nM2\n").err, "warning"));
  EXPECT_FALSE(contains(check("G21\nM3 S0\nF600\nG1 X1\nM2\n", relay_file).err, "spindle-at-zero"));
}

TEST_F(Words, a_dwell_that_was_meant_in_milliseconds_is_warned_of) {
  const Outcome outcome = check("G21\nG4 P500\nM2\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "p.ngc:2:1: warning: this dwell takes 500 seconds")) << outcome.err;
  EXPECT_FALSE(contains(check("G21\nG4 P5\nG4 P62.5\nM2\n").err, "warning"));
}

TEST_F(Words, errors_name_the_units_and_the_options_that_help) {
  const std::string far = check("G20 G0 X20\nM2\n").err;
  EXPECT_TRUE(contains(far, "X would reach 20.0000 (work 20.0000), 4.2520 inches beyond its travel's end at 15.7480"))
      << far;
  const std::string tools = write("t.tbl", "T1 P1 Z0 D3\n");
  EXPECT_TRUE(contains(check("G21 T5 M6\nM2\n", router_file, "--tools " + tools).err, "--tools FILE"));
  EXPECT_TRUE(contains(run("G21 F60 G38.2 Z-5\nM2\n").err, "--touch Z:-1.5"));
}

// --- the summary
// ------------------------------------------------------------------------------------------------------

TEST_F(Words, the_summary_counts_the_moves_of_the_program) {
  // Corners become several pieces, and short lines become fewer.
  std::string text = "G21 G64 P0.05 F1200 M3 S1000\nG1 X10\nY10\n";
  EXPECT_EQ(summary(text + "M2\n")["counts"]["moves"], 2);
  text = "G21 G64 P0.05 F1200 M3 S1000\nG0 Z1\nG1 Z0\n";
  for (int i = 0; i < 40; ++i) text += "G2 X" + std::to_string(i + 1) + " R0.6\n";
  const auto counts = summary(text + "M2\n")["counts"];
  EXPECT_EQ(counts["arcs"], 40);
  EXPECT_EQ(counts["rapids"], 1);
  EXPECT_EQ(counts["moves"], 42);
}

TEST_F(Words, the_summary_tells_of_each_tool_and_each_work_offset) {
  const auto json = summary(
      "G21 G10 L2 P2 X100\nT1 M6 M3 S1000\nG0 X10 Z2\nG1 Z-1 F300\nX20 F600\nG0 Z5\n"
      "T2 M6 M3 S1000\nG55\nG0 X0\nG1 Z-2 F60\nG0 Z5\nM2\n",
      "-y");
  ASSERT_EQ(json["tools"].size(), 2U) << json.dump(2);
  EXPECT_EQ(json["tools"][0]["tool"], 1);
  EXPECT_DOUBLE_EQ(json["tools"][0]["feed_mm_min"]["min"].get<double>(), 300);
  EXPECT_DOUBLE_EQ(json["tools"][0]["feed_mm_min"]["max"].get<double>(), 600);
  EXPECT_DOUBLE_EQ(json["tools"][0]["depth_mm"].get<double>(), -1);
  EXPECT_NEAR(json["tools"][0]["cutting_mm"].get<double>(), 13, 0.1);
  EXPECT_DOUBLE_EQ(json["tools"][1]["depth_mm"].get<double>(), -2);
  EXPECT_DOUBLE_EQ(json["work_offsets"]["G54"]["extents_mm"]["X"]["max"].get<double>(), 20);
  EXPECT_DOUBLE_EQ(json["work_offsets"]["G54"]["cutting_mm"]["X"]["min"].get<double>(), 10);
  EXPECT_DOUBLE_EQ(json["work_offsets"]["G55"]["cutting_mm"]["X"]["max"].get<double>(), 0);
  EXPECT_NEAR(json["extents_mm"]["cutting"]["X"]["min"].get<double>(), 10, 0.011) << "the corner is rounded";
  EXPECT_NEAR(json["tools"][0]["cutting_s"].get<double>() + json["tools"][1]["cutting_s"].get<double>(),
              json["time"]["cutting_s"].get<double>(), 1e-9);
}

TEST_F(Words, the_summary_of_a_program_in_inches_is_in_inches) {
  const Outcome outcome = run("G20 F30 M3 S1000\nG1 X1\nM2\n");
  EXPECT_TRUE(contains(outcome.out, "Distance, inches")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "1.0000")) << outcome.out;
  EXPECT_EQ(summary("G20 F30 M3 S1000\nG1 X1\nM2\n")["units"], "inch");
  EXPECT_NEAR(summary("G20 F30 M3 S1000\nG1 X1\nM2\n")["distance_mm"]["cutting"].get<double>(), 25.4, 1e-9);
}

TEST_F(Words, texts_for_the_operator_are_shown) {
  const std::string text = "G21\n(MSG, turn the work)\n#1=3\n(DEBUG, height #1)\n(PRINT, done)\nG0 X1\nM2\n";
  for (const Outcome& outcome : {run(text), check(text)}) {
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(contains(outcome.err, "p.ngc:2: message: turn the work")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "p.ngc:4: message: height 3")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "p.ngc:5: print: done")) << outcome.err;
  }
  EXPECT_EQ(run(text, "--quiet").err, "");
  const auto messages = summary(text)["messages"];
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[2]["kind"], "print");
}

TEST_F(Words, a_program_that_talks_without_end_is_not_shown_to_its_last_text) {
  const std::string text = "o1 repeat [5000]\n(msg,again)\no1 endrepeat\nM2\n";
  for (const Outcome& outcome : {run(text), check(text)}) {
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1001);
    EXPECT_TRUE(
        contains(outcome.err, "p.ngc: note: the program has more than 1000 messages; the others are not shown"));
  }
}

// --- pictures, explain, ramp
// ------------------------------------------------------------------------------------------

TEST_F(Words, pictures_are_coloured_and_turned_as_asked) {
  const std::string text = "G21 T1 M6 M3 S1000 F600\nG1 X20 Z-1\nY20 Z-5\nG0 Z5\nM2\n";
  const auto picture = [&](const std::string& options) {
    EXPECT_EQ(run(text, "-y -q -p " + path("a.svg") + " " + options).code, 0) << options;
    return read(path("a.svg"));
  };
  const std::string usual = picture("");
  std::vector<std::string> all = {usual};
  for (const char* option :
       {"--colour-by depth", "--colour-by tool", "--view front", "--view side", "--view lathe", "--no-rapids"}) {
    all.push_back(picture(option));
    for (std::size_t i = 0; i + 1 < all.size(); ++i) EXPECT_NE(all[i], all.back()) << option;
  }
  EXPECT_EQ(run(text, "-y -q --colour-by depth").code, 2) << "no picture is drawn";
  EXPECT_EQ(run(text, "-y -q -p " + path("a.svg") + " --colour-by mood").code, 2);
}

TEST_F(Words, explain_takes_the_files_of_the_machine_and_standard_input) {
  const std::string tools = write("t.tbl", "T1 P1 Z12.5 D3\n");
  const std::string program = write("p.ngc", "G21 T1 M6\nG43 H1\nG1 X3 Y4 F300\nG2 X13 I5\nM2\n");
  const Outcome outcome = passo("explain " + program + ":2-4 --tools " + tools);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "12.5")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "5.000 mm, 1.000 s")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "15.708 mm, 3.142 s")) << outcome.out;
  EXPECT_TRUE(contains(passo("explain -:3 < " + program).out, "5.000 mm, 1.000 s"));
  EXPECT_TRUE(contains(passo("explain - < " + program).out, "15.708 mm"));
}

}  // namespace
