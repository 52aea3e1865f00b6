#include "board_words.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "passo/link/await.hpp"

namespace passo {

std::string name_of(const About& about) {
  std::string name;
  for (const char letter : about.name) {
    if (letter == 0) break;
    // The name comes off a line. Control characters must not reach the terminal.
    name += std::isprint(static_cast<unsigned char>(letter)) != 0 ? letter : '?';
  }
  return name.empty() ? "without a name" : name;
}

std::string version_of(const About& about) {
  return fmt::format("{}.{:02}", about.firmware / 100, about.firmware % 100);
}

std::vector<std::string> switches_of(const BoardStatus& status) {
  std::vector<std::string> names;
  for (unsigned motor = 0; motor < max_motors; ++motor) {
    if ((status.inputs >> motor & 1U) != 0) names.push_back(fmt::format("limit {}", motor + 1));
  }
  struct Named {
    unsigned bit;
    const char* name;
  };
  for (const Named& one :
       {Named{input_probe, "probe"}, Named{input_door, "door"}, Named{input_emergency_stop, "emergency stop"},
        Named{input_hold, "hold button"}, Named{input_start, "start button"}}) {
    if ((status.inputs & one.bit) != 0) names.emplace_back(one.name);
  }
  return names;
}

std::string closed_switches(BoardSession& board) {
  constexpr Seconds answer{2};
  board.hang_up();
  auto status = ask_status(board, answer);
  if (status && switches_of(*status).empty()) {
    // A chip stops at once, and believes a switch only when it has stayed closed for some hundredths of a second.
    constexpr Seconds until_believed{0.15};
    await(
        board, [] { return false; }, until_believed);
    status = ask_status(board, answer);
  }
  const std::vector<std::string> closed = status ? switches_of(*status) : std::vector<std::string>();
  return closed.empty() ? "" : fmt::format("; closed now: {}", fmt::join(closed, ", "));
}

std::string state_of(const BoardStatus& status) {
  std::string state = (status.state & board_moves) != 0 ? "moves" : "rests";
  if ((status.state & board_manual) != 0) return state + ", in manual mode: the operator moves it with its keypad";
  if (status.motors == 0) return state + ", no host has connected since it started";
  if ((status.state & board_trusted) == 0) state += ", its position is unreliable";
  if ((status.inputs & outputs_timed_out) != 0) state += ", its outputs are off because its host was silent";
  if ((status.state & board_homes) != 0) state += ", an axis is being homed";
  if ((status.state & board_slipped) != 0) state += ", and stalled during motion because its events came too late";
  return state;
}

std::string reset_of(const BoardStatus& status) {
  switch (status.reset) {
    case ResetCause::power_on: return "power on";
    case ResetCause::brown_out: return "a supply voltage that was too low";
    case ResetCause::watchdog: return "its watchdog";
    case ResetCause::button: return "its reset button, or a host that opened its serial port";
  }
  return "a cause unknown to this version";
}

std::string silence_of(const BoardSession& board) {
  if (board.hung_up()) return "closes the connection: another program uses it";
  if (board.gibberish().empty()) return "does not answer";
  if (board.gibberish().find("Grbl ") != std::string::npos || board.gibberish().find("GrblHAL ") != std::string::npos) {
    return "is a machine with Grbl: use passo run, passo home or passo serve with --board grbl:... [board.grbl]";
  }
  return fmt::format("answers, but is not a Passo board: \"{}\"", board.gibberish().substr(0, 60));
}

nlohmann::json to_json(const About& about) {
  return {{"name", name_of(about)},
          {"firmware", version_of(about)},
          {"highest_event_rate_hz", about.highest_event_rate},
          {"highest_baud", about.baud},
          {"step_pulse_us", about.step_pulse / 16.0}};
}

nlohmann::json to_json(const BoardStatus& status) {
  const int motors = status.motors == 0 ? static_cast<int>(max_motors) : std::min<int>(status.motors, max_motors);
  return {{"moves", (status.state & board_moves) != 0},
          {"trusted", (status.state & board_trusted) != 0},
          {"manual", (status.state & board_manual) != 0},
          {"homes", (status.state & board_homes) != 0},
          {"slipped", (status.state & board_slipped) != 0},
          {"outputs_timed_out", (status.inputs & outputs_timed_out) != 0},
          {"motors", status.motors},
          {"executed", status.executed},
          {"event", status.event},
          {"free", status.free},
          {"reset", reset_of(status)},
          {"switches", switches_of(status)},
          {"positions", std::vector<std::int32_t>(status.positions, status.positions + motors)}};
}

}  // namespace passo
