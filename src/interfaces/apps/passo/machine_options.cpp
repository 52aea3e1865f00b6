#include "machine_options.hpp"

#include <CLI/CLI.hpp>

namespace passo {

void add_machine(CLI::App& command, std::string& machine) {
  command.add_option("-m,--machine", machine, "machine file (TOML), see docs/manual/machine-file.md")->required();
}

void add_ahead(CLI::App& command, std::optional<double>& ahead) {
  command
      .add_option("--ahead", ahead, "grbl: how long the machine may go on after the connection is lost, s (default: 1)")
      ->check(CLI::Range(0.1, 60.0));
}

void add_board(CLI::App& command, std::string& board) {
  command.add_option(
      "-b,--board", board,
      "board: serial:DEVICE[@BAUD], tcp:HOST:PORT, sim:uno, sim:mega or sim:pico (see passo board), for "
      "run, home and jog also grbl:DEVICE, a machine with Grbl, and for run sim:first_board, a parallel port "
      "and a PIC (default: the simulated machine)");
}

void add_system(CLI::App& command, std::string& system) {
  command
      .add_option("--system", system,
                  "folder with sys, proc, dev and var/lock, to be read in place of this computer's; for tests")
      ->check(CLI::ExistingDirectory);
}

void add_jog_options(CLI::App& command, JogArguments& arguments) {
  command.add_option(
      "MOVES", arguments.moves,
      "distances, e.g. X+10 Y-3 in mm; X+ jogs to the end of the travel; without moves, the keyboard jogs");
  add_machine(command, arguments.machine);
  add_board(command, arguments.board);
  command.add_option("-F,--feed", arguments.feed, "feed rate, mm/min")->capture_default_str();
  command
      .add_option("--lease", arguments.lease,
                  "keep-alive timeout: the machine stops if the jog is not renewed for this many seconds")
      ->capture_default_str();
  command.add_option("--held", arguments.held, "time that the jog button is held, s (default: until the move ends)");
  command.add_flag("--json", arguments.json, "print the result as JSON");
  command.footer(
      "Examples:\n  passo jog -m router.toml X+10 -F 600          jog 10 mm to the right\n"
      "  passo jog -m router.toml X-3 Y+4              jog both axes on a straight line\n"
      "  passo jog -m router.toml Z+                   jog up to the end of the travel\n"
      "  passo jog -m router.toml X- --held 1.5        release the button after 1.5 s: the machine stops when the "
      "timeout ends\n"
      "  passo jog -m uno.toml --board serial:/dev/ttyACM0      jog a real machine by keyboard: arrows, Page Up and "
      "Page Down");
}

void add_home_options(CLI::App& command, HomeArguments& arguments) {
  command
      .add_option("AXIS", arguments.axis, "home this axis alone, e.g. X; only Grbl boards that know $HX (default: all)")
      ->check(CLI::IsMember({"X", "Y", "Z", "A", "B", "C", "U", "V", "W"}, CLI::ignore_case));
  add_machine(command, arguments.machine);
  add_board(command, arguments.board);
  command
      .add_option("--repeat", arguments.repeat,
                  "number of homing runs; the mean and the spread of each axis' positions are reported")
      ->check(CLI::Range(1, 1000));
  command.add_flag("--json", arguments.json, "print the result as JSON");
  command.add_flag("-q,--quiet", arguments.quiet, "errors only");
  command.footer(
      "Examples:\n  passo home -m router.toml                              home the simulated machine, which starts at "
      "machine zero\n"
      "  passo home -m uno.toml --repeat 10                     measure how well the switches repeat\n"
      "  passo home -m uno.toml --board serial:/dev/ttyACM0     home a real machine\n"
      "  passo home -m router.toml --board grbl:/dev/ttyUSB0    home a machine with Grbl\n"
      "  passo home Z -m router.toml --board grbl:/dev/ttyUSB0  home its Z axis alone\n"
      "Errors end with a stable code: [home.not-met], [home.still-closed], [home.unsteady], [home.stopped], "
      "[home.board],\n"
      "[home.no-switch], [home.interrupted]; see docs/manual/homing.md");
}

void add_serve_options(CLI::App& command, ServeArguments& arguments) {
  command.add_option("-m,--machine", arguments.machine, "machine file (TOML; default: an example machine)");
  add_board(command, arguments.board);
  add_ahead(command, arguments.ahead);
  command.add_option("--grbl-tcp", arguments.grbl_tcp,
                     "HOST:PORT for G-code senders; port 0 picks a free port (default, if no interface is given: "
                     "127.0.0.1:7071, and the web interface at 127.0.0.1:7080)");
  command.add_option("--grbl-pty", arguments.grbl_pty,
                     "LINK: path of a pseudo-terminal, for senders that only open serial ports");
  command.add_option("--grbl-serial", arguments.grbl_serial,
                     "DEVICE[@BAUD]: serial port for senders (default: 115200 baud)");
  command.add_flag("--anybody-may-drive", arguments.anybody_may_drive,
                   "allow --grbl-tcp on an address that other computers can reach; the Grbl protocol has no password");
  command.add_option("--mqtt", arguments.mqtt.broker,
                     "HOST[:PORT] of an MQTT broker to publish the status to; it cannot move the machine");
  command.add_option("--mqtt-topic", arguments.mqtt.topic, "prefix of the MQTT topics")->capture_default_str();
  command.add_option("--mqtt-login", arguments.mqtt.login,
                     "file whose first line is USER:PASSWORD for the MQTT broker");
  command.add_flag("--check", arguments.check,
                   "only check the machine file and the options; open no port and move nothing");
  command.add_option("--http", arguments.http, "HOST:PORT of the web interface and the API (HTTP and WebSocket)");
  command.add_option("--http-token", arguments.http_token,
                     "file with the token that HTTP clients must give; required if other computers can reach HOST");
  command.add_option("--http-name", arguments.http_names,
                     "host name under which browsers reach this server, e.g. through a proxy; can be repeated");
  command.add_option("--macros", arguments.macros,
                     "folder with macros (.ngc) for buttons and keys, and with subroutines for all programs");
  command.add_option("--pendant", arguments.pendant,
                     "pendant that may move the machine: auto, hidraw:DEVICE, or a table FILE.toml; see passo pendant");
  command.add_option("--data", arguments.data,
                     "folder for the job queue, the job history, the alarms and what each tool has cut");
  command.add_option(
      "--tool-table", arguments.tool_library,
      "tool library (TOML) with the names and lives of tools; a check warns where a program exceeds one");
  command.add_option("--touch", arguments.touches,
                     "object that the simulated probe can touch, e.g. Z:-1.5 or X10:60,Y10:50,Z:-2; see passo run");
  command
      .add_option("--virtual-speed", arguments.virtual_speed,
                  "how many times faster than real time the simulated machine runs, e.g. to try a queue")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command.add_option("--page", arguments.page, "folder with the web interface (default: next to the program passo)");
  add_system(command, arguments.system);
  command.footer(
      "Examples:\n  passo serve                                    a simulated machine, to try the web interface or a "
      "sender\n"
      "  passo serve -m router.toml                     your machine file, still simulated\n"
      "  passo serve -m uno.toml -b serial:/dev/ttyACM0     a real machine\n"
      "  passo serve --grbl-pty /tmp/ttyPasso           for senders that open a serial port\n"
      "  passo serve --http 127.0.0.1:7080              only HTTP, e.g. curl 127.0.0.1:7080/api/v1/status\n"
      "  printf '?\\n$G\\n' | nc -q1 127.0.0.1 7071       talk to it as a sender does\n"
      "In UGS: connection TCP, host 127.0.0.1, port 7071. In bCNC: port socket://127.0.0.1:7071. See "
      "docs/manual/serve.md");
}

void add_machine_options(CLI::App& command, MachineArguments& arguments) {
  CLI::Option* const machine = command.add_option("MACHINE", arguments.machine, "machine file (TOML) to check");
  CLI::Option* const from =
      command
          .add_option("--from", arguments.from,
                      "configuration file of another controller, from which to make a machine file: the answer of "
                      "Grbl, grblHAL or FluidNC to $$, FluidNC's YAML, LinuxCNC's ini or a profile of Mach3 (XML). Or "
                      "a Grbl board itself: grbl:DEVICE[@BAUD], grbl:tcp:HOST:PORT or grbl:ws://HOST; opening a serial "
                      "port resets an "
                      "Arduino")
          ->excludes(machine);
  command
      .add_option("--format", arguments.format,
                  "format of that file: settings, fluidnc, linuxcnc or mach3 (default: detected from its content)")
      ->check(CLI::IsMember({"settings", "fluidnc", "linuxcnc", "mach3"}))
      ->needs(from);
  command.add_option("-o,--output", arguments.output, "file for the new machine file (default: standard output)")
      ->needs(from);
  command.add_flag("--json", arguments.json, "print the new machine file and the report as JSON")->needs(from);
  command.footer(
      "Examples:\n  passo machine examples/machines/router.toml     show its axes, board and tool\n"
      "  passo machine mine.toml                         check your own file: show its errors, or what it describes\n"
      "  passo machine --from settings.txt -o mine.toml  make a machine file from the answer of Grbl to $$\n"
      "  passo machine --from grbl:/dev/ttyUSB0 -o mine.toml  read the settings from the board\n"
      "  passo machine --from config.yaml > mine.toml    make one from FluidNC's configuration; the report of "
      "values used,\n"
      "                                                  assumed and not used goes to standard error\n"
      "docs/manual/machine-file.md explains every key, docs/manual/machine-import.md the formats");
}

}  // namespace passo
