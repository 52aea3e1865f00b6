#include "run_arguments.hpp"

#include "grbl_connection.hpp"
#include "picture_names.hpp"
#include "port_run.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"

namespace passo {

bool keeps_journal(const RunArguments& arguments) {
  return arguments.board != "virtual" && !arguments.board.starts_with("sim:");
}

bool counts_tools(const RunArguments& arguments) {
  return keeps_journal(arguments) || !arguments.program.tool_life.records.empty();
}

bool names_are_good(const RunArguments& arguments) {
  for (const std::string& path : arguments.pictures) {
    const std::string why = refuse_picture(path);
    if (why.empty()) continue;
    fail(exit_bad_program, why);
    return false;
  }
  for (const std::string& path : arguments.traces) {
    if (is_trace_name(path)) continue;
    fail(exit_bad_program, path + ": the name of a trace must end with .vcd or .csv");
    return false;
  }
  const bool has_look = arguments.colour_by != "speed" || arguments.view != "auto" || arguments.no_rapids;
  if (has_look && arguments.pictures.empty()) {
    fail(exit_bad_program, "--colour-by, --view and --no-rapids need --picture");
    return false;
  }
  return true;
}

bool suits_the_board(const RunArguments& arguments) {
  const char* words = nullptr;
  const bool on_port = is_on_port(arguments.board);
  if (on_port && (arguments.home || !arguments.touches.empty())) {
    words = "--home and --touch need inputs, and the port of sim:first_board has none";
  } else if ((arguments.motors.anyway || !arguments.motors.true_path.empty()) && !on_port) {
    words = "--anyway and --true-path are only for --board sim:first_board";
  } else if ((arguments.resume || !arguments.journal.empty()) && !keeps_journal(arguments)) {
    words = "--resume and --journal are only for boards that keep running: serial: or tcp:";
  } else if (!arguments.cable_cut.empty() && arguments.board != "virtual") {
    words = "--cut-cable-at is only for the simulated machine; unplug the cable of a real board";
  } else if (!arguments.touches.empty() && keeps_journal(arguments)) {
    words = "--touch is only for the simulated machine and emulated boards";
  } else if (arguments.motors.physics && keeps_journal(arguments)) {
    words = "--physics is only for the simulated machine and emulated boards";
  } else if (!arguments.motors.disturbances.empty() && !arguments.motors.physics && !on_port) {
    words = "--disturb needs --physics: without it, simulated motors follow every command";
  } else if (arguments.ahead && !names_grbl_machine(arguments.board)) {
    words = "--ahead is only for --board grbl:; boards of Passo brake by themselves when the connection is lost";
  } else if (arguments.start.line > 0 && arguments.resume) {
    words = "--resume continues at the line where the job stopped, so it cannot be combined with --from-line";
  } else if (arguments.start.line == 0 && (arguments.start.pass > 0 || arguments.start.after > 0)) {
    words = "--pass and --after refine the start point of --from-line, so they need it";
  } else if (arguments.from_here && arguments.resume) {
    words = "--resume uses the start position of the job, so it cannot be combined with --from-here";
  }
  if (words != nullptr) fail(exit_bad_program, words);
  return words == nullptr;
}

}  // namespace passo
