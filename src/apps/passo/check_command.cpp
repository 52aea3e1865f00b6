// passo check: interprets the program, builds its path, and says what is wrong. Nothing runs on a machine. With
// --motion the path is also planned and stepped, and the motion is measured.
#include <cstdio>
#include <functional>
#include <utility>

#include "commands.hpp"
#include "findings_json.hpp"
#include "program_input.hpp"
#include "progress_display.hpp"

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/program.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/proof/proof_text.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {
namespace {

nlohmann::ordered_json findings_as_json(const Diagnostics& findings) {
  return {{"good", !findings.any_error()}, {"errors", findings.errors()}, {"findings", as_json(findings.all())}};
}

// Plays the whole program on a virtual machine and measures its motion. `nominal` is the time for the progress line.
MotionProof prove(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                  Seconds nominal, Diagnostics& findings) {
  constexpr unsigned turns_between_looks = 1024;
  MotionProver prover(proof_options(machine));
  ProgressDisplay progress(program.name());
  VirtualMachine board(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock,
                       machine.board.highest_event_rate);
  IdealPlant plant = plant_of(machine, options.start);
  board.connect(plant);
  MachineSession session(machine, board, {.start = {.place = options.start, .trust = Trust::commanded}});
  while (session.state() == MachineState::offline) session.turn(endless);
  request::Start start{.program = std::move(program),
                       .options = options,
                       .nominal_time = nominal,
                       .waits_for_operator = false,
                       .live = false,
                       .answers_probes = false,
                       .findings = &findings};
  start.watchers.path = [&](const PathItem& item) { prover.watch(item); };
  start.watchers.motion = [&](const MotionItem& item) { prover.watch(item); };
  start.watchers.items = [&](const BoardItem& item) { prover.watch(item); };
  static_cast<void>(session.request(std::move(start)).has_value());
  for (unsigned turns = 0; session.busy(); ++turns) {
    session.turn(endless);
    if (turns % turns_between_looks == 0) progress.update(session.program()->nominal_time() / nominal);
  }
  return prover.finish();
}

}  // namespace

int check(const CheckArguments& arguments) {
  Diagnostics diagnostics;
  const auto machine = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  std::optional<ProgramReader> program = open_program(arguments.program);
  const std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;

  Diagnostics findings;
  FindingsDisplay display(findings);
  const auto tell = [&](const PathItem&) { display.update(); };
  const auto watch = arguments.json ? std::function<void(const PathItem&)>() : tell;
  const ProgramCheck result = check_program(program->again(), *machine, *options, findings, watch);
  if (result.good && arguments.motion) {
    display.finish();
    const MotionProof proof = prove(std::move(*program), *machine, *options, result.nominal_time, findings);
    std::fputs((arguments.json ? to_json(proof) : to_text(proof)).c_str(), stdout);
    return proof.good() ? exit_done : exit_failed;
  }
  if (arguments.json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    std::puts(findings_as_json(findings).dump(2, ' ', false, replace).c_str());
  } else {
    display.finish();
    if (result.good) std::printf("%s: no errors\n", arguments.program.program.c_str());
  }
  return result.good ? exit_done : exit_bad_program;
}

}  // namespace passo
