#include "passo/cam/profile.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "arc_fit.hpp"
#include "closed_toolpath.hpp"
#include "nested_loops.hpp"
#include "outline_tabs.hpp"
#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/cam/route.hpp"

namespace passo {
namespace {

constexpr Nanometres profile_chords{500};

class ProfilePlanner {
 public:
  using Paths = std::vector<std::vector<PathPoint>>;

  ProfilePlanner(const Paths& loops, const Paths& lines, const ProfileOptions& options, Diagnostics& diagnostics)
      : loops_(loops),
        lines_(lines),
        options_(options),
        diagnostics_(diagnostics),
        nested_(nest(loops, profile_chords)) {}

  ProfilePlan plan() {
    if (options_.side == ProfileSide::on) {
      follow_lines();
    } else {
      follow_sides();
      find_unreached();
    }
    return std::move(plan_);
  }

 private:
  void follow_sides();
  void cut_beside(const Region& stays, bool openings_only);
  void follow_lines();
  void add_run(MillRun run);
  void cut_on(const std::vector<PathPoint>& points, bool is_closed);
  void find_unreached();

  const Paths& loops_;
  const Paths& lines_;
  const ProfileOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<NestedLoop> nested_;
  struct Side {
    Region stays;
    Region ground;  // where the cutter is; empty: anywhere beside what stays
  };
  std::vector<Side> sides_;  // of each cut_beside()
  ProfilePlan plan_;
};

// All but the region, as far as a cutter inside it can see.
Region beyond(const Region& region, Nanometres far) {
  DrawnBox box = bounds(region).value_or(DrawnBox{});
  box = {{box.least.x - far, box.least.y - far}, {box.most.x + far, box.most.y + far}};
  return subtracted(filled({rectangle(box)}), region);
}

void ProfilePlanner::follow_sides() {
  plan_.face = filled_in_turn(nested_);
  const Nanometres far{4 * options_.cut.cutter.count + 1'000'000};
  if (options_.side == ProfileSide::part) {
    cut_beside(plan_.face, false);
    return;
  }
  for (std::size_t around = deepest_of(nested_) + 1; around-- > 0;) {
    const Region here = filled_at(nested_, around);
    const bool is_inside = options_.side == ProfileSide::inside;
    cut_beside(is_inside ? beyond(here, far) : here, is_inside);
    if (is_inside) sides_.back().ground = here;
  }
}

void ProfilePlanner::cut_beside(const Region& stays, bool openings_only) {
  OutlineOptions options = options_.cut;
  options.openings_only = openings_only;
  options.skips_narrow = true;
  OutlinePlan one = plan_outline(stays, options, diagnostics_);
  OutlinePlan& all = plan_.outline;
  all.outsides += one.outsides;
  all.openings += one.openings;
  all.tight += one.tight;
  all.finished += one.finished;
  all.unfinished += one.unfinished;
  all.lost_mm2 += one.lost_mm2;
  std::ranges::move(one.tabs, std::back_inserter(all.tabs));
  std::ranges::move(one.ways, std::back_inserter(all.ways));
  std::ranges::move(one.mill.notes, std::back_inserter(all.mill.notes));
  if (!one.mill.tools.empty()) {
    if (all.mill.tools.empty()) {
      all.mill.tools = std::move(one.mill.tools);
    } else {
      std::ranges::move(one.mill.tools.front().runs, std::back_inserter(all.mill.tools.front().runs));
    }
  }
  sides_.push_back({stays, {}});
}

// What lies within the cutter's width beside the lines, and was not cut.
void ProfilePlanner::find_unreached() {
  if (plan_.outline.mill.tools.empty()) return;
  const Region cut = swept(plan_.outline.ways, {(options_.cut.cutter.count + 1) / 2}, profile_chords);
  std::vector<Region> left;
  for (const Side& side : sides_) {
    // An allowance that stays is meant to.
    const bool keeps_stock = options_.cut.allowance.count > 0 && !options_.cut.finishes;
    const Region stays = keeps_stock ? grown(side.stays, options_.cut.allowance, profile_chords) : side.stays;
    Region beside = subtracted(grown(side.stays, options_.cut.cutter, profile_chords), stays);
    if (!side.ground.empty()) beside = common(beside, side.ground);
    left.push_back(subtracted(beside, cut));
  }
  constexpr Nanometres least{10'000};
  plan_.unreached = notable_part(united(left), least);
  plan_.unreached_mm2 = area_mm2(plan_.unreached);
}

// The innermost first; the open ones before all; each kind by a short way.
void ProfilePlanner::follow_lines() {
  struct Line {
    const std::vector<PathPoint>* points;
    bool is_closed;
    std::size_t rank;
  };
  std::vector<Line> all;
  for (const std::vector<PathPoint>& line : lines_) all.push_back({&line, false, 0});
  const std::size_t deepest = deepest_of(nested_);
  // nest() drops loops without an inside; those are cut, too.
  const bool knows_nesting = nested_.size() == loops_.size();
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    all.push_back({&loops_[i], true, 1 + (knows_nesting ? deepest - nested_[i].around : 0)});
  }
  std::ranges::stable_sort(all, {}, &Line::rank);
  DrawnPoint at = options_.cut.park;
  for (auto first = all.begin(); first != all.end();) {
    const auto end = std::find_if(first, all.end(), [&](const Line& line) { return line.rank != first->rank; });
    std::vector<DrawnPoint> places;
    for (auto line = first; line != end; ++line) places.push_back(line->points->front().at);
    constexpr std::uint64_t steps = 1'000'000;
    for (const std::uint32_t index : shorten_route(places, at, options_.cut.park, steps)) {
      const Line& line = *(first + static_cast<std::ptrdiff_t>(index));
      cut_on(*line.points, line.is_closed);
      at = places[index];
    }
    first = end;
  }
  plan_.dots = static_cast<std::size_t>(std::ranges::count(lines_, std::size_t{1}, &std::vector<PathPoint>::size));
  plan_.lines = lines_.size() - plan_.dots;
  if (plan_.outline.mill.tools.empty()) {
    diagnostics_.add({.code = "profile.no-line",
                      .file = "",
                      .place = {},
                      .message = "these files have no lines",
                      .expected = "lines, arcs, curves or circles",
                      .text = ""});
  }
}

// Chords that lie on arcs become arcs again. A short closed way stays as it is drawn.
std::vector<PathPoint> with_arcs_found(const std::vector<PathPoint>& points) {
  const bool has_arcs = std::ranges::any_of(points, [](const PathPoint& point) { return point.bulge != 0; });
  if (has_arcs) return points;
  std::vector<DrawnPoint> places;
  for (const PathPoint& point : points) places.push_back(point.at);
  return with_arcs(places, {});
}

void ProfilePlanner::add_run(MillRun run) {
  std::vector<MillTool>& tools = plan_.outline.mill.tools;
  if (tools.empty()) tools.push_back({options_.cut.cutter, options_.cut.words, {}});
  tools.front().runs.push_back(std::move(run));
}

void ProfilePlanner::cut_on(const std::vector<PathPoint>& points, bool is_closed) {
  if (points.size() == 1) {
    const MillPoint bottom{points.front().at, 0, options_.cut.depth};
    return add_run({bottom, bottom});
  }
  std::vector<PathPoint> row = points;
  if (is_closed) row.push_back({points.front().at, 0});
  row = with_arcs_found(row);
  std::vector<PathPoint> closed = row;
  if (is_closed) {
    closed.pop_back();
  } else {
    // There and back. The last point's way leads to the one before.
    closed.back().bulge = row.size() > 1 ? -row[row.size() - 2].bulge : 0;
    for (std::size_t i = row.size() - 1; i-- > 1;) closed.push_back({row[i].at, -row[i - 1].bulge});
  }
  ClosedToolpath track(closed);
  const OutlineOptions& cut = options_.cut;
  if (track.length() <= 0) return;
  const TabSize size{cut.tab_width, cut.tab_height, cut.cutter};
  if (is_closed) {
    const SpreadTabs tabs = spread_tabs(track, cut.tabs, size);
    OutlinePlan& outline = plan_.outline;
    std::ranges::move(put_tabs_on(track, tabs, size, cut.depth), std::back_inserter(outline.tabs));
    if (std::string words = fewer_tabs_words(track, cut.tabs, tabs); !words.empty())
      outline.mill.notes.push_back(std::move(words));
  }
  const double there = is_closed ? track.length() : track.length() / 2;
  const auto levels = std::max<std::int64_t>(1, (-cut.depth.count + cut.step.count - 1) / cut.step.count);
  MillRun run;
  double along = 0;
  Nanometres z{};
  for (std::int64_t level = 1; level <= levels; ++level) {
    const Nanometres next{cut.depth.count * level / levels};
    double way = there;
    if (cut.ramp_degrees > 0) {
      const double ramp =
          static_cast<double>(z.count - next.count) / std::tan(cut.ramp_degrees / 180 * std::numbers::pi);
      track.append(run, along, along + ramp, z, next);
      along += ramp;
      way = track.length();
    }
    track.append(run, along, along + way, next, next);
    along += way;
    z = next;
  }
  if (run.size() < 2) return;
  add_run(std::move(run));
  if (is_closed) ++plan_.outline.outsides;
}

}  // namespace

ProfilePlan plan_profile(const std::vector<std::vector<PathPoint>>& loops,
                         const std::vector<std::vector<PathPoint>>& lines, const ProfileOptions& options,
                         Diagnostics& diagnostics) {
  return ProfilePlanner(loops, lines, options, diagnostics).plan();
}

}  // namespace passo
