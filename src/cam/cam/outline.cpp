#include "passo/cam/outline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "arc_fit.hpp"
#include "closed_toolpath.hpp"
#include "edge_grid.hpp"
#include "finish_pass.hpp"
#include "flat_vector.hpp"
#include "outline_tabs.hpp"
#include "piece_order.hpp"
#include "tight_ways.hpp"
#include <fmt/format.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/cam/route.hpp"

namespace passo {
namespace {

constexpr Nanometres fine_chords{500};
constexpr Nanometres board_room{2'000};  // the cutter stays so much farther from the board than half its width

struct OutlineCut {
  DrawnRing ring;
  bool is_outside;
  std::size_t around = 0;   // how many cuts lie around it
  bool is_of_slug = false;  // mills a slug away
  bool has_tabs = true;
};

class OutlinePlanner {
 public:
  OutlinePlanner(const Region& board, const OutlineOptions& options, Diagnostics& diagnostics)
      : board_(board),
        options_(options),
        diagnostics_(diagnostics),
        ways_(grown(board, {radius().count + board_room.count}, fine_chords)),
        kept_free_(grid_of(grown(board, radius(), fine_chords))) {}

  OutlinePlan plan() {
    find_tight_gaps();
    refuse_narrow_openings();
    find_cuts();
    if (options_.tabs > 0) find_slugs();
    MillTool tool{options_.cutter, options_.words, slot_runs()};
    std::vector<ClosedToolpath> tracks;
    for (OutlineCut& cut : cuts_) tracks.push_back(track_of(std::move(cut.ring), !cut.is_of_slug));
    order(tool.runs.empty() ? options_.link.from(options_.park) : tool.runs.back().back().at, tracks);
    find_rough_tracks(tracks);
    put_tabs(tracks);
    plan_.slots = options_.slots.size();
    add_tight_runs(tool.runs);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      tool.runs.push_back(run_of(rough_[i].value_or(tracks[i])));
      if (options_.finishes && rough_[i]) tool.runs.push_back(finish_of(tracks[i], *rough_[i]));
    }
    measure_loss();
    if (!tool.runs.empty()) plan_.mill.tools.push_back(std::move(tool));
    return std::move(plan_);
  }

 private:
  Nanometres radius() const { return {(options_.cutter.count + 1) / 2}; }
  static EdgeGrid grid_of(const Region& region);
  void find_tight_gaps();
  void add_tight_runs(std::vector<MillRun>& runs);
  void refuse_narrow_openings();
  void find_cuts();
  void find_slugs();
  bool mill_slug(std::size_t opening, const Region& inside);
  void order(DrawnPoint from, std::vector<ClosedToolpath>& tracks);
  ClosedToolpath track_of(DrawnRing ring, bool may_have_dog_bones) const;
  void add_dog_bones(DrawnRing& ring) const;
  void find_rough_tracks(const std::vector<ClosedToolpath>& tracks);
  std::optional<ClosedToolpath> rough_track(const OutlineCut& cut, const ClosedToolpath& track) const;
  void put_tabs(std::vector<ClosedToolpath>& tracks);
  MillRun run_of(const ClosedToolpath& track);
  MillRun finish_of(const ClosedToolpath& track, const ClosedToolpath& rough);
  MillRun slot_of(const DrawnRing& line) const;
  std::vector<MillRun> slot_runs() const;
  bool is_clear(DrawnPoint from, DrawnPoint to, double bulge) const;
  std::vector<DrawnPoint> lead_of(const ClosedToolpath& track) const;
  void keep_way(const ClosedToolpath& track, const std::vector<DrawnPoint>& lead, double quarter);
  void measure_loss();

  const Region& board_;
  const OutlineOptions& options_;
  Diagnostics& diagnostics_;
  Region ways_;
  EdgeGrid kept_free_;  // the middle of the cutter never crosses these edges
  std::vector<OutlineCut> cuts_;
  std::vector<TightWay> tight_;
  std::vector<std::optional<ClosedToolpath>> rough_;  // of each cut that keeps an allowance
  OutlinePlan plan_;
};

EdgeGrid OutlinePlanner::grid_of(const Region& region) {
  EdgeGrid grid(bounds(region).value_or(DrawnBox{}), {500'000});
  for (const DrawnRing& ring : region.rings) grid.add(ring, 0);
  grid.finish();
  return grid;
}

// A closed gap around a part is not cut, because it would need tabs.
void OutlinePlanner::find_tight_gaps() {
  tight_ = find_tight_ways_beside(board_, ways_, options_.cutter);
  std::erase_if(tight_, [](const TightWay& way) { return way.is_closed; });
  plan_.tight = tight_.size();
}

void OutlinePlanner::add_tight_runs(std::vector<MillRun>& runs) {
  const TightCut cut{options_.depth, options_.step, options_.ramp_degrees};
  const DrawnPoint from = runs.empty() ? options_.link.from(options_.park) : runs.back().back().at;
  for (MillRun& run : tight_runs(tight_, cut, from, options_.park)) runs.push_back(std::move(run));
  for (const TightWay& way : tight_) plan_.ways.push_back(way.points);
}

void OutlinePlanner::refuse_narrow_openings() {
  for (const DrawnRing& ring : board_.rings) {
    if (area_mm2(ring) > 0) continue;
    const Region opening = filled({ring});
    if (!grown(opening, {-radius().count - board_room.count}, fine_chords).empty()) continue;
    const bool is_cut = std::ranges::any_of(
        tight_, [&](const TightWay& way) { return contains(opening, way.points[way.points.size() / 2]); });
    if (is_cut) continue;
    const DrawnBox box = *bounds(Region{{ring}});
    const DrawnPoint middle{{(box.least.x.count + box.most.x.count) / 2}, {(box.least.y.count + box.most.y.count) / 2}};
    diagnostics_.add(
        {.severity = options_.skips_narrow ? Severity::warning : Severity::error,
         .code = "outline.narrow-opening",
         .file = "",
         .place = {},
         .message = fmt::format("the opening at X{:.4g} Y{:.4g} mm is narrower than the cutter",
                                to_mm(middle.x).value(), to_mm(middle.y).value()),
         .expected = fmt::format("a cutter of less than {:.4g} mm", std::min(to_mm(box.most.x - box.least.x).value(),
                                                                             to_mm(box.most.y - box.least.y).value())),
         .text = ""});
  }
}

void OutlinePlanner::find_cuts() {
  std::vector<Region> rings;
  std::vector<DrawnBox> boxes;
  for (const DrawnRing& ring : ways_.rings) {
    rings.push_back({{ring}});
    boxes.push_back(bounds(rings.back()).value_or(DrawnBox{}));
  }
  for (std::size_t i = 0; i < rings.size(); ++i) {
    OutlineCut cut{ways_.rings[i], area_mm2(ways_.rings[i]) > 0};
    if (cut.is_outside && options_.openings_only) continue;
    (cut.is_outside ? plan_.outsides : plan_.openings) += 1;
    const DrawnPoint point = cut.ring.front();
    for (std::size_t other = 0; other < rings.size(); ++other) {
      const DrawnBox& box = boxes[other];
      const bool is_in_box =
          box.least.x <= point.x && point.x <= box.most.x && box.least.y <= point.y && point.y <= box.most.y;
      if (other != i && is_in_box && contains(rings[other], point)) ++cut.around;
    }
    cuts_.push_back(std::move(cut));
  }
  if (cuts_.empty() && tight_.empty() && !options_.openings_only) {
    diagnostics_.add({.code = "outline.no-edge",
                      .file = "",
                      .place = {},
                      .message = "these files have no closed outline",
                      .expected = "the outline of a board: closed lines and arcs",
                      .text = ""});
  }
}

// What a cut leaves in an opening is held by tabs, or milled away.
void OutlinePlanner::find_slugs() {
  std::vector<Region> outsides;
  for (const DrawnRing& ring : ways_.rings) {
    if (area_mm2(ring) > 0) outsides.push_back({{{ring.front()}}});
  }
  const std::size_t openings = cuts_.size();
  for (std::size_t i = 0; i < openings; ++i) {
    if (cuts_[i].is_outside) continue;
    const Region inside = filled({cuts_[i].ring});
    const std::vector<std::size_t> parts = parts_with(outsides, {inside});
    const bool has_parts = std::ranges::any_of(parts, [](std::size_t part) { return part == 0; });
    if (!has_parts) cuts_[i].has_tabs = !mill_slug(i, inside);
  }
}

// Adds loops within an opening, the innermost of which comes first. Whether no slug is left.
bool OutlinePlanner::mill_slug(std::size_t opening, const Region& inside) {
  const Region slug = grown(inside, {-radius().count}, fine_chords);
  if (!grown(slug, {-least_slug.count / 2}).empty()) return false;
  const std::int64_t apart = 9 * options_.cutter.count / 10;  // of two loops
  std::size_t around = cuts_[opening].around;
  Region left = slug;
  Region loop = inside;
  while (!left.empty()) {
    const Region next = grown(loop, {-apart}, fine_chords);
    // Where the next loop does not fit, the middle of what is left is within the reach of a cutter on the last one.
    loop = next.empty() ? grown(loop, {-apart / 2}, fine_chords) : next;
    if (loop.empty()) break;
    left = grown(loop, {-radius().count}, fine_chords);
    ++around;
    for (DrawnRing ring : loop.rings) {
      std::ranges::reverse(ring);  // the board lies around it
      cuts_.push_back(
          {.ring = std::move(ring), .is_outside = false, .around = around, .is_of_slug = true, .has_tabs = false});
    }
  }
  return true;
}

// The innermost first; of those as deep inside, by the shortest way.
void OutlinePlanner::order(DrawnPoint from, std::vector<ClosedToolpath>& tracks) {
  std::vector<std::size_t> all(cuts_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto depth = [this](std::size_t i) { return cuts_[i].around; };
  std::ranges::stable_sort(all, std::ranges::greater{}, depth);
  std::vector<OutlineCut> cuts;
  std::vector<ClosedToolpath> ordered;
  DrawnPoint at = from;
  for (auto first = all.begin(); first != all.end();) {
    const std::size_t around = depth(*first);
    const auto end = std::find_if(first, all.end(), [&](std::size_t i) { return depth(i) != around; });
    std::vector<DrawnPoint> places;
    for (auto cut = first; cut != end; ++cut) places.push_back(tracks[*cut].at(0));
    constexpr std::uint64_t steps = 1'000'000;
    for (const std::uint32_t index : shorten_route(places, at, options_.link.to(options_.park, true), steps)) {
      const std::size_t cut = *(first + static_cast<std::ptrdiff_t>(index));
      cuts.push_back(std::move(cuts_[cut]));
      ordered.push_back(std::move(tracks[cut]));
    }
    at = ordered.back().at(0);
    first = end;
  }
  cuts_ = std::move(cuts);
  tracks = std::move(ordered);
}

// At an inner corner the cutter goes on, until it touches the corner, and back.
void OutlinePlanner::add_dog_bones(DrawnRing& ring) const {
  const EdgeGrid edges = grid_of(board_);
  DrawnRing boned;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const DrawnPoint at = ring[i];
    boned.push_back(at);
    const FlatVector in = from_to(ring[(i + ring.size() - 1) % ring.size()], at);
    const FlatVector out = from_to(at, ring[(i + 1) % ring.size()]);
    const double in_length = std::hypot(in.x, in.y);
    const double out_length = std::hypot(out.x, out.y);
    const double turn = std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
    constexpr double least_turn = 20 * std::numbers::pi / 180;
    if (turn > -least_turn || in_length == 0 || out_length == 0) continue;  // the board lies to the left
    const FlatVector away{in.x / in_length - out.x / out_length, in.y / in_length - out.y / out_length};
    const double to_corner = static_cast<double>(radius().count + board_room.count) / std::cos(turn / 2);
    const double scale = to_corner / std::hypot(away.x, away.y);
    const DrawnPoint corner = shifted(at, {away.x * scale, away.y * scale});
    constexpr double near_enough = 5'000;  // nm
    const auto near = edges.nearest(corner, near_enough);
    if (!near) continue;
    const double share = (to_corner - static_cast<double>(radius().count)) / to_corner;
    boned.push_back(shifted(at, {away.x * scale * share, away.y * scale * share}));
    boned.push_back(at);
  }
  ring = std::move(boned);
}

// Begins in the middle of the longest edge, away from corners.
ClosedToolpath OutlinePlanner::track_of(DrawnRing ring, bool may_have_dog_bones) const {
  if (options_.dog_bones && may_have_dog_bones) add_dog_bones(ring);
  std::size_t longest = 0;
  const auto edge_length = [&](std::size_t i) { return distance_nm(ring[i], ring[(i + 1) % ring.size()]); };
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if (edge_length(i) > edge_length(longest)) longest = i;
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>((longest + 1) % ring.size()), ring.end());
  constexpr double straight = 1e6;  // nm; shorter edges may be chords of an arc
  if (distance_nm(ring.back(), ring.front()) > straight) {
    const FlatVector edge = from_to(ring.back(), ring.front());
    ring.insert(ring.begin(), shifted(ring.back(), {edge.x / 2, edge.y / 2}));
  }
  if (options_.climb) std::reverse(ring.begin() + 1, ring.end());
  ring.push_back(ring.front());
  std::vector<PathPoint> points = with_arcs(ring, {});
  points.pop_back();
  return ClosedToolpath(points);
}

void OutlinePlanner::find_rough_tracks(const std::vector<ClosedToolpath>& tracks) {
  rough_.resize(tracks.size());
  if (options_.allowance.count <= 0) return;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (cuts_[i].is_of_slug) continue;
    rough_[i] = rough_track(cuts_[i], tracks[i]);
    if (!rough_[i]) ++plan_.unfinished;
  }
}

// The track at the allowance from the contour; nothing where the part or its neighbours leave no room, or where the
// finishing pass would meet more than that.
std::optional<ClosedToolpath> OutlinePlanner::rough_track(const OutlineCut& cut, const ClosedToolpath& track) const {
  MillRun lap;
  track.append(lap, 0, track.length(), {}, {});
  const DrawnRing final_way = chords_of(lap, fine_chords);
  const Nanometres away{cut.is_outside ? options_.allowance.count : -options_.allowance.count};
  const Region beside = grown(filled({final_way}), away, fine_chords);
  if (parts_of(beside).size() != 1) return std::nullopt;
  DrawnRing ring = beside.rings.front();
  if (!cut.is_outside) std::ranges::reverse(ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (kept_free_.is_crossed(ring[i], ring[(i + 1) % ring.size()])) return std::nullopt;
  }
  DrawnRing closed = ring;
  closed.push_back(ring.front());
  const Region left = subtracted(swept({final_way}, radius(), fine_chords), swept({closed}, radius(), fine_chords));
  if (!grown(left, {-std::max(radius().count / 4, options_.allowance.count)}, fine_chords).empty()) {
    return std::nullopt;
  }
  return track_of(std::move(ring), false);
}

// The lap begins and ends in the slot of roughing.
MillRun OutlinePlanner::finish_of(const ClosedToolpath& track, const ClosedToolpath& rough) {
  constexpr Nanometres close{5'000};
  MillRun lap;
  rough.append(lap, 0, rough.length(), {}, {});
  const Region slot = swept({chords_of(lap, fine_chords)}, close, fine_chords);
  const FinishPass pass{
      .depth = options_.depth,
      .floor = options_.depth,
      .lead_nm = static_cast<double>(options_.allowance.count),
      .climb = options_.climb,
      .spring_passes = options_.spring_passes,
      .is_cut = [&](DrawnPoint point) { return contains(slot, point); },
      .is_clear = [this](DrawnPoint from, DrawnPoint to, double bulge) { return is_clear(from, to, bulge); }};
  MillRun run = finish_run(track, pass);
  plan_.ways.push_back(chords_of(run, {200}));
  ++plan_.finished;
  return run;
}

void OutlinePlanner::put_tabs(std::vector<ClosedToolpath>& tracks) {
  const TabSize size{options_.tab_width, options_.tab_height, options_.cutter};
  std::vector<SpreadTabs> tabs(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!cuts_[i].has_tabs || options_.tabs == 0) continue;
    tabs[i] = spread_tabs(tracks[i], options_.tabs, size);
    if (std::string words = fewer_tabs_words(tracks[i], options_.tabs, tabs[i]); !words.empty())
      plan_.mill.notes.push_back(std::move(words));
  }
  for (const DrawnPoint& place : options_.tab_places) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < tracks.size(); ++i) {
      if (tracks[i].nearest(place).second < tracks[best].nearest(place).second) best = i;
    }
    if (tracks.empty()) continue;
    if (tabs[best].wide_nm <= 0) tabs[best].wide_nm = static_cast<double>((size.width + size.cutter).count);
    tabs[best].middles.push_back(tracks[best].nearest(place).first);
  }
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (rough_[i]) {
      SpreadTabs beside = tabs[i];
      for (double& middle : beside.middles) middle = rough_[i]->nearest(tracks[i].at(middle)).first;
      put_tabs_on(*rough_[i], beside, size, options_.depth);
    }
    for (const DrawnPoint& place : put_tabs_on(tracks[i], tabs[i], size, options_.depth)) plan_.tabs.push_back(place);
  }
  if (std::string words = thin_tabs_words(size, options_.depth); !plan_.tabs.empty() && !words.empty())
    plan_.mill.notes.push_back(std::move(words));
}

// Whether the cutter takes nothing of the board on the way.
bool OutlinePlanner::is_clear(DrawnPoint from, DrawnPoint to, double bulge) const {
  constexpr int pieces = 8;
  for (int k = 0; k < pieces; ++k) {
    const DrawnPoint a = point_along(from, to, bulge, static_cast<double>(k) / pieces);
    const DrawnPoint b = point_along(from, to, bulge, static_cast<double>(k + 1) / pieces);
    if (kept_free_.is_crossed(a, b)) return false;
  }
  return true;
}

// From where a quarter of a circle leads to the track's start, and to where another one leads away; empty: there is no
// room. The waste lies to the left where the cutter climbs.
std::vector<DrawnPoint> OutlinePlanner::lead_of(const ClosedToolpath& track) const {
  const DrawnPoint start = track.at(0);
  const double direction = track.direction(0);
  const double side = options_.climb ? 1 : -1;
  constexpr int halvings = 4;
  auto size = static_cast<double>(options_.lead.count);
  for (int i = 0; i < halvings && size > 0; ++i, size /= 2) {
    const FlatVector along{std::cos(direction) * size, std::sin(direction) * size};
    const FlatVector aside{-along.y * side, along.x * side};
    const DrawnPoint from = shifted(start, {aside.x - along.x, aside.y - along.y});
    const DrawnPoint to = shifted(start, {aside.x + along.x, aside.y + along.y});
    const double quarter = std::tan(std::numbers::pi / 8) * side;
    const bool is_free = is_clear(from, start, quarter) && is_clear(start, to, quarter) && is_clear(to, from, 0);
    if (is_free) return {from, to};
  }
  return {};
}

MillRun OutlinePlanner::run_of(const ClosedToolpath& track) {
  const auto levels =
      std::max<std::int64_t>(1, (-options_.depth.count + options_.step.count - 1) / options_.step.count);
  const std::vector<DrawnPoint> lead = options_.lead.count > 0 ? lead_of(track) : std::vector<DrawnPoint>{};
  const double quarter = std::tan(std::numbers::pi / 8) * (options_.climb ? 1 : -1);
  if (options_.lead.count > 0 && lead.empty()) {
    const DrawnPoint at = track.at(0);
    plan_.mill.notes.push_back(
        fmt::format("there is no room for a lead-in at X{:.4g} Y{:.4g} mm", to_mm(at.x).value(), to_mm(at.y).value()));
  }
  keep_way(track, lead, quarter);
  MillRun run;
  double along = 0;
  Nanometres z{};
  for (std::int64_t level = 1; level <= levels; ++level) {
    const Nanometres next{options_.depth.count * level / levels};
    if (options_.ramp_degrees > 0) {
      if (level == 1 && !lead.empty()) run.push_back({lead[0], quarter, z});
      const double way =
          static_cast<double>(z.count - next.count) / std::tan(options_.ramp_degrees / 180 * std::numbers::pi);
      track.append(run, along, along + way, z, next);
      along += way;
    } else if (!lead.empty()) {
      run.push_back({lead[0], quarter, next});
    }
    track.append(run, along, along + track.length(), next, next);
    along += track.length();
    const bool leads_out = !lead.empty() && options_.ramp_degrees <= 0;
    if (leads_out) {
      run.back().bulge = quarter;
      run.push_back({lead[1], 0, next});
      if (level < levels) run.push_back({lead[0], 0, next});
    }
    z = next;
  }
  return run;
}

// There and back, one step deeper at each end.
MillRun OutlinePlanner::slot_of(const DrawnRing& line) const {
  const auto levels =
      std::max<std::int64_t>(1, (-options_.depth.count + options_.step.count - 1) / options_.step.count);
  MillRun run;
  for (std::int64_t level = 1; level <= levels; ++level) {
    const Nanometres z{options_.depth.count * level / levels};
    std::vector<DrawnPoint> points = line;
    if (level % 2 == 0) std::ranges::reverse(points);
    for (const PathPoint& point : with_arcs(points, {})) run.push_back({point.at, point.bulge, z});
  }
  return run;
}

std::vector<MillRun> OutlinePlanner::slot_runs() const {
  std::vector<MillRun> runs;
  std::vector<RoutePiece> pieces;
  for (const DrawnRing& slot : options_.slots) {
    runs.push_back(slot_of(slot));
    pieces.push_back({runs.back().front().at, runs.back().back().at});
  }
  std::vector<MillRun> ordered;
  constexpr std::uint64_t steps = 1'000'000;
  for (const PlacedPiece& placed : shorten_piece_order(pieces, options_.link.from(options_.park), options_.park, steps))
    ordered.push_back(std::move(runs[placed.piece]));
  return ordered;
}

// A ramp may go around a small opening very often: one lap is enough to know what is cut.
void OutlinePlanner::keep_way(const ClosedToolpath& track, const std::vector<DrawnPoint>& lead, double quarter) {
  if (track.length() <= 0) return;
  MillRun lap;
  if (!lead.empty()) lap.push_back({lead[0], quarter, {}});
  track.append(lap, 0, track.length(), {}, {});
  if (!lead.empty()) {
    lap.back().bulge = quarter;
    lap.push_back({lead[1], 0, {}});
    lap.push_back({lead[0], 0, {}});
  }
  plan_.ways.push_back(chords_of(lap, {200}));
}

void OutlinePlanner::measure_loss() {
  plan_.lost_mm2 = area_mm2(common(board_, swept(plan_.ways, radius(), fine_chords)));
}

}  // namespace

OutlinePlan plan_outline(const Region& board, const OutlineOptions& options, Diagnostics& diagnostics) {
  return OutlinePlanner(board, options, diagnostics).plan();
}

}  // namespace passo
