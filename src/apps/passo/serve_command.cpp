// passo serve: a machine that senders of G-code drive, as they drive a Grbl controller.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "example_machine_text.hpp"
#include "opened_machine.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include "serve_daemon.hpp"
#include "serve_web.hpp"
#include <fmt/format.h>

#include "passo/grbl/grbl_controller.hpp"

namespace passo {
namespace {

// Opens all lines that the arguments ask for. False, with a message and `code`: one of them cannot be.
bool open_lines(const ServeArguments& arguments, ServeDaemon::Lines& lines, int& code) {
  const bool any = !arguments.grbl_tcp.empty() || !arguments.grbl_pty.empty() || !arguments.http.empty();
  const std::string wanted = any ? arguments.grbl_tcp : "127.0.0.1:7071";
  if (!wanted.empty()) {
    const auto address = read_address(wanted);
    if (!address) {
      code = fail(exit_bad_program, "--grbl-tcp: expected HOST:PORT, as 127.0.0.1:7071, not " + wanted);
      return false;
    }
    if (!is_this_computer(address->host) && !arguments.anybody_may_drive) {
      code = fail(exit_bad_program,
                  fmt::format("--grbl-tcp {}: whoever reaches this port can drive the machine, because the protocol "
                              "has no password. If that is meant, add --anybody-may-drive [serve.open-port]",
                              wanted));
      return false;
    }
    auto line = SenderLine::listen(address->host, address->port);
    if (!line) {
      code = fail(exit_failed, line.error());
      return false;
    }
    lines.push_back(std::move(*line));
  }
  if (!arguments.grbl_pty.empty()) {
    auto line = SenderLine::open_terminal(arguments.grbl_pty);
    if (!line) {
      code = fail(exit_failed, line.error());
      return false;
    }
    lines.push_back(std::move(*line));
  }
  return true;
}

std::optional<MachineDescription> load_machine(const std::string& file) {
  Diagnostics diagnostics;
  const auto machine = file.empty() ? parse_machine(example_machine_text, "the example machine", diagnostics)
                                    : load_machine_file(file, diagnostics);
  show(diagnostics);
  return machine;
}

}  // namespace

int serve(const ServeArguments& arguments) {
  const std::optional<MachineDescription> machine = load_machine(arguments.machine);
  if (!machine) return exit_bad_machine;
  int code = exit_done;
  ServeDaemon::Lines lines;
  if (!open_lines(arguments, lines, code)) return code;
  outlive_readers();
  const auto opened = OpenedMachine::open(*machine, {.board = arguments.board, .tells_place = true}, code);
  if (!opened) return code;
  brake_on_signals();
  if (!opened->greet(opened->any_greeting(), code)) return code;
  const KnownPosition position = opened->session().status().position;
  InterpreterOptions dialect;
  dialect.dialect = Dialect::grbl;
  dialect.more_grbl_axes = more_grbl_axes(*machine);
  OpenProgram program(*machine, dialect, position.place);
  GrblController grbl(*machine, opened->session(), program);
  MotionOwner owner;
  std::unique_ptr<ServedWeb> web;
  if (!arguments.http.empty()) {
    web = ServedWeb::open(arguments, *machine, opened->session(), owner, code);
    if (!web) return code;
  }
  fmt::print("{} on {}{}\n", machine->name, opened->has_board() ? arguments.board : "a virtual board",
             lines.empty() ? ":" : ", for senders of Grbl 1.1:");
  for (const auto& line : lines) fmt::print("  {}\n", line->name());
  if (web) fmt::print("For programs and browsers:\n  {}\n", web->name());
  fmt::print("Ctrl-C stops the machine, and ends.\n");
  std::fflush(stdout);
  ServeDaemon daemon(*opened, grbl, owner, std::move(lines), web.get());
  daemon.serve();
  daemon.stop();
  return interrupted_by() == 2 || interrupted_by() == 15 ? exit_done : 128 + interrupted_by();
}

}  // namespace passo
