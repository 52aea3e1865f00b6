#include "spindle_command.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include "program_input.hpp"
#include "run_signals.hpp"
#include "spindle_opening.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/machine_file/machine_description.hpp"
#include "passo/spindle/open_vfd.hpp"

namespace passo {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto between_looks_at_spindle = std::chrono::milliseconds(20);
constexpr double between_lines = 0.5;  // s
// A round of all readings takes less.
constexpr double time_of_readings = 1.5;  // s
constexpr double longest_run_down = 60;   // s
constexpr double standing = 60;           // rpm

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::optional<SpindleBusDescription> bus_of(const std::string& file, int& code) {
  Diagnostics diagnostics;
  const auto machine = load_machine_file(file, diagnostics, MachineUse::any_board);
  show(diagnostics);
  if (!machine) {
    code = exit_bad_machine;
    return std::nullopt;
  }
  if (machine->spindle.modbus) return *machine->spindle.modbus;
  code = fail(exit_bad_machine, file + " has no table [spindle.modbus], which describes the drive [spindle.none]");
  return std::nullopt;
}

Json to_json(const HostSpindleStatus& status) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  return {{"answers", status.answers},
          {"rpm", status.revolutions_per_minute},
          {"current_a", number(status.current)},
          {"load", number(status.load)},
          {"fault", status.has_failed() ? Json(status.fault.code) : Json()},
          {"fault_text", status.fault.text}};
}

std::string readings_words(const HostSpindleStatus& status) {
  std::string words = fmt::format("{:.0f} rpm", status.revolutions_per_minute);
  if (status.current) words += fmt::format("  {:.1f} A", *status.current);
  if (status.load) words += fmt::format("  load {:.0f} %", *status.load * 100);
  return words;
}

// Looks at the spindle until `done`, a fault or Ctrl-C.
template <class Done, class Look>
void follow(const ModbusSpindle& spindle, Done done, Look look) {
  while (interrupted_by() == 0) {
    const HostSpindleStatus status = spindle.status();
    look(status);
    if (status.has_failed() || done(status)) return;
    std::this_thread::sleep_for(between_looks_at_spindle);
  }
}

struct SpindleTrial {
  std::optional<double> reached;  // s
  double highest_current = 0;
  double highest_load = 0;
  double ran = 0;                 // s at speed
  std::optional<double> stopped;  // s
};

// Runs the spindle up, for the time, and down.
SpindleTrial try_out(ModbusSpindle& spindle, const SpindleRunArguments& arguments) {
  SpindleTrial trial;
  const double begun = seconds_now();
  double next_line = 0;
  const auto look = [&](const HostSpindleStatus& status) {
    trial.highest_current = std::max(trial.highest_current, status.current.value_or(0));
    trial.highest_load = std::max(trial.highest_load, status.load.value_or(0));
    const double time = seconds_now() - begun;
    if (arguments.json || time < next_line) return;
    next_line = time + between_lines;
    fmt::print("{:6.1f} s  {}\n", time, readings_words(status));
    std::fflush(stdout);
  };
  spindle.order({.direction = arguments.reverse ? SpindleDirection::counterclockwise : SpindleDirection::clockwise,
                 .revolutions_per_minute = arguments.rpm});
  follow(
      spindle, [](const HostSpindleStatus& status) { return status.at_speed; }, look);
  const double at_speed = seconds_now();
  if (spindle.status().at_speed) {
    trial.reached = at_speed - begun;
    follow(
        spindle, [&](const HostSpindleStatus&) { return seconds_now() - at_speed >= arguments.seconds; }, look);
    trial.ran = seconds_now() - at_speed;
  }
  spindle.order({});
  const double ordered = seconds_now();
  if (interrupted_by() != 0 || spindle.status().has_failed()) return trial;
  follow(
      spindle,
      [&](const HostSpindleStatus& status) {
        return status.revolutions_per_minute <= standing || seconds_now() - ordered > longest_run_down;
      },
      look);
  if (spindle.status().revolutions_per_minute <= standing) trial.stopped = seconds_now() - ordered;
  return trial;
}

void print_trial(const SpindleTrial& trial, const HostSpindleStatus& status, const SpindleRunArguments& arguments) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  if (arguments.json) {
    Json json = to_json(status);
    json["ordered_rpm"] = arguments.rpm;
    json["reached_s"] = number(trial.reached);
    json["ran_s"] = trial.ran;
    json["stopped_s"] = number(trial.stopped);
    json["highest_current_a"] = trial.highest_current;
    json["highest_load"] = trial.highest_load;
    fmt::print("{}\n", json.dump(2));
    return;
  }
  if (trial.reached) fmt::print("{:.0f} rpm reached in {:.1f} s\n", arguments.rpm, *trial.reached);
  if (trial.stopped) fmt::print("stopped in {:.1f} s\n", *trial.stopped);
}

// The rates and parities that drives offer.
constexpr std::array scanned_rates = {9600, 19200, 38400, 4800, 2400};
constexpr std::array scanned_parities = {SerialParity::none, SerialParity::even, SerialParity::odd};

const char* name_of(SerialParity parity) {
  return parity == SerialParity::none ? "none" : parity == SerialParity::even ? "even" : "odd";
}

}  // namespace

int spindle_show(const SpindleShowArguments& arguments) {
  int code = exit_done;
  const auto bus = bus_of(arguments.machine, code);
  if (!bus) return code;
  const auto spindle = open_spindle(*bus, SpindleWish::now, code);
  if (!spindle) return code;
  catch_signals();
  const double begun = seconds_now();
  follow(
      *spindle, [&](const HostSpindleStatus&) { return seconds_now() - begun > time_of_readings; },
      [](const HostSpindleStatus&) {});
  const HostSpindleStatus status = spindle->status();
  if (arguments.json) {
    Json json = {{"drive", bus->drive}, {"device", bus->device}, {"address", bus->address}, {"baud", bus->baud}};
    json.update(to_json(status));
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{} at {}, address {}: {}\n", bus->drive, bus->device, bus->address, readings_words(status));
  }
  return status.has_failed() ? fail(exit_failed, fmt::format("{} [{}]", status.fault.text, status.fault.code)) : code;
}

int spindle_run(const SpindleRunArguments& arguments) {
  int code = exit_done;
  const auto bus = bus_of(arguments.machine, code);
  if (!bus) return code;
  if (bus->highest_rpm > 0 && arguments.rpm > bus->highest_rpm) {
    return fail(exit_bad_program, fmt::format("RPM {:g} is above max_rpm = {:g} of {} [spindle.too-fast]",
                                              arguments.rpm, bus->highest_rpm, arguments.machine));
  }
  catch_signals();
  const auto spindle = open_spindle(*bus, SpindleWish::now, code);
  if (!spindle) return code;
  const SpindleTrial trial = try_out(*spindle, arguments);
  const HostSpindleStatus status = spindle->status();
  print_trial(trial, status, arguments);
  if (status.has_failed()) return fail(exit_failed, fmt::format("{} [{}]", status.fault.text, status.fault.code));
  return interrupted_by() != 0 ? exit_of_signal() : exit_done;
}

int spindle_scan(const SpindleScanArguments& arguments) {
  int code = exit_done;
  const auto described = bus_of(arguments.machine, code);
  if (!described) return code;
  catch_signals();
  SpindleBusDescription bus = *described;
  Json found = Json::array();
  for (const int rate : scanned_rates) {
    for (const SerialParity parity : scanned_parities) {
      bus.baud = rate;
      bus.parity = parity;
      for (bus.address = 1; bus.address <= arguments.addresses && interrupted_by() == 0; ++bus.address) {
        Diagnostics diagnostics;
        const auto opened = open_vfd(bus, diagnostics);
        show(diagnostics);
        if (!opened) return fail(exit_failed, fmt::format("the spindle's drive: {} [spindle.open]", opened.error()));
        const auto reply = opened->vfd->exchange(VfdTask::read_speed, 0);
        if (!reply && reply.error().kind != VfdTrouble::Kind::refused) continue;
        found.push_back({{"address", bus.address}, {"baud", rate}, {"parity", name_of(parity)}});
        if (arguments.json) continue;
        fmt::print("address = {}\nbaud = {}\nparity = \"{}\"\n", bus.address, rate, name_of(parity));
        std::fflush(stdout);
      }
    }
  }
  if (arguments.json) fmt::print("{}\n", found.dump(2));
  if (interrupted_by() != 0) return exit_of_signal();
  if (!found.empty()) return exit_done;
  return fail(exit_failed, fmt::format("no {} drive answers at {}: is it on, are A and B swapped, and is it set to "
                                       "Modbus RTU? [spindle.none-found]",
                                       bus.drive, bus.device));
}

}  // namespace passo
