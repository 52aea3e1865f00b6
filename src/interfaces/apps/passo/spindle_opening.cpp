#include "spindle_opening.hpp"

#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/spindle/open_vfd.hpp"

namespace passo {
namespace {

// Of a drive that has just been switched on.
constexpr Seconds first_answer_of_drive{3};

}  // namespace

std::unique_ptr<ModbusSpindle> open_spindle(const SpindleBusDescription& bus, SpindleWish wish, int& code) {
  Diagnostics diagnostics;
  auto opened = open_vfd(bus, diagnostics);
  show(diagnostics);
  if (!opened) {
    code = fail(diagnostics.any_error() ? exit_bad_machine : exit_failed,
                fmt::format("the spindle's drive: {} [spindle.open]", opened.error()));
    return nullptr;
  }
  auto spindle = std::make_unique<ModbusSpindle>(std::move(opened->vfd), bus);
  if (spindle->await_drive(first_answer_of_drive)) return spindle;
  if (wish == SpindleWish::later) {
    note(fmt::format("the spindle's drive at {}, address {}, does not answer yet: no program starts before it does",
                     bus.device, bus.address));
    return spindle;
  }
  code = fail(exit_failed, fmt::format("the spindle's drive at {}, address {}, does not answer: is it on, and set to "
                                       "this address and speed? `passo spindle scan` looks for it [spindle.no-answer]",
                                       bus.device, bus.address));
  return nullptr;
}

}  // namespace passo
