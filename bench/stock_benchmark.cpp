// How fast a height field is cut: a relief of 65,000 moves on 100 x 100 mm, at 0.1 mm, for each shape of tool.
#include <cmath>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include "passo/stock/stock_cutter.hpp"

namespace {

using namespace passo;

constexpr int rows = 250;
constexpr int moves_a_row = 260;

Point place(int row, int column) {
  const double x = 100.0 * (row % 2 == 0 ? column : moves_a_row - column) / moves_a_row;
  const double y = 100.0 * row / rows;
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = -3 + std::sin(x / 7) * std::cos(y / 11) + 0.3 * std::sin(x / 2.1 + y / 3);
  return point;
}

std::vector<Curve> relief() {
  std::vector<Curve> moves;
  Point here = place(0, 0);
  for (int row = 0; row < rows; ++row) {
    for (int column = 1; column <= moves_a_row; ++column) {
      const Point next = place(row, column);
      moves.push_back(Curve::line(here, next));
      here = next;
    }
  }
  return moves;
}

Cutter cutter_of(Cutter::Kind kind) {
  constexpr Radians lean{std::numbers::pi / 12};
  switch (kind) {
    case Cutter::Kind::flat: break;
    case Cutter::Kind::ball: return Cutter::ball(Mm(3));
    case Cutter::Kind::v: return Cutter::vee(Mm(3), {2 * lean.value}, Mm(0));
    case Cutter::Kind::bull_nose: return Cutter::bull_nose(Mm(3), Mm(0.5));
    case Cutter::Kind::tapered_ball: return Cutter::tapered_ball(Mm(3), Mm(1), lean);
  }
  return Cutter::flat_end(Mm(3));
}

void cut_relief(benchmark::State& state) {
  const std::vector<Curve> moves = relief();
  const auto kind = static_cast<Cutter::Kind>(state.range(0));
  const auto threads = static_cast<unsigned>(state.range(1));
  double volume = 0;
  for (auto _ : state) {
    HeightField field = *HeightField::create({{0, 0, -6}, {100, 100, 0}}, Mm(0.1));
    StockCutter cutter(field, {.tools = {{.cutter = cutter_of(kind)}}, .clamps = {}, .threads = threads},
                       [&](const MoveCut& cut) { volume += cut.volume; });
    for (const Curve& move : moves) cutter.cut(move, {}, {});
    cutter.finish();
  }
  benchmark::DoNotOptimize(volume);
  state.SetLabel(std::string(name_of(kind)) + ", " + std::to_string(threads) + " threads");
  state.counters["moves/s"] =
      benchmark::Counter(static_cast<double>(moves.size()), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(cut_relief)
    ->ArgsProduct({{0, 1, 2, 3, 4}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
