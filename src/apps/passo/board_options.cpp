#include "board_options.hpp"

#include "command_words.hpp"
#include "number_range.hpp"
#include <CLI/CLI.hpp>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

constexpr const char* address = "serial:DEVICE, serial:DEVICE@BAUD, tcp:HOST:PORT, sim:uno, sim:mega or sim:pico";

constexpr const char* examples = R"(Examples:
  passo board list                                        what is on this computer's serial lines
  passo board flash uno --device /dev/ttyACM0             puts Passo's firmware on it, and keeps what was there
  passo board flash pico                                  onto a Pico plugged in with BOOTSEL held: finds its drive
  passo board info serial:/dev/ttyACM0                    what it is, and how it is
  passo board monitor serial:/dev/ttyACM0                 its switches and counters, live
  passo board info sim:uno                                the firmware itself, on an emulated chip
  passo board serve &                                     no board at hand: a virtual one, on 127.0.0.1:7070
  passo board monitor tcp:127.0.0.1:7070 --count 1

Wiring, and a first start without motors: docs/boards.md.)";

}  // namespace

CLI::App& add_board_command(CLI::App& app, const std::vector<std::string>& words, BoardArguments& arguments) {
  CLI::App& board = *app.add_subcommand("board", "find, flash, ask and watch boards");
  if (!is_named(board, words)) return board;
  board.require_subcommand(1);
  board.footer(examples);

  CLI::App& list = *board.add_subcommand("list", "what is on the serial lines");
  list.add_option("DEVICE", arguments.list.devices, "these only, as /dev/ttyUSB0");
  list.add_option("--wait", arguments.list.wait, "seconds for each: an Arduino that is opened starts anew")
      ->check(number_range(0.05, 60.0))
      ->capture_default_str();
  list.add_flag("--json", arguments.list.json, "print it as JSON");
  list.callback([&arguments] { arguments.chosen = [&arguments] { return board_list(arguments.list); }; });

  CLI::App& info = *board.add_subcommand("info", "what a board is, and how it is");
  info.add_option("BOARD", arguments.info.board, address)->required();
  info.add_option("--wait", arguments.info.wait, "seconds for an answer")
      ->check(number_range(0.05, 60.0))
      ->capture_default_str();
  info.add_flag("--json", arguments.info.json, "print it as JSON");
  info.callback([&arguments] { arguments.chosen = [&arguments] { return board_info(arguments.info); }; });

  CLI::App& monitor = *board.add_subcommand("monitor", "a board's inputs, state and step counters, live");
  monitor.add_option("BOARD", arguments.monitor.board, address)->required();
  monitor.add_option("--every", arguments.monitor.every, "seconds between two looks")
      ->check(number_range(0.01, 3600.0))
      ->capture_default_str();
  monitor.add_option("--count", arguments.monitor.count, "so many looks; 0: until Ctrl-C")->capture_default_str();
  monitor.add_flag("--json", arguments.monitor.json, "a JSON object a line");
  monitor.callback([&arguments] { arguments.chosen = [&arguments] { return board_monitor(arguments.monitor); }; });

  const std::vector<std::string> names(emulated_boards.begin(), emulated_boards.end());
  CLI::App& flash = *board.add_subcommand("flash", "put Passo's firmware on a board: by avrdude, on a Pico by copying");
  flash.add_option("BOARD", arguments.flash.board, "what it is")->required()->check(CLI::IsMember(names));
  flash.add_option("-d,--device", arguments.flash.device,
                   "its serial line, as /dev/ttyACM0; a Pico's drive, if there are several");
  flash.add_option("--image", arguments.flash.image,
                   "Intel hex, or of a Pico UF2; without it what was built with this program");
  flash.add_option("--backup", arguments.flash.backup,
                   "where what it holds now is kept; without it passo-backup-BOARD.hex");
  flash.add_option("--programmer", arguments.flash.programmer, "avrdude's -c; without it the board's boot loader");
  flash.add_option("--baud", arguments.flash.baud, "of the boot loader")->capture_default_str();
  flash.add_flag("--dry-run", arguments.flash.dry_run, "only say what would be done");
  flash.callback([&arguments] { arguments.chosen = [&arguments] { return board_flash(arguments.flash); }; });

  CLI::App& serve =
      *board.add_subcommand("serve", "be a virtual board, in real time, on 127.0.0.1; SIGUSR1 is its reset button");
  serve.add_option("--port", arguments.serve.port, "TCP; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  serve
      .add_option("--motors", arguments.serve.motors, "the most it can turn; without it the machine's, and 4 at least")
      ->check(CLI::Range(1, 8));
  serve.add_option("--clock", arguments.serve.clock, "ticks a second; without it the machine's, or 16 MHz")
      ->check(number_range(1e5, 1e9));
  serve.add_option("-m,--machine", arguments.serve.machine,
                   "machine file: it is that machine's board, with its clock and switches, and stands at machine zero");
  serve.add_flag("--once", arguments.serve.once, "end when everybody who has called has left");
  serve.callback([&arguments] { arguments.chosen = [&arguments] { return board_serve(arguments.serve); }; });
  return board;
}

}  // namespace passo
