// The cost of a chord for each kind of curve, from the curve's formula to displacements in steps.
#include <cmath>
#include <numbers>

#include <benchmark/benchmark.h>

#include "passo/geometry/bezier.hpp"
#include "passo/geometry/curve_in_space.hpp"
#include "passo/geometry/ellipse.hpp"
#include "passo/geometry/nurbs.hpp"
#include "passo/geometry/step_chords.hpp"

namespace passo {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
const StepScale scale{{640, 640, 640}};

template <ParametricCurve C>
void cut(benchmark::State& state, const C& curve) {
  // The argument of the benchmark is in thousandths of a millimetre.
  const ChordTolerance tolerance = *ChordTolerance::of(Mm(1e-3 * static_cast<double>(state.range(0))));
  std::int64_t count = 0;
  for (auto _ : state) {
    Chords chords(curve, tolerance);
    StepChords steps(chords, curve.at(curve.range().low), scale);
    for (StepChord chord; steps.next(chord); ++count) benchmark::DoNotOptimize(chord);
  }
  state.counters["chords"] = benchmark::Counter(static_cast<double>(count), benchmark::Counter::kAvgIterations);
  state.counters["s/chord"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

CurveInSpace turned(double turns, double rise) {
  Point start;
  start[Axis::x] = 20;
  Point end = start;
  end[Axis::z] = rise;
  return *CurveInSpace::of(Curve::arc(start, end, Axis::x, Axis::y, 0, 0, turns * full_turn));
}

void arc(benchmark::State& state) {
  cut(state, turned(1, 0));
}
void helix(benchmark::State& state) {
  cut(state, turned(10, 50));
}
void ellipse(benchmark::State& state) {
  cut(state, *Ellipse::flat({}, Mm(40), Mm(15), {0.5}, {0}, {full_turn}));
}
void parabola_arc(benchmark::State& state) {
  cut(state, *parabola({}, {0, 10, 0}, Mm(-40), Mm(40)));
}
void quadratic_bezier(benchmark::State& state) {
  cut(state, *QuadraticBezier::create({Vector3{0, 0, 0}, {30, 60, 5}, {60, 0, 10}}));
}
void cubic_bezier(benchmark::State& state) {
  cut(state, *CubicBezier::create({Vector3{0, 0, 0}, {60, 60, 0}, {0, 60, 5}, {60, 0, 10}}));
}
void nurbs_of_degree_3(benchmark::State& state) {
  cut(state, *Nurbs::create({.degree = 3,
                             .control = {{0, 0, 0}, {20, 40, 0}, {40, -40, 0}, {60, 40, 0}, {80, 0, 0}},
                             .weights = {1, 2, 1, 2, 1},
                             .knots = {}}));
}
void nurbs_circle(benchmark::State& state) {
  const double w = std::sqrt(0.5);
  const double r = 20;
  cut(state, *Nurbs::create({.degree = 2,
                             .control = {{r, 0, 0},
                                         {r, r, 0},
                                         {0, r, 0},
                                         {-r, r, 0},
                                         {-r, 0, 0},
                                         {-r, -r, 0},
                                         {0, -r, 0},
                                         {r, -r, 0},
                                         {r, 0, 0}},
                             .weights = {1, w, 1, w, 1, w, 1, w, 1},
                             .knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}}));
}

BENCHMARK(arc)->Arg(100)->Arg(1);
BENCHMARK(helix)->Arg(100)->Arg(1);
BENCHMARK(ellipse)->Arg(100)->Arg(1);
BENCHMARK(parabola_arc)->Arg(100)->Arg(1);
BENCHMARK(quadratic_bezier)->Arg(100)->Arg(1);
BENCHMARK(cubic_bezier)->Arg(100)->Arg(1);
BENCHMARK(nurbs_of_degree_3)->Arg(100)->Arg(1);
BENCHMARK(nurbs_circle)->Arg(100)->Arg(1);

}  // namespace
}  // namespace passo
