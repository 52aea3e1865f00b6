// Every number of grbl that senders may hear from passo serve, ALARM:n and error:n, is raised here by what it stands
// for.
#include <set>

#include "grbl_kit.hpp"
#include <fmt/format.h>

namespace passo::test {
namespace {

struct Expected {
  int number;
  std::string lines;  // the answer to the last one
};

// What is wrong with a line of G-code, or with a line that begins with $.
const Expected errors[] = {
    {1, "X1.2.3"},
    {1, "%"},
    {2, "X--2"},
    {2, "GX"},
    {2, "$y"},
    {2, "$10=x"},
    {3, "$nonsense=1"},
    {3, "$11=-0.5e"},
    {4, "G1 X1 F-1"},
    {4, "$10=-1"},
    {11, "G0 X1" + std::string(80, '0')},
    {11, std::string(300, 'X')},
    {14, "$N0=" + std::string(80, 'G')},
    {14, "$I=" + std::string(80, 'G')},
    {15, "$J=X9999 F100"},
    {16, "$J=G91 X1 F100 M3"},
    {20, "G5"},
    {20, "A1"},
    {21, "G90 G91"},
    {22, "G1 X1"},
    {22, "$J=X1"},
    {23, "G54.1"},
    {24, "G0 G92 X1"},
    {25, "X1 X2"},
    {26, "G92"},
    {26, "$J=G91 F100"},
    {27, "N20000000 G0"},
    {28, "G10 X1"},
    {28, "G4 X1"},
    {4, "N-1 G0"},
    {24, "G10 G43 X1"},
    {29, "G10 L2 P9 X1"},
    {30, "G53 G80"},
    {31, "G80\nX1"},
    {32, "G2 Z1 I1 F100"},
    {33, "G2 X1 Y1 I5 F100"},
    {33, "$N0=G0X9999"},
    {33, "$C\nG0 X9999"},
    {34, "G2 X50 R1 F100"},
    {35, "G2 X1 F100"},
    {36, "G0 X1 I5"},
    {37, "G43.1 X1"},
    {38, "T300"},
};

TEST(GrblNumbers, each_error_of_a_line_is_raised) {
  for (const Expected& expected : errors) {
    GrblRun run;
    run.send(expected.lines + "\n");
    run.pass(Seconds(0.2));
    ASSERT_FALSE(run.replies.empty()) << expected.lines;
    EXPECT_EQ(run.replies.back(), fmt::format("error:{}", expected.number)) << expected.lines;
  }
}

TEST(GrblNumbers, each_error_of_a_state_is_raised) {
  MachineDescription without_switches = example_machine("router");
  without_switches.homing.clear();
  for (AxisDescription& axis : without_switches.axes) axis.home.reset();
  GrblRun plain(without_switches);
  plain.send("$H\n");
  EXPECT_EQ(plain.reply(), "error:5");
  plain.send("G1 X5 F100\n$$\n");
  EXPECT_EQ(plain.reply(), "ok");
  EXPECT_EQ(plain.reply(), "error:8");
  GrblRun locked(example_machine("router"), {.place = Point(), .trust = Trust::unknown});
  locked.send("G0 X1\n");
  EXPECT_EQ(locked.reply(), "error:9");
  locked.board().set_switch(input_door, true);
  locked.pass(Seconds(0.2));
  locked.send("$X\n");
  EXPECT_EQ(locked.reply(), "error:13");
}

// grbl's list of errors, without those of settings that passo does not have: 6, 7, 10, 12, 17.
TEST(GrblNumbers, are_complete) {
  std::set<int> raised = {5, 8, 9, 13};
  for (const Expected& expected : errors) raised.insert(expected.number);
  for (int number = 1; number <= 38; ++number) {
    const bool is_of_a_setting =
        number == 6 || number == 7 || number == 10 || number == 12 || (number > 16 && number < 20);
    EXPECT_EQ(raised.contains(number), !is_of_a_setting) << number;
  }
}

// The next ALARM that the controller says.
std::string next_alarm(GrblRun& run) {
  const auto is_alarm = [&] {
    while (!run.replies.empty() && !run.replies.front().starts_with("ALARM:")) run.replies.pop_front();
    return !run.replies.empty();
  };
  return run.turn_until(is_alarm, Seconds(120)) ? run.replies.front() : "none";
}

TEST(GrblAlarms, tell_why_the_machine_has_stopped) {
  GrblRun hard;
  hard.send("G1 X50 F600\n");
  hard.pass(Seconds(1));
  hard.board().set_switch(input_limit, true);
  EXPECT_EQ(next_alarm(hard), "ALARM:1");
  GrblRun soft;
  soft.send("G0 X9999\n");
  EXPECT_EQ(next_alarm(soft), "ALARM:2");
  GrblRun lost;
  lost.grbl().poll({{.kind = MachineChange::Kind::position_lost}});
  EXPECT_EQ(next_alarm(lost), "ALARM:3");
}

TEST(GrblAlarms, tell_what_a_probe_move_has_met) {
  GrblRun before;
  before.board().set_switch(input_probe, true);
  before.pass(Seconds(0.2));
  before.send("G38.2 Z-1 F100\n");
  EXPECT_EQ(next_alarm(before), "ALARM:4");
  GrblRun nothing;
  nothing.send("G38.2 Z-1 F100\n");
  EXPECT_EQ(next_alarm(nothing), "ALARM:5");
}

// As in grbl: M2 in the line of a probe move ends the program, whatever the probe has met.
TEST(GrblAlarms, let_the_end_of_a_program_behind_a_probe_move_take_effect) {
  GrblRun run;
  run.send("M3 S5000 G55\n");
  EXPECT_EQ(run.reply(), "ok");
  run.send("G38.2 Z-1 F600 M2\n");
  EXPECT_EQ(run.reply(), "ALARM:5");
  EXPECT_TRUE(run.reply().starts_with("[PRB:"));
  EXPECT_EQ(run.reply(), "[MSG:Pgm End]");
  EXPECT_EQ(run.reply(), "ok");
  run.send("$G\n");
  EXPECT_EQ(run.reply(), "[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 F600 S5000]");
  run.pass(Seconds(0.5));
  EXPECT_EQ(run.board().counts().outputs.switches & spindle_on, 0);
}

TEST(GrblCheckMode, touches_at_the_end_of_each_probe_move) {
  GrblRun run;
  run.send("$C\n");
  while (run.reply() != "ok") continue;
  run.send("M8\nG38.4 X5 F100\n");
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_EQ(run.reply(), "ok");
  run.send("G38.3 X5\n");
  EXPECT_EQ(run.reply(), "error:33") << "it is there already";
  run.send("G38.2 X0 M30\n");
  EXPECT_EQ(run.reply(), "[MSG:Pgm End]");
  EXPECT_EQ(run.reply(), "ok");
  run.send("$G\n");
  EXPECT_EQ(run.reply(), "[GC:G1 G54 G17 G21 G90 G94 M5 M9 T0 F100 S0]");
}

TEST(GrblAlarms, tell_why_homing_has_ended) {
  const KnownPosition nowhere{.place = Point(), .trust = Trust::unknown};
  GrblRun stopped(example_machine("router"), nowhere);
  stopped.send("$H\n");
  stopped.pass(Seconds(1));
  ASSERT_TRUE(stopped.session().request(request::Stop{}));
  EXPECT_EQ(next_alarm(stopped), "ALARM:6");
  GrblRun stuck(example_machine("router"), nowhere);
  stuck.board().set_switch(stuck.description().axes.back().home_switches(), true);
  stuck.pass(Seconds(0.1));
  stuck.send("$H\n");
  EXPECT_EQ(next_alarm(stuck), "ALARM:8");
  MachineDescription far = example_machine("router");
  for (AxisDescription& axis : far.axes) {
    axis.home->switch_at += axis.home->toward_high ? 5000 : -5000;
  }
  GrblRun missed(far, nowhere);
  missed.send("$H\n");
  EXPECT_EQ(next_alarm(missed), "ALARM:9");
}

// A machine that has no switches for homing, either: its work zeros were measured from the place that is lost. Where
// the board has counted on, it goes on as a controller does that was never homed.
TEST(GrblAlarms, lock_a_machine_that_has_lost_its_place) {
  MachineDescription bare = example_machine("router");
  bare.homing.clear();
  for (AxisDescription& axis : bare.axes) axis.home.reset();
  GrblRun counted(bare, {.place = Point(), .trust = Trust::unknown});
  EXPECT_TRUE(counted.is("Idle"));
  GrblRun run(bare, {.place = Point(), .trust = Trust::unknown, .is_lost = true});
  run.grbl().connect();
  EXPECT_EQ(run.reply(), "Grbl 1.1h ['$' for help]");
  EXPECT_EQ(run.reply(), "[MSG:'$H'|'$X' to unlock]");
  EXPECT_TRUE(run.is("Alarm"));
  run.send("G0X1\n");
  EXPECT_EQ(run.reply(), "error:9");
  run.send("\x18");
  EXPECT_EQ(run.reply(), "Grbl 1.1h ['$' for help]");
  EXPECT_EQ(run.reply(), "[MSG:'$H'|'$X' to unlock]") << "a reset finds no place";
  run.send("$X\n");
  EXPECT_EQ(run.reply(), "[MSG:Caution: Unlocked]");
  EXPECT_EQ(run.reply(), "ok");
  run.send("G0X1\n");
  EXPECT_EQ(run.reply(), "ok");
  run.pass(Seconds(1));
  EXPECT_NEAR(run.session().status().now_at[Axis::x], 1, 0.01);
}

// A start line that leaves the travel stops as any other line does.
TEST(GrblAlarms, a_start_line_beyond_the_travel_is_an_alarm) {
  GrblRun run;
  GrblMemory memory;
  memory.startup = {"G0X9999", "G0X1"};
  run.grbl().remember(memory, [](const GrblMemory&) { return true; });
  run.grbl().connect();
  run.send("\n");
  for (const char* const line :
       {"Grbl 1.1h ['$' for help]", "ALARM:2", "[MSG:Reset to continue]", ">G0X9999:ok", "ok"}) {
    EXPECT_EQ(run.reply(), line);
  }
  EXPECT_TRUE(run.is("Alarm"));
  run.pass(Seconds(2));
  EXPECT_TRUE(run.replies.empty()) << "the second line does not run";
}

}  // namespace
}  // namespace passo::test
