// Each firmware, recognized by what its board says of itself.
#include "passo/sender/grbl_firmware.hpp"

#include <set>

#include "fake_pair.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

TEST(GrblFirmware, each_board_is_recognized_with_its_axes_and_buffers) {
  struct Expected {
    test::FirmwareTraits traits;
    const char* name;
    const char* version;
    const char* axes;
    std::size_t blocks;
    std::size_t bytes;
  };
  const Expected all[] = {
      {test::grbl_mega(), "grbl-Mega", "1.1h.20190825", "XYZ", 35, 255},
      {test::grbl_mega_5x(), "grbl-Mega-5X", "1.2i.20260521", "XYZAB", 35, 255},
      {test::grbl_mega_5x("XYUV"), "grbl-Mega-5X", "1.2i.20260521", "XYUV", 35, 255},
      {test::grblhal(), "grblHAL", "1.1f.20260817", "XYZ", 100, 1023},
      {test::grblhal("XYZABCUV"), "grblHAL", "1.1f.20260817", "XYZABCUV", 100, 1023},
      {test::fluidnc(3), "FluidNC", "4.0 FluidNC v4.0.1", "XYZ", 15, 128},
      {test::fluidnc(5), "FluidNC", "4.0 FluidNC v4.0.1", "XYZAB", 15, 128},
      {test::ucnc(3), "uCNC", "uCNC 1.11.0 - Generic board", "XYZ", 20, 128},
      {test::ucnc(4), "uCNC", "uCNC 1.11.0 - Generic board", "XYZA", 20, 128},
  };
  for (const Expected& expected : all) {
    FakePair pair(expected.traits);
    ASSERT_TRUE(pair.greet()) << expected.name << ": " << pair.sender.fault().value_or(GrblFault{}).message;
    const GrblMachine& machine = pair.sender.machine();
    EXPECT_EQ(machine.firmware, expected.name);
    EXPECT_TRUE(machine.is_known());
    EXPECT_EQ(machine.version, expected.version);
    EXPECT_EQ(machine.axes, expected.axes) << expected.name;
    EXPECT_EQ(machine.blocks, expected.blocks) << expected.name;
    EXPECT_EQ(machine.bytes, expected.bytes) << expected.name;
    EXPECT_EQ(pair.sender.place(), Point()) << expected.name;
  }
}

TEST(GrblFirmware, a_firmware_that_no_row_describes_is_treated_as_grbl) {
  test::FirmwareTraits traits = test::grbl_mega();
  traits.about = {"[VER:2.0.20260101:]", "[OPT:V,15,128]", "[FIRMWARE:MyFork]"};
  FakePair pair(traits);
  ASSERT_TRUE(pair.greet());
  EXPECT_EQ(pair.sender.machine().firmware, "MyFork");
  EXPECT_FALSE(pair.sender.machine().is_known());
  EXPECT_EQ(pair.sender.machine().row().name, "Grbl");
  EXPECT_EQ(words_of_grbl_error("MyFork", 20), words_of_grbl_error("Grbl", 20));
}

TEST(GrblFirmware, more_is_asked_of_those_that_tell_more) {
  FakePair hal(test::grblhal("XYZA"));
  ASSERT_TRUE(hal.greet());
  EXPECT_THAT(hal.board.lines(), Contains("$I+"));
  EXPECT_TRUE(hal.sender.machine().has_option("TC"));
  EXPECT_FALSE(hal.sender.machine().has_option("SD"));
  EXPECT_TRUE(hal.sender.machine().has_mist());
  // An alarm that no table has, in the board's words.
  hal.sender.receive("ALARM:99\r\n", hal.now);
  ASSERT_TRUE(hal.sender.fault());
  EXPECT_EQ(hal.sender.fault()->message, "ALARM:99, The coolant is empty.");

  FakePair mega(test::grbl_mega());
  ASSERT_TRUE(mega.greet());
  EXPECT_THAT(mega.board.lines(), Not(Contains("$I+")));
  EXPECT_FALSE(mega.sender.machine().has_mist()) << "it was built without M7";
}

TEST(GrblFirmware, a_board_that_rejects_a_question_is_used_without_the_answer) {
  test::FirmwareTraits traits = test::grblhal();
  traits.more_about.clear();
  traits.answers.clear();
  FakePair pair(traits);
  ASSERT_TRUE(pair.greet()) << pair.sender.fault()->message;
  EXPECT_EQ(pair.sender.machine().firmware, "grblHAL");
  EXPECT_FALSE(pair.sender.take_reply()) << "only answers to the owner's questions";
}

TEST(GrblFirmware, the_answers_to_questions_come_in_their_order) {
  FakePair pair(test::grbl_mega());
  ASSERT_TRUE(pair.greet());
  pair.sender.ask("$X=1");
  pair.sender.ask("$G");
  ASSERT_TRUE(pair.play([&] { return pair.sender.all_answered(); }));
  const auto first = pair.sender.take_reply();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->line, "$X=1");
  EXPECT_EQ(first->error, "error:3, the '$' command is unknown");
  const auto second = pair.sender.take_reply();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->line, "$G");
  EXPECT_EQ(second->error, "");
  EXPECT_THAT(second->said, ElementsAre("[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]"));
  EXPECT_FALSE(pair.sender.fault());
}

TEST(GrblFirmware, messages_of_the_board_are_kept_until_they_are_taken) {
  FakePair pair(test::fluidnc());
  ASSERT_TRUE(pair.greet());
  EXPECT_THAT(pair.sender.take_messages(), ElementsAre(" Machine: Foam"));
  for (int i = 0; i < 100; ++i) pair.sender.receive("[MSG:WARN: low memory]\r\n", pair.now);
  EXPECT_EQ(pair.sender.take_messages().size(), 50U);
  EXPECT_TRUE(pair.sender.take_messages().empty());
}

TEST(GrblFirmware, values_in_inches_are_converted_as_each_firmware_means_them) {
  const auto at = [](const char* firmware) {
    GrblMachine machine;
    machine.firmware = firmware;
    machine.settings[13] = 1;
    return machine.millimetres(Point{{1, 0, 0, 10}});
  };
  EXPECT_EQ(at("grblHAL"), (Point{{25.4, 0, 0, 10}}));
  EXPECT_EQ(at("FluidNC"), (Point{{25.4, 0, 0, 10}}));
  EXPECT_EQ(at("grbl-Mega-5X"), (Point{{25.4, 0, 0, 254}}));
}

TEST(GrblFirmware, the_table_has_each_name_and_mark_once) {
  std::set<std::string_view> names;
  std::set<std::string_view> marks;
  for (const GrblFirmware& firmware : grbl_firmwares()) {
    EXPECT_TRUE(names.insert(firmware.name).second) << firmware.name;
    EXPECT_TRUE(firmware.mark.empty() || marks.insert(firmware.mark).second) << firmware.name;
    EXPECT_EQ(&grbl_firmware(firmware.name), &firmware);
  }
  EXPECT_EQ(grbl_firmwares().front().name, "Grbl");
}

}  // namespace
}  // namespace passo
