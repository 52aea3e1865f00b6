// A program that probes, and what must have been found after a run over a line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/probe_kit.hpp"
#include <gtest/gtest.h>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/euclid.hpp"
#include "passo/interpreter/probe_outcome.hpp"
#include "passo/link/link.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo::test {

struct LineProbing {
  std::vector<ProbeOutcome> outcomes;
  std::vector<Point> contacts;  // as the oracle saw them
  std::vector<Point> releases;
  Point end;
  Diagnostics diagnostics;
  std::optional<LinkError> error;
  bool stopped_by_probe = false;
  BoardOutputs outputs;
  std::uint64_t frames = 0;
  int recoveries = 0;
  int holds = 0;
  Seconds longest_ahead{0};
};

// `others`: steps by which axes beside Z may be off.
inline void expect_place(const MachineDescription& machine, const Point& place, const Point& expected,
                         double others = 0.5) {
  for (const AxisDescription& axis : machine.axes) {
    // An axis that does not move stands between two steps or not.
    const double steps = axis.axis == Axis::z ? 0.5 : others;
    EXPECT_NEAR(place[axis.axis], expected[axis.axis], steps / axis.steps_per_unit + 1e-9) << letter_of(axis.axis);
  }
}

// Down to the plate, off it until it is free, slowly onto it again; from there on as was found, and along in the air.
inline const std::string touches =
    "G21 G90 G0 X1 Y2\nF500 G38.2 X1.5 Z-5\n#31=#5063\nF120 G38.4 X1 Z1\n#32=#5063\nF40 G38.3 Z-3\n"
    "G0 Z1\nG1 X[3+#31] Y[3+#32] Z[2+#5063] F3000\nF600 G38.3 X-2\nG0 X0 Y0 Z0\nM2\n";
inline constexpr double plate = -1.23;

// How long motion goes on after a contact before the machine brakes: the motion that the board had, and the motion on
// the way to the board.
inline double longest_overrun(const MachineDescription& machine, const LineProbing& result, double speed) {
  double overrun = 0;
  for (const AxisDescription& axis : machine.axes) {
    const double slowest = axis.acceleration_at(axis.velocity).value();
    const double blind = 2 * result.longest_ahead.value();
    overrun = std::max(overrun, speed * blind + speed * speed / (2 * slowest) + 2 / axis.steps_per_unit);
  }
  return overrun;
}

// `factor`: of the feeds, by an override.
inline void expect_as_the_oracle_saw(const MachineDescription& machine, const LineProbing& result, double factor = 1) {
  ASSERT_FALSE(result.error) << message_of(*result.error);
  ASSERT_FALSE(result.diagnostics.any_error()) << render(result.diagnostics, false);
  ASSERT_EQ(result.outcomes.size(), 4U);
  ASSERT_GE(result.contacts.size(), 2U);
  ASSERT_GE(result.releases.size(), 1U);
  const Point seen[] = {result.contacts[0], result.releases[0], result.contacts[1]};
  const double speeds[] = {500, 120, 40};
  for (std::size_t i = 0; i < 3; ++i) {
    SCOPED_TRACE("probe move " + std::to_string(i));
    const ProbeOutcome& outcome = result.outcomes[i];
    EXPECT_TRUE(outcome.touched);
    // Where ports are written one after the other, as on the Mega, X steps some cycles behind Z at the very event.
    expect_place(machine, outcome.contact, seen[i], 1.5);
    const double steps = outcome.contact[Axis::z] * machine.axes[2].steps_per_unit;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
    EXPECT_LE(std::abs(outcome.contact[Axis::z] - seen[i][Axis::z]), 1e-9) << "to the step";
    EXPECT_LE(distance(outcome.rest, outcome.contact), longest_overrun(machine, result, factor * speeds[i] / 60));
  }
  EXPECT_FALSE(result.outcomes[3].touched);
  EXPECT_NEAR(result.outcomes[3].rest[Axis::x], -2, 1e-9);
  expect_place(machine, result.end, Point());
}

}  // namespace passo::test
