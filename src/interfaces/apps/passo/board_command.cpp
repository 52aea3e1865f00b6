// passo board info, monitor: what a board is, and what it does.
#include <algorithm>
#include <chrono>
#include <cstdio>
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

int board_info(const BoardInfoArguments& arguments) {
  int code = exit_done;
  const auto port = open_named(arguments.board, code);
  if (!port) return code;
  BoardSession board(*port, inquiry_care);
  const auto about = ask_about(board, Seconds(arguments.wait));
  const auto status = about ? ask_status(board, Seconds(arguments.wait)) : std::nullopt;
  if (!status) return fail(exit_failed, arguments.board + ": " + silence_of(board));
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
      return fail(exit_failed, arguments.board + ": " + silence_of(board));
    }
    // A terminal shows one line that changes. A pipe gets a line for each status.
    fmt::print("{}{}", arguments.json ? to_json(*status).dump() : line_of(*status), live ? "\033[K\r" : "\n");
    if (const int printed = flush_output(); printed != exit_done) return printed;
  }
  if (live) fmt::print("\n");
  return exit_done;
}

}  // namespace passo
