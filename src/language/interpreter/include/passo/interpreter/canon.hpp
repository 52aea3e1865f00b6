// CanonPrinter: prints operations as canonical calls, in exactly the format of `rs274 -g` (LinuxCNC 2.9).
//
//     7 N..... USE_LENGTH_UNITS(CANON_UNITS_INCHES)
//     8 N20    STRAIGHT_FEED(1.0000, 0.0000, -0.2500, 0.0000, 0.0000, 0.0000)
//
// A line has a counter, the N word of the block, and the call. Lengths are in the units that are active at that point
// of the program. As in `rs274 -g`, U V W and spindle numbers other than 0 are not shown. Unlike `rs274 -g`, a number
// that rounds to zero has no sign, and N has no leading zeros.
#pragma once

#include <cstdint>
#include <string>

#include "passo/interpreter/operation.hpp"

namespace passo {

class CanonPrinter {
 public:
  // `machine_units`: the units of tool table entries, which are printed as in the table.
  explicit CanonPrinter(LengthUnits machine_units = LengthUnits::mm) : machine_units_(machine_units) {}

  // Appends one line to `out`, including a newline.
  void print(const Operation& operation, std::string& out);

 private:
  std::uint64_t count_ = 0;
  LengthUnits machine_units_;
  LengthUnits units_ = LengthUnits::mm;
};

}  // namespace passo
