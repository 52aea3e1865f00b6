// TraceCsv: a row for each event with a step, for spreadsheets and scripts.
//
//   t,x,y,z
//   0.000010031,1,0,-1
//
// The first column is the time in seconds from the start. It has nine decimals, rounded half up from the exact tick.
// The following columns are −1, 0 or 1 for each axis: the direction of the axis, independent of the direction of its
// motor. If the board switches windings itself, x_f1 to x_f4 and so on follow: 1 for a winding that carries current
// from this event on. Other outputs are not included. A row takes about 20 ns.
#pragma once

#include <array>
#include <cstdint>

#include "passo/report/trace.hpp"
#include "passo/report/trace_buffer.hpp"

namespace passo {

class TraceCsv final : public Trace {
 public:
  // The first piece of text begins with the header.
  TraceCsv(const TraceOptions& options, TraceSink sink);

  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override;
  void finish(Ticks end) override;

 private:
  void put_seconds(std::uint64_t ticks);
  void put_windings(std::uint8_t stepped, std::uint8_t directions);

  TraceBuffer buffer_;
  std::uint64_t ticks_a_second_;
  unsigned motors_;
  std::uint8_t inverted_ = 0;
  TraceWindings windings_;
  // The whole second of the last row.
  std::uint64_t second_ = 0;
  std::uint64_t second_start_ = 0;  // ticks
};

}  // namespace passo
