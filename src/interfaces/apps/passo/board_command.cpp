// passo board list, info, monitor: which boards there are, what each board is, and what it does.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "board_opening.hpp"
#include "board_words.hpp"
#include "commands.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "passo/base/counted.hpp"
#include "passo/link/await.hpp"
#include "passo/transport/stream_port.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// An Arduino whose line was just opened is in its boot loader for a second or two. So it is asked again and again.
constexpr LinkTimeouts inquiry_care{.answer_within = Seconds(0.25), .patience = Seconds(3600)};

// The names of this computer's serial lines. Names in by-id stay the same wherever a board is plugged in. If there are
// none, the kernel's names are used.
std::vector<std::string> serial_lines() {
  std::vector<std::string> lines;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator("/dev/serial/by-id", none)) lines.push_back(entry.path());
  if (lines.empty()) {
    for (const auto& entry : fs::directory_iterator("/dev", none)) {
      const std::string name = entry.path().filename();
      if (name.starts_with("ttyUSB") || name.starts_with("ttyACM")) lines.push_back(entry.path());
    }
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Opens a board by its address. If that fails, shows the reason, sets `code` to the exit code and returns null.
std::unique_ptr<BoardPort> open_named(const std::string& board, int& code) {
  const auto address = parse_board_address(board);
  if (!address || address->kind == BoardAddress::Kind::virtual_machine) {
    code = fail(exit_bad_program,
                address ? "the built-in simulated machine has no board to query; start one with `passo board serve`"
                        : address.error());
    return nullptr;
  }
  auto port = open_addressed(*address);
  if (port) return std::move(*port);
  code = fail(exit_failed, port.error());
  return nullptr;
}

std::string silence(const BoardSession& board) {
  if (board.hung_up()) return "closes the connection: another program uses it";
  if (board.gibberish().empty()) return "does not answer";
  if (board.gibberish().find("Grbl ") != std::string::npos || board.gibberish().find("GrblHAL ") != std::string::npos) {
    return "is a machine with Grbl: use passo run or passo home with --board grbl:... [board.grbl]";
  }
  return fmt::format("answers, but is not a Passo board: \"{}\"", board.gibberish().substr(0, 60));
}

struct Found {
  std::string device;
  std::string words;
  std::optional<About> about;
};

Found look_at(const std::string& device, Seconds wait) {
  Found found{.device = device, .words = {}, .about = {}};
  auto port = open_board({.kind = BoardAddress::Kind::serial, .place = device, .port = ""});
  if (!port) {
    found.words = port.error();
    return found;
  }
  BoardSession board(**port, inquiry_care);
  found.about = ask_about(board, wait);
  found.words = found.about ? fmt::format("{}, firmware {}, {} events/s", name_of(*found.about),
                                          version_of(*found.about), found.about->highest_event_rate)
                            : silence(board);
  return found;
}

std::string line_of(const BoardStatus& status) {
  std::string line = fmt::format("{:<8}", (status.state & board_moves) != 0 ? "moves" : "rests");
  const int motors = status.motors == 0 ? 0 : std::min<int>(status.motors, max_motors);
  for (int motor = 0; motor < motors; ++motor) line += fmt::format(" {:>10}", status.positions[motor]);
  line += fmt::format("   item {:>5} + {:<3}  ", status.executed, status.event);
  const std::vector<std::string> switches = switches_of(status);
  for (std::size_t i = 0; i < switches.size(); ++i) line += (i > 0 ? ", " : "") + switches[i];
  return switches.empty() ? line + "-" : line;
}

}  // namespace

int board_list(const BoardListArguments& arguments) {
  const std::vector<std::string> devices = arguments.devices.empty() ? serial_lines() : arguments.devices;
  nlohmann::json json = nlohmann::json::array();
  if (devices.empty() && !arguments.json) fmt::print("No USB serial port found.\n");
  for (const std::string& device : devices) {
    if (is_terminal(STDERR_FILENO)) fmt::print(stderr, "{}: asking...\r", device);
    const Found found = look_at(device, Seconds(arguments.wait));
    if (!arguments.json) fmt::print("serial:{}  {}\n", found.device, found.words);
    nlohmann::json one = {{"board", "serial:" + found.device}, {"says", found.words}};
    if (found.about) one["about"] = to_json(*found.about);
    json.push_back(one);
  }
  if (arguments.json) fmt::print("{}\n", json.dump(2));
  return exit_done;
}

int board_info(const BoardInfoArguments& arguments) {
  int code = exit_done;
  const auto port = open_named(arguments.board, code);
  if (!port) return code;
  BoardSession board(*port, inquiry_care);
  const auto about = ask_about(board, Seconds(arguments.wait));
  const auto status = about ? ask_status(board, Seconds(arguments.wait)) : std::nullopt;
  if (!status) return fail(exit_failed, arguments.board + ": " + silence(board));
  if (arguments.json) {
    fmt::print("{}\n", nlohmann::json{{"about", to_json(*about)}, {"status", to_json(*status)}}.dump(2));
    return exit_done;
  }
  std::string switches;
  for (const std::string& name : switches_of(*status)) switches += (switches.empty() ? "" : ", ") + name;
  fmt::print("{}\n", name_of(*about));
  fmt::print("  firmware      {}, protocol {}\n", version_of(*about), int{protocol_version});
  fmt::print("  events        at most {} per second\n", about->highest_event_rate);
  if (about->step_pulse > 0) fmt::print("  step pulse    {:.2f} us\n", about->step_pulse / 16.0);
  if (about->baud > 0) fmt::print("  link          at most {} baud\n", about->baud);
  fmt::print("  state         {}\n", state_of(*status));
  fmt::print("  last reset    {}\n", reset_of(*status));
  fmt::print("  switches on   {}\n", switches.empty() ? "none" : switches);
  for (int motor = 0; motor < std::min<int>(status->motors, max_motors); ++motor) {
    fmt::print("  motor {}       {}\n", motor + 1, counted(status->positions[motor], "step"));
  }
  return exit_done;
}

int board_monitor(const BoardMonitorArguments& arguments) {
  int code = exit_done;
  const auto port = open_named(arguments.board, code);
  if (!port) return code;
  catch_signals();
  const bool live = rewrites_lines(STDOUT_FILENO) && !arguments.json;
  if (!arguments.json) fmt::print("state     steps of each motor   item + events done   switches that are on\n");
  BoardSession board(*port, inquiry_care);
  for (std::uint64_t n = 0; interrupted_by() == 0 && (arguments.count == 0 || n < arguments.count); ++n) {
    if (n > 0) std::this_thread::sleep_for(std::chrono::duration<double>(arguments.every));
    const auto status = ask_status(board, Seconds(5));
    if (interrupted_by() != 0) break;
    if (!status) {
      if (live) fmt::print("\n");
      return fail(exit_failed, arguments.board + ": " + silence(board));
    }
    // A terminal shows one line that changes. A pipe gets a line for each status.
    fmt::print("{}{}", arguments.json ? to_json(*status).dump() : line_of(*status), live ? "\033[K\r" : "\n");
    if (const int printed = flush_output(); printed != exit_done) return printed;
  }
  if (live) fmt::print("\n");
  return exit_done;
}

}  // namespace passo
