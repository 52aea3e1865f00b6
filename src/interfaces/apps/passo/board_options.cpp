#include "board_options.hpp"

#include <array>

#include "commands.hpp"
#include "machine_options.hpp"
#include "number_range.hpp"
#include <CLI/CLI.hpp>

#include "passo/emulator/emulated_board.hpp"

namespace passo {
namespace {

constexpr const char* address = "address: serial:DEVICE[@BAUD], tcp:HOST:PORT, sim:uno, sim:mega or sim:pico";

constexpr const char* examples = R"(Examples:
  passo board list                                        list this computer's serial ports, and who uses them
  passo board list --ask                                  open the free ones, and ask which board is there
  passo board flash uno --device /dev/ttyACM0             flash Passo's firmware; back up the old one
  passo board flash pico                                  flash a Pico that was plugged in with BOOTSEL held
  passo board info serial:/dev/ttyACM0                    show type, firmware and status
  passo board monitor serial:/dev/ttyACM0                 show inputs and step counters, live
  passo board settings grbl:/dev/ttyUSB0                  show the settings of a Grbl board
  passo board info sim:uno                                the real firmware on an emulated chip
  passo board serve &                                     simulate a board on 127.0.0.1:7070
  passo board monitor tcp:127.0.0.1:7070 --count 1

Wiring and the first start, without motors: docs/boards.md.)";

void add_board_list_options(CLI::App& command, BoardListArguments& arguments) {
  command.add_option("DEVICE", arguments.devices,
                     "serial ports to open and ask, e.g. /dev/ttyUSB0 (default: list all, and open none)");
  command.add_flag("--ask", arguments.ask,
                   "open all ports that are not in use, and ask which board is there; opening a port restarts an "
                   "Arduino, also under a job of a program that is not seen");
  command.add_option("--wait", arguments.wait, "time to wait for the answer of each port, s")
      ->check(number_range(0.05, 60.0))
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "print the result as JSON");
  add_system(command, arguments.system);
  command.footer(
      "Without DEVICE and --ask, no port is opened: names and users come from the files of the system.\n"
      "A port that is in use is never opened.\n"
      "Examples:\n"
      "  passo board list\n"
      "  passo board list --ask\n"
      "  passo board list /dev/ttyACM0 --json | jq '.[0].says'");
}

void add_board_info_options(CLI::App& command, BoardInfoArguments& arguments) {
  command.add_option("BOARD", arguments.board, address)->required();
  command.add_option("--wait", arguments.wait, "time to wait for an answer, s")
      ->check(number_range(0.05, 60.0))
      ->capture_default_str();
  command.add_flag("--json", arguments.json, "print the result as JSON");
}

void add_board_monitor_options(CLI::App& command, BoardMonitorArguments& arguments) {
  command.add_option("BOARD", arguments.board, address)->required();
  command.add_option("--every", arguments.every, "interval of the queries, s")
      ->check(number_range(0.01, 3600.0))
      ->capture_default_str();
  command.add_option("--count", arguments.count, "number of queries; 0: until Ctrl-C")->capture_default_str();
  command.add_flag("--json", arguments.json, "one JSON object per line");
}

void add_board_settings_options(CLI::App& command, BoardSettingsArguments& arguments) {
  command
      .add_option(
          "BOARD", arguments.board,
          "address: grbl:DEVICE[@BAUD], grbl:tcp:HOST:PORT or grbl:ws://HOST; opening a serial port resets an Arduino")
      ->required();
  command.add_option("NAME", arguments.names, "show only these settings, with their meaning, e.g. 110 or '$110'");
  CLI::Option* const set =
      command
          .add_option("--set", arguments.set,
                      "write a setting, and read it back; may be given several times. A value out of its range, or one "
                      "that the board rejects, leaves the old one. - reads them from standard input, one a line: the "
                      "list of processes does not show a password there")
          ->type_name("NAME=VALUE")
          ->allow_extra_args(false);
  command.add_option("--save", arguments.save, "write all settings to this file, after changes; - is standard output")
      ->type_name("FILE");
  command
      .add_option("--compare", arguments.compare,
                  "show how the settings differ from this file; exit with code 1 if they do")
      ->type_name("FILE")
      ->excludes(set);
  command.add_option("--restore", arguments.restore, "write the settings of this file that differ, one by one")
      ->type_name("FILE")
      ->excludes(set)
      ->excludes("--compare");
  CLI::Option* const config = command.add_flag("--config", arguments.config, "FluidNC: print the board's YAML")
                                  ->excludes(set)
                                  ->excludes("--restore")
                                  ->excludes("--compare")
                                  ->excludes("--save");
  command
      .add_option("--write-config", arguments.write_config,
                  "FluidNC: replace the board's YAML by this file, and read it back; it takes effect when the board "
                  "has restarted")
      ->type_name("FILE")
      ->excludes(set)
      ->excludes("--restore")
      ->excludes("--compare")
      ->excludes("--save")
      ->excludes(config);
  command.add_flag("--json", arguments.json, "print the result as JSON");
  command.footer(
      "Examples:\n"
      "  passo board settings grbl:/dev/ttyUSB0                     all settings: name, value, unit, title\n"
      "  passo board settings grbl:/dev/ttyUSB0 110 111             these two, with range and meaning\n"
      "  passo board settings grbl:/dev/ttyUSB0 --set 110=3000      write one\n"
      "  passo board settings grbl:/dev/ttyUSB0 --save router.txt   a copy before you change anything\n"
      "  passo board settings grbl:/dev/ttyUSB0 --compare router.txt\n"
      "  passo board settings grbl:/dev/ttyUSB0 --restore router.txt\n"
      "  passo board settings grbl:/dev/ttyUSB0 --config            FluidNC: its YAML\n"
      "  passo board settings grbl:/dev/ttyUSB0 --write-config router.yaml\n"
      "Nothing is written without --set, --restore or --write-config. Grbl, grblHAL, FluidNC and uCNC: "
      "docs/manual/grbl-machines.md");
}

void add_board_files_options(CLI::App& command, BoardFilesArguments& arguments) {
  command
      .add_option(
          "BOARD", arguments.board,
          "address: grbl:DEVICE[@BAUD], grbl:tcp:HOST:PORT or grbl:ws://HOST; opening a serial port resets an Arduino")
      ->required();
  CLI::Option* const run =
      command
          .add_option("--run", arguments.run,
                      "run this file, by its path in the list; Passo does not check it. Ctrl-C brakes and ends it")
          ->type_name("PATH");
  CLI::Option* const upload =
      command.add_option("--upload", arguments.upload, "send this file to the board")->type_name("FILE")->excludes(run);
  command.add_option("--as", arguments.as, "its path on the board (default: the same name on the card)")
      ->type_name("PATH")
      ->needs(upload);
  command.add_option("--delete", arguments.remove, "delete this file, by its path in the list")
      ->type_name("PATH")
      ->excludes(run)
      ->excludes(upload);
  command.add_flag("--json", arguments.json, "print the result as JSON");
  command.footer(
      "Examples:\n"
      "  passo board files grbl:/dev/ttyACM0                            list the files on the board\n"
      "  passo board files grbl:/dev/ttyACM0 --upload part.nc           send one to its card\n"
      "  passo board files grbl:/dev/ttyACM0 --upload part.nc --as /sd/jobs/part.nc\n"
      "  passo board files grbl:/dev/ttyACM0 --run /part.nc             run one\n"
      "  passo board files grbl:/dev/ttyACM0 --delete /part.nc\n"
      "grblHAL with a card, and FluidNC: docs/manual/grbl-machines.md#files-on-the-board");
}

void add_board_flash_options(CLI::App& command, BoardFlashArguments& arguments) {
  const std::vector<std::string> names(emulated_boards.begin(), emulated_boards.end());
  command.add_option("BOARD", arguments.board, "type of board")->required()->check(CLI::IsMember(names));
  command.add_option("-d,--device", arguments.device,
                     "serial port, e.g. /dev/ttyACM0; for a Pico its drive, if there are several");
  command.add_option("--image", arguments.image,
                     "firmware: Intel hex, for a Pico UF2 (default: the firmware built with this program)");
  command.add_option("--backup", arguments.backup,
                     "file for a backup of the current firmware (default: passo-backup-BOARD.hex)");
  command.add_option("--programmer", arguments.programmer,
                     "programmer for avrdude -c (default: the board's boot loader)");
  command.add_option("--baud", arguments.baud, "baud rate of the boot loader")->capture_default_str();
  command.add_flag("--dry-run", arguments.dry_run, "only print what would be done");
}

void add_board_serve_options(CLI::App& command, BoardServeArguments& arguments) {
  command.add_option("--port", arguments.port, "TCP port; 0 picks a free one")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command.add_option("--motors", arguments.motors, "number of motors (default: as in the machine file, at least 4)")
      ->check(CLI::Range(1, 8));
  command.add_option("--clock", arguments.clock, "timer frequency, Hz (default: as in the machine file, or 16 MHz)")
      ->check(number_range(1e5, 1e9));
  command.add_option("-m,--machine", arguments.machine,
                     "machine file: simulate the board of that machine, with its clock and switches, at machine zero");
  command.add_flag("--once", arguments.once, "exit after the last client has disconnected");
}

}  // namespace

std::function<int()> add_board_help(CLI::App& board) {
  board.footer(examples);
  return {};
}

std::span<const Command> board_commands() {
  static constexpr std::array<Command, 7> commands{
      {{"list", "list the boards on the serial ports",
        options_of<BoardListArguments, add_board_list_options, board_list>},
       {"info", "show a board's type, firmware and status",
        options_of<BoardInfoArguments, add_board_info_options, board_info>},
       {"monitor", "show a board's inputs, state and step counters, live",
        options_of<BoardMonitorArguments, add_board_monitor_options, board_monitor>},
       {"settings", "show, write, save, compare and restore the settings of a Grbl board",
        options_of<BoardSettingsArguments, add_board_settings_options, board_settings>},
       {"files", "list, send, run and delete the files on a Grbl board",
        options_of<BoardFilesArguments, add_board_files_options, board_files>},
       {"flash", "flash Passo's firmware onto a board",
        options_of<BoardFlashArguments, add_board_flash_options, board_flash>},
       {"serve", "simulate a board in real time on 127.0.0.1; SIGUSR1 acts as its reset button",
        options_of<BoardServeArguments, add_board_serve_options, board_serve>}}};
  return commands;
}

}  // namespace passo
