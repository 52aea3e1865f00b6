// read_signals: digital signals from a file: a value change dump (VCD, as Passo, sigrok and GTKWave write it) or a CSV.
//
// The first column of a CSV is the time in seconds, and its first row has the names. A column with the name of an axis
// (x, y, z…) has the steps of a motor, -1, 0 or 1, as in the trace of a run. It is read as two signals: x_step, which
// is high until halfway to the motor's next step, but at most a millisecond, and x_dir, high while it steps down. The
// other columns are levels, 0 or 1.
//
// In a VCD, signals of several bits and unknown levels (x, z) are low. Times are nanoseconds, rounded down.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/report/signals.hpp"

namespace passo {

struct SignalsToRead {
  std::function<bool(std::string_view name)> wanted;              // the other signals have a name, but no changes
  std::int64_t until = std::numeric_limits<std::int64_t>::max();  // nothing after this time is read
  std::size_t most_changes = 0;                                   // of all wanted signals together
};

// Reads a VCD if the name ends with .vcd, else a CSV. `end` of the result is the last time in the file, at most
// `until`. The error begins with the file's name and the line, and says what was expected.
Result<Signals, std::string> read_signals(const std::string& path, const SignalsToRead& what);

}  // namespace passo
