#include "passo/judge/link_delay.hpp"

#include <cstddef>
#include <utility>
#include <variant>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/session/board_machine_session.hpp"
#include "passo/session/planned_program.hpp"

namespace passo {
namespace {

constexpr unsigned turns_between_looks = 1024;

std::string trouble_of(const std::vector<MachineChange>& changes, Ticket ticket) {
  for (const MachineChange& change : changes) {
    const bool is_answer = change.kind == MachineChange::Kind::answered && change.ticket == ticket;
    if (is_answer && change.fault) return change.fault->message();
  }
  return "";
}

}  // namespace

Seconds planned_time(ProgramReader program, const MachineDescription& machine, const InterpreterOptions& options,
                     const ProgramCheck& check) {
  PlannedProgram planned(std::move(program), machine, options, check);
  Seconds time{0};
  MotionItem item;
  while (planned.next(item)) {
    const auto* move = std::get_if<PlannedMove>(&item);
    time += move != nullptr ? move->duration() : std::get<Action>(item).dwell;
  }
  return time;
}

bool has_line_cost(const MachineDescription& machine, const ProgramCheck& check) {
  return machine.board.held_items_are_given && !check.probes;
}

Result<LinkDelay, std::string> link_delay(ProgramReader program, const MachineDescription& machine,
                                          const InterpreterOptions& options, const ProgramCheck& check, Seconds without,
                                          const std::function<void(double)>& progress) {
  VirtualMachine board(machine.motor_count(), machine.board.clock, machine.board.highest_event_rate,
                       static_cast<std::size_t>(machine.board.held_items));
  IdealPlant plant = plant_of(machine, Point());
  board.connect(plant);
  board.wire(pin_setup(machine));
  VirtualLine line(board, machine.board.clock, LineOptions());
  const Greeting greeting{.session = 1};
  BoardMachineSession session(machine, line,
                              {.over_a_line = true,
                               .care = virtual_line_care,
                               .greeting = greeting,
                               .start = {.place = Point(), .trust = Trust::commanded}});
  session.greet(greeting);
  while (session.state() == MachineState::offline) session.poll(endless);
  if (session.state() != MachineState::idle && session.state() != MachineState::door) {
    return Failure{session.trouble_words()};
  }
  Diagnostics unheard;
  const auto ticket = session.request(request::Start{.program = std::move(program),
                                                     .options = options,
                                                     .nominal_time = check.nominal_time,
                                                     .waits_for_operator = false,
                                                     .live = false,
                                                     .findings = &unheard});
  if (!ticket) return Failure{std::string()};
  for (unsigned turns = 1; session.busy(); ++turns) {
    session.poll(endless);
    if (progress && turns % turns_between_looks == 0) progress(session.program()->nominal_time() / check.nominal_time);
  }
  return LinkDelay{.held_items = machine.board.held_items,
                   .without = without,
                   .over = Seconds(static_cast<double>(board.now().count) / machine.board.clock.value()),
                   .rests = session.ledger()->recoveries(),
                   .slowdowns = session.ledger()->slowdowns(),
                   .trouble = trouble_of(session.take_changes(), *ticket)};
}

}  // namespace passo
