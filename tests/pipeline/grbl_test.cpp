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
  ASSERT_TRUE(in_file.session().request(request::Start{
      .program = ProgramReader::from_text("t", std::string(program_lines) + "M2\n"), .options = in_grbl()}));
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

TEST(GrblJog, a_sender_that_goes_ends_its_jog) {
  GrblRun run;
  run.send("$J=G91 X100 F3000\n");
  run.pass(Seconds(0.5));
  run.grbl().disconnect();
  ASSERT_TRUE(run.turn_until([&] { return run.is("Idle"); }, Seconds(1)));
  EXPECT_LT(run.session().status().now_at[Axis::x], 60);
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

// Any bytes: the controller answers each line once, and comes to rest after a reset.
TEST(GrblHostile, random_bytes_end_in_a_machine_that_obeys) {
  std::mt19937_64 random(seed());
  const std::string pieces[] = {"G1X",  "G0Y-", "$J=G91X", "F1000", "\n", "\n", "\n",  "\r\n", "?",      "!",    "~",
                                "\x85", "$H",   "$X\n",    "$C\n",  "G2", "I1", "M2",  "(",    ")",      "$$\n", "9e9",
                                "\xC3", "\x90", "G38.2Z-", "1.5",   "%",  "S9", "M3 ", "$10=", "$N0=G0", "\x18", "G91"};
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
