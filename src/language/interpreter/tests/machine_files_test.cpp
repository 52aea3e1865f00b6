// The files beside a program: tool table, saved parameters, settings. Good files are read, and errors are reported at
// their places.
#include <filesystem>

#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/interpreter/saved_offsets.hpp"
#include "passo/interpreter/tool_table_file.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

// A file with this text, until the test ends.
class WrittenFile {
 public:
  explicit WrittenFile(const std::string& text, const std::string& name = "file") {
    std::string file = "passo_";
    file.append(testing::UnitTest::GetInstance()->current_test_info()->name()).append(name);
    path_ = (fs::temp_directory_path() / file).string();
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~WrittenFile() { fs::remove(path_); }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct Wrong {
  const char* text;
  const char* code;
  std::uint32_t line;
  std::uint32_t column;
};

template <class Read>
void expect_wrong(const Wrong& wrong, Read read) {
  const WrittenFile file(wrong.text);
  Diagnostics diagnostics;
  EXPECT_FALSE(read(file.path(), diagnostics)) << wrong.text;
  ASSERT_FALSE(diagnostics.all().empty()) << wrong.text;
  const Diagnostic& error = diagnostics.all().front();
  EXPECT_EQ(error.code, wrong.code) << wrong.text;
  EXPECT_EQ(error.file, file.path());
  EXPECT_EQ(error.place.line, wrong.line) << wrong.text;
  EXPECT_EQ(error.place.column, wrong.column) << wrong.text;
  EXPECT_FALSE(error.expected.empty());
}

ToolTable tools_of(const std::string& text, LengthUnits units = LengthUnits::mm) {
  const WrittenFile file(text);
  ToolTable table;
  Diagnostics diagnostics;
  EXPECT_TRUE(read_tool_table(file.path(), units, table, diagnostics)) << render(diagnostics, false);
  return table;
}

TEST(ToolTableFile, has_all_that_linuxcnc_knows_of_a_tool) {
  const ToolTable table = tools_of("T1 P4 X1 Y+2 Z-3 A4 B5 C6 U7 V8 W9 D3.5 I10 J-20 Q7 ;a remark; T2\n");
  const Tool* const tool = table.find(1);
  ASSERT_NE(tool, nullptr);
  EXPECT_EQ(tool->pocket, 4);
  EXPECT_EQ(tool->offset, (Point{{{1, 2, -3, 4, 5, 6, 7, 8, 9}}}));
  EXPECT_EQ(tool->diameter, Mm(3.5));
  EXPECT_EQ(tool->front_angle_deg, 10);
  EXPECT_EQ(tool->back_angle_deg, -20);
  EXPECT_EQ(tool->orientation, 7);
  EXPECT_EQ(table.all().size(), 1U);
}

TEST(ToolTableFile, is_read_in_any_case_order_and_line_end) {
  const ToolTable table = tools_of("; tools\r\n\r\nz1 t9 p1\r\n  T7\tP2\tD.5;\r\nT3 P3");
  EXPECT_EQ(table.all().size(), 3U);
  EXPECT_EQ(table.find(9)->offset[Axis::z], 1);
  EXPECT_EQ(table.find(9)->place, 1);
  EXPECT_EQ(table.find(3)->place, 3);
  EXPECT_EQ(table.find(4), nullptr);
}

TEST(ToolTableFile, lengths_are_in_the_units_of_the_machine_and_angles_are_not) {
  const Tool tool = *tools_of("T1 P1 Z1 A1 W1 D1 I1\n", LengthUnits::inch).find(1);
  EXPECT_EQ(tool.offset[Axis::z], 25.4);
  EXPECT_EQ(tool.offset[Axis::w], 25.4);
  EXPECT_EQ(tool.offset[Axis::a], 1);
  EXPECT_EQ(tool.diameter, Mm(25.4));
  EXPECT_EQ(tool.front_angle_deg, 1);
}

TEST(SavedOffsets, begin_with_g54_and_without_g92) {
  SavedParameters saved{{5161, 4}, {5210, 1}, {5211, 2}, {5219, 3}, {5220, 7}, {5221, 8}};
  begin_with_g54(saved);
  forget_g92(saved);
  EXPECT_EQ(saved, (SavedParameters{{5161, 4}, {5220, 1}, {5221, 8}}));
}

TEST(ToolTableFile, an_empty_one_has_no_tools_and_is_a_table) {
  const ToolTable table = tools_of("");
  EXPECT_TRUE(table.all().empty());
  EXPECT_FALSE(table.name.empty());
}

TEST(ToolTableFile, is_written_with_what_changed_and_all_else_as_it_was) {
  const std::string text = "; tools\r\n\nT1  P4 Z+1.5\tD3 ; mill Z9\nt2 P2\n\nT3 P3 X1;no end";
  ToolTable table = tools_of(text);
  EXPECT_EQ(tool_table_text(text, LengthUnits::mm, table), text);
  Tool* const mill = table.find(1);
  mill->offset[Axis::z] = 2.25;
  mill->offset[Axis::x] = -0.5;
  table.find(2)->diameter = Mm(6);
  table.find(2)->orientation = 3;
  table.find(3)->offset[Axis::x] = 0;
  EXPECT_EQ(tool_table_text(text, LengthUnits::mm, table),
            "; tools\r\n\nT1  P4 Z+2.25\tD3 X-0.5 ; mill Z9\nt2 P2 D6 Q3\n\nT3 P3 X0;no end");
}

TEST(ToolTableFile, is_written_without_a_file_before) {
  const std::string text = "T1 P4 Z1.5 D3\nT7 P7\n";
  EXPECT_EQ(tool_table_text(tools_of(text)), text);
}

TEST(ToolTableFile, gets_a_line_for_each_new_tool_at_its_end) {
  std::string text = "; tools\nT1 P4 Z1.5";
  const ToolTable known = tools_of(text);
  add_new_tools(text, known, known);
  EXPECT_EQ(text, "; tools\nT1 P4 Z1.5");
  add_new_tools(text, known, tools_of("T1 P9\nT5 P2 Z3\nT7 P7\n"));
  EXPECT_EQ(text, "; tools\nT1 P4 Z1.5\nT5 P2\nT7 P7\n");
  std::string empty;
  add_new_tools(empty, ToolTable(), known);
  EXPECT_EQ(empty, "T1 P4\n");
}

TEST(ToolTableFile, is_written_in_the_units_of_the_machine) {
  const std::string text = "T1 P1 Z1 A1\n";
  ToolTable table = tools_of(text, LengthUnits::inch);
  EXPECT_EQ(tool_table_text(text, LengthUnits::inch, table), text);
  table.find(1)->offset[Axis::z] = 12.7;
  table.find(1)->offset[Axis::a] = 30;
  EXPECT_EQ(tool_table_text(text, LengthUnits::inch, table), "T1 P1 Z0.5 A30\n");
}

TEST(ToolTableFile, what_is_wrong_is_told_with_its_place) {
  const Wrong wrongs[] = {
      {"T1 P1 K3\n", "tools.unknown-word", 1, 7},
      {"nonsense\n", "tools.unknown-word", 1, 1},
      {"T1 P1 Zx\n", "tools.bad-number", 1, 7},
      {"T1 P1 Z 1\n", "tools.bad-number", 1, 7},
      {"T1 P1 Zinf\n", "tools.bad-number", 1, 7},
      {"T1 P1 Znan\n", "tools.bad-number", 1, 7},
      {"T1 P1 Z0x10\n", "tools.bad-number", 1, 7},
      {"T1 P1 D1e7\n", "tools.bad-number", 1, 7},
      {"T1P1Z1\n", "tools.not-whole", 1, 1},
      {"T-1 P1\n", "tools.not-whole", 1, 1},
      {"T0 P1\n", "tools.not-whole", 1, 1},
      {"T100000 P1\n", "tools.not-whole", 1, 1},
      {"T1 P1.5\n", "tools.not-whole", 1, 4},
      {"T1 P1 Q10\n", "tools.not-whole", 1, 7},
      {"\n\nP1 Z1\n", "tools.missing-number", 3, 1},
      {"T1 Z1\n", "tools.missing-number", 1, 1},
      {"T1 P1 Z1 Z2\n", "tools.repeated-word", 1, 10},
      {"T1 P1\nT1 P2\n", "tools.repeated-tool", 2, 1},
  };
  for (const Wrong& wrong : wrongs) {
    expect_wrong(wrong, [](const std::string& path, Diagnostics& diagnostics) {
      ToolTable table;
      return read_tool_table(path, LengthUnits::mm, table, diagnostics);
    });
  }
}

TEST(ToolTableFile, is_bounded) {
  std::string text;
  for (std::size_t i = 1; i <= ToolTable::most_tools + 1; ++i)
    text.append("T").append(std::to_string(i)).append(" P1\n");
  expect_wrong({text.c_str(), "tools.too-many", static_cast<std::uint32_t>(ToolTable::most_tools + 1), 1},
               [](const std::string& path, Diagnostics& diagnostics) {
                 ToolTable table;
                 return read_tool_table(path, LengthUnits::mm, table, diagnostics);
               });
}

TEST(ToolTableFile, that_is_missing_is_an_error) {
  ToolTable table;
  Diagnostics diagnostics;
  EXPECT_FALSE(read_tool_table("no/such.tbl", LengthUnits::mm, table, diagnostics));
  EXPECT_THAT(render(diagnostics, false), HasSubstr("no/such.tbl"));
}

TEST(ParameterFile, carries_offsets_from_one_program_to_the_next) {
  InterpreterOptions options;
  const WrittenFile before("5161\t7.0\n5220\t2\n5241 10\n100\t3\n");
  Diagnostics diagnostics;
  ASSERT_TRUE(read_parameter_file(before.path(), options.parameters, diagnostics)) << render(diagnostics, false);
  Diagnostics findings;
  Interpreter first(
      ProgramReader::from_text("a.ngc", "G0 X1\nG10 L2 P1 X5 R45\nG92 Z2\n#100=[#100+1]\n#101=9\nG28\nM2\n"), options,
      findings);
  Operation operation;
  Point home;
  while (first.next(operation)) {
    if (const auto* move = std::get_if<operation::StraightTraverse>(&operation.what)) home = move->end;
  }
  EXPECT_EQ(home[Axis::x], -3);  // the home in the second system

  const WrittenFile after(parameter_file_text(first.saved_parameters()), "after");
  EXPECT_THAT(contents(after.path()), HasSubstr("100\t4.000000\n"));
  EXPECT_THAT(contents(after.path()), testing::Not(HasSubstr("101\t")));
  InterpreterOptions next;
  ASSERT_TRUE(read_parameter_file(after.path(), next.parameters, diagnostics)) << render(diagnostics, false);
  const Interpreted second = interpret_text("(debug,#5220 #5221 #5230 #5241 #5161 #5210 #5213 #5422)\nM2\n", next);
  EXPECT_THAT(second.calls(),
              HasSubstr("\"1.000000 5.000000 45.000000 10.000000 7.000000 1.000000 -2.000000 2.000000\""));
  EXPECT_EQ(second.all<operation::SetG92Offset>().front().offset[Axis::z], -2);
  EXPECT_EQ(second.all<operation::SetRotation>().front().degrees, 45);
}

TEST(ParameterFile, lengths_are_in_the_units_of_the_machine) {
  InterpreterOptions options;
  options.machine_units = LengthUnits::inch;
  options.parameters = {{5221, 2.0}, {5224, 2.0}};
  const Interpreted result = interpret_text("G21\n(debug,#5221 #5420)\nG10 L2 P1 X25.4\n(debug,#5221)\nM2\n", options);
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"2.000000 -50.800000\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"1.000000\")"));
  EXPECT_EQ(result.all<operation::SetWorkOffset>().front().offset[Axis::a], 2);
}

TEST(ParameterFile, what_is_wrong_is_told_with_its_place) {
  const Wrong wrongs[] = {
      {"5221 1\nx 2\n", "parameters.bad-number", 2, 1}, {"0\t2\n", "parameters.bad-number", 1, 1},
      {"5602\t2\n", "parameters.bad-number", 1, 1},     {"99999999999\t2\n", "parameters.bad-number", 1, 1},
      {"5221\n", "parameters.bad-value", 1, 1},         {"5221\tnan\n", "parameters.bad-value", 1, 6},
      {"5221\t1e300\n", "parameters.bad-value", 1, 6},  {"5220\t0\n", "parameters.bad-value", 1, 6},
      {"5221\t1 2\n", "parameters.bad-value", 1, 8},    {"5221\t1\n5221\t1\n", "parameters.repeated", 2, 1},
  };
  for (const Wrong& wrong : wrongs) {
    expect_wrong(wrong, [](const std::string& path, Diagnostics& diagnostics) {
      SavedParameters parameters;
      return read_parameter_file(path, parameters, diagnostics);
    });
  }
}

SettingsFile settings_of(const std::string& text) {
  const WrittenFile file(text);
  SettingsFile settings;
  Diagnostics diagnostics;
  EXPECT_TRUE(settings.read(file.path(), diagnostics)) << render(diagnostics, false);
  return settings;
}

TEST(SettingsFile, tells_programs_its_values) {
  InterpreterOptions options;
  options.settings = std::make_shared<SettingsFile>(
      settings_of("# a machine\n[Vars]\nTool Z = 30 # up\nEND=-1.5\nTEXT = hello\nEND=7\n[OTHER]\nEND = 9\n"));
  const Interpreted result = interpret_text(
      "(debug,#<_ini[VARS]tool z> #<_ini[vars]end> #<_ini[other]end> #<_ini[vars]text>)\n"
      "#1=EXISTS[#<_ini[vars]end>]\n#2=EXISTS[#<_ini[vars]nothing>]\n(debug,#1 #2)\n#3=#<_ini[vars]nothing>\n"
      "#<_ini[vars]end>=3\nM2\n",
      options);
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"30.000000 -1.500000 9.000000 ######\")"));
  EXPECT_THAT(result.calls(), HasSubstr("MESSAGE(\"1.000000 0.000000\")"));
  ASSERT_EQ(result.diagnostics.errors(), 2U) << result.rendered();
  EXPECT_EQ(result.diagnostics.all()[0].code, "gcode.unknown-parameter");
  EXPECT_EQ(result.diagnostics.all()[1].code, "gcode.read-only-parameter");
}

TEST(SettingsFile, names_folders_and_units) {
  const SettingsFile settings = settings_of(
      "[DISPLAY]\nPROGRAM_PREFIX = /nc\n[RS274NGC]\nSUBROUTINE_PATH = subs:/more\n[TRAJ]\nLINEAR_UNITS = inch\n");
  const std::vector<std::string> folders = settings.sub_folders();
  ASSERT_EQ(folders.size(), 3U);
  EXPECT_EQ(folders[0], "/nc");
  EXPECT_EQ(folders[1], (fs::temp_directory_path() / "subs").string());
  EXPECT_EQ(folders[2], "/more");
  EXPECT_EQ(settings.machine_units(), LengthUnits::inch);
  EXPECT_EQ(settings_of("[TRAJ]\nX=1\n").machine_units(), std::nullopt);
}

TEST(SettingsFile, what_is_wrong_is_told_with_its_place) {
  const Wrong wrongs[] = {
      {"[A\nB=1\n", "settings.bad-section", 1, 1},
      {"[A]\n  no value\n", "settings.bad-line", 2, 3},
      {"[A]\n=3\n", "settings.bad-line", 2, 1},
  };
  for (const Wrong& wrong : wrongs) {
    expect_wrong(wrong, [](const std::string& path, Diagnostics& diagnostics) {
      SettingsFile settings;
      return settings.read(path, diagnostics);
    });
  }
}

TEST(SettingsFile, a_setting_that_changes_what_programs_mean_is_followed_or_told) {
  const auto finding_of = [](const std::string& text) {
    const WrittenFile file(text);
    Diagnostics diagnostics;
    SettingsFile settings;
    (void)settings.read(file.path(), diagnostics);
    return diagnostics.all().empty() ? Diagnostic{} : diagnostics.all().front();
  };
  for (const char* const setting :
       {"[RS274NGC]\nREMAP = M6 modalgroup=6 ngc=x", "[RS274NGC]\nFEATURES = 2", "[RS274NGC]\nRETAIN_G43 = 1",
        "[RS274NGC]\nOWORD_NARGS=yes", "[RS274NGC]\nNO_DOWNCASE_OWORD = 1",
        "[RS274NGC]\nCENTER_ARC_RADIUS_TOLERANCE_MM = 1", "[RS274NGC]\nCENTER_ARC_RADIUS_TOLERANCE_INCH = 1",
        "[RS274NGC]\nPARAMETER_G73_PECK_CLEARANCE = 1", "[RS274NGC]\nPARAMETER_G83_PECK_CLEARANCE = 1",
        "[EMCIO]\nRANDOM_TOOLCHANGER = 1", "[EMCIO]\nDB_PROGRAM = tools.py", "[EMCIO]\nTOOL_CHANGE_AT_G30 = 1",
        "[EMCIO]\nTOOL_CHANGE_QUILL_UP = 1", "[EMCIO]\nTOOL_CHANGE_WITH_SPINDLE_ON = 1", "[AXIS_A]\nWRAPPED_ROTARY = 1",
        "[AXIS_B]\nWRAPPED_ROTARY = YES", "[AXIS_C]\nWRAPPED_ROTARY = 1", "[AXIS_A]\nLOCKING_INDEXER_JOINT = 3",
        "[TRAJ]\nANGULAR_UNITS = rad"}) {
    const Diagnostic finding = finding_of(std::string(setting) + "\n");
    EXPECT_EQ(finding.code, "settings.not-followed") << setting;
    EXPECT_EQ(finding.severity, Severity::error) << setting;
    EXPECT_EQ(finding.place.line, 2U);
  }
  for (const char* const setting :
       {"[RS274NGC]\nRS274NGC_STARTUP_CODE = G20", "[RS274NGC]\nON_ABORT_COMMAND = o<stop> call",
        "[RS274NGC]\nOWORD_WARNONLY = 1", "[RS274NGC]\nOWORD_WARN_ONLY = 1", "[EMCIO]\nTOOL_CHANGE_POSITION = 0 0 5",
        "[PYTHON]\nTOPLEVEL = subs.py", "[WIZARD]\nWIZARD_ROOT = wizards"}) {
    EXPECT_EQ(finding_of(std::string(setting) + "\n").severity, Severity::warning) << setting;
    EXPECT_EQ(finding_of(std::string(setting) + "\n").code, "settings.not-followed") << setting;
  }
  for (const char* const harmless :
       {"[RS274NGC]\nFEATURES = 12", "[RS274NGC]\nRETAIN_G43 = 0", "[EMCIO]\nRANDOM_TOOLCHANGER = 0",
        "[TRAJ]\nANGULAR_UNITS = degree", "[RS274NGC]\nDISABLE_G92_PERSISTENCE = 1", "[VARS]\nREMAP = 1",
        "[AXIS_A]\nWRAPPED_ROTARY = 0", "[AXIS_X]\nWRAPPED_ROTARY = 1", "[RS274NGC]\nLOG_LEVEL = 5",
        "[RS274NGC]\nHAL_PIN_VARS = 1"}) {
    EXPECT_EQ(finding_of(std::string(harmless) + "\n").code, "") << harmless;
  }
}

InterpreterOptions with_settings(const std::string& text) {
  InterpreterOptions options;
  options.settings = std::make_shared<SettingsFile>(settings_of(text));
  return options;
}

TEST(SettingsFile, the_offset_of_g92_outlives_the_run_unless_that_is_forbidden) {
  const auto last_x = [](InterpreterOptions options, SavedParameters& saved) {
    options.parameters = {{5210, 1}, {5211, 3}};
    Diagnostics diagnostics;
    Interpreter interpreter(ProgramReader::from_text("test.ngc", "G53 G0 X10\n(debug,#5420)\nG52 X4\nM2\n"), options,
                            diagnostics);
    Operation operation;
    std::string text;
    while (interpreter.next(operation)) {
      if (const auto* message = std::get_if<operation::Message>(&operation.what)) text = message->text;
    }
    saved = interpreter.saved_parameters();
    return text;
  };
  SavedParameters saved;
  EXPECT_EQ(last_x({}, saved), "7.000000");
  EXPECT_EQ(saved.at(5211), 4);
  EXPECT_EQ(last_x(with_settings("[RS274NGC]\nDISABLE_G92_PERSISTENCE = 1\n"), saved), "10.000000");
  EXPECT_EQ(saved.at(5210), 0);
  EXPECT_EQ(saved.at(5211), 0);
}

// LinuxCNC 2.10 clears the offset at the program's end too. 2.9 clears its parameters, but the offset stays in effect.
TEST(SettingsFile, the_program_end_clears_g92_where_it_does_not_outlive_the_run) {
  const auto offset_after = [](const char* program, const InterpreterOptions& options) {
    return interpret_text(program, options).last<operation::SetG92Offset>().offset[Axis::x];
  };
  const InterpreterOptions forgets = with_settings("[RS274NGC]\nDISABLE_G92_PERSISTENCE = 1\n");
  for (const char* const program : {"G21 G92 X5\nM2\n", "G21 G92 X5\nM30\n", "G21 G52 X-5\nG55\nM2\n"}) {
    EXPECT_EQ(std::abs(offset_after(program, {})), 5) << program;
    EXPECT_EQ(offset_after(program, forgets), 0) << program;
  }
}

TEST(SettingsFile, numbered_programs_may_be_forbidden) {
  const InterpreterOptions options = with_settings("[RS274NGC]\nDISABLE_FANUC_STYLE_SUB = 1\n");
  for (const char* const program : {"M98 P1\nM2\nO1\nM99\n", "O1\nG0 X1\nM2\n", "G0 X1\nM99\n"}) {
    const Interpreted result = interpret_text(program, options);
    EXPECT_EQ(result.diagnostics.errors(), 1U) << program << result.rendered();
    EXPECT_EQ(result.diagnostics.all().front().code, "gcode.no-numbered-programs") << result.rendered();
  }
}

TEST(SettingsFile, the_work_system_may_stay_after_the_program) {
  const auto system_after = [](const InterpreterOptions& options) {
    return interpret_text("G55\nM2\n", options).last<operation::SetWorkOffset>().system;
  };
  EXPECT_EQ(system_after({}), 1);
  EXPECT_EQ(system_after(with_settings("[RS274NGC]\nDISABLE_AUTO_G54 = 1\n")), 2);
}

TEST(SettingsFile, its_values_are_read_only_and_may_be_hidden) {
  for (const char* const text : {"[A]\nB = 3\n", "[A]\nC = 3\n"}) {
    const Interpreted result = interpret_text("#<_ini[a]b>=5\nM2\n", with_settings(text));
    EXPECT_EQ(result.diagnostics.all().front().code, "gcode.read-only-parameter") << result.rendered();
  }
  const std::string program = "#1=#<_ini[a]b>\nM2\n";
  EXPECT_EQ(interpret_text(program, with_settings("[A]\nB = 3\n")).diagnostics.errors(), 0U);
  EXPECT_EQ(interpret_text(program, with_settings("[A]\nB = 3\n[RS274NGC]\nINI_VARS = 0\n")).diagnostics.errors(), 1U);
}

TEST(Parameters, numbers_5021_on_are_the_machine_position_where_a_machine_is_there) {
  InterpreterOptions options;
  options.on_machine = true;
  const std::string program = "G21 G10 L2 P1 X5\nG0 X2\n#1=#5021\nG0 Y#1\nM2\n";
  EXPECT_EQ(interpret_text(program, options).last<operation::StraightTraverse>().end[Axis::y], 7);
  EXPECT_EQ(interpret_text(program).last<operation::StraightTraverse>().end[Axis::y], 0);
  // No offset counts, and the units are the program's: LinuxCNC 2.10 has them as #<_abs_x> and so on.
  const std::string offsets = "G20 G10 L2 P1 X1\nG92 Z3\nG43.1 Z2 C4\nG0 X2 Z5 C30 W-1\n";
  EXPECT_THAT(interpret_text(offsets + "(debug,#5021 #5022 #5023 #5026 #5029)\n"
                                       "(debug,#<_abs_x> #<_abs_y> #<_abs_z> #<_abs_c> #<_abs_w>)\nM2\n",
                             options)
                  .calls(),
              HasSubstr("MESSAGE(\"3.000000 0.000000 4.000000 34.000000 -1.000000\")\n"
                        "MESSAGE(\"3.000000 0.000000 4.000000 34.000000 -1.000000\")"));
  EXPECT_EQ(interpret_text("#5029=1\nM2\n", options).diagnostics.errors(), 1U);
  EXPECT_EQ(interpret_text("#5029=1\nM2\n").diagnostics.errors(), 0U);
}

TEST(Subs, are_found_in_the_folders_of_the_options_in_order) {
  const fs::path folder = fs::temp_directory_path() / "passo_subs_in_folders";
  for (const char* const name : {"first", "second"}) {
    fs::create_directories(folder / name);
    std::ofstream(folder / name / "which.ngc") << "o<which> sub\n(print," << name << ")\no<which> endsub\n";
  }
  std::ofstream(folder / "second" / "only.ngc") << "o<only> sub\n(print,only)\no<only> endsub\n";
  InterpreterOptions options;
  options.sub_folders = {(folder / "first").string(), (folder / "second").string()};
  const Interpreted result = interpret_text("o<which> call\no<only> call\no<missing> call\nM2\n", options);
  fs::remove_all(folder);
  EXPECT_THAT(result.calls(), HasSubstr("first\nonly\n"));
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_THAT(result.diagnostics.all().front().expected,
              HasSubstr("missing.ngc next to the program or in " + options.sub_folders[0]));
}

// rs274 ends the program there. Passo looks for more errors, and a program with an error does not run.
TEST(Subs, an_error_in_a_file_of_its_own_is_told_with_the_file_the_line_and_the_call) {
  const fs::path folder = fs::temp_directory_path() / "passo_error_in_a_file";
  fs::create_directories(folder);
  std::ofstream(folder / "hole.ngc") << "o<hole> sub\nG0 Y#1\nG0 Z[1\no<hole> endsub\n";
  InterpreterOptions options;
  options.sub_folders = {folder.string()};
  const Interpreted result = interpret_text("G21\nG0 X1\no<hole> call [5]\nG0 X2\nM2\n", options);
  fs::remove_all(folder);
  ASSERT_EQ(result.diagnostics.errors(), 1U) << result.rendered();
  EXPECT_THAT(result.rendered(),
              HasSubstr((folder / "hole.ngc").string() + ":3:5: error: the bracket that opens here"));
  EXPECT_THAT(result.rendered(), HasSubstr("= in o<hole>, called at test.ngc:3\n"));
}

}  // namespace
}  // namespace passo
