#include "passo/laser/laser_raster.hpp"

#include <cmath>

namespace passo {
namespace {

// Neighbouring cells of a line with the same S word; from `first` to before `end`.
struct CellRun {
  std::size_t first = 0;
  std::size_t end = 0;
  std::uint32_t s = 0;
};

class RasterWriter {
 public:
  RasterWriter(LaserProgram& program, const BeamCells& cells, const RasterMoves& moves)
      : program_(program), cells_(cells), moves_(moves) {}

  void write() {
    const std::size_t lines = moves_.is_along_y ? cells_.columns : cells_.rows;
    bool is_back = false;
    for (std::size_t line = 0; line < lines; ++line) {
      const std::vector<CellRun> runs = runs_of(line);
      if (runs.empty()) continue;
      write_line(runs, line, is_back);
      if (!moves_.is_one_way) is_back = !is_back;
    }
  }

 private:
  std::vector<CellRun> runs_of(std::size_t line) const;
  void write_line(const std::vector<CellRun>& runs, std::size_t line, bool is_back);
  bool is_jumped(const CellRun& gap) const;

  // The place on a line, `along` nm from the edge of the cells.
  DrawnPoint place(std::size_t line, std::int64_t along) const {
    const std::int64_t across = static_cast<std::int64_t>(line) * moves_.line.count + moves_.line.count / 2;
    return moves_.is_along_y ? DrawnPoint{{moves_.origin.x.count + across}, {moves_.origin.y.count + along}}
                             : DrawnPoint{{moves_.origin.x.count + along}, {moves_.origin.y.count + across}};
  }
  std::int64_t edge(std::size_t cell) const { return static_cast<std::int64_t>(cell) * moves_.line.count; }

  LaserProgram& program_;
  const BeamCells& cells_;
  const RasterMoves& moves_;
};

// From the first burned cell to the last, with the gaps between them.
std::vector<CellRun> RasterWriter::runs_of(std::size_t line) const {
  const std::size_t count = moves_.is_along_y ? cells_.rows : cells_.columns;
  std::vector<CellRun> runs;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t s = cells_.s[moves_.is_along_y ? i * cells_.columns + line : line * cells_.columns + i];
    if (runs.empty() && s == 0) continue;
    if (runs.empty() || runs.back().s != s) runs.push_back({i, i, s});
    runs.back().end = i + 1;
  }
  if (!runs.empty() && runs.back().s == 0) runs.pop_back();
  return runs;
}

// A rapid needs the overscan on both sides of the gap, and only saves time where some way is left.
bool RasterWriter::is_jumped(const CellRun& gap) const {
  constexpr std::int64_t least = 5'000'000;
  return gap.s == 0 && edge(gap.end) - edge(gap.first) >= 2 * moves_.overscan.count + least;
}

void RasterWriter::write_line(const std::vector<CellRun>& runs, std::size_t line, bool is_back) {
  const std::int64_t ahead = is_back ? -moves_.overscan.count : moves_.overscan.count;
  const auto start_of = [&](const CellRun& run) { return edge(is_back ? run.end : run.first); };
  const auto end_of = [&](const CellRun& run) { return edge(is_back ? run.first : run.end); };
  bool begins = true;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const CellRun& run = runs[is_back ? runs.size() - 1 - i : i];
    if (is_jumped(run)) {
      program_.run(place(line, start_of(run) + ahead), moves_.feed);
      begins = true;
      continue;
    }
    if (begins) {
      program_.travel(place(line, start_of(run) - ahead));
      program_.run(place(line, start_of(run)), moves_.feed);
      begins = false;
    }
    program_.burn(place(line, end_of(run)), 0, {run.s, moves_.feed});
  }
  program_.run(place(line, end_of(runs[is_back ? 0 : runs.size() - 1]) + ahead), moves_.feed);
}

}  // namespace

Nanometres overscan_for(Nanometres feed, MmPerSecond2 acceleration) {
  const double speed = to_mm(feed).value() / 60;
  // Rounded up to a whole hundredth, so that the words of the program stay short.
  constexpr double per_mm = 100;
  const double way = std::ceil(speed * speed / (2 * acceleration.value()) * per_mm) / per_mm;
  return to_nanometres(Mm(way));
}

void burn_raster(LaserProgram& program, const BeamCells& cells, const RasterMoves& moves) {
  program.write_tersely(true);
  RasterWriter(program, cells, moves).write();
  program.write_tersely(false);
}

}  // namespace passo
