#include "line_cost.hpp"

#include <utility>

#include "opened_machine.hpp"
#include "progress_display.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/link/await.hpp"
#include "passo/report/line_words.hpp"
#include "passo/session/planned_program.hpp"

namespace passo {
namespace {

constexpr unsigned turns_between_looks = 1024;

std::string so_often(int count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
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

std::optional<LineCost> line_cost(ProgramReader program, const MachineDescription& machine,
                                  const InterpreterOptions& options, const ProgramCheck& check, Seconds without) {
  if (!machine.board.held_items_are_given || check.probes) return {};
  LineCost cost{.held_items = machine.board.held_items, .without = without};
  ProgressDisplay progress(program.name());
  Diagnostics unheard;
  int code = 0;
  const auto opened = OpenedMachine::open(machine, {.over_a_line = true}, code);
  if (!opened || !opened->greet(opened->any_greeting(), code)) return {};
  MachineSession& session = opened->session();
  const auto ticket = session.request(request::Start{.program = std::move(program),
                                                     .options = options,
                                                     .nominal_time = check.nominal_time,
                                                     .waits_for_operator = false,
                                                     .live = false,
                                                     .findings = &unheard});
  if (!ticket) return {};
  for (unsigned turns = 1; session.busy(); ++turns) {
    session.turn(endless);
    if (turns % turns_between_looks == 0) progress.update(session.program()->nominal_time() / check.nominal_time);
  }
  const Answered answered = answer_of(session.take_changes(), *ticket);
  if (answered.fault) cost.trouble = answered.fault->message();
  cost.over = Seconds(static_cast<double>(opened->machine().now().count) / machine.board.clock.value());
  cost.rests = session.ledger()->recoveries();
  cost.slowdowns = session.ledger()->slowdowns();
  return cost;
}

std::string to_text(const LineCost& cost) {
  std::string words = fmt::format("line            to a board with {}: ", counted(cost.held_items, "place"));
  if (!cost.trouble.empty()) return words + cost.trouble + "\n";
  if (cost.cost() < least_cost_of_line) {
    words += "costs no time";
  } else {
    words += fmt::format("{:.3f} s longer, {}", cost.cost().value(), percent_of(cost.cost(), cost.without));
  }
  if (cost.slowdowns > 0) words += fmt::format("; slower {} where its places are few", so_often(cost.slowdowns));
  if (cost.rests > 0) words += fmt::format("; rests {} for want of more", so_often(cost.rests));
  return words + "\n";
}

nlohmann::ordered_json as_json(const LineCost& cost) {
  nlohmann::ordered_json json = {{"held_items", cost.held_items},
                                 {"time_s", cost.over.value()},
                                 {"cost_s", cost.cost().value()},
                                 {"cost_share", cost.share()},
                                 {"slowdowns", cost.slowdowns},
                                 {"rests", cost.rests},
                                 {"trouble", nullptr}};
  if (!cost.trouble.empty()) json["trouble"] = cost.trouble;
  return json;
}

}  // namespace passo
