// BoardMachineSession: what is wrong with the board, in sentences, with what only the session knows of it.
#include <string>
#include <utility>

#include "work.hpp"

#include "passo/session/stop_cause.hpp"

namespace passo {
namespace {

RefusalReason reason_of(StopCause::Kind kind) {
  switch (kind) {
    case StopCause::Kind::unknown: break;
    case StopCause::Kind::emergency_stop: return RefusalReason::emergency_stop;
    case StopCause::Kind::drive_alarm: return RefusalReason::drive_alarm;
    case StopCause::Kind::limit_switch_of_axis: return RefusalReason::limit_switch_of_axis;
    case StopCause::Kind::limit_switch: return RefusalReason::limit_switch;
  }
  return RefusalReason::motors_stopped;
}

const char* finer_code_of(StopCause::Kind kind) {
  switch (kind) {
    case StopCause::Kind::unknown: break;
    case StopCause::Kind::emergency_stop: return ".emergency-stop";
    case StopCause::Kind::drive_alarm: return ".drive-alarm";
    case StopCause::Kind::limit_switch_of_axis: return ".limit-switch-of-axis";
    case StopCause::Kind::limit_switch: return ".limit-switch";
  }
  return "";
}

}  // namespace

Sentence BoardMachineSession::sentence_of(LinkError error) const {
  Sentence sentence{.code = std::string(code_of(error)), .text = std::string(message_of(error))};
  const auto add = [&sentence](std::string_view finer, std::string_view name, std::string value, const char* more) {
    sentence.code += finer;
    sentence.arguments.emplace_back(name, std::move(value));
    sentence.text += filled(more, sentence.arguments);
  };
  if (error == LinkError::stopped) return sentence_of_stop();
  if (error == LinkError::cannot_set_up) {
    add(".lacks", "missing", words_of_setup(board_.undone_setup()), ": it has no {missing}");
  }
  if (error == LinkError::cannot_time) {
    add(".makes", "timing", words_of_timing(board_.timing(), board_.wanted_timing(), machine_.board.clock.value()),
        ": it provides {timing}");
  }
  const std::uint32_t line =
      error == LinkError::stood_still && work_ ? work_->standstill_line.value_or(0) : std::uint32_t{0};
  if (line != 0) add(".at-line", "line", std::to_string(line), "; that was near line {line} of the program");
  return sentence;
}

Sentence BoardMachineSession::sentence_of_stop() const {
  const std::uint16_t inputs = board_.stopped_by();
  const std::string code(code_of(LinkError::stopped));
  if (inputs == 0) return {.code = code, .text = std::string(message_of(LinkError::stopped))};
  if (state_ == MachineState::offline && (inputs & input_emergency_stop) != 0) {
    return {.code = code + ".emergency-stop-is-pressed", .text = "the emergency stop is pressed: release it first"};
  }
  const StopCause cause = stop_cause(inputs, machine_);
  return {.code = code + finer_code_of(cause.kind),
          .arguments = cause.arguments,
          .text = cause.what + ": the motor positions are unreliable"};
}

Refusal BoardMachineSession::refusal_in_alarm() const {
  if (trouble_.error == LinkError::drivers_off) return {RefusalReason::drivers_off};
  StopCause cause = stop_cause(board_.stopped_by(), machine_);
  return {reason_of(cause.kind), std::move(cause.arguments)};
}

}  // namespace passo
