// The hooks of the machine file, before the first line of a job and at its M2.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct HookRun {
  std::vector<std::string> events;
  Diagnostics diagnostics;
  SavedParameters saved;
};

HookRun run(const ProgramHooks& hooks, const std::string& program, Dialect dialect = Dialect::linuxcnc) {
  HookRun done;
  InterpreterOptions options;
  options.hooks = hooks;
  options.dialect = dialect;
  options.on_machine = true;
  Interpreter interpreter(ProgramReader::from_text("t", program), options, done.diagnostics);
  Frame frame;
  Operation operation;
  const auto at = [&](const Point& end) {
    const Point to = frame.machine_from_work(end);
    done.events.push_back(fmt::format("X{:g} Z{:g}", to[Axis::x], to[Axis::z]));
  };
  while (interpreter.next(operation)) {
    frame.follow(operation);
    if (const auto* move = std::get_if<operation::StraightTraverse>(&operation.what)) at(move->end);
    if (const auto* move = std::get_if<operation::StraightFeed>(&operation.what)) at(move->end);
    if (const auto* flood = std::get_if<operation::SetFlood>(&operation.what)) {
      done.events.emplace_back(flood->on ? "flood" : "dry");
    }
    if (std::holds_alternative<operation::ProgramEnd>(operation.what)) done.events.emplace_back("end");
  }
  done.saved = interpreter.saved_parameters();
  return done;
}

const ProgramHooks both{.at_start = "G20 G90\nM8\nG53 G0 X1\nG91\n", .at_end = "M9\nG53 G0 X2\n"};

TEST(Hooks, run_before_the_first_line_and_before_the_end) {
  for (const char* const end : {"M2\n", "m30 (done)\n", "N9 M 0 2\n"}) {
    const HookRun done = run(both, std::string("G0 X10\nX20 Z3\n") + end);
    EXPECT_FALSE(done.diagnostics.any_error()) << render(done.diagnostics, false);
    // The modes of the hook are not those of the program, and its coolant is.
    EXPECT_THAT(done.events, ElementsAre("flood", "X25.4 Z0", "X10 Z0", "X20 Z3", "dry", "X2 Z3", "end")) << end;
  }
}

TEST(Hooks, are_left_out_by_small_programs_without_an_end) {
  EXPECT_THAT(run(both, "%\nG0 X10 (not M2)\n%\n").events, ElementsAre("X10 Z0"));
  EXPECT_THAT(run(both, "G0 X10 ; M30\n").events, ElementsAre("X10 Z0"));
}

TEST(Hooks, run_where_the_end_is_in_a_sub_or_behind_a_percent_sign) {
  EXPECT_THAT(run(both, "%\no<e> sub\nM2\no<e> endsub\nG0 X10\no<e> call\n%\n").events,
              ElementsAre("flood", "X25.4 Z0", "X10 Z0", "dry", "X2 Z0", "end"));
}

TEST(Hooks, may_have_flow_and_subs_and_only_one_of_them) {
  const HookRun done =
      run({.at_start = "#<n> = 2\no1 while [#<n> GT 0]\nG0 X#<n>\n#<n> = [#<n>-1]\no1 endwhile\n"}, "G0 X5\nM2\n");
  EXPECT_FALSE(done.diagnostics.any_error()) << render(done.diagnostics, false);
  EXPECT_THAT(done.events, ElementsAre("X2 Z0", "X1 Z0", "X5 Z0", "end"));
  EXPECT_THAT(run({.at_end = "G0 X1\n"}, "G0 X5\nM2\n").events, ElementsAre("X5 Z0", "X1 Z0", "end"));
}

TEST(Hooks, end_the_program_if_they_leave_other_offsets_or_tools_or_end_it) {
  const std::vector<std::pair<std::string, std::string>> troubles = {
      {"G92 X5\n", "has changed the offset of G92"},
      {"G10 L2 P1 Z-9\n", "has changed the offset of G54 (#5223)"},
      {"M61 Q4\n", "has put tool 4 into the spindle"},
      {"M2\n", "the program would end in a hook"},
  };
  for (const auto& [lines, words] : troubles) {
    for (const bool at_start : {true, false}) {
      const HookRun done =
          run(at_start ? ProgramHooks{.at_start = lines} : ProgramHooks{.at_end = lines}, "G0 X1\nM2\n");
      ASSERT_TRUE(done.diagnostics.any_error()) << lines;
      EXPECT_EQ(done.diagnostics.all().front().code, "gcode.hook");
      EXPECT_THAT(done.diagnostics.all().front().message, HasSubstr(words));
      EXPECT_EQ(done.saved.contains(5211) ? done.saved.at(5211) : 0, 0);
    }
  }
}

TEST(Hooks, name_their_own_lines_in_messages) {
  const HookRun done = run({.at_start = "G0 X1\nG0 X[\n"}, "G0 X1\nM2\n");
  ASSERT_TRUE(done.diagnostics.any_error());
  EXPECT_EQ(done.diagnostics.all().front().file, "hooks.at_start of the machine file");
  EXPECT_EQ(done.diagnostics.all().front().place.line, 3U);
}

TEST(Hooks, refuse_programs_of_the_grbl_dialect) {
  const HookRun done = run(both, "G0 X1\nM2\n", Dialect::grbl);
  ASSERT_TRUE(done.diagnostics.any_error());
  EXPECT_EQ(done.diagnostics.all().front().code, "gcode.hook");
}

}  // namespace
}  // namespace passo
