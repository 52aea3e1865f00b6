// Signals: digital signals over time, as a table (CSV), as waveforms (VCD) and as a picture.
//
// Times are nanoseconds from the start. A signal is low before its first change. Changes must be in order of time; of
// several changes at the same time the last one is used.
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
  std::string name;  // letters, digits and punctuation without blanks
  std::vector<SignalChange> changes = {};
};

struct Signals {
  std::string title;  // name of the VCD module, one word
  std::vector<Signal> signals = {};
  std::int64_t end = 0;

  // A picture with more changes would not be legible.
  static constexpr std::size_t most_drawn_changes = 20'000;
  std::size_t count_of_changes() const;
};

// All three write into `file`; the caller commits it. The CSV has a row for the start and for each time at which
// something changes: the time in seconds, then 1 or 0 for each signal.
void write_signals_csv(const Signals& signals, OutputFile& file);
void write_signals_vcd(const Signals& signals, OutputFile& file);
// Draws a lane for each signal, filled while the signal is high.
Status<OutputError> draw_signals(const Signals& signals, const PictureOptions& options, OutputFile& file);

}  // namespace passo
