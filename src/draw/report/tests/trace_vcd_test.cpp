#include "passo/report/trace_vcd.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "kit/seed.hpp"
#include "vcd_reader.hpp"

namespace passo {
namespace {

using Changes = std::vector<VcdChange>;

const std::vector<TraceMotor> xyz = {{.axis = Axis::x}, {.axis = Axis::y}, {.axis = Axis::z}};

// At 16 MHz the unit is 100 ps: a tick has 625 of them, and the usual pulse of 2.5 µs has 25,000.
class Trace16 {
 public:
  explicit Trace16(TraceOptions options = {.motors = xyz})
      : trace_(options, [this](std::string_view piece) { text_ += piece; }) {}
  TraceVcd* operator->() { return &trace_; }
  Vcd finished(std::int64_t end) {
    trace_.finish(Ticks{end});
    return Vcd(text_);
  }
  std::string text(std::int64_t end) {
    trace_.finish(Ticks{end});
    return text_;
  }

 private:
  std::string text_;
  TraceVcd trace_;
};

std::string timescale_at(double hertz) {
  return Trace16({.motors = xyz, .clock = Hertz(hertz)}).finished(0).timescale;
}

TEST(TraceVcd, declares_the_lines_of_each_axis_and_the_outputs_and_has_no_date) {
  Trace16 trace({.motors = {{.axis = Axis::x}, {.axis = Axis::a}}});
  const std::string text = trace.text(0);
  EXPECT_EQ(text.find("$date"), std::string::npos);
  EXPECT_TRUE(text.starts_with("$version Passo $end\n$timescale 100 ps $end\n"));
  const Vcd vcd(text);
  EXPECT_EQ(vcd.scope, "machine");
  EXPECT_THAT(vcd.names, testing::ElementsAre("X_step", "X_dir", "A_step", "A_dir", "spindle", "spindle_reverse",
                                              "mist", "flood", "spindle_rpm"));
  for (const auto& [name, changes] : vcd.wires) EXPECT_EQ(changes, Changes({{0, 0}})) << name;
}

TEST(TraceVcd, shows_the_windings_that_the_board_switches) {
  Trace16 trace({.motors = {{.axis = Axis::x}, {.axis = Axis::y}}, .windings = *Excitation::named("half-step")});
  trace->on_steps(Ticks{1000}, 0b01, 0);     // X 1: F2
  trace->on_steps(Ticks{2000}, 0b01, 0);     // X 2: F2 F3
  trace->on_steps(Ticks{3000}, 0b11, 0b11);  // X 1: F2; Y -1: F1
  const Vcd vcd = trace.finished(4000);
  EXPECT_EQ(vcd.wires.at("X_F1"), Changes({{0, 0}}));
  EXPECT_EQ(vcd.wires.at("X_F2"), Changes({{0, 0}, {625'000, 1}}));
  EXPECT_EQ(vcd.wires.at("X_F3"), Changes({{0, 0}, {1'250'000, 1}, {1'875'000, 0}}));
  EXPECT_EQ(vcd.wires.at("Y_F1"), Changes({{0, 0}, {1'875'000, 1}}));
  EXPECT_EQ(vcd.wires.at("Y_F4"), Changes({{0, 0}}));
}

TEST(TraceVcd, a_tick_is_a_whole_number_of_units_where_it_can_be) {
  EXPECT_EQ(timescale_at(16e6), "100 ps");  // 62.5 ns
  EXPECT_EQ(timescale_at(20e6), "10 ns");   // 50 ns
  EXPECT_EQ(timescale_at(84e6), "1 ps");    // 11.9… ns
  EXPECT_EQ(timescale_at(72e6), "1 ps");
  EXPECT_EQ(timescale_at(125e3), "1 us");  // 8 µs
  EXPECT_EQ(timescale_at(1e6), "100 ns");  // less than a tick, since half a tick needs a place too
  EXPECT_EQ(timescale_at(1), "100 ms");
}

TEST(TraceVcd, a_pulse_begins_at_its_step_and_lasts_the_step_pulse) {
  Trace16 trace;
  trace->on_steps(Ticks{1000}, 0b001, 0);
  trace->on_steps(Ticks{2000}, 0b011, 0);
  const Vcd vcd = trace.finished(3000);
  EXPECT_EQ(vcd.wires.at("X_step"), Changes({{0, 0}, {625'000, 1}, {650'000, 0}, {1'250'000, 1}, {1'275'000, 0}}));
  EXPECT_EQ(vcd.wires.at("Y_step"), Changes({{0, 0}, {1'250'000, 1}, {1'275'000, 0}}));
  EXPECT_EQ(vcd.wires.at("Z_step"), Changes({{0, 0}}));
  EXPECT_EQ(vcd.end, 1'875'000U);
}

TEST(TraceVcd, a_pulse_ends_half_way_to_the_next_step_where_that_is_sooner) {
  Trace16 trace;
  trace->on_steps(Ticks{100}, 1, 0);
  trace->on_steps(Ticks{105}, 1, 0);
  const Vcd vcd = trace.finished(105);
  EXPECT_EQ(vcd.wires.at("X_step"), Changes({{0, 0}, {62'500, 1}, {64'062, 0}, {65'625, 1}, {90'625, 0}}));
}

TEST(TraceVcd, a_direction_is_set_together_with_the_first_step_that_way) {
  Trace16 trace;
  trace->on_steps(Ticks{1000}, 0b001, 0b001);
  trace->on_steps(Ticks{2000}, 0b010, 0b000);  // X does not step, so its direction stays
  trace->on_steps(Ticks{3000}, 0b001, 0b000);
  const Vcd vcd = trace.finished(3000);
  EXPECT_EQ(vcd.wires.at("X_dir"), Changes({{0, 0}, {625'000, 1}, {1'875'000, 0}}));
  EXPECT_EQ(vcd.wires.at("Y_dir"), Changes({{0, 0}}));
}

TEST(TraceVcd, shows_the_level_of_the_line_of_an_inverted_motor) {
  Trace16 trace({.motors = {{.axis = Axis::x, .inverted = true}}});
  trace->on_steps(Ticks{1000}, 1, 1);
  EXPECT_EQ(trace.finished(1000).value("X_dir", 625'000), 1U);
}

TEST(TraceVcd, shows_the_outputs_when_they_change) {
  Trace16 trace;
  trace->on_outputs(Ticks{0}, {.switches = spindle_on, .spindle_rpm = 12000});
  trace->on_steps(Ticks{160}, 1, 0);
  trace->on_outputs(Ticks{160}, {.switches = spindle_on | flood_on, .spindle_rpm = 12000});
  trace->on_outputs(Ticks{320}, {.switches = spindle_on | flood_on, .spindle_rpm = 12000});
  trace->on_outputs(Ticks{480}, {.switches = spindle_on | spindle_reverse | mist_on, .spindle_rpm = 65535});
  trace->on_outputs(Ticks{640}, {});
  const Vcd vcd = trace.finished(640);
  EXPECT_EQ(vcd.wires.at("spindle"), Changes({{0, 0}, {0, 1}, {400'000, 0}}));
  EXPECT_EQ(vcd.wires.at("spindle_reverse"), Changes({{0, 0}, {300'000, 1}, {400'000, 0}}));
  EXPECT_EQ(vcd.wires.at("mist"), Changes({{0, 0}, {300'000, 1}, {400'000, 0}}));
  EXPECT_EQ(vcd.wires.at("flood"), Changes({{0, 0}, {100'000, 1}, {300'000, 0}}));
  EXPECT_EQ(vcd.wires.at("spindle_rpm"), Changes({{0, 0}, {0, 12000}, {300'000, 65535}, {400'000, 0}}));
  EXPECT_EQ(vcd.wires.at("X_step"), Changes({{0, 0}, {100'000, 1}, {125'000, 0}}));
}

TEST(TraceVcd, goes_on_to_the_end_of_a_job_that_waits_there) {
  Trace16 trace;
  trace->on_steps(Ticks{16}, 1, 0);
  EXPECT_EQ(trace.finished(16'000'000).end, 10'000'000'000U);
}

// The time in units of so many picoseconds, rounded half up.
std::uint64_t in_units(std::int64_t ticks, std::int64_t hertz, std::int64_t unit) {
  __extension__ using Wide = __int128;
  const Wide divisor = Wide{hertz} * unit;
  return static_cast<std::uint64_t>((Wide{2} * ticks * 1'000'000'000'000 + divisor) / (2 * divisor));
}

struct ShownStep {
  std::uint64_t time;
  bool down;
  friend bool operator==(const ShownStep&, const ShownStep&) = default;
};
// The rising edges of a step line, each with the level of its direction line. Also checks the length of each pulse.
std::vector<ShownStep> steps_of(const Vcd& vcd, const std::string& axis, std::uint64_t longest_pulse) {
  std::vector<ShownStep> steps;
  const Changes& edges = vcd.wires.at(axis + "_step");
  const Changes& directions = vcd.wires.at(axis + "_dir");
  std::size_t direction = 0;
  for (std::size_t i = 1; i < edges.size(); i += 2) {
    while (direction + 1 < directions.size() && directions[direction + 1].time <= edges[i].time) ++direction;
    steps.push_back({edges[i].time, directions[direction].value == 1});
    EXPECT_LT(i + 1, edges.size()) << "a pulse that does not end";
    if (i + 1 >= edges.size()) break;
    const std::uint64_t pulse = edges[i + 1].time - edges[i].time;
    EXPECT_GE(pulse, 1U);
    EXPECT_LE(pulse, longest_pulse);
    if (i + 2 < edges.size()) {
      EXPECT_LE(2 * pulse, edges[i + 2].time - edges[i].time);
    }
  }
  return steps;
}

TEST(TraceVcd, random_jobs_have_every_step_at_its_time_and_every_pulse_closed_before_the_next) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  struct Clock {
    std::int64_t hertz;
    std::int64_t unit;  // picoseconds
  };
  for (const Clock& clock : std::vector<Clock>{
           {16'000'000, 100}, {20'000'000, 10'000}, {72'000'000, 1}, {1'000'000, 100'000}, {3'999'999'999, 1}}) {
    Trace16 trace({.motors = xyz, .clock = Hertz(static_cast<double>(clock.hertz))});
    std::vector<ShownStep> steps[3];
    std::int64_t ticks = 0;
    for (int i = 0; i < 3000; ++i) {
      ticks += static_cast<std::int64_t>(1 + random() % (random() % 8 == 0 ? 1'000'000 : 100));
      const auto stepped = static_cast<std::uint8_t>(1 + random() % 7);
      const auto directions = static_cast<std::uint8_t>(random() % 8);
      trace->on_steps(Ticks{ticks}, stepped, directions);
      for (unsigned m = 0; m < 3; ++m) {
        if ((stepped >> m & 1) == 0) continue;
        steps[m].push_back({in_units(ticks, clock.hertz, clock.unit), (directions >> m & 1) != 0});
      }
      if (random() % 16 != 0) continue;
      ticks += static_cast<std::int64_t>(random() % 3);
      trace->on_outputs(Ticks{ticks}, {.switches = static_cast<std::uint8_t>(random() % 16)});
    }
    const Vcd vcd = trace.finished(ticks);
    EXPECT_EQ(vcd.timescale, timescale_at(static_cast<double>(clock.hertz)));
    const auto pulse = static_cast<std::uint64_t>(2'500'000 / clock.unit);
    EXPECT_EQ(steps_of(vcd, "X", pulse), steps[0]) << clock.hertz;
    EXPECT_EQ(steps_of(vcd, "Y", pulse), steps[1]) << clock.hertz;
    EXPECT_EQ(steps_of(vcd, "Z", pulse), steps[2]) << clock.hertz;
  }
}

}  // namespace
}  // namespace passo
