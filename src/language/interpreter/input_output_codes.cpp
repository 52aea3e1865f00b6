#include "input_output_codes.hpp"

#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double highest_channel = 63;  // LinuxCNC has 64 of each kind

}  // namespace

bool InputOutputCodes::run(CodeNumber number) {
  switch (number) {
    case code(62):
    case code(63):
    case code(64):
    case code(65): return set_digital_output(number);
    case code(66): return read_input();
    default: return set_analog_output(number == code(67));
  }
}

bool InputOutputCodes::set_digital_output(CodeNumber number) {
  std::int32_t output = 0;
  if (!words_.has('P')) {
    return fail("gcode.missing-word", words_.span(input_output), fmt::format("{} without P", spelling('M', number)),
                "P, the number of the output");
  }
  if (!whole_word('P', 0, highest_channel, output)) return false;
  const bool on = number == code(62) || number == code(64);
  emit(operation::SetDigitalOutput{output, on, number == code(62) || number == code(63)});
  return true;
}

bool InputOutputCodes::set_analog_output(bool with_motion) {
  std::int32_t output = 0;
  for (const char letter : {'E', 'Q'}) {
    if (words_.has(letter)) continue;
    return fail("gcode.missing-word", words_.span(input_output),
                fmt::format("{} without {}", with_motion ? "M67" : "M68", letter),
                "E, the number of the output, and Q, its value");
  }
  if (!whole_word('E', 0, highest_channel, output)) return false;
  emit(operation::SetAnalogOutput{output, words_['Q'], with_motion});
  return true;
}

// The program reads the answer in #5399. The interpreter knows no inputs, so the answer is 0. On the machine a wait
// gets -1, as if its time had run out.
bool InputOutputCodes::read_input() {
  using Until = operation::ReadInput::Until;
  const bool analog = words_.has('E');
  if (analog == words_.has('P')) {
    return fail(analog ? "gcode.ambiguous-word" : "gcode.missing-word",
                analog ? words_.span('E') : words_.span(input_output),
                analog ? "M66 with P and E" : "M66 without P or E", "P for a digital input, or E for an analog one");
  }
  std::int32_t input = 0;
  std::int32_t until = 0;
  if (!whole_word(analog ? 'E' : 'P', 0, highest_channel, input)) return false;
  if (words_.has('L') && !whole_word('L', 0, 4, until)) return false;
  if (analog && until != 0) {
    return fail("gcode.bad-wait", words_.span('L'), "M66 cannot wait for an analog input", "L0, or no L");
  }
  if (until != 0 && (!words_.has('Q') || words_['Q'] <= 0)) {
    return fail("gcode.bad-wait", words_.has('Q') ? words_.span('Q') : words_.span('L'),
                fmt::format("M66 L{} waits without a timeout", until), "Q, the timeout in seconds, above 0");
  }
  parameters_.set(input_parameter, until != 0 && block_.options.on_machine ? -1 : 0);
  emit(operation::ReadInput{input, analog, static_cast<Until>(until), Seconds(until != 0 ? words_['Q'] : 0)});
  return true;
}

bool InputOutputCodes::run_user_code(CodeNumber number) {
  if (!block_.options.user_codes) {
    return fail(
        "gcode.user-code", words_.span(user),
        fmt::format("{} is a user code, which is not allowed", spelling('M', number)),
        "--user-codes, if the program runs correctly without this code, or a subroutine for it in a folder of --subs");
  }
  emit(operation::UserCode{number / 10, words_.has('P') ? words_['P'] : -1, words_.has('Q') ? words_['Q'] : -1});
  return true;
}

}  // namespace passo
