// What machines with other firmware than Grbl 1.1h, or with other settings, tell.
#include "grbl_pair.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::HasSubstr;

// As grblHAL of August 2026 answers.
void be_grblhal(StrictGrbl& machine) {
  machine.greeting = "GrblHAL 1.1f ['$' or '$HELP' for help]";
  machine.options = "VNML+,100,1024,3,0";
  machine.more_of_itself =
      "[AXS:3:XYZ]\r\n[NEWOPT:ENUMS,RT+,TC,SED]\r\n[FIRMWARE:grblHAL]\r\n[SIGNALS:D]\r\n[NVS STORAGE:*EEPROM]\r\n"
      "[DRIVER:Simulator]\r\n";
  machine.offsets =
      "[G54:0.000,0.000,0.000]\r\n[G59.1:9.000,9.000,9.000]\r\n[G92:0.000,0.000,0.000]\r\n[TLO:0.000,0.000,0.000]\r\n"
      "[PRB:0.000,0.000,0.000:0]\r\n";
}

TEST(GrblDialects, what_grblhal_tells_of_itself_is_no_restart) {
  GrblPair pair(1023);
  be_grblhal(pair.machine);
  ASSERT_TRUE(pair.greet()) << pair.sender.fault()->message;
  EXPECT_EQ(pair.sender.machine().firmware, "grblHAL");
  ASSERT_TRUE(pair.stream(300));
  EXPECT_FALSE(pair.sender.fault());
  // It tells 1024, and holds 1023.
  EXPECT_FALSE(pair.machine.overflowed());
  EXPECT_GT(pair.machine.most_waiting(), 1023U - 32) << "the line that waits for a block has left the buffer";
  EXPECT_EQ(pair.machine.done().size(), 300U);
}

TEST(GrblDialects, each_firmware_has_its_own_alarms_and_errors) {
  EXPECT_EQ(words_of_grbl_alarm("grblHAL", 10), "its emergency stop is pressed");
  EXPECT_EQ(words_of_grbl_alarm("FluidNC", 10), "the spindle did not reach its speed");
  EXPECT_EQ(words_of_grbl_alarm("Grbl", 10), "homing found no second switch of an axis with two motors");
  EXPECT_EQ(words_of_grbl_alarm("grblHAL", 1), words_of_grbl_alarm("Grbl", 1));
  EXPECT_EQ(words_of_grbl_error("grblHAL", 46), "it must be homed first");
  EXPECT_EQ(words_of_grbl_error("FluidNC", 152), "its configuration is invalid; see its boot messages");
  EXPECT_EQ(words_of_grbl_error("FluidNC", 20), words_of_grbl_error("Grbl", 20));
  EXPECT_EQ(words_of_grbl_error("Grbl", 99), "an error that Grbl 1.1 does not have");
}

TEST(GrblDialects, fluidnc_may_start_slowly_and_tell_errors_in_words) {
  GrblPair pair;
  pair.machine.greeting = "Grbl 3.9 [FluidNC v3.9.5 (noradio) '$' for help]";
  pair.machine.options = "MPHS";
  pair.machine.silent = true;
  int steps = 0;
  // It starts for 6 s, and tells what it does.
  ASSERT_TRUE(pair.play([&] { return pair.sender.ready() || pair.sender.fault(); },
                        [&] {
                          ++steps;
                          if (steps % 100 == 0 && steps < 1200) pair.machine.say("[MSG:INFO: Connecting to WiFi STA]");
                          if (steps != 1200) return;
                          pair.machine.restart();
                          pair.machine.silent = false;
                        }));
  ASSERT_FALSE(pair.sender.fault()) << pair.sender.fault()->message;
  EXPECT_EQ(pair.sender.machine().firmware, "FluidNC");
  EXPECT_EQ(pair.sender.machine().bytes, 128U);

  pair.sender.add("G1F600X1Y0Z0", 1);
  static_cast<void>(pair.sender.take_bytes(pair.now));
  pair.sender.receive("error:Unsupported command\r\n", pair.now);
  ASSERT_TRUE(pair.sender.fault());
  EXPECT_EQ(pair.sender.fault()->message, "the machine rejects \"G1F600X1Y0Z0\": error:Unsupported command");
}

TEST(GrblDialects, an_answer_that_comes_late_is_not_that_to_the_first_question) {
  GrblPair pair;
  bool asked = false;
  ASSERT_TRUE(pair.play([&] { return pair.sender.ready() || pair.sender.fault(); },
                        [&] {
                          if (asked || pair.sender.lines_sent() == 0) return;
                          asked = true;
                          pair.sender.receive("ok\r\n", pair.now);  // of the line end that ended another sender's line
                        }));
  ASSERT_TRUE(pair.sender.ready());
  EXPECT_EQ(pair.sender.unanswered_bytes(), 0U);
  EXPECT_EQ(pair.sender.machine().system, "G54");
  ASSERT_TRUE(pair.stream(20));
  EXPECT_FALSE(pair.sender.fault());
}

TEST(GrblDialects, reports_all_the_time_do_not_delay_the_greeting_for_ever) {
  GrblPair pair;
  int steps = 0;
  const bool is_greeted = pair.play([&] { return pair.sender.ready() || pair.sender.fault(); },
                                    [&] {
                                      if (++steps % 20 == 0) pair.machine.say("<Idle|MPos:0.000,0.000,0.000|FS:0,0>");
                                    });
  EXPECT_TRUE(is_greeted && pair.sender.ready());
}

TEST(GrblDialects, a_spindle_may_take_its_time_while_the_machine_is_idle) {
  GrblPair pair;
  pair.machine.spindle_time = 12;
  ASSERT_TRUE(pair.greet());
  pair.sender.add("M3S1000", 1);
  pair.sender.add("G1F600X1Y0Z0", 2);
  ASSERT_TRUE(pair.play([&] { return pair.sender.at_rest() || pair.sender.stopped(); }));
  EXPECT_FALSE(pair.sender.fault());
}

// With $10=0 grblHAL tells the work place alone, and never an offset.
TEST(GrblDialects, a_place_is_known_from_the_work_place_and_the_offsets) {
  GrblPair pair;
  be_grblhal(pair.machine);
  pair.machine.own_report = [] { return std::string("<Idle|WPos:1.000,2.000,3.000>"); };
  pair.machine.offsets =
      "[G54:50.000,0.000,0.000]\r\n[G55:10.000,20.000,0.000]\r\n[G92:0.500,0.000,0.000]\r\n[TLO:0.000,0.000,4.000]\r\n";
  pair.machine.modes = "G0 G55 G17 G21 G90 G94 G40 G43.1 G98 G50 M5 M9 T0 F0 S0.";
  ASSERT_TRUE(pair.greet());
  EXPECT_EQ(*pair.sender.place(), (Point{{11.5, 22, 7}}));

  // Grbl tells the length of the tool alone, and with $13=1 all in inches.
  GrblPair inches;
  inches.machine.settings = "$10=0\r\n$13=1\r\n";
  inches.machine.own_report = pair.machine.own_report;
  inches.machine.offsets = "[G54:0.0000,1.0000,0.0000]\r\n[G92:0.0000,0.0000,0.0000]\r\n[TLO:1.0000]\r\n";
  ASSERT_TRUE(inches.greet());
  const Point place = *inches.sender.place();
  EXPECT_NEAR(place[Axis::x], 25.4, 1e-9);
  EXPECT_NEAR(place[Axis::y], 76.2, 1e-9);
  EXPECT_NEAR(place[Axis::z], 101.6, 1e-9);

  GrblPair nowhere;
  nowhere.machine.own_report = [] { return std::string("<Idle|FS:0,0>"); };
  ASSERT_TRUE(nowhere.greet());
  EXPECT_FALSE(nowhere.sender.place());
}

TEST(GrblDialects, numbers_belong_to_the_axes_that_the_machine_has) {
  GrblPair five;
  five.machine.more_of_itself = "[AXS:5:XYZAB]\r\n";
  five.machine.own_report = [] { return std::string("<Idle|MPos:1.000,2.000,3.000,90.000,45.000>"); };
  ASSERT_TRUE(five.greet());
  EXPECT_EQ(*five.sender.place(), (Point{{1, 2, 3, 90, 45}}));

  GrblPair lathe;
  lathe.machine.more_of_itself = "[AXS:2:XZ]\r\n";
  lathe.machine.own_report = [] { return std::string("<Idle|MPos:1.000,2.000>"); };
  ASSERT_TRUE(lathe.greet());
  ASSERT_TRUE(lathe.play([&] { return lathe.sender.place() == Point{{1, 0, 2}}; }));
}

TEST(GrblDialects, another_firmware_is_no_machine_and_its_words_are_shown) {
  const auto fault_of = [](const std::string& says) {
    GrblPair pair;
    pair.machine.silent = true;
    int steps = 0;
    pair.play([&] { return pair.sender.stopped(); },
              [&] {
                if (++steps % 50 == 0) pair.machine.say(says);
              });
    EXPECT_LT(pair.now, Seconds(21));
    return pair.sender.fault().value_or(GrblFault{});
  };
  GrblFault fault = fault_of("echo:Unknown command: \"$I\"");
  EXPECT_EQ(fault.code, "grbl.no-answer");
  EXPECT_THAT(fault.message, HasSubstr("It sent \"echo:Unknown command: \"$I\"\""));
  fault = fault_of("{\"r\":{\"fv\":0.99},\"f\":[1,0,4]}");
  EXPECT_THAT(fault.message, HasSubstr("It sent \"{\"r\""));
  fault = fault_of("\xfe\x80\x06\xf8");
  EXPECT_EQ(fault.code, "grbl.no-answer");
  EXPECT_THAT(fault.message, HasSubstr("another baud rate (@BAUD)"));
  for (const char* old : {"Grbl 0.9j ['$' for help]", "<Idle,MPos:0.000,0.000,0.000,WPos:0.000,0.000,0.000>"}) {
    fault = fault_of(old);
    EXPECT_EQ(fault.code, "grbl.too-old") << old;
  }
}

TEST(GrblDialects, broken_lines_tell_nothing) {
  GrblMachine machine;
  for (const char* line : {"$", "$=", "$13", "$13=x", "$nan=1", "$1e99=1", "[", "[]", "[OPT:", "[OPT:]", "[OPT:V]",
                           "[AXS:]", "[AXS:3:]", "[GC:]", "[G54:]", "[G54:x]", "[VER]", "[TLO:nan]", ""}) {
    machine.hear(line);
  }
  EXPECT_EQ(machine.blocks, 15U);
  EXPECT_EQ(machine.bytes, 128U);
  EXPECT_EQ(machine.axes, grbl_axes);
  EXPECT_TRUE(machine.offsets.empty());
  EXPECT_TRUE(machine.settings.empty());
  EXPECT_FALSE(read_grbl_report("<Idle|MPos:nan,0,0>")->machine_place);
  EXPECT_FALSE(read_grbl_report("<Idle|Bf:-1,1e9>")->bytes_free);
  EXPECT_EQ(read_grbl_report("<Run|FS:1500,8000>")->feed, 1500);
  EXPECT_EQ(read_grbl_report("<Run|F:12.5>")->feed, 12.5);
  EXPECT_FALSE(read_grbl_report("<Run|FS:inf,0>")->feed);
}

}  // namespace
}  // namespace passo
