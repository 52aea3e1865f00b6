#include "board_summary.hpp"

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"

namespace passo {

BoardBefore board_before(MachineConnection& machine) {
  if (machine.session().homing() == nullptr) return {};
  return {.counts = machine.machine().counts(),
          .time = machine.machine().now(),
          .frames = machine.frames_sent(),
          .bytes = machine.bytes_sent()};
}

void add_board(RunSummary& summary, MachineConnection& opened, const MachineDescription& machine,
               const BoardBefore& before) {
  const MachineCounts counts = opened.machine().counts();
  const BoardSession& link = opened.session().board();
  BoardSummary board;
  const Ticks time{opened.machine().now().count - before.time.count};
  board.end = Seconds(static_cast<double>(time.count) / machine.board.clock.value());
  board.events = static_cast<std::uint64_t>(counts.events - before.counts.events);
  board.frames = opened.frames_sent() - before.frames;
  board.bytes = opened.bytes_sent() - before.bytes;
  if (const QueueUpdateLedger* ledger = opened.session().ledger(); ledger != nullptr && link.board()) {
    board.held_items = link.board()->capacity;
    board.rests = ledger->recoveries();
  }
  const Point place = kinematics_of(machine).axes(motors_of(counts));
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const std::int64_t net = axis.inverted ? -counts.motors[m].position : counts.motors[m].position;
    const std::int64_t total = counts.motors[m].total - before.counts.motors[m].total;
    summary.axes[m].net_steps = Steps{net};
    summary.axes[m].total_steps = Steps{total};
    summary.axes[m].position = place[axis.axis];
    board.pulses += static_cast<std::uint64_t>(total);
  }
  summary.board = board;
}

}  // namespace passo
