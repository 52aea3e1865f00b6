#include "spindle_reader.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "passo/machine_file/spindle_bus_description.hpp"

namespace passo {
namespace {

constexpr NumberKey counts_key{"encoder_counts_per_turn", 4, 1e6, "4096"};
constexpr NumberKey run_up_key{"run_up_s", 0, 1000, "0.5"};
constexpr NumberKey droop_key{"droop_percent", 0, 50, "3"};
constexpr NumberKey ripple_key{"ripple_percent", 0, 50, "5"};
constexpr NumberKey ripple_rate_key{"ripple_hz", 0.01, 1000, "2"};
constexpr NumberKey bus_baud_key{"baud", 1200, 115200, "9600"};
constexpr NumberKey bus_stop_bits_key{"stop_bits", 1, 2, "1"};
constexpr NumberKey bus_address_key{"address", 1, 247, "1"};
constexpr NumberKey bus_poles_key{"poles", 2, 24, "2"};
constexpr NumberKey bus_lowest_rpm_key{"min_rpm", 0, 65535, "6000"};
constexpr NumberKey bus_rated_current_key{"rated_current_a", 0.1, 1000, "8"};
constexpr NumberKey bus_tolerance_key{"tolerance_percent", 0.5, 50, "5"};
constexpr NumberKey bus_reach_key{"reach_s", 0.5, 600, "15"};
constexpr std::string_view bus_drive_key = "drive";
constexpr std::string_view bus_parity_key = "parity";
constexpr const char* bus_code = "machine.spindle";

// What libmodbus can set.
constexpr int possible_bauds[] = {1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200};

void read_baud(TableReader& reader, SpindleBusDescription& bus) {
  const auto baud = reader.whole_number(bus_baud_key, Need::optional);
  if (!baud) return;
  bus.baud = static_cast<int>(*baud);
  if (std::ranges::find(possible_bauds, bus.baud) != std::end(possible_bauds)) return;
  reader.error(bus_code, bus_baud_key.name, fmt::format("{} = {}", reader.full_name(bus_baud_key.name), bus.baud),
               "1200, 2400, 4800, 9600, 19200, 38400, 57600 or 115200");
}

void read_parity(TableReader& reader, SpindleBusDescription& bus) {
  const auto word = reader.text(bus_parity_key, "even", Need::optional);
  if (!word || *word == "none") return;
  bus.parity = *word == "odd" ? SerialParity::odd : SerialParity::even;
  if (*word == "even" || *word == "odd") return;
  reader.error(bus_code, bus_parity_key,
               fmt::format("{} = \"{}\"", reader.full_name(bus_parity_key), word->substr(0, 40)),
               "\"none\", \"even\" or \"odd\"");
}

void read_poles(TableReader& reader, SpindleBusDescription& bus) {
  const auto poles = reader.whole_number(bus_poles_key, Need::optional);
  if (!poles) return;
  bus.poles = static_cast<int>(*poles);
  if (bus.poles % 2 == 0) return;
  reader.error(bus_code, bus_poles_key.name, fmt::format("{} = {}", reader.full_name(bus_poles_key.name), bus.poles),
               "an even number: 2 for a motor with 24000 rpm at 400 Hz, 4 for one with 12000 rpm");
}

}  // namespace

SpindleDescription read_spindle(TableReader& reader) {
  SpindleDescription spindle;
  if (const auto counts = reader.whole_number(counts_key, Need::optional)) {
    spindle.counts_per_turn = static_cast<int>(*counts);
  }
  if (const auto time = reader.number(run_up_key, Need::optional)) spindle.run_up = Seconds(*time);
  spindle.run_up_is_given = reader.has(run_up_key.name);
  if (const auto droop = reader.number(droop_key, Need::optional)) spindle.droop = *droop / 100;
  if (const auto ripple = reader.number(ripple_key, Need::optional)) spindle.ripple = *ripple / 100;
  if (const auto rate = reader.number(ripple_rate_key, Need::optional)) spindle.ripple_rate = Hertz(*rate);
  return spindle;
}

std::shared_ptr<const SpindleBusDescription> read_spindle_bus(const TomlEntry& entry, double highest_rpm,
                                                              const TomlReporter& reporter,
                                                              const std::function<void(TableReader&)>& finish) {
  TableReader table(std::get<TomlTable>(entry.value.content), "spindle.modbus", entry.place, reporter);
  auto bus = std::make_shared<SpindleBusDescription>();
  bus->highest_rpm = highest_rpm;
  if (auto drive = table.text(bus_drive_key, "huanyang", Need::required)) bus->drive = std::move(*drive);
  if (!bus->drive.empty() && bus->drive != "huanyang" && bus->drive != "h100" && !bus->has_table_file()) {
    table.error(bus_code, bus_drive_key,
                fmt::format("{} = \"{}\"", table.full_name(bus_drive_key), bus->drive.substr(0, 40)),
                "\"huanyang\", \"h100\", or a table file of another drive, e.g. \"my-drive.toml\"");
  }
  if (auto device = table.text("device", "/dev/serial/by-id/usb-FTDI_FT232R-if00-port0", Need::required)) {
    bus->device = std::move(*device);
  }
  read_baud(table, *bus);
  read_parity(table, *bus);
  read_poles(table, *bus);
  if (const auto bits = table.whole_number(bus_stop_bits_key, Need::optional)) bus->stop_bits = static_cast<int>(*bits);
  if (const auto address = table.whole_number(bus_address_key, Need::optional))
    bus->address = static_cast<int>(*address);
  bus->lowest_rpm = table.number(bus_lowest_rpm_key, Need::optional).value_or(bus->lowest_rpm);
  bus->rated_current = table.number(bus_rated_current_key, Need::optional).value_or(bus->rated_current);
  if (const auto percent = table.number(bus_tolerance_key, Need::optional)) bus->tolerance = *percent / 100;
  if (const auto time = table.number(bus_reach_key, Need::optional)) bus->reach = Seconds(*time);
  finish(table);
  return bus;
}

}  // namespace passo
