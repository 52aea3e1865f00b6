// BlockExecutor: blocks that are cycles, and the tool change of a machine that measures.
#include <utility>

#include "block_executor.hpp"
#include "program_lines.hpp"

namespace passo {

// A cycle gives as many operations at a time as the queue takes, and the rest of its block comes behind it.
void BlockExecutor::go_on() {
  if (lathe_.wants_contour()) return;
  if (cycle_ != nullptr) {
    Cycle& cycle = cycle_->cycle();
    Operation operation;
    bool more = true;
    if (cycle.awaits()) cycle.apply(block_.answers.probe());
    operation.word = block_.word;
    operation.axis_words = cycle_ == &tools_ ? nullptr : &block_.axis_words;
    operation.in_machine = cycle_ == &tools_;
    const bool compensated = cutter_.active();
    while (operations_.has_room() && (more = cycle.next(operation))) {
      if (!compensated) {
        operations_.push(operation);
      } else if (!cutter_codes_.follow(operation.what)) {
        cycle_ = nullptr;
        cutter_.skip_to(state_.position = cycle.position());
        return;
      }
    }
    if (!compensated || !more) state_.position = cycle.position();
    if (more || cycle.awaits()) return;
    if (compensated) state_.cutter_shift = cutter_.shift(state_.position);
    const bool has_changed = tools_.take_begun();
    if (!std::exchange(cycle_, nullptr)->finish()) return;
    if (tools_.take_macro_call()) {
      return subprograms_.call_machine_program(change_macro_number, words_.span(ModalGroup::tool_change));
    }
    if (has_changed && (!execute_after_change() || cycle_ != nullptr)) return;
  }
  const CodeEntry* const stop = words_.code(ModalGroup::stopping);
  if (stop == nullptr || !tools_.check_stop(stop->number) || !hooks_.check_stop(stop->number)) return;
  if (const std::int32_t hook = hooks_.begin_end(stop->number)) {
    return subprograms_.call_machine_program(hook, words_.span(ModalGroup::stopping));
  }
  if (!block_.ended) stops_.run(stop->number);
}

bool BlockExecutor::call_start_hook() {
  const std::int32_t hook = hooks_.begin_start();
  if (hook != 0) subprograms_.call_machine_program(hook, {});
  return hook != 0;
}

void BlockExecutor::leave_hook() {
  restore(hooks_.end());
  if (!block_.ended && hooks_.ending() != 0) stops_.run(hooks_.ending());
}

// A line of a lathe cycle's contour.
void BlockExecutor::add_to_contour(const Block& block) {
  state_.line = block.line;
  lathe_.add_to_contour(words_.read(block, parameters_, reporter_) && (block.assignments.empty() || assign(block)));
}

void BlockExecutor::end_contour() {
  if (lathe_.end_contour()) cycle_ = &lathe_;
}

}  // namespace passo
