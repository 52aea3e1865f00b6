#include "passo/drive/output_sequencer.hpp"

#include <algorithm>

#include "passo/link/board_port.hpp"
#include "passo/path/run_up.hpp"

namespace passo {

void OutputSequencer::await_feed() {
  parts_.script.until([this] { return parts_.feed.settled(); });
}

void OutputSequencer::switch_as_ordered() {
  parts_.script.then([this] { parts_.feed.switch_outputs(parts_.order.tell()); });
  await_feed();
}

void OutputSequencer::switch_off() {
  parts_.script.then([this] { parts_.feed.switch_outputs({}); });
  await_feed();
}

void OutputSequencer::switch_on(const OutputState& outputs, Seconds spindle_wait) {
  OutputState spindle = outputs;
  spindle.mist = spindle.flood = false;
  const auto order = [this](const OutputState& wanted) {
    parts_.script.then([this, wanted] {
      parts_.order.order(wanted);
      parts_.feed.switch_outputs(parts_.order.tell());
    });
    await_feed();
  };
  const auto rest = [this](Seconds wait) {
    parts_.script.then([this, wait] { pause(wait); });
    await_pause_end();
  };
  order(spindle);
  if (spindle.spindle != SpindleDirection::off) {
    rest(std::max(spindle_wait, run_up_time({}, spindle, times_.spindle_run_up)));
  }
  if (spindle == outputs) return;
  order(outputs);
  if (times_.coolant_wait > Seconds(0)) rest(times_.coolant_wait);
}

void OutputSequencer::let_go() {
  CommandedOutputs& order = parts_.order;
  if (!order.spindle_stands() && !order.all_stand()) return await_pause_end();
  order.stop_spindle(false);
  order.stop_all(false);
  switch_on_again();
}

void OutputSequencer::stop_spindle(bool stands) {
  parts_.order.stop_spindle(stands);
  switch_as_ordered();
  if (!stands) pause(run_up_time({}, parts_.order.in_force(), times_.spindle_run_up));
}

void OutputSequencer::hold_speed(const Action& action) {
  parts_.order.enable_override(action.heeds.spindle_override);
  if (!parts_.order.is_news()) return;
  const Seconds wait = times_.spindle_run_up * (parts_.order.change_of_speed() / 1000);
  switch_as_ordered();
  parts_.script.then([this, wait] { pause(wait); });
  await_pause_end();
}

void OutputSequencer::await_pause_end() {
  parts_.script.until([this] { return pause_end_ - parts_.link.now() <= hardly_any; });
}

}  // namespace passo
