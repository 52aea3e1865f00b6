#include "board_options.hpp"

#include <array>

#include "commands.hpp"
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

void add_board_list_options(CLI::App& command, BoardListArguments& arguments) {
  command.add_option("DEVICE", arguments.devices, "these only, as /dev/ttyUSB0");
  command.add_option("--wait", arguments.wait, "seconds for each: an Arduino that is opened starts anew")
      ->check(number_range(0.05, 60.0))
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "print it as JSON");
}

void add_board_info_options(CLI::App& command, BoardInfoArguments& arguments) {
  command.add_option("BOARD", arguments.board, address)->required();
  command.add_option("--wait", arguments.wait, "seconds for an answer")
      ->check(number_range(0.05, 60.0))
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "print it as JSON");
}

void add_board_monitor_options(CLI::App& command, BoardMonitorArguments& arguments) {
  command.add_option("BOARD", arguments.board, address)->required();
  command.add_option("--every", arguments.every, "seconds between two looks")
      ->check(number_range(0.01, 3600.0))
      ->capture_default_str();
  command.add_option("--count", arguments.count, "so many looks; 0: until Ctrl-C")->capture_default_str();
  command.add_flag("--json", arguments.json, "a JSON object a line");
}

void add_board_flash_options(CLI::App& command, BoardFlashArguments& arguments) {
  const std::vector<std::string> names(emulated_boards.begin(), emulated_boards.end());
  command.add_option("BOARD", arguments.board, "what it is")->required()->check(CLI::IsMember(names));
  command.add_option("-d,--device", arguments.device,
                     "its serial line, as /dev/ttyACM0; a Pico's drive, if there are several");
  command.add_option("--image", arguments.image,
                     "Intel hex, or of a Pico UF2; without it what was built with this program");
  command.add_option("--backup", arguments.backup,
                     "where what it holds now is kept; without it passo-backup-BOARD.hex");
  command.add_option("--programmer", arguments.programmer, "avrdude's -c; without it the board's boot loader");
  command.add_option("--baud", arguments.baud, "of the boot loader")->capture_default_str();
  command.add_flag("--dry-run", arguments.dry_run, "only say what would be done");
}

void add_board_serve_options(CLI::App& command, BoardServeArguments& arguments) {
  command.add_option("--port", arguments.port, "TCP; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command.add_option("--motors", arguments.motors, "the most it can turn; without it the machine's, and 4 at least")
      ->check(CLI::Range(1, 8));
  command.add_option("--clock", arguments.clock, "ticks a second; without it the machine's, or 16 MHz")
      ->check(number_range(1e5, 1e9));
  command.add_option(
      "-m,--machine", arguments.machine,
      "machine file: it is that machine's board, with its clock and switches, and stands at machine zero");
  command.add_flag("--once", arguments.once, "end when everybody who has called has left");
}

}  // namespace

std::function<int()> add_board_help(CLI::App& board) {
  board.footer(examples);
  return {};
}

std::span<const Command> board_commands() {
  static constexpr std::array<Command, 5> commands{
      {{"list", "what is on the serial lines", options_of<BoardListArguments, add_board_list_options, board_list>},
       {"info", "what a board is, and how it is", options_of<BoardInfoArguments, add_board_info_options, board_info>},
       {"monitor", "a board's inputs, state and step counters, live",
        options_of<BoardMonitorArguments, add_board_monitor_options, board_monitor>},
       {"flash", "put Passo's firmware on a board: by avrdude, on a Pico by copying",
        options_of<BoardFlashArguments, add_board_flash_options, board_flash>},
       {"serve", "be a virtual board, in real time, on 127.0.0.1; SIGUSR1 is its reset button",
        options_of<BoardServeArguments, add_board_serve_options, board_serve>}}};
  return commands;
}

}  // namespace passo
