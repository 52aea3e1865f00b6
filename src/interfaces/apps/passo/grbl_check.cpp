#include "grbl_check.hpp"

#include <algorithm>

#include "commands.hpp"
#include "grbl_connection.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/grbl/grbl_settings.hpp"
#include "passo/judge/check_page.hpp"
#include "passo/sender/grbl_motion.hpp"
#include "passo/transport/board_address.hpp"

namespace passo {
namespace {

constexpr double bits_per_byte = 10;  // with start bit and stop bit

// Of the machine file's settings only those of the axes: its $11 would be our path tolerance.
GrblMachine grbl_on_uno(const MachineDescription& machine) {
  constexpr int first_of_axes = 100;
  GrblMachine board;
  if (machine.is_core_xy) board.hear("[OPT:VC,15,128]");
  board.axes = "XYZ" + more_grbl_axes(machine);
  for (const GrblSetting& setting : grbl_settings(machine, {})) {
    if (setting.number >= first_of_axes) board.hear(fmt::format("${}={}", setting.number, setting.value));
  }
  return board;
}

}  // namespace

// USB itself and a network are faster than every board, but behind a network there may be a serial line.
double grbl_bytes_per_second(const BoardAddress& address, const GrblMachine& machine) {
  if (address.kind == BoardAddress::Kind::tcp) return address.behind_baud / bits_per_byte;
  const bool is_native_usb = address.place.starts_with("/dev/ttyACM") && machine.firmware != "Grbl";
  return address.kind == BoardAddress::Kind::serial && !is_native_usb ? address.baud / bits_per_byte : 0;
}

std::optional<GrblBoard> grbl_board(const std::string& name, const MachineDescription& machine,
                                    InterpreterOptions& options, int& code) {
  if (name == "grbl") {
    const GrblMachine uno = grbl_on_uno(machine);
    return GrblBoard{.limits = limits_of(uno), .line = {}, .target = GrblTarget::of(uno)};
  }
  if (!names_grbl_machine(name)) {
    code = fail(exit_bad_program,
                name + ": --board of check takes grbl, grbl:DEVICE[@BAUD], grbl:tcp:HOST:PORT or grbl:ws://HOST");
    return std::nullopt;
  }
  const auto address = parse_board_address(name);
  brake_on_signals();
  const auto opened = address ? GrblConnection::open(name, code) : nullptr;
  if (!opened) {
    if (!address) code = fail(exit_bad_program, address.error());
    return std::nullopt;
  }
  const GrblSender& sender = opened->sender();
  const GrblMachine& board = sender.machine();
  set_offsets(options, board);
  options.start = sender.place().value_or(options.start);
  GrblBoard found{.firmware = board.firmware + " " + board.version,
                  .limits = limits_of(board),
                  .line = {.bytes_per_second = grbl_bytes_per_second(*address, board), .buffer = sender.buffer_size()},
                  .target = GrblTarget::of(board)};
  const auto& steps = found.limits.steps_per_mm.values;
  if (std::ranges::all_of(steps, [](double per_unit) { return per_unit <= 0; })) {
    code = fail(exit_failed, name +
                                 ": the machine has not reported its steps per millimetre ($100 to $102). It may be "
                                 "in an alarm: home it first [grbl.locked]");
    return std::nullopt;
  }
  for (const Axis axis : all_axes) {
    const bool moves =
        found.limits.velocity[axis] > MmPerSecond(0) && found.limits.acceleration[axis] > MmPerSecond2(0);
    if (found.limits.steps_per_mm[axis] <= 0 || moves) continue;
    code = fail(exit_failed, fmt::format("{}: the machine reports a maximum rate ($110 to $112) or an acceleration "
                                         "($120 to $122) of 0 for {}",
                                         name, letter_of(axis)));
    return std::nullopt;
  }
  return found;
}

Judgement judge_on_grbl(const ProgramReader& program, const MachineDescription& machine,
                        const InterpreterOptions& options, const ProgramCheck& check, const JudgeWatchers& watchers,
                        const std::function<void(double)>& progress, GrblBoard& board) {
  GrblMotion motion(program, machine, options, board.limits, board.line, board.target);
  Judgement judged = judge(motion, machine, check.nominal_time, watchers, progress);
  board.forecast = motion.result();
  return judged;
}

std::string to_text(const GrblBoard& board) {
  std::string text = fmt::format("board           {}, {} blocks: {} in all\n", board.firmware, board.limits.blocks,
                                 clock_words(board.forecast.time));
  if (board.line.bytes_per_second <= 0) return text;
  const GrblForecast::Result& forecast = board.forecast;
  text += fmt::format("connection      {:.0f} baud", board.line.bytes_per_second * bits_per_byte);
  const Seconds lost = forecast.time - forecast.unhindered;
  constexpr double noticeable = 0.005;
  if (lost > noticeable * forecast.time) {
    text += fmt::format(": too slow for this program, which takes {:.1f} s longer; it carries F{:.0f} at line {}",
                        lost.value(), forecast.feed_carried.value() * 60, forecast.densest_line);
  } else {
    text += ": fast enough";
  }
  return text + "\n";
}

nlohmann::ordered_json as_json(const GrblBoard& board) {
  nlohmann::ordered_json json = {{"firmware", board.firmware},
                                 {"blocks", board.limits.blocks},
                                 {"time_s", board.forecast.time.value()},
                                 {"bytes_per_second", nullptr},
                                 {"lost_on_connection_s", (board.forecast.time - board.forecast.unhindered).value()},
                                 {"feed_carried_mm_min", nullptr},
                                 {"densest_line", nullptr}};
  if (board.line.bytes_per_second > 0) json["bytes_per_second"] = board.line.bytes_per_second;
  if (board.forecast.feed_carried > MmPerSecond(0)) {
    json["feed_carried_mm_min"] = board.forecast.feed_carried.value() * 60;
    json["densest_line"] = board.forecast.densest_line;
  }
  return json;
}

}  // namespace passo
