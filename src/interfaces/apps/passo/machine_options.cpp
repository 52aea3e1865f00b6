#include "machine_options.hpp"

#include <CLI/CLI.hpp>

namespace passo {

void add_machine(CLI::App& command, std::string& machine) {
  command.add_option("-m,--machine", machine, "machine file (TOML), see docs/manual/machine-file.md")->required();
}

void add_board(CLI::App& command, std::string& board) {
  command.add_option("-b,--board", board,
                     "serial:DEVICE[@BAUD], tcp:HOST:PORT, sim:uno or sim:mega, see passo board; grbl:DEVICE: a "
                     "machine with Grbl, for "
                     "run and home; without it the virtual machine");
}

void add_jog_options(CLI::App& command, JogArguments& arguments) {
  command.add_option("MOVES", arguments.moves,
                     "X+10 Y-3: by so much; X+: as far as the travel goes; none, on a terminal: by keys");
  add_machine(command, arguments.machine);
  add_board(command, arguments.board);
  command.add_option("-F,--feed", arguments.feed, "along the way, mm/min")->capture_default_str();
  command.add_option("--lease", arguments.lease, "SECONDS: not renewed for so long, the machine brakes")
      ->capture_default_str();
  command.add_option("--held", arguments.held, "SECONDS: how long the button is held; without it to the end");
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.footer(
      "Examples:\n  passo jog -m router.toml X+10 -F 600          10 mm to the right\n"
      "  passo jog -m router.toml X-3 Y+4              straight to both\n"
      "  passo jog -m router.toml Z+                   up to the end of the travel\n"
      "  passo jog -m router.toml X- --held 1.5        let go after 1.5 s: it rests a lease later\n"
      "  passo jog -m uno.toml --board serial:/dev/ttyACM0      by keys, on a real machine: arrows, Page Up and Down");
}

void add_home_options(CLI::App& command, HomeArguments& arguments) {
  add_machine(command, arguments.machine);
  add_board(command, arguments.board);
  command
      .add_option("--repeat", arguments.repeat,
                  "home so many times, and tell how well the places of each axis agree (mean, spread)")
      ->check(CLI::Range(1, 1000));
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.add_flag("-q,--quiet", arguments.quiet, "only errors");
  command.footer(
      "Examples:\n  passo home -m router.toml                              the virtual machine, from machine zero\n"
      "  passo home -m uno.toml --repeat 10                     how well the switches repeat\n"
      "  passo home -m uno.toml --board serial:/dev/ttyACM0     a real one\n"
      "  passo home -m router.toml --board grbl:/dev/ttyUSB0    a machine with Grbl\n"
      "Errors end in a stable code: [home.not-met], [home.still-closed], [home.unsteady], [home.stopped], "
      "[home.board],\n"
      "[home.no-switch], [home.interrupted]; see docs/manual/homing.md");
}

void add_serve_options(CLI::App& command, ServeArguments& arguments) {
  command.add_option("-m,--machine", arguments.machine, "machine file (TOML); without it an example");
  add_board(command, arguments.board);
  command.add_option("--grbl-tcp", arguments.grbl_tcp,
                     "HOST:PORT for senders; without any line 127.0.0.1:7071, and browsers at 127.0.0.1:7080. Port 0: "
                     "any that is free");
  command.add_option("--grbl-pty", arguments.grbl_pty,
                     "LINK: a pseudo-terminal for senders that know serial ports alone");
  command.add_option("--grbl-serial", arguments.grbl_serial,
                     "DEVICE[@BAUD]: a serial port for senders, at 115200 baud if nothing else is said");
  command.add_flag("--anybody-may-drive", arguments.anybody_may_drive,
                   "allow a HOST that other computers reach: the protocol has no password");
  command.add_option("--mqtt", arguments.mqtt,
                     "HOST[:PORT] of an MQTT broker that is told the status; it moves nothing");
  command.add_option("--mqtt-topic", arguments.mqtt_topic, "what all its topics begin with")->capture_default_str();
  command.add_option("--mqtt-login", arguments.mqtt_login, "FILE whose first line is USER:PASSWORD for the broker");
  command.add_flag("--check", arguments.check,
                   "only say whether the machine file and the options are good; nothing is opened, nothing moves");
  command.add_option("--http", arguments.http, "HOST:PORT for programs and browsers: HTTP and WebSocket");
  command.add_option("--http-token", arguments.http_token,
                     "FILE with a token that HTTP then asks for; needed where other computers reach HOST");
  command.add_option("--http-name", arguments.http_names, "a NAME by which browsers know this server, as a proxy's");
  command.add_option("--data", arguments.data, "DIR for the queue of jobs, their history and alarms");
  command.add_option("--touch", arguments.touches,
                     "what the probe of the virtual machine touches, as Z:-1.5 or X10:60,Y10:50,Z:-2; as of run");
  command.add_option("--page", arguments.page, "DIR with the page for browsers; without it the one beside the program");
  command.footer(
      "Examples:\n  passo serve                                    a virtual machine: try a sender on it\n"
      "  passo serve -m router.toml                     your machine file, still virtual\n"
      "  passo serve -m uno.toml -b serial:/dev/ttyACM0     a real machine\n"
      "  passo serve --grbl-pty /tmp/ttyPasso           for senders that open a serial port\n"
      "  passo serve --http 127.0.0.1:7080              for programs: curl 127.0.0.1:7080/api/v1/status\n"
      "  printf '?\\n$G\\n' | nc -q1 127.0.0.1 7071       what a sender sees\n"
      "In UGS: connection TCP, host 127.0.0.1, port 7071. In bCNC: port socket://127.0.0.1:7071. See "
      "docs/manual/serve.md");
}

void add_machine_options(CLI::App& command, MachineArguments& arguments) {
  command.add_option("MACHINE", arguments.machine, "machine file (TOML)")->required();
  command.footer(
      "Examples:\n  passo machine examples/machines/router.toml     its axes, board and tool, in numbers\n"
      "  passo machine mine.toml                         what is wrong with a file of your own, and where\n"
      "Every key is explained in docs/manual/machine-file.md");
}

}  // namespace passo
