// What senders of Grbl see: transcripts of their handshakes, streamed programs, holds, jogs and resets.
#include <filesystem>
#include <random>

#include "grbl_kit.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>

namespace passo::test {
namespace {

TEST(GrblTranscripts, each_sender_hears_what_it_expects) {
  int played = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PASSO_SOURCE_DIR "/tests/grbl")) {
    if (entry.path().extension() != ".txt") continue;
    SCOPED_TRACE(entry.path().filename().string());
    GrblRun run;
    play(run, entry.path().string());
    ++played;
  }
  EXPECT_GE(played, 8);
}

constexpr const char* program_lines =
    "G21\nG90\nM3 S1000\nG0 X0 Y0 Z1\nG1 Z-0.5 F400\nG1 X10 Y0 F500\nG1 X10 Y10\nG2 X5 Y15 I-5 J0\nG1 X0 Y10\n"
    "G1 X2.5 Y2.5\nG1 X7.5 Y2.5\nG1 X7.5 Y7.5\nG0 Z1\nM5\nG0 X3 Y4\n";

std::array<std::int64_t, max_motors> counts_of(const VirtualMachine& board) {
  std::array<std::int64_t, max_motors> counts{};
  for (std::size_t m = 0; m < counts.size(); ++m) counts[m] = board.counts().motors[m].position;
  return counts;
}

// As a sender does that counts characters: no more than fits into the told buffer.
void stream(GrblRun& run, const std::string& text, Seconds between = Seconds(0)) {
  std::istringstream lines(text);
  std::deque<std::size_t> unanswered;
  std::size_t in_flight = 0;
  const auto take_answer = [&] {
    ASSERT_EQ(run.reply(), "ok");
    in_flight -= unanswered.front();
    unanswered.pop_front();
  };
  for (std::string line; std::getline(lines, line);) {
    while (in_flight + line.size() + 1 > GrblInput::told_size) take_answer();
    run.send(line + "\n");
    unanswered.push_back(line.size() + 1);
    in_flight += line.size() + 1;
    if (between > Seconds(0)) run.pass(between);
  }
  while (!unanswered.empty()) take_answer();
}

TEST(GrblStream, a_streamed_program_ends_at_the_counts_of_the_program_in_a_file) {
  GrblRun streamed;
  stream(streamed, program_lines);
  ASSERT_TRUE(streamed.turn_until([&] { return streamed.is("Idle"); }));
  GrblRun slow;
  stream(slow, program_lines, Seconds(0.7));
  ASSERT_TRUE(slow.turn_until([&] { return slow.is("Idle"); }));

  GrblRun in_file;
  ASSERT_TRUE(in_file.session().request(
      request::Start{.program = ProgramReader::from_text("t", std::string(program_lines) + "M2\n"),
                     .options = in_grbl(in_file.description())}));
  ASSERT_TRUE(in_file.turn_until([&] { return !in_file.session().busy(); }));
  EXPECT_EQ(counts_of(streamed.board()), counts_of(in_file.board()));
  EXPECT_EQ(counts_of(slow.board()), counts_of(in_file.board()));
}

TEST(GrblStream, short_moves_are_passed_without_stopping) {
  std::string text = "G21 G90 F3000\n";
  for (int i = 1; i <= 200; ++i) text += fmt::format("G1 X{:.2f} Y{:.3f}\n", i * 0.25, 0.02 * (i % 7));
  GrblRun run;
  stream(run, text);
  const Seconds begun = run.session().now();
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_LT(run.session().now() - begun, Seconds(3)) << "50 mm at 50 mm/s, without stops";
}

TEST(GrblStream, a_hold_amid_a_line_rests_on_the_path_and_goes_on) {
  GrblRun run;
  run.send("G1 X20 F1200\nG1 X2");  // the second line is cut
  run.pass(Seconds(0.4));
  run.send("!0 Y5\n");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Hold:0"); }, Seconds(2)));
  const auto held = counts_of(run.board());
  EXPECT_NE(held[0], 0);
  run.pass(Seconds(1));
  EXPECT_EQ(counts_of(run.board()), held);
  run.send("~");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_TRUE(run.status().starts_with("<Idle|MPos:20.000,5.000,0.000|")) << run.status();
}

TEST(GrblStream, a_reset_brakes_and_the_place_stays_known) {
  GrblRun run;
  run.send("G1 X50 F3000\n");
  run.pass(Seconds(0.5));
  run.send("\x18");
  ASSERT_TRUE(
      run.turn_until([&] { return !run.replies.empty() && run.replies.back().starts_with("Grbl"); }, Seconds(2)));
  EXPECT_TRUE(run.is("Idle")) << run.status();
  const double x = run.session().status().position.place[Axis::x];
  EXPECT_GT(x, 1);
  EXPECT_LT(x, 50);
  run.replies.clear();
  run.send("G0 X0\n");
  EXPECT_EQ(run.reply(), "ok");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_EQ(counts_of(run.board())[0], 0);
}

TEST(GrblJog, a_cancelled_jog_brakes_and_the_next_line_goes_on_from_there) {
  GrblRun run;
  run.send("$J=G91 X100 F3000\n");
  EXPECT_EQ(run.reply(), "ok");
  run.pass(Seconds(0.5));
  EXPECT_TRUE(run.is("Jog"));
  run.send("\x85");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }, Seconds(1)));
  const auto rest = counts_of(run.board())[0];
  EXPECT_GT(rest, 640);
  EXPECT_LT(rest, 64000);
  run.send("G91 G0 X1\nG90 G0 X0\n");
  ASSERT_TRUE(run.turn_until([&] { return run.replies.size() == 2; }));
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_EQ(counts_of(run.board())[0], 0);
}

// As in grbl 1.1, which accepts a jog in Idle and Jog only.
TEST(GrblJog, is_refused_during_a_hold_and_has_no_effect_after_it) {
  GrblRun run;
  run.send("G1 X20 F1200\n");
  EXPECT_EQ(run.reply(), "ok");
  run.pass(Seconds(0.4));
  run.send("!");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Hold:0"); }, Seconds(2)));
  run.send("$J=G91 X5 F600\n");
  EXPECT_EQ(run.reply(), "error:8");
  run.send("~");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_TRUE(run.status().starts_with("<Idle|MPos:20.000,0.000,0.000|")) << run.status();
  run.send("$J=G91 X5 F600\n");
  EXPECT_EQ(run.reply(), "ok");
}

TEST(GrblJog, a_jog_leaves_the_modes_as_they_were) {
  GrblRun run;
  run.send("G20 G91 G2 X0 Y0.2 J0.1 F50\n");
  EXPECT_EQ(run.reply(), "ok");
  run.turn_until([&] { return run.is("Idle"); });
  run.send("$G\n");
  const std::string before = run.reply();
  EXPECT_EQ(run.reply(), "ok");
  run.send("$J=G21 G90 X10 F600\n");
  EXPECT_EQ(run.reply(), "ok");
  run.turn_until([&] { return run.is("Idle"); });
  run.send("$G\n");
  EXPECT_EQ(run.reply(), before);
}

TEST(GrblJog, goes_at_its_own_speed_whatever_the_override) {
  GrblRun run;
  for (int i = 0; i < 20; ++i) run.send("\x92");
  run.send("$J=G91 X100 F1200\n");
  run.pass(Seconds(1));
  EXPECT_NEAR(run.session().status().speed_now.value() * 60, 1200, 12);
  run.send("\x85");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  run.send("G91 G1 X50 F1200\n");
  run.pass(Seconds(1));
  EXPECT_NEAR(run.session().status().speed_now.value() * 60, 120, 2);
}

TEST(GrblJog, a_sender_that_goes_ends_its_jog) {
  GrblRun run;
  run.send("$J=G91 X100 F3000\n");
  run.pass(Seconds(0.5));
  run.grbl().disconnect();
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }, Seconds(1)));
  EXPECT_LT(run.session().status().now_at[Axis::x], 60);
}

TEST(GrblJog, of_a_sender_that_asks_no_more_ends_by_its_lease) {
  GrblRun run;
  for (int i = 0; i < 5; ++i) {
    run.send("?");
    run.pass(Seconds(0.2));
  }
  run.send("$J=G91 X200 F3000\n");
  for (int i = 0; i < 5; ++i) {
    run.pass(Seconds(0.2));
    run.send("?");
  }
  EXPECT_TRUE(run.is("Jog")) << "as long as the sender asks";
  run.pass(Seconds(0.3));
  EXPECT_TRUE(run.session().busy()) << "a question may be late";
  run.grbl().receive("");
  run.pass(Seconds(0.6));
  EXPECT_TRUE(run.is("Idle")) << run.status();
  const double reached = run.session().status().now_at[Axis::x];
  EXPECT_GT(reached, 50);
  EXPECT_LT(reached, 110);
}

// Found by the fuzzer: the cancel was asked for again and again at the same instant, for ever.
TEST(GrblJog, that_ends_by_its_lease_is_cancelled_once) {
  GrblRun run;
  run.send("?");
  run.pass(Seconds(0.08));
  run.send("?$J=X15F500\n$J=G91X1000F100\n");
  int turns = 0;
  ASSERT_TRUE(run.turn_until([&] { return ++turns > 5000 || run.session().now() > Seconds(2); }, Seconds(5)));
  EXPECT_LT(turns, 5000);
  EXPECT_TRUE(run.is("Idle")) << run.status();
}

TEST(GrblJog, of_a_sender_that_never_asks_goes_on) {
  GrblRun run;
  run.send("$J=G91 X100 F3000\n");
  run.pass(Seconds(3));
  EXPECT_NEAR(run.session().status().now_at[Axis::x], 100, 1e-3);
}

// Of a transcript: the fields A, Ov, Ln and FS of a status report.
std::string field(const std::string& status, const std::string& name) {
  const std::size_t at = status.find("|" + name + ":");
  if (at == std::string::npos) return "";
  const std::size_t from = at + name.size() + 2;
  return status.substr(from, status.find_first_of("|>", from) - from);
}
std::string report_with(GrblRun& run, const std::string& name) {
  for (int i = 0; i < 40; ++i) {
    if (const std::string status = run.status(); !field(status, name).empty()) return field(status, name);
  }
  return "";
}

TEST(GrblRealTime, a_hold_that_rests_tells_where) {
  for (const double wait : {0.11, 0.3, 0.42, 0.55, 0.7}) {
    GrblRun run;
    run.send("G1 X80 Y31 F2400\n");
    run.pass(Seconds(wait));
    run.send("!");
    ASSERT_TRUE(run.turn_until([&] { return run.session().status().rests; }, Seconds(2)));
    const Point first = run.session().status().now_at;
    run.pass(Seconds(0.3));
    const Point then = run.session().status().now_at;
    EXPECT_EQ(first[Axis::x], then[Axis::x]);
    EXPECT_EQ(first[Axis::y], then[Axis::y]);
  }
}

TEST(GrblRealTime, rapids_go_at_a_half_and_a_quarter) {
  const auto time_of = [](const std::string& command) {
    GrblRun run;
    run.send(command + "G0 X100\n");
    const Seconds begun = run.session().now();
    EXPECT_TRUE(run.turn_until([&] { return run.is("Run"); }));
    EXPECT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
    EXPECT_NEAR(run.session().status().now_at[Axis::x], 100, 1e-3);
    return (run.session().now() - begun).value();
  };
  const double whole = time_of("");
  const double speed = GrblRun().description().axes[0].velocity.value();
  EXPECT_NEAR(time_of("\x96") - whole, 100 / speed, 100 / speed * 0.35) << "twice the way's time, but for speeding up";
  EXPECT_NEAR(time_of("\x97"), 400 / speed, 0.5);
  EXPECT_NEAR(time_of("\x97\x95"), whole, 0.02);
  GrblRun run;
  run.send("\x96");
  EXPECT_EQ(report_with(run, "Ov"), "100,50,100");
}

TEST(GrblRealTime, a_feed_is_not_a_rapid) {
  GrblRun run;
  run.send("\x97G1 X10 F1200\n");
  ASSERT_TRUE(run.turn_until([&] { return run.session().status().speed_now > MmPerSecond(19); }, Seconds(2)));
}

TEST(GrblRealTime, a_spindle_is_stopped_in_a_hold_only_and_turns_again_with_the_resume) {
  GrblRun run;
  run.send("M3 S1000\nG1 X20 F600\n");
  run.pass(Seconds(0.5));
  run.send("\x9E");
  run.pass(Seconds(0.2));
  EXPECT_EQ(run.board().counts().outputs.switches & spindle_on, spindle_on) << "not while the machine moves";
  run.send("!");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Hold:0"); }, Seconds(2)));
  run.send("\x9E");
  run.pass(Seconds(0.1));
  EXPECT_EQ(run.board().counts().outputs.switches & spindle_on, 0);
  run.send("\x9E");
  run.pass(Seconds(0.1));
  EXPECT_EQ(run.board().counts().outputs.switches & spindle_on, spindle_on);
  run.send("\x9E");
  run.pass(Seconds(0.1));
  EXPECT_EQ(run.board().counts().outputs.switches & spindle_on, 0);
  const auto held = counts_of(run.board());
  run.send("~");
  run.pass(Seconds(0.05));
  EXPECT_EQ(run.board().counts().outputs.switches & spindle_on, spindle_on);
  EXPECT_EQ(counts_of(run.board()), held) << "the spindle gets its time";
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_NEAR(run.session().status().now_at[Axis::x], 20, 1e-3);
}

TEST(GrblRealTime, coolant_buttons_count_until_the_program_switches_the_same) {
  GrblRun run;
  const auto flood = [&] { return (run.board().counts().outputs.switches & flood_on) != 0; };
  run.send("G1 X10 F600\n");
  run.pass(Seconds(0.3));
  run.send("\xA0");
  run.pass(Seconds(0.1));
  EXPECT_TRUE(flood());
  EXPECT_EQ(report_with(run, "A"), "F");
  run.send("M3 S100\nG1 X12\n");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_TRUE(flood()) << "another output does not change it";
  run.send("M8\nG1 X14\nM9\nG1 X15\n");
  ASSERT_TRUE(run.turn_until([&] { return run.session().status().now_at[Axis::x] > 14.5; }));
  EXPECT_FALSE(flood());
  run.send("\xA0");
  run.pass(Seconds(0.1));
  EXPECT_TRUE(flood());
  run.send("\xA0");
  run.pass(Seconds(0.1));
  EXPECT_FALSE(flood());

  GrblRun idle;
  idle.send("\xA0");
  idle.pass(Seconds(0.2));
  EXPECT_NE(idle.board().counts().outputs.switches & flood_on, 0);
  idle.send("$G\n");
  EXPECT_NE(idle.reply().find(" M8 "), std::string::npos) << "as a line of the program";
}

TEST(GrblRealTime, a_door_holds_and_switches_off_until_the_resume) {
  GrblRun run;
  run.send("M3 S1000 M8\nG1 X20 F600\n");
  run.pass(Seconds(0.5));
  run.send("\x84");
  run.collect();
  EXPECT_TRUE(run.is("Door:2")) << run.status();
  ASSERT_TRUE(run.turn_until([&] { return run.is("Door:0"); }, Seconds(2)));
  run.pass(Seconds(0.1));
  EXPECT_EQ(run.board().counts().outputs.switches, 0);
  const auto held = counts_of(run.board());
  run.pass(Seconds(1));
  EXPECT_EQ(counts_of(run.board()), held);
  run.send("~");
  run.pass(Seconds(0.1));
  EXPECT_EQ(run.board().counts().outputs.switches, spindle_on) << "the spindle first";
  EXPECT_EQ(counts_of(run.board()), held);
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_EQ(run.board().counts().outputs.switches, spindle_on | flood_on);
  EXPECT_NEAR(run.session().status().now_at[Axis::x], 20, 1e-3);

  GrblRun jog;
  jog.send("$J=G91 X100 F3000\n");
  jog.pass(Seconds(0.5));
  jog.send("\x84");
  ASSERT_TRUE(jog.turn_until([&] { return jog.is("Door:0"); }, Seconds(2)));
  const double reached = jog.session().status().now_at[Axis::x];
  jog.send("~");
  jog.pass(Seconds(1));
  EXPECT_NEAR(jog.session().status().now_at[Axis::x], reached, 0.1) << "the jog is over";
  EXPECT_TRUE(jog.is("Idle")) << jog.status();
}

TEST(GrblRealTime, the_line_that_is_executed_is_told_by_its_number) {
  GrblRun run;
  run.send("N10 G1 X5 F600\nN20 G1 Y5\nG1 X0\n");
  ASSERT_TRUE(run.turn_until([&] { return run.session().status().now_at[Axis::x] > 2; }));
  EXPECT_EQ(field(run.status(), "Ln"), "10");
  ASSERT_TRUE(run.turn_until([&] { return run.session().status().now_at[Axis::y] > 2; }));
  EXPECT_EQ(field(run.status(), "Ln"), "20");
  ASSERT_TRUE(run.turn_until([&] { return run.session().status().now_at[Axis::x] < 3; }));
  EXPECT_EQ(field(run.status(), "Ln"), "");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_EQ(field(run.status(), "Ln"), "");
}

// The machine brakes for the end of the queue. A line that comes then leads on, without a rest.
TEST(GrblStream, a_line_that_comes_while_the_machine_brakes_leads_on) {
  int passed = 0;
  for (int late = 0; late < 12; ++late) {
    GrblRun run;
    run.send("G1 X20 F3000\n");
    ASSERT_TRUE(run.turn_until([&] { return run.session().status().speed_now > MmPerSecond(49); }, Seconds(2)));
    double place = 16 + 0.25 * late;
    ASSERT_TRUE(run.turn_until([&] { return run.session().status().now_at[Axis::x] > place; }, Seconds(2)));
    run.send("G1 X40\n");
    bool rested = false;
    ASSERT_TRUE(run.turn_until(
        [&] {
          rested = rested || run.session().state() == MachineState::await_line;
          return run.session().status().now_at[Axis::x] > 30;
        },
        Seconds(5)));
    passed += rested ? 0 : 1;
    ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
    EXPECT_NEAR(run.session().status().now_at[Axis::x], 40, 1e-3);
  }
  EXPECT_GE(passed, 3);
}

TEST(GrblAxes, of_the_machine_beside_xyz_are_taken_and_told) {
  MachineDescription machine = example_machine("router");
  AxisDescription turn = machine.axes.back();
  turn.axis = Axis::a;
  turn.home.reset();
  turn.travel_low = -3600;
  turn.travel_high = 3600;
  machine.axes.push_back(turn);
  GrblRun run(machine);
  run.send("G1 A90 X1 F600\n");
  EXPECT_EQ(run.reply(), "ok");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_TRUE(run.status().starts_with("<Idle|MPos:1.000,0.000,0.000,90.000|")) << run.status();
  run.send("G1 B9\n$J=G91 A10 F600\n");
  EXPECT_EQ(run.reply(), "error:20");
  EXPECT_EQ(run.reply(), "ok");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_TRUE(run.status().starts_with("<Idle|MPos:1.000,0.000,0.000,100.000|")) << run.status();
  GrblRun three;
  three.send("G1 A9 F100\n");
  EXPECT_EQ(three.reply(), "error:20");
}

TEST(GrblHoming, a_machine_that_is_not_homed_is_locked_until_it_is) {
  GrblRun run(example_machine("router"), KnownPosition{.place = Point(), .trust = Trust::unknown});
  EXPECT_TRUE(run.is("Alarm"));
  run.send("G0 X1\n");
  EXPECT_EQ(run.reply(), "error:9");
  run.send("$H\n");
  run.pass(Seconds(1));
  EXPECT_TRUE(run.replies.empty()) << "still on its way";
  EXPECT_TRUE(run.is("Home"));
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_TRUE(run.is("Idle"));
  EXPECT_EQ(run.session().status().position.trust, Trust::homed);
}

TEST(GrblProbe, what_is_touched_is_told_before_the_ok) {
  TouchBox plate;
  plate.ranges[Axis::z].high = -3;
  GrblRun run(example_machine("router"), GrblRun::at_zero(), {plate});
  run.send("G38.2 Z-10 F100\nG0 Z0\n");
  const std::string probed = run.reply();
  EXPECT_TRUE(probed.starts_with("[PRB:0.000,0.000,-3.0") && probed.ends_with(":1]")) << probed;
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_EQ(run.reply(), "ok");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  EXPECT_EQ(counts_of(run.board())[2], 0);
  run.send("G38.2 Z-2 F100\n");
  EXPECT_EQ(run.reply(), "ALARM:5");
  EXPECT_EQ(run.reply(), "[PRB:0.000,0.000,0.000:0]");
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_TRUE(run.is("Alarm"));
}

TEST(GrblProbe, that_meets_nothing_locks_and_questions_are_answered) {
  GrblRun run;
  run.send("G38.2 Z-1 F600\n");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Alarm"); }));
  while (run.reply() != "ok") continue;
  run.send("$#\n");
  EXPECT_EQ(run.reply(), "[G54:0.000,0.000,0.000]") << "as grbl, which asks for rest alone";
  while (run.reply() != "ok") continue;
  run.send("G0 X1\n");
  EXPECT_EQ(run.reply(), "error:9");
}

TEST(GrblReplies, each_write_is_whole_lines_of_ascii) {
  GrblRun run;
  run.send("?$$\n$#\n$I\n$G\n$\n$N\nG1 X1 F100\n?");
  run.pass(Seconds(1));
  ASSERT_FALSE(run.writes.empty());
  for (const std::string& text : run.writes) {
    EXPECT_TRUE(text.ends_with("\r\n")) << text;
    for (const char c : text) EXPECT_TRUE(c == '\r' || c == '\n' || (c >= ' ' && c < 127)) << text;
  }
}

TEST(GrblSettings, are_written_into_the_machine_file_and_shown) {
  GrblRun run;
  std::ifstream file(PASSO_SOURCE_DIR "/examples/machines/router.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  bool writes = true;
  run.grbl().keep_settings(text, [&](const std::string& before, const std::string& after) {
    if (!writes || before != text) return false;
    text = after;
    return true;
  });
  run.send("$110=4800\n");
  EXPECT_TRUE(run.reply().starts_with("[MSG:Saved in the machine file"));
  EXPECT_EQ(run.reply(), "ok");
  EXPECT_NE(text.find("max_velocity_mm_s = 80 "), std::string::npos);
  run.send("$$\n");
  run.turn_until([&] { return !run.replies.empty() && run.replies.back() == "ok"; });
  EXPECT_NE(std::ranges::find(run.replies, "$110=4800.000"), run.replies.end());
  run.replies.clear();
  writes = false;
  run.send("$110=3000\n");
  EXPECT_TRUE(run.reply().starts_with("[MSG:The machine file cannot"));
  EXPECT_EQ(run.reply(), "error:3");
  run.send("$110=0\n$32=1\n");
  EXPECT_TRUE(run.reply().starts_with("[MSG:This value would"));
  EXPECT_EQ(run.reply(), "error:3");
  EXPECT_TRUE(run.reply().starts_with("[MSG:The machine file has no"));
  EXPECT_EQ(run.reply(), "error:3");
  GrblRun without;
  without.send("$110=3000\n");
  EXPECT_EQ(without.reply(), "error:3");
}

TEST(GrblMemoryOf, a_controller_is_kept_and_its_start_lines_run_for_the_first_sender) {
  std::vector<GrblMemory> kept;
  {
    GrblRun run;
    run.grbl().remember({}, [&](const GrblMemory& memory) {
      kept.push_back(memory);
      return true;
    });
    run.grbl().connect();
    run.send("$N1=G1X2F1200\n$I=SHOP\n$10=1\n$N0=" + std::string(80, 'G') + "\n$N0=G4711\n");
    for (const char* reply : {"Grbl 1.1h ['$' for help]", "ok", "ok", "ok", "error:14", "error:20"}) {
      EXPECT_EQ(run.reply(), reply);
    }
    ASSERT_EQ(kept.size(), 3U);
  }
  GrblRun again;
  again.grbl().remember(kept.back(), [](const GrblMemory&) { return false; });
  EXPECT_FALSE(again.session().busy()) << "nothing moves while nobody is there";
  again.grbl().connect();
  EXPECT_EQ(again.reply(), "Grbl 1.1h ['$' for help]");
  again.pass(Seconds(0.5));
  EXPECT_TRUE(again.replies.empty()) << "whoever has come may be no sender";
  again.send("\n");
  EXPECT_EQ(again.reply(), ">G1X2F1200:ok");
  EXPECT_EQ(again.reply(), "ok");
  ASSERT_TRUE(again.turn_until([&] { return again.session().status().now_at[Axis::x] == 2; }));
  again.grbl().connect();
  EXPECT_EQ(again.reply(), "Grbl 1.1h ['$' for help]");
  again.send("\n");
  EXPECT_EQ(again.reply(), "ok");
  again.pass(Seconds(0.5));
  EXPECT_TRUE(again.replies.empty()) << "once: a later sender finds the controller at work";
  again.send("$I=OTHER\n");
  EXPECT_TRUE(again.reply().starts_with("[MSG:")) << "the disk is full";
  EXPECT_EQ(again.reply(), "error:3");
}

TEST(GrblMemoryOf, offsets_are_shared_with_others_at_rest) {
  GrblRun run;
  std::vector<SavedParameters> shared;
  run.grbl().share_offsets([&](const SavedParameters& parameters) { shared.push_back(parameters); });
  run.send("G1 X10 F600\n");
  ASSERT_TRUE(run.turn_until([&] { return run.session().state() == MachineState::run; }));
  run.send("G10 L2 P2 X5\n");
  run.pass(Seconds(0.1));
  EXPECT_TRUE(shared.empty()) << "a disk takes its time";
  ASSERT_TRUE(run.turn_until([&] { return !shared.empty(); }));
  EXPECT_EQ(shared.back().at(5241), 5);
  SavedParameters others = shared.back();
  others[5221] = 7;
  others[5211] = 99;  // G92 belongs to a program
  run.grbl().apply_offsets(others);
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }));
  run.replies.clear();
  run.send("$#\n");
  EXPECT_EQ(run.reply(), "[G54:7.000,0.000,0.000]");
  EXPECT_EQ(run.reply(), "[G55:5.000,0.000,0.000]");
}

TEST(GrblMemoryOf, all_offsets_and_homes_are_given_back) {
  GrblRun run;
  run.send("G0 X5\n");
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle") && run.session().status().now_at[Axis::x] == 5; }));
  run.send("G28.1\nG30.1\nG10 L2 P1 X2\nG10 L2 P3 Y2\nG92 X1\n");
  run.pass(Seconds(0.5));
  run.replies.clear();
  run.send("$RST=#\n");
  run.pass(Seconds(0.5));
  run.replies.clear();
  run.send("$#\n");
  for (const char* const name : {"G54", "G55", "G56", "G57", "G58", "G59", "G28", "G30", "G92"}) {
    EXPECT_EQ(run.reply(), fmt::format("[{}:0.000,0.000,0.000]", name));
  }
}

TEST(GrblLock, is_not_opened_while_the_door_is) {
  GrblRun run(example_machine("router"), {.place = Point(), .trust = Trust::unknown});
  run.board().set_switch(input_door, true);
  run.pass(Seconds(0.2));
  run.replies.clear();
  run.send("$X\n$H\n");
  EXPECT_EQ(run.reply(), "error:13");
  EXPECT_EQ(run.reply(), "error:13");
  GrblRun closed(example_machine("router"), {.place = Point(), .trust = Trust::unknown});
  closed.send("$X\n");
  EXPECT_EQ(closed.reply(), "[MSG:Caution: Unlocked]");
}

// Any bytes: the controller answers each line once, and comes to rest after a reset.
TEST(GrblHostile, random_bytes_end_in_a_machine_that_obeys) {
  std::mt19937_64 random(seed());
  const std::string pieces[] = {"G1X",  "G0Y-", "$J=G91X", "F1000", "\n",      "\n",   "\n",     "\r\n", "?",    "!",
                                "~",    "\x85", "$H",      "$X\n",  "$C\n",    "G2",   "I1",     "M2",   "(",    ")",
                                "$$\n", "9e9",  "\xC3",    "\x90",  "G38.2Z-", "1.5",  "%",      "\x84", "\x96", "\x9E",
                                "\xA0", "N7",   "A1",      "S9",    "M3 ",     "$10=", "$N0=G0", "\x18", "G91"};
  for (int trial = 0; trial < 40; ++trial) {
    GrblRun run;
    for (int i = 0; i < 150; ++i) {
      run.send(random() % 8 == 0 ? std::string(1, static_cast<char>(random())) : pieces[random() % std::size(pieces)]);
      if (random() % 6 == 0) run.pass(Seconds(0.01));
    }
    run.send("\n\x18");
    ASSERT_TRUE(run.turn_until([&] { return !run.session().busy(); }, Seconds(60))) << "trial " << trial;
    run.pass(Seconds(0.1));
    run.replies.clear();
    run.send("$X\n");
    std::string last;
    ASSERT_TRUE(run.turn_until([&] { return !run.replies.empty() && run.replies.back() == "ok"; }, Seconds(60)))
        << "trial " << trial << ", " << run.status();
  }
}

}  // namespace
}  // namespace passo::test
