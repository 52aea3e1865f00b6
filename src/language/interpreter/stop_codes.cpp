#include "stop_codes.hpp"

#include <utility>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

}  // namespace

bool StopCodes::run(CodeNumber number) {
  // A fault is reported. The program stops all the same.
  (void)cutter_codes_.report(cutter_.release(), words_.span(stopping));
  switch (number) {
    case code(0): emit(operation::ProgramStop{}); return true;
    case code(1): emit(operation::OptionalProgramStop{}); return true;
    case code(60):
      emit(operation::PalletShuttle{});
      emit(operation::ProgramStop{});
      return true;
    case code(98):
    case code(99): return true;  // ProgramFlow::follow() executes them
    default: end_program(number == code(30)); return true;
  }
}

void StopCodes::end_program(bool pallet) {
  const auto is_on = [&](std::string_view name) {
    return block_.options.settings && block_.options.settings->is_on("RS274NGC", name);
  };
  if (state_.measured.work_shift != 0) frame_.shift_work_z(-std::exchange(state_.measured.work_shift, 0));
  if (!is_on("DISABLE_AUTO_G54")) frame_.activate_system(1, false);
  if (is_on("DISABLE_G92_PERSISTENCE")) (void)frame_.set_g92(code(92, 1));
  if (state_.modal.plane() != Plane::xy) emit(operation::SelectPlane{Plane::xy});
  emit(operation::SetFeedMode{});
  emit(operation::SetFeedRate{});
  if (!state_.feed_override) emit(operation::SetFeedOverride{true});
  for (std::uint8_t i = 0; i < state_.spindle_count; ++i) {
    if (!state_.spindles[i].speed_override) emit(operation::SetSpeedOverride{true, i});
    emit(operation::TurnSpindle{SpindleDirection::off, i});
    emit(operation::SetSpindleMode{0, i});
  }
  if (state_.mist) emit(operation::SetMist{false});
  if (state_.flood) emit(operation::SetFlood{false});
  if (pallet) emit(operation::PalletShuttle{});
  emit(operation::ProgramEnd{});
  block_.ended = true;
}

bool StopCodes::dwell() {
  if (!words_.has_code(non_modal, code(4))) return true;
  block_.word = {words_.span(non_modal).column, words_.span(non_modal).length};
  if (block_.motion != nullptr && letters_of(*block_.motion).has('P')) {
    return fail("gcode.ambiguous-word", words_.span('P'),
                fmt::format("P is ambiguous: both G4 and {} use it", spelling(*block_.motion)),
                interpreter_says::two_blocks);
  }
  if (is_negative('P')) {
    return fail("gcode.negative-word", words_.span('P'), "a dwell of " + number_and_noun(words_['P'], "second"),
                "P of 0 or more");
  }
  emit(operation::Dwell{Seconds(never_negative('P'))});
  return true;
}

}  // namespace passo
