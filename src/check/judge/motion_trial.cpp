#include "passo/judge/motion_trial.hpp"

#include <utility>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/session/board_machine_session.hpp"
#include "passo/verdict/proof_options.hpp"

namespace passo {

MotionProof prove_motion(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                         Seconds nominal, Diagnostics& findings, const TrialWatchers& watchers) {
  constexpr unsigned turns_between_looks = 1024;
  MotionProver prover(proof_options(machine));
  VirtualMachine board(machine.motor_count(), machine.board.clock, machine.board.highest_event_rate);
  IdealPlant plant = plant_of(machine, options.start);
  board.connect(plant);
  board.wire(pin_setup(machine));
  BoardMachineSession session(machine, board, {.start = {.place = options.start, .trust = Trust::commanded}});
  while (session.state() == MachineState::offline) session.poll(endless);
  request::Start start{.program = std::move(program),
                       .options = options,
                       .nominal_time = nominal,
                       .waits_for_operator = false,
                       .live = false,
                       .answers_probes = false,
                       .findings = &findings};
  start.watchers.path = [&](const PathItem& item) {
    prover.watch(item);
    if (watchers.path) watchers.path(item);
  };
  start.watchers.motion = [&](const MotionItem& item) {
    prover.watch(item);
    if (watchers.motion) watchers.motion(item);
  };
  start.watchers.items = [&](const BoardItem& item) { prover.watch(item); };
  static_cast<void>(session.request(std::move(start)).has_value());
  for (unsigned turns = 0; session.busy(); ++turns) {
    session.poll(endless);
    if (watchers.progress && turns % turns_between_looks == 0) {
      watchers.progress(session.program()->nominal_time() / nominal);
    }
  }
  return prover.finish();
}

}  // namespace passo
