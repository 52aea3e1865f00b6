// A spindle with a simulated drive at a pseudo-terminal, in real time.
#include "passo/spindle/modbus_spindle.hpp"

#include <chrono>
#include <functional>
#include <string>

#include "kit/simulated_vfd.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/spindle/open_vfd.hpp"

namespace passo {
namespace {

using test::SimulatedVfd;
using testing::HasSubstr;

using Kind = SimulatedVfd::Kind;

bool comes_true(const std::function<bool()>& condition, double seconds = 3) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

SpindleBusDescription bus_of(Kind kind, const SimulatedVfd& drive) {
  const char* const name = kind == Kind::huanyang ? "huanyang"
                           : kind == Kind::h100   ? "h100"
                                                  : PASSO_SOURCE_DIR "/examples/drives/delta-ms300.toml";
  return {.drive = name, .device = drive.device(), .highest_rpm = 24000, .rated_current = 10, .reach = Seconds(2)};
}

std::unique_ptr<ModbusSpindle> spindle_at(Kind kind, const SimulatedVfd& drive) {
  Diagnostics diagnostics;
  auto opened = open_vfd(bus_of(kind, drive), diagnostics);
  EXPECT_TRUE(opened) << opened.error();
  if (!opened) return nullptr;
  return std::make_unique<ModbusSpindle>(std::move(opened->vfd), bus_of(kind, drive));
}

constexpr SpindleOrder forward{.direction = SpindleDirection::clockwise, .revolutions_per_minute = 12000};
constexpr SpindleOrder reverse{.direction = SpindleDirection::counterclockwise, .revolutions_per_minute = 12000};

class EachDrive : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(ModbusSpindle, EachDrive, testing::Values(Kind::huanyang, Kind::h100, Kind::table),
                         [](const auto& kind) {
                           return kind.param == Kind::huanyang ? "huanyang"
                                  : kind.param == Kind::h100   ? "h100"
                                                               : "table";
                         });

// Frames of both families: those of the H-100 are those of a table.
class BadBus : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(ModbusSpindle, BadBus, testing::Values(Kind::huanyang, Kind::table),
                         [](const auto& kind) { return kind.param == Kind::huanyang ? "huanyang" : "table"; });

TEST_P(EachDrive, runs_reverses_and_stops) {
  SimulatedVfd drive(GetParam());
  const auto spindle = spindle_at(GetParam(), drive);
  ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
  spindle->order(forward);
  EXPECT_FALSE(spindle->status().at_speed);
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  EXPECT_NEAR(drive.hertz(), 200, 10);
  ASSERT_TRUE(comes_true([&] { return spindle->status().current.value_or(0) > 0; }));
  EXPECT_NEAR(*spindle->status().current, 5, 0.11);
  EXPECT_NEAR(*spindle->status().load, 0.5, 0.02);
  spindle->order(reverse);
  EXPECT_FALSE(spindle->status().at_speed);
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  EXPECT_NEAR(drive.hertz(), -200, 10);
  spindle->order({});
  ASSERT_TRUE(comes_true([&] { return drive.hertz() == 0; }));
  EXPECT_FALSE(spindle->status().has_failed());
}

TEST_P(BadBus, bears_damaged_late_and_missing_replies) {
  SimulatedVfd drive(GetParam());
  const auto spindle = spindle_at(GetParam(), drive);
  ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
  spindle->order(forward);
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  const auto await_good_replies = [&] {
    const int before = drive.requests();
    return comes_true([&] { return drive.requests() > before + 2; });
  };
  drive.wrong_checksums = 2;
  ASSERT_TRUE(comes_true([&] { return drive.wrong_checksums == 0; }));
  ASSERT_TRUE(await_good_replies());
  drive.silent_replies = 1;
  ASSERT_TRUE(comes_true([&] { return drive.silent_replies == 0; }));
  ASSERT_TRUE(await_good_replies());
  drive.delay_ms = 120;
  ASSERT_TRUE(await_good_replies());
  EXPECT_FALSE(spindle->status().has_failed()) << spindle->status().fault.text;
  EXPECT_TRUE(spindle->status().at_speed);
}

TEST_P(BadBus, is_lost_within_a_second_of_silence_and_stopped_when_it_returns) {
  SimulatedVfd drive(GetParam());
  const auto spindle = spindle_at(GetParam(), drive);
  ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
  spindle->order(forward);
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  drive.is_silent = true;
  ASSERT_TRUE(comes_true([&] { return spindle->status().has_failed(); }, 1.5));
  EXPECT_EQ(spindle->status().fault.code, "spindle.no-answer");
  EXPECT_FALSE(spindle->clear_fault());
  EXPECT_TRUE(drive.is_told_to_run());
  drive.is_silent = false;
  ASSERT_TRUE(comes_true([&] { return !drive.is_told_to_run(); }));
  ASSERT_TRUE(comes_true([&] { return spindle->clear_fault(); }));
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  EXPECT_NEAR(drive.hertz(), 200, 10);
}

TEST_P(EachDrive, is_stopped_when_the_owner_ends) {
  SimulatedVfd drive(GetParam());
  {
    const auto spindle = spindle_at(GetParam(), drive);
    ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
    spindle->order(forward);
    ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  }
  EXPECT_FALSE(drive.is_told_to_run());
}

TEST(ModbusSpindle, names_a_fault_of_the_drive_and_goes_on_after_its_reset) {
  SimulatedVfd drive(Kind::table);
  const auto spindle = spindle_at(Kind::table, drive);
  ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
  spindle->order(forward);
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  drive.fault = 21;
  ASSERT_TRUE(comes_true([&] { return spindle->status().has_failed(); }));
  EXPECT_EQ(spindle->status().fault.text, "the spindle's drive reports fault 21: the drive is overloaded (oL)");
  ASSERT_TRUE(comes_true([&] { return spindle->clear_fault(); }));
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
}

TEST(ModbusSpindle, notices_a_drive_that_was_switched_off_and_on) {
  SimulatedVfd drive(Kind::huanyang);
  const auto spindle = spindle_at(Kind::huanyang, drive);
  ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
  spindle->order(forward);
  ASSERT_TRUE(comes_true([&] { return spindle->status().at_speed; }));
  drive.restart();
  ASSERT_TRUE(comes_true([&] { return spindle->status().has_failed(); }));
  EXPECT_EQ(spindle->status().fault.code, "spindle.slowed");
}

TEST(ModbusSpindle, a_drive_that_refuses_its_commands_fails) {
  SimulatedVfd drive(Kind::h100);
  const auto spindle = spindle_at(Kind::h100, drive);
  ASSERT_TRUE(spindle && spindle->await_drive(Seconds(2)));
  drive.exceptions = 1000;
  spindle->order(forward);
  ASSERT_TRUE(comes_true([&] { return spindle->status().has_failed(); }));
  EXPECT_EQ(spindle->status().fault.code, "spindle.refused");
}

TEST(ModbusSpindle, a_port_that_is_not_there_or_in_use_is_named) {
  Diagnostics diagnostics;
  const auto nowhere = open_vfd({.drive = "h100", .device = "/dev/nowhere"}, diagnostics);
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(nowhere.error(), HasSubstr("/dev/nowhere: No such file"));
  SimulatedVfd drive(Kind::h100);
  const auto spindle = spindle_at(Kind::h100, drive);
  const auto second = open_vfd(bus_of(Kind::h100, drive), diagnostics);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error(), HasSubstr("in use by another program"));
}

}  // namespace
}  // namespace passo
