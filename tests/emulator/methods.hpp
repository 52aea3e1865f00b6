// The methods whose cost is measured, one list for the chip's program and for the host, which plays the same orders with
// the same code and expects the same bytes.
//
// An order is a method's number and values: a line's distances; an arc's start and end; a ramp's first interval. A walk is
// one method under way: done() and next(), which gives a Pulse or an interval.
// Portable.
#pragma once

#include <stdint.h>

#include "passo/interpolate/arcs.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/lean.hpp"
#include "passo/interpolate/master_slave.hpp"
#include "passo/interpolate/point_comparison_line.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"

namespace passo {

// What the chip reads instead of a method's number while there is nothing to do.
inline constexpr uint8_t no_order = 0xff;

struct Order {
  uint8_t method = no_order;
  int32_t values[4] = {};
  uint16_t most = 0;  // pulses
};

template <class Interpolator, uint8_t axes_>
class LineWalk {
 public:
  using Output = Pulse;
  static constexpr uint8_t axes = axes_;

  constexpr explicit LineWalk(const Order& order) : interpolator_(first_values(order).distances) {}
  constexpr bool done() const { return interpolator_.done(); }
  constexpr Pulse next() { return interpolator_.next(); }

 private:
  struct Values {
    int32_t distances[axes_];
  };
  static constexpr Values first_values(const Order& order) {
    Values values = {};
    for (uint8_t axis = 0; axis < axes; ++axis) values.distances[axis] = order.values[axis];
    return values;
  }

  Interpolator interpolator_;
};

template <class Interpolator>
class ArcWalk {
 public:
  using Output = Pulse;
  static constexpr uint8_t axes = 2;

  constexpr explicit ArcWalk(const Order& order)
      : interpolator_(ArcPoints{{order.values[0], order.values[1]}, {order.values[2], order.values[3]}, false}) {}
  constexpr bool done() const { return interpolator_.done(); }
  constexpr Pulse next() { return interpolator_.next(); }

 private:
  Interpolator interpolator_;
};

enum class MethodKind : uint8_t { line, arc, ramp };

template <class Walk_>
struct Method {
  using Walk = Walk_;
  const char* name;  // as the command line has it
  MethodKind kind;
  uint8_t bits;  // of a length, or of what a ramp reckons with
};

template <class Length, class Visitor>
constexpr bool visit_interpolator(uint8_t number, Visitor&& visit) {
  constexpr uint8_t bits = LengthTraits<Length>::bits;
  constexpr MethodKind line = MethodKind::line;
  constexpr MethodKind arc = MethodKind::arc;
  switch (number) {
    case 0: visit(Method<LineWalk<MasterSlave<3, Length>, 3>>{"master-slave", line, bits}); return true;
    case 1: visit(Method<LineWalk<Lean<3, Length>, 3>>{"lean", line, bits}); return true;
    case 2: visit(Method<LineWalk<Dda<3, Length>, 3>>{"dda", line, bits}); return true;
    case 3: visit(Method<LineWalk<SlopeRecalculated<Length>, 2>>{"slope-recalculated", line, bits}); return true;
    case 4: visit(Method<LineWalk<SlopeBlocks<Length>, 2>>{"slope-blocks", line, bits}); return true;
    case 5: visit(Method<LineWalk<PointComparisonLine<Length>, 2>>{"point-comparison", line, bits}); return true;
    case 6: visit(Method<ArcWalk<PointComparisonArc<Length>>>{"point-comparison", arc, bits}); return true;
    case 7: visit(Method<ArcWalk<MidpointArc<Length>>>{"midpoint", arc, bits}); return true;
    case 8: visit(Method<ArcWalk<DdaArc<Length>>>{"dda", arc, bits}); return true;
    default: return false;
  }
}

// Calls visit with the method of that number. False: there are fewer.
template <class Visitor>
constexpr bool visit_method(uint8_t number, Visitor&& visit) {
  constexpr uint8_t interpolators = 9;
  if (number < interpolators) return visit_interpolator<uint16_t>(number, visit);
  return visit_interpolator<uint32_t>(static_cast<uint8_t>(number - interpolators), visit);
}

}  // namespace passo
