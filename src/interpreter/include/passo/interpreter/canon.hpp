// CanonPrinter: operations as canonical calls, in the very form that `rs274 -g` prints.
//
//      7 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)
//     16 N....  STRAIGHT_FEED(x, y, z, a, b, c)
#pragma once

#include <cstdint>
#include <string>

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

class CanonPrinter {
 public:
  // Appends one line (or none), with its line end, to `out`.
  void print(const Operation& operation, std::string& out);

 private:
  std::uint64_t count_ = 0;
  LengthUnits units_ = LengthUnits::mm;
};

}  // namespace passo
