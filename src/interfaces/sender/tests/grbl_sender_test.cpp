#include "passo/sender/grbl_sender.hpp"

#include "grbl_pair.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(GrblSender, streams_all_lines_and_fills_the_buffer_to_the_byte_but_never_more) {
  for (const std::size_t bytes : {std::size_t{128}, std::size_t{254}, std::size_t{80}}) {
    GrblPair pair(bytes);
    pair.machine.options = fmt::format("VNMGPH,15,{}", bytes);
    ASSERT_TRUE(pair.greet());
    EXPECT_EQ(pair.sender.buffer_size(), bytes);
    EXPECT_EQ(pair.sender.machine().version, "1.1h.20190830");
    std::size_t most = 0;
    ASSERT_TRUE(pair.stream(300, [&] { most = std::max(most, pair.sender.unanswered_bytes()); }));
    EXPECT_FALSE(pair.sender.fault());
    EXPECT_FALSE(pair.machine.overflowed());
    EXPECT_GT(most, bytes - 16) << "a line would have fitted";
    EXPECT_EQ(pair.machine.done().size(), 300U);
    EXPECT_EQ(pair.machine.done().back(), "G1F600X300Y0Z0");
    EXPECT_EQ((*pair.sender.place())[Axis::x], 300);
  }
}

TEST(GrblSender, takes_128_bytes_if_the_machine_tells_no_size) {
  GrblPair pair;
  pair.machine.options = "PHS";
  ASSERT_TRUE(pair.greet());
  EXPECT_EQ(pair.sender.machine().bytes, 128U);
  EXPECT_EQ(pair.sender.machine().blocks, 15U);
}

TEST(GrblSender, tells_the_line_that_was_refused_and_stops_before_the_next) {
  GrblPair pair;
  pair.machine.refused = "G1F600X40Y0Z0";
  ASSERT_TRUE(pair.greet());
  ASSERT_TRUE(pair.stream(100));
  ASSERT_TRUE(pair.sender.stopped());
  const auto& fault = pair.sender.fault();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, "grbl.error");
  EXPECT_EQ(fault->last_line, 40U);
  EXPECT_EQ(fault->message, "the machine rejects \"G1F600X40Y0Z0\": error:20, it does not support a code of the line");
  for (const std::string& line : pair.machine.done()) EXPECT_NE(line, "G1F600X41Y0Z0");
}

TEST(GrblSender, tells_an_alarm_and_between_which_lines_it_came) {
  GrblPair pair;
  pair.machine.trips = "G1F600X40Y0Z0";
  ASSERT_TRUE(pair.greet());
  ASSERT_TRUE(pair.stream(100));
  const auto& fault = pair.sender.fault();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, "grbl.alarm");
  EXPECT_EQ(fault->message, "ALARM:1, a limit switch closed; the position is lost");
  EXPECT_LE(fault->first_line, 40U);
  EXPECT_GT(fault->first_line, 20U);
  EXPECT_GE(fault->last_line, 40U);
}

TEST(GrblSender, holds_goes_on_and_stops_where_it_holds) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  int steps = 0;
  ASSERT_TRUE(pair.stream(60, [&] {
    ++steps;
    if (steps == 20) pair.sender.hold();
    if (steps == 60) {
      EXPECT_EQ(pair.sender.report()->state, "Hold");
      pair.sender.resume();
    }
    if (steps == 200) pair.sender.stop();
  }));
  EXPECT_TRUE(pair.sender.stopped());
  EXPECT_FALSE(pair.sender.fault());
  EXPECT_EQ(pair.machine.state, "Idle") << "a reset at rest is no alarm";
  EXPECT_EQ((*pair.sender.place())[Axis::x], pair.machine.x);
  EXPECT_LT(pair.machine.x, 60);
}

TEST(GrblSender, notices_a_restart_silence_and_lost_bytes) {
  GrblPair restarted;
  ASSERT_TRUE(restarted.greet());
  int steps = 0;
  ASSERT_TRUE(restarted.stream(60, [&] {
    if (++steps == 50) restarted.machine.restart();
  }));
  ASSERT_TRUE(restarted.sender.fault());
  EXPECT_EQ(restarted.sender.fault()->code, "grbl.restarted");

  GrblPair silent;
  ASSERT_TRUE(silent.greet());
  silent.machine.silent = true;
  silent.machine.block_time = 1000;
  ASSERT_TRUE(silent.stream(60));
  ASSERT_TRUE(silent.sender.fault());
  EXPECT_EQ(silent.sender.fault()->code, "grbl.no-answer");

  GrblPair lossy;
  ASSERT_TRUE(lossy.greet());
  lossy.machine.loses_next_line_end = true;
  ASSERT_TRUE(lossy.stream(1));
  ASSERT_TRUE(lossy.sender.fault());
  EXPECT_EQ(lossy.sender.fault()->code, "grbl.lost-bytes");
}

TEST(GrblSender, waits_for_a_long_dwell) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  pair.sender.add("G4P20", 1, Seconds(20));
  pair.sender.add("G1F600X1Y0Z0", 2);
  ASSERT_TRUE(pair.play([&] { return pair.sender.at_rest(); }));
  EXPECT_FALSE(pair.sender.fault());
}

TEST(GrblSender, says_that_nobody_answers) {
  GrblSender sender{Seconds(0)};
  Seconds now{0};
  for (; now < Seconds(20) && !sender.fault(); now += Seconds(0.05)) static_cast<void>(sender.take_bytes(now));
  ASSERT_TRUE(sender.fault());
  EXPECT_EQ(sender.fault()->code, "grbl.no-answer");
  EXPECT_LT(now, Seconds(8));
}

TEST(GrblSender, overrides_in_grbls_steps) {
  GrblPair pair;
  ASSERT_TRUE(pair.greet());
  static_cast<void>(pair.sender.take_bytes(pair.now));
  const auto bytes_of = [&] {
    std::string bytes;
    for (int i = 0; i < 200; ++i) bytes += pair.sender.take_bytes(pair.now + Seconds(i * 0.005));
    pair.now += Seconds(1);
    std::erase(bytes, '?');
    return bytes;
  };
  pair.sender.override_feed(123);
  EXPECT_EQ(bytes_of(), "\x90\x91\x91\x93\x93\x93");
  pair.sender.override_feed(5);
  EXPECT_EQ(bytes_of(), "\x90\x92\x92\x92\x92\x92\x92\x92\x92\x92");
  pair.sender.override_spindle(89);
  EXPECT_EQ(bytes_of(), "\x99\x9B\x9D");
}

TEST(GrblReport, is_read_with_all_that_counts) {
  const auto report = read_grbl_report("<Hold:1|WPos:1.000,-2.500,0.000,90.000|Bf:3,77|Pn:XP|WCO:0.500,0.000,1.000>");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->state, "Hold");
  EXPECT_EQ(report->detail, 1);
  EXPECT_FALSE(report->rests());
  EXPECT_EQ((*report->work_place)[Axis::y], -2.5);
  EXPECT_EQ((*report->work_offset)[Axis::z], 1.0);
  EXPECT_EQ(report->blocks_free, 3U);
  EXPECT_EQ(report->bytes_free, 77U);
  EXPECT_EQ(report->pins, "XP");
  for (const char* line : {"", "<>", "<Idle", "Idle>", "<|MPos:1>", "ok"}) EXPECT_FALSE(read_grbl_report(line)) << line;
  EXPECT_FALSE(read_grbl_report("<Idle|MPos:1.0,x,2>")->machine_place);
}

}  // namespace
}  // namespace passo
