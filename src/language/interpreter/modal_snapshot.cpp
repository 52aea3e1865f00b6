#include "modal_snapshot.hpp"

#include "block_executor.hpp"

namespace passo {
namespace {

using enum ModalGroup;

}  // namespace

ModalSnapshot snapshot_of(const ProgramState& state) {
  return {.valid = true,
          .restore_at_return = false,
          .modal = state.modal,
          .tool_offset = state.frame.tool_offset(),
          .feed = state.feed,
          .spindles = state.spindles,
          .tolerance = state.tolerance,
          .mist = state.mist,
          .flood = state.flood,
          .feed_override = state.feed_override,
          .adaptive_feed = state.feed_permissions.adaptive,
          .feed_hold = state.feed_permissions.hold};
}

// M70 saves, M71 forgets, M72 restores. M73 saves, and the end of the sub then restores.
bool BlockExecutor::keep_modal_state(CodeNumber number) {
  const auto depth = static_cast<std::size_t>(state_.call_depth);
  if (depth >= snapshots_.size()) snapshots_.resize(depth + 1);
  ModalSnapshot& here = snapshots_[depth];
  if (number == code(71)) {
    here.valid = false;
  } else if (number != code(72)) {
    here = snapshot_of(state_);
    here.restore_at_return = number == code(73);
  } else if (here.valid) {
    restore(here);
  } else {
    return fail("gcode.nothing-saved", words_.span(spindle), "M72 without a saved modal state",
                "M70 or M73 before, in the same subroutine");
  }
  return true;
}

void BlockExecutor::leave_sub(const OperationSource& source) {
  restore_after_sub(source);
  if (block_.ended) return;
  block_.source = source;
  block_.word = {};
  if (hooks_.is_left(state_.call_depth)) return leave_hook();
  if (!tools_.changes_by_macro(state_.call_depth)) return;
  tools_.examine_after_macro();
  restore(tools_.modes_before_macro());
  tools_.go_on_after_macro();
  cycle_ = &tools_;
}

void BlockExecutor::restore_after_sub(const OperationSource& source) {
  const auto left = static_cast<std::size_t>(state_.call_depth) + 1;
  if (left >= snapshots_.size() || !std::exchange(snapshots_[left].valid, false)) return;
  if (!snapshots_[left].restore_at_return) return;
  block_.source = source;
  block_.word = {};
  restore(snapshots_[left]);
}

// Restores in the order in which a block would set the modes. Feed, the speed of spindle 0 and path mode are emitted
// even if they did not change, as in LinuxCNC.
void BlockExecutor::restore(const ModalSnapshot& saved) {
  words_.clear();
  const auto put_back = [&](ModalGroup group) {
    if (state_.modal[group] != saved.modal[group]) (void)set_group(*find_code('G', saved.modal[group]));
  };
  put_back(length_units);
  put_back(feed_mode);
  state_.feed = saved.feed;
  if (!state_.modal.inverse_time()) emit_feed_rate(saved.feed / state_.length_unit());
  restore_spindles(saved);
  for (const ModalGroup group : modes_in_order) {
    // Cutter compensation is restored only to off. To turn it on needs a tool and a move that leads in.
    if (group == cutter_compensation && saved.modal[group] != code(40)) continue;
    if (group == tool_length) {
      frame_.restore_tool_offset(saved);
    } else if (group == path_mode) {
      modes_.restore_path_mode(saved.modal[group], saved.tolerance);
    } else {
      put_back(group);
    }
  }
  restore_switches(saved);
}

void BlockExecutor::restore_spindles(const ModalSnapshot& saved) {
  state_.modal.set(spindle_mode, saved.modal[spindle_mode]);
  for (std::uint8_t i = 0; i < state_.spindle_count; ++i) {
    const SpindleState now = state_.spindles[i];
    const SpindleState& then = state_.spindles[i] = saved.spindles[i];
    if (now.surface_limit != then.surface_limit) emit(operation::SetSpindleMode{then.surface_limit, i});
    if (i == 0 || now.speed != then.speed) emit(operation::SetSpindleSpeed{then.speed, i});
    if (now.direction != then.direction) emit(operation::TurnSpindle{then.direction, i});
    if (now.speed_override != then.speed_override) emit(operation::SetSpeedOverride{then.speed_override, i});
  }
}

void BlockExecutor::restore_switches(const ModalSnapshot& saved) {
  if (std::exchange(state_.mist, saved.mist) != saved.mist) emit(operation::SetMist{saved.mist});
  if (std::exchange(state_.flood, saved.flood) != saved.flood) emit(operation::SetFlood{saved.flood});
  if (std::exchange(state_.feed_override, saved.feed_override) != saved.feed_override) {
    emit(operation::SetFeedOverride{saved.feed_override});
  }
  if (std::exchange(state_.feed_permissions.adaptive, saved.adaptive_feed) != saved.adaptive_feed) {
    emit(operation::SetAdaptiveFeed{saved.adaptive_feed});
  }
  if (std::exchange(state_.feed_permissions.hold, saved.feed_hold) != saved.feed_hold)
    emit(operation::SetFeedHold{saved.feed_hold});
}

}  // namespace passo
