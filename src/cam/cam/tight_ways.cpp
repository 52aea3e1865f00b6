#include "tight_ways.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "arc_fit.hpp"
#include "closed_toolpath.hpp"
#include "medial_axis.hpp"
#include "stroke_walk.hpp"

#include "passo/cam/route.hpp"

namespace passo {
namespace {

constexpr Nanometres tight_chords{500};
constexpr double longest_twig = 60'000;  // nm: three times the widest tolerance

DrawnPoint drawn_of(const MedialPoint& point) {
  return {{std::llround(point.x)}, {std::llround(point.y)}};
}

double length_of(const DrawnRing& line) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += distance_nm(line[i], line[i + 1]);
  return length;
}

// The medial axis of a thin region without its twigs, as lines.
class MiddleLines {
 public:
  explicit MiddleLines(const MedialAxis& axis) : at_node_(axis.nodes) {
    for (const MedialPiece& piece : axis.pieces) {
      Line line{piece.from, piece.to, {}};
      for (const MedialPoint& point : piece.points) line.points.push_back(drawn_of(point));
      for (const std::uint32_t node : {piece.from, piece.to}) at_node_[node].push_back(lines_.size());
      lines_.push_back(std::move(line));
    }
    is_left_.assign(lines_.size(), true);
  }

  std::vector<TightWay> find() {
    prune();
    std::vector<CutterStroke> strokes;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (is_left_[i]) strokes.push_back({lines_[i].from, lines_[i].to, run_of(lines_[i].points)});
    }
    std::vector<TightWay> ways;
    for (const MillRun& run : walk_strokes(std::move(strokes), at_node_.size(), {})) {
      TightWay way;
      for (const MillPoint& point : run) way.points.push_back(point.at);
      way.is_closed = way.points.size() > 3 && way.points.front() == way.points.back();
      if (way.is_closed) way.points.pop_back();
      ways.push_back(std::move(way));
    }
    return ways;
  }

 private:
  struct Line {
    std::uint32_t from;
    std::uint32_t to;
    DrawnRing points;
  };

  std::size_t degree(std::uint32_t node) const {
    const auto is_left = [this](std::size_t line) { return is_left_[line]; };
    return static_cast<std::size_t>(std::ranges::count_if(at_node_[node], is_left));
  }
  std::size_t only_line_at(std::uint32_t node) const {
    return *std::ranges::find_if(at_node_[node], [this](std::size_t line) { return is_left_[line]; });
  }

  void prune() {
    std::vector<double> lost(at_node_.size(), 0);
    std::vector<std::uint32_t> ends;
    for (std::uint32_t node = 0; node < at_node_.size(); ++node) {
      if (degree(node) == 1) ends.push_back(node);
    }
    while (!ends.empty()) {
      const std::uint32_t node = ends.back();
      ends.pop_back();
      if (degree(node) != 1) continue;
      const std::size_t index = only_line_at(node);
      const Line& line = lines_[index];
      const double sum = lost[node] + length_of(line.points);
      if (sum > longest_twig) continue;
      is_left_[index] = false;
      const std::uint32_t other = line.from == node ? line.to : line.from;
      lost[other] = std::max(lost[other], sum);
      if (degree(other) == 1) ends.push_back(other);
    }
  }

  static MillRun run_of(const DrawnRing& points) {
    MillRun run;
    for (const DrawnPoint& point : points) run.push_back({point});
    return run;
  }

  std::vector<Line> lines_;
  std::vector<bool> is_left_;
  std::vector<std::vector<std::size_t>> at_node_;
};

std::vector<TightWay> middle_lines_of(const Region& gap) {
  std::vector<TightWay> ways;
  if (const std::optional<MedialAxis> axis = medial_axis(gap, {.tolerance_nm = 1'000}))
    ways = MiddleLines(*axis).find();
  if (!ways.empty()) return ways;
  const DrawnBox box = *bounds(gap);
  return {{{{{(box.least.x.count + box.most.x.count) / 2}, {(box.least.y.count + box.most.y.count) / 2}}}, false}};
}

std::int64_t levels_of(const TightCut& cut) {
  return std::max<std::int64_t>(1, (-cut.depth.count + cut.step.count - 1) / cut.step.count);
}

// Down step by step; up in between, so that chips come out.
MillRun pecked(DrawnPoint at, const TightCut& cut) {
  MillRun run = {{at, 0, {}}};
  const std::int64_t levels = levels_of(cut);
  for (std::int64_t level = 1; level <= levels; ++level) {
    const Nanometres z{cut.depth.count * level / levels};
    run.push_back({at, 0, z, MillPace::rapid});
    if (level == levels) break;
    const std::size_t before = run.size();
    enter_above(run, at, z);
    if (run.size() == before) run.back().pace = MillPace::cut;
  }
  return run;
}

// The line as a closed track that leads there and back.
ClosedToolpath track_of(const TightWay& way) {
  DrawnRing points = way.points;
  if (way.is_closed) points.push_back(points.front());
  std::vector<PathPoint> row = with_arcs(points, {});
  std::vector<PathPoint> closed(row.begin(), row.end() - 1);
  if (!way.is_closed) {
    for (std::size_t i = row.size() - 1; i > 0; --i) closed.push_back({row[i].at, -row[i - 1].bulge});
  }
  return ClosedToolpath(closed);
}

}  // namespace

std::vector<TightWay> find_tight_ways(const Region& free, const Region& reach, Nanometres cutter) {
  const Nanometres radius{(cutter.count + 1) / 2};
  const Region room = grown(free, {tight_cut_tolerance(cutter).count / 2 - radius.count}, tight_chords);
  // Sharp corners of cleared areas leave slivers that are not gaps.
  constexpr Nanometres beside{50'000};
  const Region gaps = reach.empty() ? room : subtracted(room, grown(reach, beside, tight_chords));
  if (gaps.empty()) return {};
  std::vector<TightWay> ways;
  for (const Region& gap : parts_of(gaps)) {
    const Region around = common(reach, grown(gap, {2 * beside.count}, tight_chords));
    const bool is_apart = around.empty();
    for (TightWay& way : middle_lines_of(gap)) {
      const double least = is_apart ? 0 : static_cast<double>(radius.count) / 2;
      if (length_of(way.points) >= least) ways.push_back(std::move(way));
    }
  }
  return ways;
}

std::vector<TightWay> find_tight_ways_beside(const Region& part, const Region& around, Nanometres cutter) {
  const std::optional<DrawnBox> box = bounds(part);
  if (!box) return {};
  const Nanometres far{2 * cutter.count + 1'000'000};
  const Region whole =
      filled({rectangle({{box->least.x - far, box->least.y - far}, {box->most.x + far, box->most.y + far}})});
  return find_tight_ways(subtracted(whole, part), subtracted(whole, around), cutter);
}

MillRun tight_run(const TightWay& way, const TightCut& cut) {
  if (way.points.size() == 1) return pecked(way.points.front(), cut);
  const ClosedToolpath track = track_of(way);
  const double once = way.is_closed ? track.length() : track.length() / 2;
  MillRun run;
  double along = 0;
  Nanometres z{};
  const std::int64_t levels = levels_of(cut);
  for (std::int64_t level = 1; level <= levels; ++level) {
    const Nanometres next{cut.depth.count * level / levels};
    const double begin = along;
    if (cut.ramp_degrees > 0) {
      along += static_cast<double>(z.count - next.count) / std::tan(cut.ramp_degrees / 180 * std::numbers::pi);
      track.append(run, begin, along, z, next);
    }
    // Around once, or on to the next end and from there to the other.
    const bool is_at_end = way.is_closed || std::abs(std::remainder(along, once)) < 1;
    const double end = along + once + (is_at_end ? 0 : once - std::fmod(along, once));
    track.append(run, along, end, next, next);
    along = end;
    z = next;
  }
  return run;
}

std::vector<MillRun> tight_runs(const std::vector<TightWay>& ways, const TightCut& cut, DrawnPoint from,
                                DrawnPoint park) {
  std::vector<DrawnPoint> places;
  for (const TightWay& way : ways) places.push_back(way.points.front());
  std::vector<MillRun> runs;
  constexpr std::uint64_t steps = 1'000'000;
  for (const std::uint32_t index : shorten_route(places, from, park, steps)) {
    if (MillRun run = tight_run(ways[index], cut); run.size() > 1) runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace passo
