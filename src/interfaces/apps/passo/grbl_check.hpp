// passo check for a machine whose Grbl board plans the motion by itself.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/interpreter/interpreter.hpp"
#include "passo/judge/judgement.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/sender/grbl_forecast.hpp"
#include "passo/sender/grbl_program_check.hpp"
#include "passo/transport/board_address.hpp"

namespace passo {

struct GrblBoard {
  std::string firmware = "Grbl 1.1";
  GrblLimits limits;
  GrblLine line;
  GrblTarget target;
  GrblForecast::Result forecast = {};  // after judge_on_grbl()
};

// Returns the rate that limits the lines to a board; 0: none does.
double grbl_bytes_per_second(const BoardAddress& address, const GrblMachine& machine);

// Returns the board that `name` identifies: "grbl" is Grbl on an Uno with the limits of the machine file; an address is
// asked for its settings and offsets, which then also apply to `options`. Empty, with a message and `code`: it is
// neither, or does not answer.
std::optional<GrblBoard> grbl_board(const std::string& name, const MachineDescription& machine,
                                    InterpreterOptions& options, int& code);

// Analyses the motion that the board plans for a checked program.
Judgement judge_on_grbl(const ProgramReader& program, const MachineDescription& machine,
                        const InterpreterOptions& options, const ProgramCheck& check, const JudgeWatchers& watchers,
                        const std::function<void(double)>& progress, GrblBoard& board);

std::string to_text(const GrblBoard& board);
nlohmann::ordered_json as_json(const GrblBoard& board);

}  // namespace passo
