// The methods whose cost is measured, one list for the chip's program, for the host, which plays the same orders with
// the same code and expects the same bytes, and for the host's benchmark.
//
// An order is a method's number and values: a line's distances; an arc's start and end, from the centre; a ramp's first
// interval, steps and fastest interval. A walk is one method under way: done() and next(), which gives a Pulse or an
// interval. Portable.
#pragma once

#include <stdint.h>

#include "passo/interpolate/arcs.hpp"
#include "passo/interpolate/bresenham_line.hpp"
#include "passo/interpolate/dda.hpp"
#include "passo/interpolate/exact_ramp.hpp"
#include "passo/interpolate/master_slave.hpp"
#include "passo/interpolate/point_comparison_line.hpp"
#include "passo/interpolate/ramp_move.hpp"
#include "passo/interpolate/ramp_table.hpp"
#include "passo/interpolate/recursive_ramp.hpp"
#include "passo/interpolate/slope_blocks.hpp"
#include "passo/interpolate/slope_recalculated.hpp"
#include "passo/interpolate/table_ramp.hpp"

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
  static constexpr uint8_t axes = 2;

  constexpr explicit ArcWalk(const Order& order)
      : interpolator_(ArcPoints{{order.values[0], order.values[1]}, {order.values[2], order.values[3]}, false}) {}
  constexpr bool done() const { return interpolator_.done(); }
  constexpr Pulse next() { return interpolator_.next(); }

 private:
  Interpolator interpolator_;
};

// How each ramp is begun: with K_b in ticks.
template <class Ramp>
struct Begin;
template <class Table>
struct Begin<TableRamp<Table>> {
  static constexpr TableRamp<Table> with(uint32_t first) {
    TableRamp<Table> ramp;
    static_cast<void>(ramp.set_first_interval(first));  // orders have one that fits
    return ramp;
  }
};
template <class Square>
struct Begin<RecursiveRamp<Square>> {
  static constexpr RecursiveRamp<Square> with(uint32_t first) { return {static_cast<Square>(first) * first, first}; }
};
template <>
struct Begin<ExactRamp> {
  static constexpr ExactRamp with(uint32_t first) { return ExactRamp(static_cast<uint64_t>(first) * first); }
};

// Faster and faster, for ever.
template <class Ramp>
class RampWalk {
 public:
  static constexpr uint8_t axes = 1;

  constexpr explicit RampWalk(const Order& order) : ramp_(Begin<Ramp>::with(static_cast<uint32_t>(order.values[0]))) {}
  constexpr bool done() const { return false; }
  constexpr typename Ramp::Interval next() {
    ramp_.rise();
    return ramp_.interval();
  }

 private:
  Ramp ramp_;
};

// There and back to rest: order.values[1] steps, at order.values[2] ticks a step at the fastest.
template <class Ramp, class Count>
class MoveWalk {
 public:
  static constexpr uint8_t axes = 1;

  constexpr explicit MoveWalk(const Order& order) : move_(Begin<Ramp>::with(static_cast<uint32_t>(order.values[0]))) {
    static_cast<void>(move_.set_rates(0, static_cast<typename Ramp::Interval>(order.values[2])));
    move_.move_to(order.values[1]);
  }
  constexpr bool done() const { return move_.done(); }
  constexpr typename Ramp::Interval next() { return move_.next(); }

 private:
  RampMove<Ramp, Count> move_;
};

enum class MethodKind : uint8_t { line, arc, ramp, move };

constexpr const char* name_of(MethodKind kind) {
  switch (kind) {
    case MethodKind::line: return "line";
    case MethodKind::arc: return "arc";
    case MethodKind::ramp: return "ramp";
    case MethodKind::move: return "whole ramp move";
  }
  return "";
}

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
    case 1: visit(Method<LineWalk<BresenhamLine<3, Length>, 3>>{"lean", line, bits}); return true;
    case 2: visit(Method<LineWalk<Dda<3, Length>, 3>>{"dda", line, bits}); return true;
    case 3: visit(Method<LineWalk<BresenhamLine<2, Length>, 2>>{"lean", line, bits}); return true;
    case 4: visit(Method<LineWalk<SlopeRecalculated<Length>, 2>>{"slope-recalculated", line, bits}); return true;
    case 5: visit(Method<LineWalk<SlopeBlocks<Length>, 2>>{"slope-blocks", line, bits}); return true;
    case 6: visit(Method<LineWalk<PointComparisonLine<Length>, 2>>{"point-comparison", line, bits}); return true;
    case 7: visit(Method<ArcWalk<PointComparisonArc<Length>>>{"point-comparison", arc, bits}); return true;
    case 8: visit(Method<ArcWalk<MidpointArc<Length>>>{"midpoint", arc, bits}); return true;
    case 9: visit(Method<ArcWalk<DdaArc<Length>>>{"dda", arc, bits}); return true;
    default: return false;
  }
}

template <class Table, class Visitor>
constexpr bool visit_ramp(uint8_t number, Visitor&& visit) {
  constexpr MethodKind ramp = MethodKind::ramp;
  constexpr MethodKind move = MethodKind::move;
  switch (number) {
    case 0: visit(Method<RampWalk<TableRamp<Table>>>{"table", ramp, 16}); return true;
    case 1: visit(Method<RampWalk<RecursiveRamp<uint32_t>>>{"recursive", ramp, 32}); return true;
    case 2: visit(Method<RampWalk<RecursiveRamp<uint64_t>>>{"recursive", ramp, 64}); return true;
    case 3: visit(Method<RampWalk<ExactRamp>>{"exact", ramp, 64}); return true;
    case 4: visit(Method<MoveWalk<TableRamp<Table>, uint16_t>>{"table", move, 16}); return true;
    case 5: visit(Method<MoveWalk<ExactRamp, uint32_t>>{"exact", move, 64}); return true;
    default: return false;
  }
}

inline constexpr uint16_t ramp_table_size = 512;

// Calls visit with the method of that number. False: there are fewer. Table: where a table ramp reads its factors.
template <class Table, class Visitor>
constexpr bool visit_method(uint8_t number, Visitor&& visit) {
  constexpr uint8_t interpolators = 10;
  if (number < interpolators) return visit_interpolator<uint16_t>(number, visit);
  number = static_cast<uint8_t>(number - interpolators);
  if (number < interpolators) return visit_interpolator<uint32_t>(number, visit);
  return visit_ramp<Table>(static_cast<uint8_t>(number - interpolators), visit);
}

}  // namespace passo
