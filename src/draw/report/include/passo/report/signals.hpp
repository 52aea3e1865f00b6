// Signals: wires over time, each high or low, as a table (CSV), as waves (VCD) and as a picture.
//
// Times are nanoseconds from the start. A signal is low before its first change. Changes are in order of time; of
// several at one time the last one counts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

struct SignalChange {
  std::int64_t at = 0;
  bool high = false;
};

struct Signal {
  std::string name;  // of letters, digits and signs without a space
  std::vector<SignalChange> changes = {};
};

struct Signals {
  std::string title;  // of the VCD's module, one word
  std::vector<Signal> signals = {};
  std::int64_t end = 0;

  // A picture with more changes shows nothing any more.
  static constexpr std::size_t most_drawn_changes = 20'000;
  std::size_t count_of_changes() const;
};

// All three write into `file`, which the caller commits.
// A row at the start and at each time at which something changes: the time in seconds, then a 1 or 0 for each signal.
void write_signals_csv(const Signals& signals, OutputFile& file);
void write_signals_vcd(const Signals& signals, OutputFile& file);
// A lane for each signal, filled while the signal is high.
Status<OutputError> draw_signals(const Signals& signals, const PictureOptions& options, OutputFile& file);

}  // namespace passo
