#include "peel_runs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "closed_toolpath.hpp"
#include "finish_pass.hpp"

namespace passo {
namespace {

constexpr Nanometres lap_chords{500};

// The run at this depth, with its links lifted.
void add_level(const MillRun& piece, Nanometres z, MillRun& run) {
  for (const MillPoint& point : piece) {
    if (!run.empty() && run.back().pace == MillPace::link) {
      link_to(run, point.at);
      run.back().bulge = point.bulge;
      run.back().pace = point.pace;
    } else {
      run.push_back({point.at, point.bulge, z, point.pace});
    }
  }
}

}  // namespace

// Rims often coincide, so they are swept a few at a time, with longer chords; the walls are not.
Region swept_rims(const PeelWay& way, Nanometres radius, std::vector<DrawnRing>& laps) {
  constexpr Nanometres rim_chords{20'000};
  constexpr std::size_t at_once = 256;  // chords
  std::vector<Region> parts;
  std::vector<DrawnRing> some;
  std::size_t count = 0;
  const auto sweep_some = [&] {
    if (!some.empty()) parts.push_back(swept(some, radius, rim_chords));
    some.clear();
    count = 0;
  };
  const auto part_of = [](const MillRun& run, std::size_t first, std::size_t last) {
    return MillRun(run.begin() + static_cast<std::ptrdiff_t>(first),
                   run.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  };
  for (std::size_t i = 0; i < way.runs.size(); ++i) {
    const MillRun& run = way.runs[i];
    std::size_t begin = 0;
    const auto add_rims = [&](std::size_t end) {
      if (end <= begin) return;
      const DrawnRing chords = chords_of(part_of(run, begin, end), rim_chords);
      for (std::size_t from = 0; from + 1 < chords.size(); from += at_once) {
        const std::size_t to = std::min(chords.size() - 1, from + at_once);
        some.emplace_back(chords.begin() + static_cast<std::ptrdiff_t>(from),
                          chords.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        count += to - from;
        if (count >= at_once) sweep_some();
      }
    };
    for (const PeelLap& lap : way.laps) {
      if (lap.run != i) continue;
      add_rims(lap.first);
      laps.push_back(chords_of(part_of(run, lap.first, lap.last), lap_chords));
      begin = lap.last;
    }
    add_rims(run.size() - 1);
  }
  sweep_some();
  while (parts.size() > 1) {
    for (std::size_t i = 0; i < parts.size() / 2; ++i) parts[i] = united(parts[2 * i], parts[2 * i + 1]);
    if (parts.size() % 2 == 1) parts[parts.size() / 2] = std::move(parts.back());
    parts.resize((parts.size() + 1) / 2);
  }
  return parts.empty() ? Region{} : std::move(parts.front());
}

// A helix down to each layer, or straight down, and then all runs there.
std::vector<MillRun> peel_runs(const PeelWay& way, const PeelLayers& layers) {
  std::vector<MillRun> runs;
  const ClosedToolpath lap = [&] {
    std::vector<PathPoint> points;
    for (const MillPoint& point : way.entry) points.push_back({point.at, point.bulge});
    points.pop_back();
    return ClosedToolpath(points);
  }();
  Nanometres z{};
  for (const Nanometres next : layers.floors) {
    MillRun run;
    double along = 0;
    enter_above(run, lap.at(0), z);
    if (layers.ramp_degrees > 0) {
      along = static_cast<double>(z.count - next.count) / std::tan(layers.ramp_degrees / 180 * std::numbers::pi);
      lap.append(run, 0, along, z, next);
    }
    // A whole lap at this depth, and on to where the spiral begins.
    const double laps = std::ceil(along / lap.length() + 1 - 1e-9);
    lap.append(run, along, laps * lap.length(), next, next);
    bool is_first = true;
    for (const MillRun& piece : way.runs) {
      if (is_first) {
        run.pop_back();
      } else {
        run.clear();
        // It begins with a link where this layer has already been cut.
        enter_above(run, piece.front().at, piece.front().pace == MillPace::link ? next : z);
      }
      add_level(piece, next, run);
      if (next < layers.rough_depth) mark_finish(run, 0);
      is_first = false;
      runs.push_back(run);
    }
    z = next;
  }
  return runs;
}

}  // namespace passo
