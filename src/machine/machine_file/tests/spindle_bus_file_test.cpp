// [spindle.modbus] of a machine file.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passo/machine_file/machine_description.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

std::string file_with(const std::string& bus) {
  return "name = \"m\"\n[board]\nclock_hz = 16_000_000\nmax_event_rate_hz = 50_000\nstep_pulse_us = 2\n"
         "[tool]\nmax_rpm = 18000\n[axis.X]\nsteps_per_mm = 100\ntravel_mm = [0, 100]\nmax_velocity_mm_s = 10\n"
         "max_acceleration_mm_s2 = 100\n[spindle.modbus]\n" +
         bus;
}

std::string findings(const std::string& bus) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parse_machine(file_with(bus), "m.toml", diagnostics));
  return render(diagnostics, true);
}

TEST(SpindleBusFile, has_defaults_for_all_but_drive_and_device) {
  Diagnostics diagnostics;
  const auto machine =
      parse_machine(file_with("drive = \"huanyang\"\ndevice = \"/dev/ttyUSB0\"\n"), "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, true);
  const SpindleBusDescription& bus = *machine->spindle.modbus;
  EXPECT_EQ(bus.baud, 9600);
  EXPECT_EQ(bus.parity, SerialParity::none);
  EXPECT_EQ(bus.address, 1);
  EXPECT_EQ(bus.highest_rpm, 18000);
  EXPECT_EQ(bus.reach, Seconds(15));
  EXPECT_THAT(describe(*machine), HasSubstr("huanyang by Modbus at /dev/ttyUSB0, address 1, 9600 baud 8N1"));
}

TEST(SpindleBusFile, takes_all_its_keys) {
  Diagnostics diagnostics;
  const auto machine = parse_machine(
      file_with(
          "drive = \"mine.toml\"\ndevice = \"/dev/ttyS1\"\naddress = 7\nbaud = 38400\nparity = \"even\"\n"
          "stop_bits = 2\npoles = 4\nmin_rpm = 3000\nrated_current_a = 5.5\ntolerance_percent = 2\nreach_s = 4\n"),
      "m.toml", diagnostics);
  ASSERT_TRUE(machine) << render(diagnostics, true);
  const SpindleBusDescription& bus = *machine->spindle.modbus;
  EXPECT_TRUE(bus.has_table_file());
  EXPECT_EQ(bus.address, 7);
  EXPECT_EQ(bus.parity, SerialParity::even);
  EXPECT_EQ(bus.rpm_per_hertz(), 30);
  EXPECT_EQ(bus.tolerance, 0.02);
  EXPECT_EQ(bus.rated_current, 5.5);
}

TEST(SpindleBusFile, errors_name_what_was_expected) {
  EXPECT_THAT(findings("drive = \"huanyang\"\n"), HasSubstr("device"));
  EXPECT_THAT(findings("drive = \"abb\"\ndevice = \"d\"\n"), HasSubstr("\"huanyang\", \"h100\", or a table file"));
  EXPECT_THAT(findings("drive = \"h100\"\ndevice = \"d\"\nbaud = 9601\n"), HasSubstr("1200, 2400, 4800, 9600"));
  EXPECT_THAT(findings("drive = \"h100\"\ndevice = \"d\"\nparity = \"mark\"\n"),
              HasSubstr("\"none\", \"even\" or \"odd\""));
  EXPECT_THAT(findings("drive = \"h100\"\ndevice = \"d\"\npoles = 3\n"), HasSubstr("an even number"));
  EXPECT_THAT(findings("drive = \"h100\"\ndevice = \"d\"\naddress = 0\n"), HasSubstr("1 to 247"));
  EXPECT_THAT(findings("drive = \"h100\"\ndevice = \"d\"\nadress = 1\n"), HasSubstr("address"));
}

}  // namespace
}  // namespace passo
