#include "passo/session/operator_panel.hpp"

#include "passo/wire/message.hpp"

namespace passo {
namespace {

// The board tells at once; this is for what is lost on the way.
constexpr Seconds between_questions{0.2};
// In a hold.
constexpr Seconds a_moment{0.05};

}  // namespace

void OperatorPanel::look() {
  if (drive_.state() == MotionDrive::State::ended) return;
  if (holds_ && drive_.state() == MotionDrive::State::held) {
    drive_.listen(a_moment);
  } else if (drive_.now() - asked_ > between_questions) {
    asked_ = drive_.now();
    drive_.ask();
  }
  if (const std::uint16_t pressed = drive_.take_pressed(); pressed != 0) act(pressed);
}

// Who presses both at once wants a hold.
void OperatorPanel::act(std::uint16_t pressed) {
  if ((pressed & (input_hold | input_door)) != 0) {
    holds_ = true;
    drive_.hold();
    return;
  }
  const bool may_start = (drive_.inputs() & (input_hold | input_door)) == 0;
  if ((pressed & input_start) == 0 || !holds_ || !may_start) return;
  holds_ = false;
  drive_.resume();
}

}  // namespace passo
