#include "backlash_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace passo {
namespace {

// The longest window, in backlashes. At this length the motor is hardly faster than the axis, so a longer one gains
// nothing.
constexpr double longest_window = 200;
// The shortest window, in backlashes. In a shorter one the motor would move four times as far as the tool, and a stop
// takes no longer.
constexpr double shortest_window = 0.5;
// The greatest depth of the window's ends below the extreme of the axis, in permitted deviations, and the factor
// between the depths that are tried.
constexpr double greatest_depth = 30;
constexpr double next_depth = 1.2;
// In mm or degrees of s. The planner needs longer pieces.
constexpr double shortest_piece = 1e-5;
// In radians. A cubic with the ends and the slopes of such an arc differs from it by 2e-9 of the radius, and by 1e-4 of
// the curvature.
constexpr double turn_of_a_piece = 0.03;
// The most segments on each side of a reversal.
constexpr std::size_t most_segments = 256;
// As in trajectory/: the path stops where its direction changes by more.
constexpr double tangent_tolerance = 1e-6;

bool continues_in(const Segment& before, const Segment& after) {
  if (before.mode == PathMode::exact_stop || !(before.curve.end() == after.curve.start())) return false;
  const Point change = after.curve.tangent(Mm(0)) - before.curve.tangent(before.curve.length());
  return std::ranges::all_of(change.values, [](double part) { return std::abs(part) <= tangent_tolerance; });
}

bool is_arc(const Segment& segment) {
  return segment.curve.shape() == Curve::Shape::arc;
}

// Returns the s where the axis comes within `room` of its extreme. It is farther away at s = `out`, and nearer at s =
// `in`.
double border(const Curve& curve, Axis axis, double extreme, double room, double out, double in) {
  constexpr int halvings = 50;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (out + in) / 2;
    const bool near = std::abs(curve.at(Mm(middle))[axis] - extreme) <= room;
    (near ? in : out) = middle;
  }
  return in;
}

}  // namespace

std::size_t BacklashOverlap::Run::segment_at(double s) const {
  const auto after = std::upper_bound(starts.begin(), starts.end() - 1, s);
  return after == starts.begin() ? 0 : static_cast<std::size_t>(after - starts.begin()) - 1;
}

double BacklashOverlap::Run::at(double s, Axis axis) const {
  const std::size_t i = segment_at(s);
  return segments[i].curve.at(Mm(std::clamp(s - starts[i], 0.0, segments[i].curve.length().value())))[axis];
}

double BacklashOverlap::Window::look(int number, int count) const {
  const double half = count / 2.0;
  return number < half ? begin + (turn - begin) * number / half : turn + (end - turn) * (number - half) / half;
}

bool BacklashOverlap::next(PathItem& item) {
  while (ready_.empty()) {
    PathItem one;
    if (!read(one)) {
      if (behind_.empty()) return false;
      release_all();
      continue;
    }
    const auto* segment = std::get_if<Segment>(&one);
    if (segment == nullptr) {
      release_all();
      ready_.push_back(one);
    } else if (segment->takes_up_backlash) {
      take_up(*segment);
    } else {
      keep(*segment);
    }
  }
  item = ready_.front();
  ready_.pop_front();
  return true;
}

bool BacklashOverlap::read(PathItem& item) {
  if (ahead_.empty()) return path_.next(item);
  item = ahead_.front();
  ahead_.pop_front();
  return true;
}

void BacklashOverlap::release_all() {
  for (const Segment& segment : behind_) ready_.emplace_back(segment);
  behind_.clear();
}

// Keeps a segment, in case an axis reverses soon after it, and releases those that are too far behind.
void BacklashOverlap::keep(const Segment& segment) {
  if (!behind_.empty() && !continues_in(behind_.back(), segment)) release_all();
  behind_.push_back(segment);
  if (segment.mode == PathMode::exact_stop) return release_all();
  double reach = 0;
  for (const Axis axis : all_axes) {
    if (options_.in_motion.has(axis)) reach = std::max(reach, longest_window * options_.backlash[axis]);
  }
  double length = 0;
  std::size_t kept = 0;
  for (auto one = behind_.rbegin(); one != behind_.rend() && kept < most_segments; ++one, ++kept) {
    if (kept > 0 && !(length < reach)) break;
    length += one->curve.length().value();
  }
  for (; behind_.size() > kept; behind_.pop_front()) ready_.emplace_back(behind_.front());
}

void BacklashOverlap::take_up(const Segment& at_stop) {
  if (overlap(at_stop)) return;
  if (!behind_.empty()) behind_.back().mode = PathMode::exact_stop;
  release_all();
  ready_.emplace_back(at_stop);
}

bool BacklashOverlap::overlap(const Segment& at_stop) {
  Reversal reversal;
  if (!find_reversal(at_stop, reversal)) return false;
  Run run = run_around(reversal);
  std::optional<Window> window;
  std::optional<BacklashRamp> ramp;
  for (double depth = reversal.room; depth <= reversal.room * greatest_depth; depth *= next_depth) {
    const Window deeper = window_of(run, reversal, depth);
    if (!(deeper.begin < run.turn && deeper.end > run.turn)) break;
    const double width = deeper.end - deeper.begin;
    if (!(width > std::max(shortest_window * std::abs(reversal.lead), 20 * shortest_piece))) continue;
    if (window && !(width > window->end - window->begin)) break;
    const BacklashRamp its_ramp = best_ramp(run, deeper, reversal);
    const AxisWay way = way_on(run, deeper, its_ramp, reversal);
    if (std::abs(way.at_end) > options_.least[reversal.axis]) break;
    const bool is_certain = depth == reversal.room;
    if (!is_certain && way.deviation > reversal.room) break;
    window = deeper;
    ramp = its_ramp;
  }
  if (!window) return false;
  rewrite(run, *window, *ramp, reversal);
  return true;
}

bool BacklashOverlap::find_reversal(const Segment& at_stop, Reversal& reversal) {
  const Point lead = at_stop.curve.start() - at_stop.curve.end();
  int turned = 0;
  for (const Axis axis : all_axes) {
    if (lead[axis] == 0) continue;
    ++turned;
    reversal.axis = axis;
  }
  const Axis axis = reversal.axis;
  if (turned != 1 || !options_.in_motion.has(axis) || behind_.empty()) return false;
  reversal.downs = at_stop.downs;
  reversal.lead = at_stop.downs.has(axis) ? options_.backlash[axis] : -options_.backlash[axis];
  reversal.extreme = at_stop.curve.end()[axis];
  reversal.reach = longest_window * options_.backlash[axis];
  reversal.room = room_on(behind_.back(), axis, false) - options_.least[axis];
  read_ahead(reversal);
  const auto* after = ahead_.empty() ? nullptr : std::get_if<Segment>(&ahead_.front());
  if (after == nullptr || after->takes_up_backlash || !continues_in(behind_.back(), *after)) return false;
  reversal.on_arcs = is_arc(behind_.back()) && is_arc(*after);
  reversal.room = std::min(room_on(behind_.back(), axis, reversal.on_arcs), room_on(*after, axis, reversal.on_arcs)) -
                  options_.least[axis];
  return reversal.room > 0 && is_usable(behind_.back(), reversal) && is_usable(*after, reversal);
}

// Reads the segments after the reversal, up to where the window must end, or to the first item that is not part of a
// smooth path.
void BacklashOverlap::read_ahead(const Reversal& reversal) {
  double length = 0;
  for (std::size_t i = 0; i < most_segments && length < reversal.reach; ++i) {
    if (i == ahead_.size()) {
      PathItem item;
      if (!path_.next(item)) return;
      ahead_.push_back(item);
    }
    const auto* segment = std::get_if<Segment>(&ahead_[i]);
    if (segment == nullptr || segment->takes_up_backlash || segment->mode == PathMode::exact_stop) return;
    length += segment->curve.length().value();
  }
}

// The permitted deviation of the axis from the smoothed path.
double BacklashOverlap::room_on(const Segment& segment, Axis axis, bool on_arcs) const {
  const double share = options_.smoothing_share;
  const bool own = is_rotary(axis) && segment.turn_tolerance > 0;
  const double whole = (own ? segment.turn_tolerance : segment.tolerance.value()) / share;
  return on_arcs ? whole : whole * (1 - share);
}

bool BacklashOverlap::is_usable(const Segment& segment, const Reversal& reversal) const {
  if (segment.takes_up_backlash || segment.lead || segment.lock != SpindleLock::none) return false;
  if (!segment.curve.has_length() || (reversal.on_arcs && !is_arc(segment))) return false;
  return room_on(segment, reversal.axis, reversal.on_arcs) - options_.least[reversal.axis] >= reversal.room;
}

// The segments before and after the reversal that may be part of the window.
BacklashOverlap::Run BacklashOverlap::run_around(const Reversal& reversal) const {
  const auto near = [&](const Point& place) {
    return std::abs(place[reversal.axis] - reversal.extreme) <= reversal.room * greatest_depth;
  };
  Run run;
  double before = 0;
  std::size_t first = behind_.size();
  while (first > 0 && before < reversal.reach && is_usable(behind_[first - 1], reversal)) {
    before += behind_[--first].curve.length().value();
    if (!near(behind_[first].curve.start())) break;
  }
  run.segments.assign(behind_.begin() + static_cast<std::ptrdiff_t>(first), behind_.end());
  double after = 0;
  bool turns_again = false;
  for (std::size_t i = 0; i < ahead_.size() && after < reversal.reach; ++i) {
    const auto* segment = std::get_if<Segment>(&ahead_[i]);
    turns_again = segment != nullptr && segment->takes_up_backlash;
    if (segment == nullptr || !is_usable(*segment, reversal) || !continues_in(run.segments.back(), *segment)) break;
    run.segments.push_back(*segment);
    after += segment->curve.length().value();
    if (!near(segment->curve.end())) break;
  }
  run.starts.push_back(0);
  for (const Segment& segment : run.segments) run.starts.push_back(run.starts.back() + segment.curve.length().value());
  run.turn = run.starts[behind_.size() - first];
  run.last_end = turns_again ? run.turn + after / 2 : run.length();  // the rest is for the next reversal
  return run;
}

// The longest run that the tolerance allows. Both sides share the reach.
BacklashOverlap::Window BacklashOverlap::window_of(const Run& run, const Reversal& reversal, double depth) {
  const auto is_near = [&](const Point& place) { return std::abs(place[reversal.axis] - reversal.extreme) <= depth; };
  const auto border_on = [&](std::size_t i, double out, double in) {
    return run.starts[i] + border(run.segments[i].curve, reversal.axis, reversal.extreme, depth, out, in);
  };
  Window window{.begin = 0, .end = run.length(), .turn = run.turn};
  const std::size_t turn = run.segment_at(run.turn);
  const auto begin_at_depth = [&] {
    for (std::size_t i = turn; i-- > 0;) {
      const Curve& curve = run.segments[i].curve;
      if (!is_near(curve.start())) return border_on(i, 0, curve.length().value());
    }
    return 0.0;
  };
  window.begin = begin_at_depth();
  for (std::size_t i = turn; i < run.segments.size(); ++i) {
    const Curve& curve = run.segments[i].curve;
    if (is_near(curve.end())) continue;
    window.end = border_on(i, curve.length().value(), 0);
    break;
  }
  window.end = std::min(window.end, run.last_end);
  const double before = run.turn - window.begin;
  const double after = window.end - run.turn;
  if (before + after > reversal.reach) {
    const double kept = std::min(before, std::max(reversal.reach / 2, reversal.reach - after));
    window.begin = run.turn - kept;
    window.end = run.turn + std::min(after, reversal.reach - kept);
  }
  // An axis that is lower than the path at the end of the window would not be in contact with the flank.
  depth = std::min(depth, std::abs(run.at(window.end, reversal.axis) - reversal.extreme));
  window.begin = std::max(window.begin, begin_at_depth());
  for (const double start : run.starts) {
    if (std::abs(window.begin - start) < shortest_piece) window.begin = start;
    if (std::abs(window.end - start) < shortest_piece) window.end = start;
  }
  return window;
}

// The ramp that minimizes the greatest second derivative of the motor's position by s, and so allows the highest speed.
BacklashRamp BacklashOverlap::best_ramp(const Run& run, const Window& window, const Reversal& reversal) const {
  constexpr int candidates = 17;
  constexpr int looks = 32;
  const double width = window.end - window.begin;
  std::vector<double> bends;
  for (int i = 0; i <= looks; ++i) {
    const double s = window.look(i, looks);
    const std::size_t segment = run.segment_at(s);
    bends.push_back(run.segments[segment].curve.second_derivative(Mm(s - run.starts[segment]))[reversal.axis]);
  }
  const auto ramp_at = [&](double share) {
    return BacklashRamp(window.begin, window.begin + width * share, window.end, options_.smoothness);
  };
  BacklashRamp best = ramp_at(0.5);
  double least = INFINITY;
  for (int k = 0; k < candidates; ++k) {
    const BacklashRamp ramp = ramp_at(0.2 + 0.6 * k / (candidates - 1));
    const bool fits = std::ranges::all_of(ramp.knots(), [&](double knot) {
      return std::ranges::all_of(
          run.starts, [&](double start) { return knot == start || std::abs(knot - start) >= shortest_piece; });
    });
    if (!fits) continue;
    double most = 0;
    for (int i = 0; i <= looks; ++i) {
      const double s = window.look(i, looks);
      const double own = bends[static_cast<std::size_t>(i)];
      most = std::max(most, std::abs(own - reversal.lead * ramp.second_derivative(s)));
    }
    if (most < least) best = ramp;
    least = std::min(least, most);
  }
  return best;
}

// The axis begins in contact with the flank that has pushed it.
BacklashOverlap::AxisWay BacklashOverlap::way_on(const Run& run, const Window& window, const BacklashRamp& ramp,
                                                 const Reversal& reversal) {
  constexpr int looks = 100;
  constexpr double between_looks = 1.02;
  const double down = reversal.lead > 0 ? 1 : -1;
  const double backlash = std::abs(reversal.lead);
  double height = down * run.at(window.begin, reversal.axis);  // of the axis; the extreme is the highest
  AxisWay way;
  for (int i = 0; i <= looks; ++i) {
    const double s = window.look(i, looks);
    const double planned = down * run.at(s, reversal.axis);
    const double motor = planned - backlash * ramp.at(s);  // of the flank below the axis
    height = std::clamp(height, motor, motor + backlash);
    way.at_end = height - planned;
    way.deviation = std::max(way.deviation, std::abs(way.at_end) * between_looks);
  }
  return way;
}

// Replaces the segments of the window.
void BacklashOverlap::rewrite(Run& run, const Window& window, const BacklashRamp& ramp, const Reversal& reversal) {
  const std::size_t first = run.segment_at(window.begin);
  const auto before_turn = static_cast<std::size_t>(std::ranges::find(run.starts, run.turn) -
                                                    run.starts.begin());  // segments of the run behind the reversal
  const std::size_t untouched = behind_.size() - before_turn + first;
  for (std::size_t i = 0; i < untouched; ++i) ready_.emplace_back(behind_[i]);
  behind_.clear();
  ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(run.segments.size() - before_turn));
  std::size_t i = first;
  if (window.begin > run.starts[first]) {
    Segment head = run.segments[first];
    head.curve = head.curve.part(Mm(0), Mm(window.begin - run.starts[first]));
    head.mode = PathMode::continuous;
    ready_.emplace_back(head);
  }
  for (; i < run.segments.size() && run.starts[i] < window.end; ++i) {
    std::vector<double> cuts{std::max(run.starts[i], window.begin), std::min(run.starts[i + 1], window.end)};
    for (const double knot : ramp.knots()) {
      if (knot > cuts[0] + shortest_piece && knot < cuts[1] - shortest_piece) cuts.push_back(knot);
    }
    std::ranges::sort(cuts);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      add_piece(run.segments[i], run.starts[i], cuts[k], cuts[k + 1], ramp, reversal);
    }
  }
  const Segment& last = run.segments[i - 1];
  std::vector<PathItem> rest;
  if (window.end < run.starts[i]) {
    Segment tail = last;
    tail.curve = last.curve.part(Mm(window.end - run.starts[i - 1]), last.curve.length());
    tail.downs = reversal.downs;
    rest.emplace_back(tail);
  }
  for (; i < run.segments.size(); ++i) rest.emplace_back(run.segments[i]);
  ahead_.insert(ahead_.begin(), rest.begin(), rest.end());
}

// A part of a segment, with the ramp. An arc is divided so finely that cubics can replace it.
void BacklashOverlap::add_piece(const Segment& whole, double start, double from, double to, const BacklashRamp& ramp,
                                const Reversal& reversal) {
  const double length = whole.curve.length().value();
  const double turn = is_arc(whole) ? std::abs(whole.curve.arc_data().sweep) * (to - from) / length : 0;
  const int count = 1 + static_cast<int>(std::min(turn / turn_of_a_piece, 1e4));
  const auto lead_at = [&](double s) { return reversal.lead * (1 - ramp.at(s)); };
  const auto lead_slope_at = [&](double s) { return -reversal.lead * ramp.slope(s); };
  for (int i = 0; i < count; ++i) {
    const double one = i == 0 ? from : from + (to - from) * i / count;
    const double other = i + 1 == count ? to : from + (to - from) * (i + 1) / count;
    const bool ends = !(other - start < length);
    const Mm in(one - start);
    const Mm out = ends ? whole.curve.length() : Mm(other - start);
    const MotorLead lead{.axis = reversal.axis,
                         .start = lead_at(one),
                         .start_slope = lead_slope_at(one),
                         .end = lead_at(other),
                         .end_slope = lead_slope_at(other)};
    Point begin = one == start ? whole.curve.start() : whole.curve.at(in);
    Point end = ends ? whole.curve.end() : whole.curve.at(out);
    Point begin_slope = whole.curve.tangent(in);
    Point end_slope = whole.curve.tangent(out);
    begin[lead.axis] += lead.start;
    begin_slope[lead.axis] += lead.start_slope;
    end[lead.axis] += lead.end;
    end_slope[lead.axis] += lead.end_slope;
    Segment piece = whole;
    piece.curve = Curve::cubic(begin, begin_slope, end, end_slope, out - in);
    piece.mode = ends ? whole.mode : PathMode::continuous;
    piece.downs = reversal.downs;
    piece.lead = lead;
    ready_.emplace_back(piece);
  }
}

}  // namespace passo
