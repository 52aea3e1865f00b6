#include "passo/cam/pocket.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "arc_fit.hpp"
#include "closed_toolpath.hpp"
#include "edge_grid.hpp"
#include "engagement.hpp"
#include "finish_pass.hpp"
#include "helix_entry.hpp"
#include "nested_loops.hpp"
#include "peel.hpp"
#include "peel_runs.hpp"
#include "tight_ways.hpp"
#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/route.hpp"

namespace passo {
namespace {

constexpr Nanometres pocket_chords{500};
constexpr Nanometres wall_room{2'000};  // the cutter stays so much farther from the walls than half its width
constexpr Nanometres least_left{10'000};
constexpr std::int64_t most_offsets = 5'000;

class PocketPlanner {
 public:
  PocketPlanner(const Region& area, const PocketOptions& options, Diagnostics& diagnostics,
                const WorkProgress& progress)
      : area_(area),
        options_(options),
        diagnostics_(diagnostics),
        progress_(progress),
        narrowest_(options.most_engagement > 0 ? least_peeled(options.cutter) : Nanometres{}),
        roughed_(area),
        walls_(bounds(area).value_or(DrawnBox{}), {1'000'000}) {
    for (const DrawnRing& ring : grown(area, {-radius().count}, pocket_chords).rings) walls_.add(ring, 0);
    walls_.finish();
  }

  PocketPlan plan() {
    if (area_.empty()) {
      tell("pocket.no-area", Severity::error, "these files have no closed contour",
           "closed contours around the areas to clear");
      return {};
    }
    tell_narrow_parts();
    leave_allowance();
    reach_ = reachable(roughed_);
    MillTool tool{options_.cutter, options_.words, {}};
    const bool is_done = options_.most_engagement > 0 ? peel_all(tool.runs) : go_around_all(tool.runs);
    if (!is_done) return {};
    add_tight_ways(tool.runs);
    if (options_.finishes) finish_walls(tool.runs);
    measure();
    progress_.update(1);
    if (!tool.runs.empty()) plan_.mill.tools.push_back(std::move(tool));
    return std::move(plan_);
  }

 private:
  Nanometres radius() const { return {(options_.cutter.count + 1) / 2}; }
  Nanometres step_over() const {
    return {
        std::max<std::int64_t>(10'000, std::llround(static_cast<double>(options_.cutter.count) * options_.step_over))};
  }
  // Where the cutter's middle may be: with constant engagement nowhere that it would be in a slot.
  Region reachable(const Region& area) const {
    const Region inner = grown(area, {-radius().count - wall_room.count - narrowest_.count}, pocket_chords);
    return narrowest_.count > 0 ? grown(inner, narrowest_, pocket_chords) : inner;
  }
  bool go_around_all(std::vector<MillRun>& runs);
  bool peel_all(std::vector<MillRun>& runs);
  std::optional<PeelWay> peel_within(const Region& ground, const WorkProgress& progress);
  std::vector<std::uint32_t> order_of(const std::vector<Region>& pockets) const;
  Nanometres rough_depth() const { return options_.depth + options_.floor_allowance; }
  std::int64_t levels() const {
    return std::max<std::int64_t>(1, (-rough_depth().count + options_.step.count - 1) / options_.step.count);
  }
  // Of all layers; a last one finishes the floor.
  std::vector<Nanometres> floors() const {
    std::vector<Nanometres> all;
    for (std::int64_t level = 1; level <= levels(); ++level) all.push_back({rough_depth().count * level / levels()});
    if (options_.finishes && options_.floor_allowance.count > 0) all.push_back(options_.depth);
    return all;
  }
  void tell(std::string code, Severity severity, std::string message, std::string expected);
  void tell_narrow_parts();
  void find_offsets();
  // A ring that the cutter follows, and for an innermost ring, the part of the ground inside it.
  struct PocketRing {
    DrawnRing ring;
    const Region* core = nullptr;
    std::size_t layer = 0;
  };
  // A loop, and whether the cutter goes down along it; otherwise it comes from the end of the previous loop.
  struct PocketLoop {
    ClosedToolpath track;
    bool goes_down;
  };
  void take_rings(std::size_t layer, std::size_t index, std::vector<PocketRing>& rings);
  ClosedToolpath track_of(DrawnRing ring, DrawnPoint near) const;
  bool may_go_on(DrawnPoint from, DrawnPoint to, bool is_free) const;
  double ramp_along(const ClosedToolpath& track) const;
  std::optional<Helix> helix_in(const PocketRing& ring) const;
  std::vector<PocketLoop> loops_of(std::vector<PocketRing> rings);
  void add_runs(const std::vector<PocketLoop>& loops, std::vector<MillRun>& runs);
  void add_tight_ways(std::vector<MillRun>& runs);
  bool may_be_finished(const Region& part, const Region& rough) const;
  void leave_allowance();
  void finish_walls(std::vector<MillRun>& runs);
  void measure();

  const Region& area_;
  const PocketOptions& options_;
  Diagnostics& diagnostics_;
  const WorkProgress& progress_;
  Nanometres narrowest_;  // half of the ground's least width, beyond the cutter's
  Region roughed_;        // the area without allowances
  Region finished_;       // the parts of the area whose walls are finished
  Region reach_;          // where the middle of the cutter may be
  EdgeGrid walls_;        // what it never crosses
  struct Offset {
    std::vector<Region> parts = {};
    std::vector<std::vector<std::size_t>> inner = {};  // of each part: the parts of the next offset in it
  };
  std::vector<Offset> offsets_;
  std::size_t parts_ = 0;  // of all offsets
  std::size_t taken_ = 0;  // of these
  std::vector<DrawnRing> ways_;
  Region cut_;  // by ways that are swept already
  PocketPlan plan_;
};

void PocketPlanner::tell(std::string code, Severity severity, std::string message, std::string expected) {
  diagnostics_.add({.severity = severity,
                    .code = std::move(code),
                    .file = "",
                    .place = {},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = ""});
}

void PocketPlanner::tell_narrow_parts() {
  for (const Region& part : parts_of(area_)) {
    if (!grown(part, {-radius().count - wall_room.count - narrowest_.count}, pocket_chords).empty()) continue;
    if (!grown(part, {tight_cut_tolerance(options_.cutter).count / 2 - radius().count}, pocket_chords).empty() &&
        narrowest_.count == 0)
      continue;
    const DrawnBox box = *bounds(part);
    tell("pocket.narrow", Severity::warning,
         fmt::format("the area at X{:.4g} Y{:.4g} mm is narrower than the cutter{}, and is not cleared",
                     to_mm({(box.least.x.count + box.most.x.count) / 2}).value(),
                     to_mm({(box.least.y.count + box.most.y.count) / 2}).value(),
                     narrowest_.count > 0 ? " needs for this engagement" : ""),
         "a smaller cutter");
  }
}

// The shortest way from pocket to pocket.
std::vector<std::uint32_t> PocketPlanner::order_of(const std::vector<Region>& pockets) const {
  std::vector<DrawnPoint> places;
  for (const Region& pocket : pockets) places.push_back(pocket.rings.front().front());
  constexpr std::uint64_t steps = 1'000'000;
  return shorten_route(places, options_.park, options_.park, steps);
}

bool PocketPlanner::go_around_all(std::vector<MillRun>& runs) {
  find_offsets();
  const std::vector<Region>& pockets = offsets_.front().parts;
  plan_.pockets = pockets.size();
  for (const std::uint32_t index : order_of(pockets)) {
    std::vector<PocketRing> rings;
    take_rings(0, index, rings);
    add_runs(loops_of(std::move(rings)), runs);
  }
  return true;
}

bool PocketPlanner::peel_all(std::vector<MillRun>& runs) {
  const std::vector<Region> grounds = parts_of(reach_);
  plan_.pockets = grounds.size();
  const WorkProgress peeling = progress_.part(0, 0.95);
  const double all_mm2 = area_mm2(reach_);
  double done_mm2 = 0;
  for (const std::uint32_t index : order_of(grounds)) {
    const double before = done_mm2 / all_mm2;
    done_mm2 += area_mm2(grounds[index]);
    const WorkProgress progress = peeling.part(before, done_mm2 / all_mm2);
    const std::optional<PeelWay> way = peel_within(grounds[index], progress.part(0, 0.85));
    if (!way) return false;
    plan_.loops += way->discs;
    cut_ = united(cut_, swept_rims(*way, radius(), ways_));
    for (MillRun& run : peel_runs(*way, {floors(), rough_depth(), options_.ramp_degrees}))
      runs.push_back(std::move(run));
    progress.update(1);
  }
  return true;
}

// The plan looks from disc to disc. What it makes is measured as a whole; where walls and crossings make it more, with
// a smaller angle once more.
std::optional<PeelWay> PocketPlanner::peel_within(const Region& ground, const WorkProgress& progress) {
  double aim = 0.97 * options_.most_engagement;
  Engagement found;
  double from = 0;
  for (int attempt = 0; attempt < 4; ++attempt) {
    // Nobody knows how many attempts it takes, mostly one: each gets most of what is left.
    const double to = from + 0.8 * (1 - from);
    const WorkProgress now = progress.part(from, to);
    from = to;
    PeelWay way =
        peel(ground, {.cutter = options_.cutter, .most_degrees = aim, .climb = options_.climb}, now.part(0, 0.9));
    if (!way.is_whole) {
      tell("pocket.engagement", Severity::error,
           fmt::format("this engagement needs a toolpath of more than {:.4g} m",
                       longest_peel * to_mm(radius()).value() / 1000),
           "a greater --engagement, or a larger cutter");
      return std::nullopt;
    }
    found = find_engagement({way.entry}, way.runs, options_.cutter, now.part(0.9, 1));
    if (found.most_degrees <= options_.most_engagement) {
      plan_.engagement = std::max(plan_.engagement, found.most_degrees);
      return way;
    }
    aim *= std::min(0.97, 0.99 * options_.most_engagement / found.most_degrees);
  }
  tell("pocket.engagement", Severity::error,
       fmt::format("the cutter would be engaged {:.1f} degrees at X{:.4g} Y{:.4g} mm", found.most_degrees,
                   to_mm(found.at.x).value(), to_mm(found.at.y).value()),
       "a greater --engagement, or a smaller cutter");
  return std::nullopt;
}

// The ground layer by layer inwards. Each is an offset of the first: offsets of offsets would round rounded corners
// again, with ever more points.
void PocketPlanner::find_offsets() {
  offsets_.push_back({parts_of(reach_), {}});
  const double ground_mm2 = area_mm2(reach_);
  for (std::int64_t k = 1; k < most_offsets && !offsets_.back().parts.empty(); ++k) {
    const Region ground = grown(reach_, {-k * step_over().count}, pocket_chords);
    progress_.part(0, 0.05).update(1 - area_mm2(ground) / ground_mm2);
    Offset inner{parts_of(ground), {}};
    Offset& outer = offsets_.back();
    outer.inner.resize(outer.parts.size());
    const std::vector<std::size_t> around = parts_with(inner.parts, outer.parts);
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (around[i] < outer.parts.size()) outer.inner[around[i]].push_back(i);
    }
    offsets_.push_back(std::move(inner));
  }
  offsets_.back().inner.resize(offsets_.back().parts.size());
  for (const Offset& offset : offsets_) parts_ += offset.parts.size();
}

// The rings around a part of the ground: first what lies within them. Where corners are sharp, two loops leave ground
// between them. It is less than a cutter wide, so its own edge is a way that clears it.
void PocketPlanner::take_rings(std::size_t layer, std::size_t index, std::vector<PocketRing>& rings) {
  const Region& part = offsets_[layer].parts[index];
  const std::vector<std::size_t>& within = offsets_[layer].inner[index];
  const std::size_t first = rings.size();
  Region between = grown(part, {-radius().count}, pocket_chords);
  for (const std::size_t inner : within) {
    take_rings(layer + 1, inner, rings);
    between = subtracted(between, grown(offsets_[layer + 1].parts[inner], radius(), pocket_chords));
  }
  for (const DrawnRing& ring : notable_part(between, least_left).rings) rings.push_back({ring});
  progress_.part(0.05, 0.25).stage(taken_++, parts_).update(1);
  // Islands before the outer wall, which comes last.
  for (std::size_t i = part.rings.size(); i-- > 0;) rings.push_back({part.rings[i]});
  if (within.empty()) {
    rings[first].core = &part;
    rings[first].layer = layer;
  }
}

// Begins at the ring's place nearest to `near`. Short edges may be chords of an arc, and stay whole.
ClosedToolpath PocketPlanner::track_of(DrawnRing ring, DrawnPoint near) const {
  std::size_t best = 0;
  DrawnPoint begin = ring.front();
  double least = distance_nm(begin, near);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const DrawnPoint next = ring[(i + 1) % ring.size()];
    constexpr double straight = 1e6;  // nm
    const bool is_long = distance_nm(ring[i], next) > straight;
    const EdgeGrid::Near place = EdgeGrid::to_edge(near, {ring[i], is_long ? next : ring[i], 0});
    if (place.distance_nm >= least) continue;
    least = place.distance_nm;
    best = i;
    begin = place.at;
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(best), ring.end());
  if (begin != ring.front()) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    if (ring.front() != begin) ring.insert(ring.begin(), begin);
  }
  // The region lies to the left of its rings, the wall to the right: so it is for climb milling.
  if (!options_.climb) std::reverse(ring.begin() + 1, ring.end());
  ring.push_back(ring.front());
  std::vector<PathPoint> points = with_arcs(ring, {});
  points.pop_back();
  return ClosedToolpath(points);
}

// Whether the cutter may move straight from one loop to another: never near walls, and through uncut material at most
// as far as its width.
bool PocketPlanner::may_go_on(DrawnPoint from, DrawnPoint to, bool is_free) const {
  if (!is_free && distance_nm(from, to) > static_cast<double>(options_.cutter.count)) return false;
  return !walls_.is_crossed(from, to);
}

// The length of the descent by one layer. A loop that is tiny compared with the cutter cannot be a ramp.
double PocketPlanner::ramp_along(const ClosedToolpath& track) const {
  const bool is_tiny = track.length() < static_cast<double>(options_.cutter.count) / 4;
  if (options_.ramp_degrees <= 0 || is_tiny) return 0;
  const auto down = static_cast<double>(-rough_depth().count) / static_cast<double>(levels());
  return down / std::tan(options_.ramp_degrees / 180 * std::numbers::pi);
}

std::optional<Helix> PocketPlanner::helix_in(const PocketRing& ring) const {
  if (ring.core == nullptr || options_.ramp_degrees <= 0) return std::nullopt;
  const auto margin = static_cast<double>(ring.layer) * static_cast<double>(step_over().count);
  return find_helix(*ring.core, margin, options_.cutter);
}

// Where no link leads from the previous loop, the cutter goes down along a helix or along the loop.
std::vector<PocketPlanner::PocketLoop> PocketPlanner::loops_of(std::vector<PocketRing> rings) {
  std::vector<PocketLoop> loops;
  DrawnPoint at = rings.front().ring.front();
  const auto add = [&](ClosedToolpath track, bool goes_down) {
    at = track.at(goes_down ? ramp_along(track) : 0);
    MillRun lap;
    track.append(lap, 0, track.length(), {}, {});
    ways_.push_back(chords_of(lap, pocket_chords));
    loops.push_back({std::move(track), goes_down});
  };
  for (PocketRing& ring : rings) {
    ClosedToolpath track = track_of(std::move(ring.ring), at);
    if (track.length() <= 0) continue;
    bool goes_down = loops.empty() || !may_go_on(at, track.at(0), false);
    const std::optional<Helix> helix = goes_down ? helix_in(ring) : std::nullopt;
    if (helix) {
      add(passo::track_of(*helix, track.at(0), options_.climb), true);
      if (track.is_within(helix->centre, helix->radius)) continue;
      track = track.from(track.nearest(at).first);
      goes_down = !may_go_on(at, track.at(0), false);
    }
    add(std::move(track), goes_down);
  }
  plan_.loops += loops.size();
  return loops;
}

// All loops of a pocket, layer by layer. A run ends where the cutter must lift.
void PocketPlanner::add_runs(const std::vector<PocketLoop>& loops, std::vector<MillRun>& runs) {
  MillRun run;
  Nanometres z{};
  double begin = 0;  // where the first loop begins
  for (const Nanometres next : floors()) {
    for (const PocketLoop& loop : loops) {
      const bool is_first = &loop == &loops.front();
      double along = is_first ? begin : 0;
      const DrawnPoint start = loop.track.at(along);
      if (!loop.goes_down) {
        run.push_back({start, 0, next});
      } else {
        // The previous layer is cleared.
        const bool goes_on = is_first && !run.empty() && may_go_on(run.back().at, start, true);
        if (!goes_on && run.size() > 1) runs.push_back(std::exchange(run, {}));
        goes_on ? link_to(run, start) : enter_above(run, start, z);
        const double ramp = ramp_along(loop.track);
        if (ramp > 0) loop.track.append(run, along, along + ramp, z, next);
        along += ramp;
      }
      // All of it at this depth, once: it ends where the ramp did.
      const std::size_t level = run.empty() ? 0 : run.size() - 1;
      loop.track.append(run, along, along + loop.track.length(), next, next);
      if (next < rough_depth()) mark_finish(run, level);
      if (loops.size() == 1) begin = along + loop.track.length();
    }
    z = next;
  }
  if (run.size() > 1) runs.push_back(std::move(run));
}

// Gaps exactly as wide as the cutter. Adaptive clearing leaves them, because they are slots. An allowance that stays is
// none of the ground: beside it, the stock on a wall would look like such a gap.
void PocketPlanner::add_tight_ways(std::vector<MillRun>& runs) {
  if (options_.most_engagement > 0) return;
  const Region reach = finished_.empty() ? reach_ : united(reach_, reachable(finished_));
  const std::vector<TightWay> ways = find_tight_ways(options_.finishes ? area_ : roughed_, reach, options_.cutter);
  for (const TightWay& way : ways) {
    ways_.push_back(way.points);
    if (way.is_closed) ways_.back().push_back(way.points.front());
  }
  plan_.tight = ways.size();
  const DrawnPoint from = runs.empty() ? options_.park : runs.back().back().at;
  const Nanometres floor = options_.finishes ? options_.depth : rough_depth();
  const TightCut cut{floor, options_.step, options_.ramp_degrees};
  for (MillRun& run : tight_runs(ways, cut, from, options_.park)) runs.push_back(std::move(run));
}

// The cutter that finishes the walls meets little stock: at most a quarter of its width.
bool PocketPlanner::may_be_finished(const Region& part, const Region& rough) const {
  const Region whole = reachable(part);
  if (whole.empty()) return false;
  const Region cut = grown(reachable(rough), radius(), pocket_chords);
  const Region left = subtracted(grown(whole, radius(), pocket_chords), cut);
  return grown(left, {-std::max(radius().count / 4, options_.allowance.count)}, pocket_chords).empty();
}

// Each pocket keeps stock on its walls, unless it is so narrow that the finishing pass would cut a slot.
void PocketPlanner::leave_allowance() {
  if (options_.allowance.count <= 0) return;
  roughed_ = {};
  for (const Region& part : parts_of(area_)) {
    const Region rough = grown(part, {-options_.allowance.count}, pocket_chords);
    const bool keeps = may_be_finished(part, rough);
    if (!keeps) ++plan_.unfinished;
    roughed_ = united(roughed_, keeps ? rough : part);
    if (keeps && options_.finishes) finished_ = united(finished_, part);
  }
}

// Islands before the wall around them.
void PocketPlanner::finish_walls(std::vector<MillRun>& runs) {
  const auto is_clear = [this](DrawnPoint from, DrawnPoint to, double bulge) {
    constexpr int pieces = 8;
    for (int k = 0; k < pieces; ++k) {
      const DrawnPoint a = point_along(from, to, bulge, static_cast<double>(k) / pieces);
      const DrawnPoint b = point_along(from, to, bulge, static_cast<double>(k + 1) / pieces);
      if (walls_.is_crossed(a, b)) return false;
    }
    return true;
  };
  const FinishPass pass{.depth = options_.depth,
                        .floor = options_.depth,
                        .lead_nm = static_cast<double>(options_.lead.count),
                        .climb = options_.climb,
                        .spring_passes = options_.spring_passes,
                        .is_cut = [this](DrawnPoint point) { return contains(reach_, point); },
                        .is_clear = is_clear};
  for (const Region& part : parts_of(reachable(finished_))) {
    for (std::size_t i = part.rings.size(); i-- > 0;) {
      const DrawnPoint near = runs.empty() ? options_.park : runs.back().back().at;
      const ClosedToolpath track = track_of(part.rings[i], near);
      if (track.length() <= 0) continue;
      MillRun run = finish_run(track, pass);
      ways_.push_back(chords_of(run, pocket_chords));
      runs.push_back(std::move(run));
      ++plan_.finished;
    }
  }
}

void PocketPlanner::measure() {
  const Region cut = united(cut_, swept(ways_, radius(), pocket_chords));
  plan_.unreached = notable_part(subtracted(options_.finishes ? area_ : roughed_, cut), least_left);
  plan_.unreached_mm2 = area_mm2(plan_.unreached);
  plan_.lost_mm2 = area_mm2(notable_part(subtracted(cut, area_), {50}));
}

}  // namespace

PocketPlan plan_pocket(const Region& area, const PocketOptions& options, Diagnostics& diagnostics,
                       const WorkProgress& progress) {
  return PocketPlanner(area, options, diagnostics, progress).plan();
}

}  // namespace passo
