// complete_model: checks what a reader has found, and adds what a machine file needs besides: a board that can make
// the steps, a travel, the distance to the switch after homing.
#pragma once

#include <string>

#include "import_context.hpp"
#include "imported_model.hpp"

namespace passo {

// The board of the machine file.
struct ImportedBoard {
  std::int64_t clock_hz = 16'000'000;
  std::int64_t event_rate_hz = 500'000;
  std::string reason;  // why this board
  DecimalNumber step_pulse_us;
  bool pulse_is_shortened = false;
};

// Returns nothing, with diagnostics, if no machine file can describe the machine. Afterwards each axis has a positive
// scale, a travel, a velocity and an acceleration, all within the ranges of a machine file, and each home is complete.
std::optional<ImportedBoard> complete_model(ImportedModel& model, ImportContext& context);

}  // namespace passo
