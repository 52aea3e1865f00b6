#include "run_arguments.hpp"

#include "picture_names.hpp"
#include "program_input.hpp"
#include "run_outputs.hpp"

namespace passo {

bool keeps_journal(const RunArguments& arguments) {
  return arguments.board != "virtual" && !arguments.board.starts_with("sim:");
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
    fail(exit_bad_program, path + ": a trace's name ends in .vcd or .csv");
    return false;
  }
  const bool has_look = arguments.colour_by != "speed" || arguments.view != "auto" || arguments.no_rapids;
  if (has_look && arguments.pictures.empty()) {
    fail(exit_bad_program, "--colour-by, --view and --no-rapids are for a --picture");
    return false;
  }
  return true;
}

bool suits_the_board(const RunArguments& arguments) {
  const char* words = nullptr;
  if ((arguments.resume || !arguments.journal.empty()) && !keeps_journal(arguments)) {
    words = "--resume and --journal are for a board that outlives the run: serial: or tcp:";
  } else if (!arguments.cable_cut.empty() && arguments.board != "virtual") {
    words = "--cut-cable-at is for the virtual machine; of a board's cable, pull the plug";
  } else if (!arguments.touches.empty() && keeps_journal(arguments)) {
    words = "--touch is for the virtual machine and emulated boards";
  } else if (arguments.physics && keeps_journal(arguments)) {
    words = "--physics is for the virtual machine and emulated boards; a real machine has its own";
  } else if (!arguments.disturbances.empty() && !arguments.physics) {
    words = "--disturb needs --physics: without it the motors do what they are told, whatever holds them";
  } else if (arguments.from_line > 0 && arguments.resume) {
    words = "--resume knows the line where the job goes on, so --from-line has no place beside it";
  } else if (arguments.from_line == 0 && (arguments.pass > 0 || arguments.after > 0)) {
    words = "--pass and --after tell more of the place that --from-line names, so they need it";
  } else if (arguments.from_here && arguments.resume) {
    words = "--resume knows where the job began, so --from-here has no place beside it";
  }
  if (words != nullptr) fail(exit_bad_program, words);
  return words == nullptr;
}

}  // namespace passo
