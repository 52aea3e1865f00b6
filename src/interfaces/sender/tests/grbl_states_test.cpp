// The states in which a machine may be when it is greeted, or into which it may come amid a run: each works or is an
// error with a code, and none is waited for without a bound.
#include <array>
#include <random>

#include "grbl_pair.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

TEST(GrblStates, a_machine_that_takes_no_lines_is_not_asked) {
  struct Case {
    const char* state;
    const char* code;
    const char* words;
  };
  for (const auto& [state, code, words] :
       {Case{"Sleep", "grbl.asleep", "Reset it"}, Case{"Check", "grbl.check-mode", "$C"},
        Case{"Hold:0", "grbl.busy", "feed hold"}, Case{"Hold:1", "grbl.busy", "feed hold"},
        Case{"Door:1", "grbl.busy", "close it"}, Case{"Tool", "grbl.busy", "tool change"},
        Case{"Run", "grbl.busy", "already moving (state Run)"}, Case{"Jog", "grbl.busy", "(state Jog)"},
        Case{"Home", "grbl.busy", "(state Home)"}, Case{"Wait", "grbl.busy", "in state Wait"}}) {
    GrblPair pair;
    pair.machine.own_report = [state = state] { return fmt::format("<{}|MPos:0.000,0.000,0.000>", state); };
    ASSERT_TRUE(pair.play([&] { return pair.sender.stopped(); })) << state;
    EXPECT_LT(pair.now, Seconds(5)) << state;
    EXPECT_EQ(pair.sender.fault()->code, code) << state;
    EXPECT_THAT(pair.sender.fault()->message, HasSubstr(words)) << state;
    EXPECT_EQ(pair.sender.lines_sent(), 0U) << state;
  }
}

TEST(GrblStates, an_alarm_at_the_start_is_known_by_its_number) {
  GrblPair said;
  said.machine.more_of_itself = "[FIRMWARE:grblHAL]\r\n";
  said.machine.greeting = "GrblHAL 1.1f ['$' or '$HELP' for help]";
  said.machine.restart();
  said.machine.state = "Alarm";
  said.machine.say("ALARM:11");
  ASSERT_TRUE(said.greet());
  EXPECT_EQ(said.sender.alarm_words(), "ALARM:11, it must be homed first");

  GrblPair reported;
  reported.machine.state = "Alarm";
  reported.machine.own_report = [] { return std::string("<Alarm:1|MPos:0.000,0.000,0.000>"); };
  ASSERT_TRUE(reported.greet());
  EXPECT_EQ(reported.sender.alarm_words(), "ALARM:1, a limit switch closed; the position is lost");

  GrblPair untold;
  untold.machine.state = "Alarm";
  ASSERT_TRUE(untold.greet());
  EXPECT_EQ(untold.sender.alarm_words(), "");
}

// grblHAL with its emergency stop pressed: error:79. The questions are asked again after that.
TEST(GrblStates, an_alarm_in_which_questions_are_refused_is_an_alarm) {
  GrblPair pair;
  pair.machine.state = "Alarm";
  pair.machine.settings = "error:79\r\n";
  ASSERT_TRUE(pair.play([&] { return pair.sender.ready() || pair.sender.fault(); }));
  EXPECT_TRUE(pair.sender.ready()) << pair.sender.fault()->message;
}

TEST(GrblStates, an_alarm_in_which_no_line_is_answered_needs_a_reset) {
  GrblPair pair;
  pair.machine.state = "Mute";
  pair.machine.own_report = [] { return std::string("<Alarm|MPos:0.000,0.000,0.000>"); };
  ASSERT_TRUE(pair.play([&] { return pair.sender.stopped(); }));
  EXPECT_EQ(pair.sender.fault()->code, "grbl.locked");
  EXPECT_THAT(pair.sender.fault()->message, HasSubstr("reset it"));
}

// Streams, changes the state after a second, and plays until the stream ends.
GrblFault fault_amid(const std::string& state, Seconds most, const std::string& line = {}) {
  GrblPair pair;
  EXPECT_TRUE(pair.greet());
  const Seconds begun = pair.now;
  bool changed = false;
  EXPECT_TRUE(pair.stream(100, [&] {
    if (changed || pair.now - begun < Seconds(1)) return;
    changed = true;
    pair.machine.state = state;
    if (!line.empty()) pair.machine.say(line);
  })) << state;
  EXPECT_LT(pair.now - begun, most) << state;
  return pair.sender.fault().value_or(GrblFault{});
}

TEST(GrblStates, a_state_that_does_not_end_by_itself_ends_the_stream) {
  EXPECT_EQ(fault_amid("Sleep", Seconds(2)).code, "grbl.asleep");
  EXPECT_EQ(fault_amid("Check", Seconds(2)).code, "grbl.check-mode");
  const GrblFault alarm = fault_amid("Alarm", Seconds(5));
  EXPECT_THAT(alarm.code, testing::AnyOf("grbl.alarm", "grbl.error"));
  EXPECT_GT(alarm.last_line, 0U);
  const GrblFault old = fault_amid("Alarm", Seconds(2), "ALARM: Hard limit");
  EXPECT_EQ(old.code, "grbl.alarm");
  EXPECT_EQ(old.message, "ALARM: Hard limit");
  // It says that it runs, and nothing goes on.
  const GrblFault stuck = fault_amid("Stuck", Seconds(90));
  EXPECT_EQ(stuck.code, "grbl.no-answer");
  EXPECT_THAT(stuck.message, HasSubstr("in state Stuck, but has neither moved nor answered"));
}

TEST(GrblStates, a_locked_machine_without_lines_in_hand_ends_the_stream_too) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  pair.sender.add("G1F600X1Y0Z0", 1);
  ASSERT_TRUE(pair.play([&] { return pair.sender.all_answered(); }));
  pair.machine.state = "Alarm";
  ASSERT_TRUE(pair.play([&] { return pair.sender.stopped(); }));
  EXPECT_EQ(pair.sender.fault()->code, "grbl.alarm");
}

TEST(GrblStates, people_at_the_machine_have_their_time_and_are_told_what_to_do) {
  for (const char* state : {"Hold:0", "Door:1", "Tool"}) {
    GrblPair pair;
    ASSERT_TRUE(pair.greet());
    const Seconds begun = pair.now;
    int step = 0;
    std::string words;
    ASSERT_TRUE(pair.stream(60, [&] {
      if (step == 0 && pair.now - begun > Seconds(1)) {
        step = 1;
        pair.machine.state = state;
      }
      if (step == 1 && pair.now - begun > Seconds(600)) {
        step = 2;
        words = pair.sender.waits_for();
        pair.machine.resume();
      }
    }));
    EXPECT_FALSE(pair.sender.fault()) << state;
    EXPECT_THAT(words, HasSubstr("cycle start button")) << state;
    EXPECT_EQ(pair.machine.done().size(), 60U) << state;
    EXPECT_EQ(pair.sender.waits_for(), "") << state;
  }
}

// It would go on for seconds after a hold that it does not hear.
TEST(GrblStates, homing_is_reset_at_once) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  pair.machine.put(22, 1);
  pair.machine.homes_for_ever = true;
  pair.sender.add("$H", 0, Seconds(300));
  ASSERT_TRUE(pair.play([&] { return pair.machine.state == "Home"; }));
  pair.sender.stop();
  EXPECT_EQ(pair.sender.take_bytes(pair.now).find('\x18'), 0U);
  pair.machine.receive("\x18");
  ASSERT_TRUE(pair.play([&] { return pair.sender.stopped(); }));
  EXPECT_LT(pair.now, Seconds(5));
}

// Which takes at most five minutes; grblHAL reports its state meanwhile, Grbl is silent.
TEST(GrblStates, homing_that_does_not_end_is_an_error) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  pair.machine.put(22, 1);
  pair.machine.homes_for_ever = true;
  pair.sender.add("$H", 0, Seconds(300));
  ASSERT_TRUE(pair.play_for(Seconds(400), [&] { return pair.sender.stopped(); }));
  EXPECT_EQ(pair.sender.fault()->code, "grbl.no-answer");
}

TEST(GrblStates, a_hold_of_ours_waits_for_nobody) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  int steps = 0;
  ASSERT_TRUE(pair.stream(60, [&] {
    ++steps;
    if (steps == 20) pair.sender.hold();
    if (steps == 100) {
      EXPECT_EQ(pair.sender.report()->state, "Hold");
      EXPECT_EQ(pair.sender.waits_for(), "");
      pair.sender.resume();
    }
  }));
  EXPECT_FALSE(pair.sender.fault());
}

TEST(GrblStates, a_stop_does_not_wait_for_a_machine_that_rests_otherwise) {
  for (const char* state : {"Door:1", "Tool", "Sleep"}) {
    GrblReport report{.state = std::string(state).substr(0, std::string(state).find(':')), .detail = 1};
    EXPECT_TRUE(report.rests()) << state;
  }
  EXPECT_FALSE((GrblReport{.state = "Door", .detail = 2}).rests());
}

// Whatever it says, and whenever: the greeting and the stream end, with a fault or at rest.
TEST(GrblStates, no_words_of_a_machine_are_waited_for_without_end) {
  constexpr std::array words = {"ok",       "error:8",        "error:9",  "error:",
                                "ALARM:1",  "ALARM:",         "ALARM:x",  "<Idle|WPos:1,2,3>",
                                "<Run>",    "<Alarm>",        "<Sleep>",  "<Check>",
                                "<Home>",   "<Idle>",         "<>",       "Grbl 1.1h ['$' for help]",
                                "[VER:]",   "[OPT:V,0,0]",    "[AXS:9:",  "[GC:G55 G56]",
                                "$13=1",    "$10=0",          "[MSG:]",   "[FIRMWARE:grblHAL]",
                                "<Jog|Bf:", "<Idle|Bf:0,64>", "\xff\xfe", "[TLO:1,2]",
                                "",         "[G92:1]",        ">:ok",     "{\"sr\":{}}"};
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    GrblPair pair;
    const unsigned one_in = 50U << random() % 6;
    const auto chatter = [&] {
      if (random() % one_in == 0) pair.machine.say(words[random() % words.size()]);
      pair.machine.silent = random() % 4 == 0;
    };
    ASSERT_TRUE(pair.play([&] { return pair.sender.ready() || pair.sender.stopped(); }, chatter)) << seed;
    EXPECT_LT(pair.now, GrblSender::longest_greeting + Seconds(1)) << seed;
    if (pair.sender.stopped()) continue;
    const Seconds begun = pair.now;
    EXPECT_TRUE(pair.stream(60, chatter)) << seed;
    EXPECT_LT(pair.now - begun, Seconds(200)) << seed;
  }
}

}  // namespace
}  // namespace passo
