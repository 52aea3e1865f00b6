// passo serve: a machine that senders of G-code drive, as they drive a Grbl controller.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "example_machine_text.hpp"
#include "grbl_check.hpp"
#include "grbl_connection.hpp"
#include "grbl_machine_connection.hpp"
#include "machine_connection.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include "serve_addresses.hpp"
#include "serve_daemon.hpp"
#include "serve_web.hpp"
#include "served_journal.hpp"
#include "served_pendant.hpp"
#include "touch_option.hpp"
#include <fmt/format.h>

#include "passo/grbl/grbl_controller.hpp"
#include "passo/job/job_identity.hpp"
#include "passo/job/state_file.hpp"
#include "passo/machine_file/camera_description.hpp"
#include "passo/report/output_file.hpp"
#include "passo/transport/service_notice.hpp"

namespace passo {
namespace {

// Puts a line to the others. False, with a message and `code`: it cannot be opened.
bool add(Result<std::unique_ptr<SenderConnection>, std::string> line, ServeDaemon::Lines& lines, int& code) {
  if (line) {
    lines.push_back(std::move(*line));
  } else {
    code = fail(exit_failed, line.error());
  }
  return line.has_value();
}

// Opens all lines that the arguments ask for. False, with a message and `code`: one of them cannot be.
bool open_lines(const ServeArguments& arguments, ServeDaemon::Lines& lines, int& code) {
  const bool any = !arguments.grbl_tcp.empty() || !arguments.grbl_pty.empty() || !arguments.grbl_serial.empty() ||
                   !arguments.http.empty();
  const std::string wanted = any ? arguments.grbl_tcp : "127.0.0.1:7071";
  if (!wanted.empty()) {
    const auto address = sender_address(arguments, wanted, code);
    if (!address || !add(SenderConnection::listen(address->host, address->port), lines, code)) return false;
  }
  if (!arguments.grbl_pty.empty() && !add(SenderConnection::open_terminal(arguments.grbl_pty), lines, code))
    return false;
  if (arguments.grbl_serial.empty()) return true;
  const auto port = sender_port(arguments, code);
  return port && add(SenderConnection::open_serial(port->place, port->baud), lines, code);
}

// The text of the machine file. The example's, if none is named.
std::optional<std::string> machine_text(const std::string& file) {
  if (file.empty()) return example_machine_text;
  Diagnostics diagnostics;
  auto text = machine_file_text(file, diagnostics);
  show(diagnostics);
  return text;
}

std::optional<MachineDescription> described(const std::string& text, const std::string& file, MachineUse use) {
  Diagnostics diagnostics;
  auto machine = parse_machine(text, file.empty() ? "the example machine" : file, diagnostics, use);
  show(diagnostics);
  return machine;
}

// Returns why it cannot be written; empty: it is.
std::string write_whole(const std::string& file, const std::string& text) {
  Result<OutputFile, OutputError> output = OutputFile::open(file);
  if (!output) return output.error().message;
  output->write(text);
  const auto done = output->commit();
  return done ? std::string() : done.error().message;
}

// Whoever has changed the file meanwhile is not overwritten.
std::string replace_file(const std::string& file, const std::string& before, const std::string& after) {
  Diagnostics ignored;
  if (machine_file_text(file, ignored) != before) return "the file was changed by another program in the meantime";
  return write_whole(file, after);
}

// What senders have set outlives the daemon, as it outlives a reset of a controller's board.
void remember(GrblController& grbl, const std::string& folder) {
  const std::string file = (std::filesystem::path(folder) / "grbl.txt").string();
  grbl.remember(read_grbl_memory(read_state_file(file).value_or("")),
                [file](const GrblMemory& memory) { return write_whole(file, grbl_memory_text(memory)).empty(); });
}

MachineFileAccess access_to(const std::string& file) {
  if (file.empty()) return {.name = "the example machine", .read = [] { return std::string(example_machine_text); }};
  return {.name = std::filesystem::path(file).filename().string(),
          .read =
              [file] {
                Diagnostics ignored;
                return machine_file_text(file, ignored);
              },
          .write = [file](const std::string& before,
                          const std::string& after) { return replace_file(file, before, after); }};
}

// Without any line, senders and browsers of this computer find the machine at its usual ports.
ServeArguments with_usual(ServeArguments arguments) {
  if (arguments.grbl_tcp.empty() && arguments.grbl_pty.empty() && arguments.grbl_serial.empty() &&
      arguments.http.empty() && arguments.data.empty()) {
    arguments.grbl_tcp = "127.0.0.1:7071";
    arguments.http = "127.0.0.1:7080";
  }
  if (arguments.page.empty()) arguments.page = usual_page_folder();
  return arguments;
}

// The journal of the last job is read before the board hears of another session. Null, with a message. A virtual board
// that had a job has died with its host: nobody knows where its machine stands (docs/decisions/0109).
std::unique_ptr<ServedJournal> open_journal(const std::string& folder, MachineConnection& opened,
                                            const Greeting& greeting) {
  if (const auto words = opened.wait_for_rest()) {
    fail(exit_failed, "the board: " + *words);
    return nullptr;
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  auto journal = ServedJournal::open(folder, opened);
  if (!journal || !journal->resume_job(greeting)) return nullptr;
  if (!opened.is_on_a_line() && journal->found()) {
    opened.start_at({.place = Point(), .trust = Trust::unknown, .is_lost = true});
  } else {
    opened.stand_as_counted();
  }
  return journal;
}

// What is served, and what belongs to it.
struct ServedThings {
  const ServeArguments& arguments;
  const std::string& text;  // of the machine file
  const MachineDescription& machine;
  ServedMachine served;
  std::string words = {};                    // the board
  ServedJournal* journal = nullptr;          // null: an interrupted job cannot be resumed
  MachineConnection* simulated = nullptr;    // a machine in this process
  GrblMachineSession* grbl_board = nullptr;  // a board that keeps the work offsets
};

// Serves until a signal is received. The machine is ready.
int serve_machine(ServedThings things, ServeDaemon::Lines lines, ServiceNotice& service) {
  const ServeArguments& arguments = things.arguments;
  const MachineDescription& machine = things.machine;
  MachineSession& session = things.served.session;
  int code = exit_done;
  InterpreterOptions dialect;
  dialect.dialect = Dialect::grbl;
  dialect.more_grbl_axes = more_grbl_axes(machine);
  StreamedProgram program(machine, dialect, session.status().position.place);
  GrblController grbl(machine, session, program);
  if (!arguments.machine.empty()) {
    grbl.keep_settings(things.text, [&](const std::string& before, const std::string& after) {
      return replace_file(arguments.machine, before, after).empty();
    });
  }
  MachineControl owner;
  std::unique_ptr<ServedWeb> web;
  PendantStatus pendant_status;
  ServedJobs jobs{.journal = things.journal,
                  .machine_file = stamp_of_text(arguments.machine, things.text),
                  .machine_access = access_to(arguments.machine)};
  if (things.grbl_board != nullptr) {
    jobs.path_judge = [board = things.grbl_board] { return board->path_judge(); };
  }
  if (!arguments.http.empty()) {
    web = ServedWeb::open(arguments, machine, session, owner, jobs, code);
    if (!web) return code;
    if (things.grbl_board != nullptr) {
      const auto address = parse_board_address(arguments.board);
      const double rate = address ? grbl_bytes_per_second(*address, things.grbl_board->board()) : 0;
      web->follow_board(*things.grbl_board, rate);
    }
    web->share_offsets(grbl);
    if (const auto camera = parse_camera(things.text)) web->show(*camera);
    if (const auto place = web->broken_off_at(); place && things.simulated != nullptr) {
      things.simulated->stand_in_truth_at(*place);
    }
  } else if (things.grbl_board != nullptr) {
    grbl.apply_offsets(things.grbl_board->offsets());
    grbl.share_offsets(
        [board = things.grbl_board](const SavedParameters& parameters) { board->store_offsets(parameters); });
    things.grbl_board->watch_offsets([&grbl, board = things.grbl_board] { grbl.apply_offsets(board->offsets()); });
  }
  if (!arguments.data.empty()) remember(grbl, arguments.data);
  std::unique_ptr<ServedStatus> status;
  if (!arguments.mqtt.broker.empty()) {
    status = ServedStatus::open(arguments, machine, code);
    if (!status) return code;
  }
  std::unique_ptr<ServedPendant> pendant;
  if (machine.handwheel && !web) note("the handwheel acts through the API of --http, which is missing");
  if (!arguments.pendant.empty() || (machine.handwheel && web)) {
    const PendantMachine moved{.machine = machine, .session = session, .owner = owner, .api = web->api()};
    pendant = ServedPendant::open(arguments, moved, pendant_status, things.text, code);
    if (!pendant) return code;
    web->api().watch(pendant_status);
  }
  fmt::print("{} on {}{}\n", machine.name, things.words, lines.empty() ? ":" : ", for Grbl 1.1 senders:");
  for (const auto& line : lines) fmt::print("  {}\n", line->name());
  if (web) fmt::print("Web interface and API:\n  {}\n", web->name());
  if (pendant) fmt::print("Pendant:\n  {}\n", pendant->name());
  if (status) fmt::print("Status by MQTT:\n  {}\n", status->name());
  fmt::print("Ctrl-C stops the machine and the server.\n");
  std::fflush(stdout);
  ServeDaemon daemon(things.served, grbl, owner, std::move(lines), web.get(), service);
  daemon.tell(status.get());
  daemon.follow(pendant.get());
  service.ready(machine.name);
  daemon.serve();
  service.stopping();
  daemon.stop();
  return interrupted_by() == 2 || interrupted_by() == 15 ? exit_done : exit_of_signal();
}

// A machine whose motion a Grbl board plans. It has no journal: its jobs continue at a line.
int serve_grbl_board(const ServeArguments& arguments, const std::string& text, const MachineDescription& machine,
                     ServeDaemon::Lines lines, ServiceNotice& service) {
  if (!leaves_spindle_to_grbl(machine)) return exit_bad_machine;
  int code = exit_done;
  brake_on_signals();
  const Seconds ahead(arguments.ahead.value_or(GrblSender::default_ahead.value()));
  const auto opened = GrblMachineConnection::open(arguments.board, machine, ahead, code, arguments.system);
  if (!opened) return code;
  return serve_machine({.arguments = arguments,
                        .text = text,
                        .machine = machine,
                        .served = {.session = opened->session(), .has_board = true},
                        .words = opened->words(),
                        .grbl_board = &opened->session()},
                       std::move(lines), service);
}

}  // namespace

int serve(const ServeArguments& given) {
  const ServeArguments arguments = with_usual(given);
  const auto text = machine_text(arguments.machine);
  const auto machine = text ? described(*text, arguments.machine, use_with(arguments.board)) : std::nullopt;
  if (!machine) return exit_bad_machine;
  if (!arguments.data.empty() && arguments.http.empty()) {
    return fail(exit_bad_program, "--data is for the jobs of --http, which is missing [serve.data]");
  }
  if (!arguments.pendant.empty() && arguments.http.empty()) {
    return fail(exit_bad_program, "--pendant acts through the API of --http, which is missing [serve.pendant]");
  }
  const std::optional<std::vector<Touchable>> things = read_touch_options(arguments.touches, *machine);
  if (!things) return exit_bad_program;
  if (!things->empty() && arguments.board != "virtual") {
    return fail(exit_bad_program, "--touch is only for the simulated machine [serve.touch]");
  }
  if (arguments.ahead && !names_grbl_machine(arguments.board)) {
    return fail(exit_bad_program,
                "--ahead is only for --board grbl:; boards of Passo brake by themselves when the connection is lost "
                "[serve.ahead]");
  }
  if (arguments.virtual_speed != 1 && arguments.board != "virtual") {
    return fail(exit_bad_program, "--virtual-speed is only for the simulated machine [serve.virtual-speed]");
  }
  if (arguments.check) return check_serve(arguments, machine->name);
  int code = exit_done;
  ServiceNotice service;
  ServeDaemon::Lines lines;
  if (!open_lines(arguments, lines, code)) return code;
  outlive_readers();
  if (names_grbl_machine(arguments.board)) {
    return serve_grbl_board(arguments, *text, *machine, std::move(lines), service);
  }
  // A board that a killed program has left brakes by itself.
  const bool keeps = !arguments.data.empty();
  const auto opened = MachineConnection::open(*machine,
                                              {.board = arguments.board,
                                               .over_a_line = keeps && arguments.board == "virtual",
                                               .touchables = *things,
                                               .tells_place = true,
                                               .needs_place = true,
                                               .spindle = SpindleWish::later,
                                               .may_move = keeps},
                                              code);
  if (!opened) return code;
  brake_on_signals();
  std::unique_ptr<ServedJournal> journal;
  const Greeting greeting = opened->any_greeting();
  if (keeps) {
    journal = open_journal(arguments.data, *opened, greeting);
    if (!journal) return exit_failed;
  }
  if (!opened->greet(greeting, code)) return code;
  return serve_machine({.arguments = arguments,
                        .text = *text,
                        .machine = *machine,
                        .served = {.session = opened->session(),
                                   .has_board = opened->has_board(),
                                   .keep_place = [&] { opened->keep_place(); },
                                   .speed = arguments.virtual_speed},
                        .words = opened->has_board() ? arguments.board : "a simulated board",
                        .journal = journal.get(),
                        .simulated = opened->has_board() ? nullptr : opened.get()},
                       std::move(lines), service);
}

}  // namespace passo
