// Where a sender's lines end and wait: the stream, overrides, what is shown, a cancel that comes with its jog.
#include "pipeline/grbl_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::GrblRun;

bool is_idle_within(GrblRun& run, Seconds time) {
  return run.turn_until([&] { return run.session().state() == MachineState::idle; }, time);
}

TEST(GrblStream, ends_when_its_sender_has_gone) {
  for (const std::string end : {"", "M30\n"}) {
    GrblRun run;
    run.send("G21 G91 G1 X1 F600\n" + end);
    ASSERT_TRUE(run.turn_until([&] { return run.session().state() == MachineState::await_line; }));
    run.grbl().disconnect();
    EXPECT_TRUE(is_idle_within(run, Seconds(0.2))) << end;
    EXPECT_EQ(run.session().status().position.place[Axis::x], 1) << end;
  }
}

TEST(GrblStream, ends_a_second_after_its_last_line_and_begins_anew_with_the_next) {
  GrblRun run;
  run.send("G91 G1 X1 F600\n");
  ASSERT_TRUE(run.turn_until([&] { return run.session().state() == MachineState::await_line; }));
  run.pass(Seconds(0.8));
  EXPECT_EQ(run.session().state(), MachineState::await_line);
  EXPECT_TRUE(is_idle_within(run, Seconds(0.5)));
  run.send("X1\n$G\n");
  EXPECT_TRUE(run.turn_until([&] { return run.session().status().position.place[Axis::x] == 2; }));
  run.pass(Seconds(0.1));
  EXPECT_NE(std::ranges::find_if(run.replies, [](const std::string& line) { return line.find("G91") != line.npos; }),
            run.replies.end());
}

TEST(GrblStream, goes_on_while_the_spindle_is_on) {
  GrblRun run;
  run.send("M3 S1000\n");
  run.pass(Seconds(3));
  run.grbl().disconnect();
  run.pass(Seconds(3));
  EXPECT_EQ(run.session().state(), MachineState::await_line);
  run.grbl().connect();
  run.send("M5\n");
  EXPECT_TRUE(is_idle_within(run, Seconds(2)));
}

TEST(GrblOverrides, are_a_hundred_percent_again_after_the_end_of_a_program) {
  for (const std::string end : {"M2", "M30"}) {
    GrblRun run;
    run.send("G91 G1 X2 F600\n" + end + "\n\x91\x91\x96\x9A");
    const auto is_whole = [&] { return run.session().status().overrides == Overrides(); };
    run.turn_until([&] { return run.session().state() == MachineState::run; });
    EXPECT_FALSE(is_whole());
    run.pass(Seconds(0.05));
    EXPECT_FALSE(is_whole()) << "the program has not come to its end";
    EXPECT_NE(run.status().find("|Ov:120,50,110"), std::string::npos);
    EXPECT_TRUE(run.turn_until(is_whole, Seconds(5))) << end;
    EXPECT_EQ(run.session().status().position.place[Axis::x], 0) << "it is still the same stream";
    EXPECT_NE(run.status().find("|Ov:100,100,100"), std::string::npos);
  }
}

TEST(GrblOverrides, stay_where_no_program_has_ended) {
  GrblRun run;
  run.send("\x91G91 G1 X1 F600\n");
  run.pass(Seconds(3));
  EXPECT_EQ(run.session().status().overrides.feed, 1.1);
}

TEST(GrblReport, shows_outputs_and_overrides_in_the_next_report) {
  GrblRun run;
  for (int i = 0; i < 3; ++i) run.status();
  const auto expect_next = [&](const std::string& bytes, const std::string& shown) {
    run.send(bytes);
    run.pass(Seconds(0.2));
    EXPECT_NE(run.status().find(shown), std::string::npos) << bytes;
    EXPECT_EQ(run.status().find("|Ov:"), std::string::npos) << bytes << ": once";
    run.replies.clear();
  };
  expect_next("M3 S1000\n", "|Ov:100,100,100|A:S>");
  expect_next("M8\n", "|Ov:100,100,100|A:SF>");
  expect_next("M9\n", "|Ov:100,100,100|A:S>");
  expect_next("M5\n", "|Ov:100,100,100>");
  expect_next("\x91", "|Ov:110,100,100>");
  ASSERT_TRUE(run.session().request(request::Override{.rapids = 0.5}));
  expect_next("", "|Ov:110,50,100>");
}

TEST(GrblJog, a_cancel_in_the_same_packet_cancels) {
  for (const std::string cancel : {"\x85", "\xC2\x85"}) {
    GrblRun run;
    run.send("$J=G91X100F1000\n$J=G91X100F1000\n" + cancel);
    run.pass(Seconds(2));
    EXPECT_EQ(run.session().status().now_at[Axis::x], 0);
    EXPECT_EQ(run.replies, (std::deque<std::string>{"ok", "ok"}));
    EXPECT_TRUE(run.is("Idle"));
    // The next one is another jog.
    run.send("$J=G91X1F1000\n");
    run.pass(Seconds(2));
    EXPECT_EQ(run.session().status().now_at[Axis::x], 1);
  }
}

TEST(GrblJog, a_cancel_amid_its_line_cancels) {
  GrblRun run;
  run.send(
      "$J=G91X1\x85"
      "00F1000\n$J=G91X1F1000\n");
  run.pass(Seconds(2));
  EXPECT_EQ(run.session().status().now_at[Axis::x], 1);
}

TEST(GrblJog, a_cancel_just_after_its_line_cancels) {
  GrblRun run;
  run.send("$J=G91X100F1000\n");
  run.poll();
  run.send("\x85");
  run.pass(Seconds(2));
  EXPECT_EQ(run.session().status().now_at[Axis::x], 0);
  EXPECT_TRUE(run.is("Idle"));
}

TEST(GrblJog, a_cancel_takes_no_other_line) {
  GrblRun run;
  run.send("G91 G1 X1 F600\n\x85");
  run.pass(Seconds(2));
  EXPECT_EQ(run.session().status().now_at[Axis::x], 1);
}

TEST(GrblStops, say_their_words_where_the_machine_waits) {
  GrblRun run;
  run.send("G91 G1 X1 F600\n(MSG,Turn the pl\xC3\xA4te [A])\n(msg , and clamp it)\nM0 (now)\nG1 X1\n");
  ASSERT_TRUE(run.turn_until([&] { return run.session().status().waits_for.has_value(); }));
  run.pass(Seconds(0.1));
  const std::deque<std::string> said{
      "ok", "ok", "ok", "ok", "ok", "[MSG:Turn the pl\xC3\xA4te [A]]", "[MSG:and clamp it]"};
  EXPECT_EQ(run.replies, said);
  run.replies.clear();
  run.send("!");
  run.pass(Seconds(0.2));
  EXPECT_TRUE(run.replies.empty()) << "the same wait";
  run.send("~");
  run.pass(Seconds(1));
  EXPECT_EQ(run.session().status().now_at[Axis::x], 2);
  run.send("M0\n");
  run.pass(Seconds(1));
  EXPECT_EQ(run.replies, (std::deque<std::string>{"ok"}));
}

}  // namespace
}  // namespace passo
