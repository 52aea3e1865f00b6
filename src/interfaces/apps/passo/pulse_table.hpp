// PulseTable: the pulses of one method as CSV, one per line. The columns are selectable: only the decision variables,
// the four phases of the pulse, the duration of the pulse.
#pragma once

#include <optional>
#include <string>

#include "passo/base/result.hpp"
#include "passo/report/output_file.hpp"
#include "passo/study/measure.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct PulseTable {
  bool beats = false;           // judge, feed, compute, check for the end
  std::optional<Seconds> time;  // duration of the whole move; empty: no durations
  SpeedRule rule = SpeedRule::roots;
  // For one of several moves: its number from 1, which becomes the first column, and when it begins. The header is
  // written with move 1 only.
  int point = 0;
  Seconds begin{0};
};

// Writes the header and all pulses. Fails with the reason if the method does not support the move.
Status<std::string> write_pulse_table(const Method& method, const StepMove& move, const PulseTable& table,
                                      OutputFile& file);

}  // namespace passo
