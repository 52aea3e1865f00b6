#include "lathe_moves.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

using Shape = LatheSegment::Shape;
using namespace lathe_tolerance;

constexpr double deepest = -1e9;
constexpr int most_idle_steps = 100'000;

bool is_same(LathePoint a, LathePoint b) {
  return std::abs(a - b) < same;
}

}  // namespace

void LatheMoves::arc(const LatheSegment& along, LathePoint end) {
  const bool clockwise = along.shape == Shape::clockwise;
  add({clockwise ? LatheMove::Kind::clockwise : LatheMove::Kind::counterclockwise, end, along.center});
}

void LatheMoves::along(const LatheSegment& segment) {
  segment.is_arc() ? arc(segment, segment.end) : line(segment.end);
}

LatheRoughing::LatheRoughing(LatheContour contour, Extent extent, double depth_of_cut, double lift)
    : contour_(std::move(contour)), extent_(extent), depth_of_cut_(std::max(depth_of_cut, 2 * same)), lift_(lift) {
  std::vector<LatheSegment>& segments = contour_.segments;
  tool_ = segments.front().start;
  level_ = top_level_ = tool_.imag();
  const LathePoint last = segments.back().end;
  if (last.imag() < top_level_) {
    LatheSegment out;
    out.start = last;
    out.end = {last.real(), top_level_};
    segments.push_back(out);
  }
}

bool LatheRoughing::step(LatheMoves& moves) {
  if (phase_ == Phase::done) return false;
  const LathePoint before = tool_;
  const double level_before = level_;
  next_step(moves);
  const bool progress = std::abs(tool_ - before) > same || level_ < level_before;
  idle_steps_ = progress ? 0 : idle_steps_ + 1;
  if (idle_steps_ > most_idle_steps) fault_ = LatheFault::stuck;
  return fault_ == LatheFault::none;
}

void LatheRoughing::next_step(LatheMoves& moves) {
  if (phase_ == Phase::begin) {
    moves.rapid(tool_);
    phase_ = extent_ == Extent::only_pockets ? Phase::skip : Phase::down;
  } else if (at_end()) {
    phase_ = Phase::done;
  } else if (phase_ == Phase::skip) {
    dive(deepest, moves) ? static_cast<void>(++at_) : static_cast<void>(phase_ = Phase::down);
  } else if (phase_ == Phase::down) {
    go_down(moves);
  } else if (phase_ == Phase::up) {
    go_up(moves);
  } else {
    climb_only(moves);
    ++at_;
  }
}

void LatheRoughing::go_down(LatheMoves& moves) {
  if (const double above = level_ - same - tool_.imag(); above > 0) {
    level_ -= std::ceil(above / depth_of_cut_) * depth_of_cut_;
  }
  if (!dive(level_, moves)) {
    phase_ = extent_ == Extent::no_pockets ? Phase::up_only : Phase::up;
  } else if (std::abs(tool_.imag() - level_) > same) {
    ++at_;  // the segment ends above the level
  } else {
    cut(moves);
  }
}

// Cuts from the tool along Z to the next segment in the way and goes back above the cut. Then lowers the level.
// If the tool is already where that segment starts, only goes on to that segment.
void LatheRoughing::cut(LatheMoves& moves) {
  for (std::size_t hit = at_; hit < contour_.segments.size(); ++hit) {
    const LatheCrossings found = crossings(contour_.segments[hit], tool_.imag());
    if (found.count == 0) continue;
    const double z = hit == at_ ? found.back() : found.front();  // an arc that falls is met where it rises again
    const double distance = std::abs(z - tool_.real());
    if (z - same > tool_.real()) continue;
    if (distance < same) {
      if (hit == at_) continue;
      if (!is_same(tool_, contour_.segments[hit].start)) break;
      at_ = hit;
      return;
    }
    // A short cut leaves no room for the whole lift.
    const double lift = lift_ == 0 ? 0 : std::min(1.0, distance / 2 / lift_) * lift_;
    moves.line({z, tool_.imag()});
    moves.rapid(LathePoint(z, tool_.imag()) + LathePoint(lift, lift));
    moves.rapid(tool_ + LathePoint(-lift, lift));
    at_ == 0 ? moves.rapid(tool_) : moves.line(tool_);
    break;
  }
  level_ -= depth_of_cut_;
}

void LatheRoughing::go_up(LatheMoves& moves) {
  if (climb(moves)) {
    ++at_;
  } else {
    enter_pocket();
  }
}

void LatheRoughing::enter_pocket() {
  if (extent_ == Extent::only_pockets) {
    if (pocket_level_ && tool_.imag() > *pocket_level_) pocket_level_.reset();
    if (!pocket_level_) pocket_level_ = tool_.imag();
  }
  level_ = pocket_level_.value_or(top_level_);
  phase_ = Phase::down;
}

bool LatheRoughing::dive(double x, LatheMoves& moves) {
  return segment().is_arc() ? dive_arc(x, moves) : dive_line(x, moves);
}

bool LatheRoughing::dive_line(double x, LatheMoves& moves) {
  const LatheSegment& line = segment();
  if (line.start.imag() <= line.end.imag() + same) return false;
  LathePoint to = line.end;
  if (x >= line.end.imag()) {
    const LatheCrossings found = crossings(line, x);
    if (found.count == 0) {
      fault_ = LatheFault::stuck;
      return true;
    }
    to = {found.front(), x};
  }
  at_ == 0 ? moves.rapid(to) : moves.line(to);
  tool_ = to;
  return true;
}

bool LatheRoughing::dive_arc(double x, LatheMoves& moves) {
  const LatheSegment& arc = segment();
  if (std::real(tool_ - arc.end) <= same) {
    tool_ = arc.end;
    return true;
  }
  LatheCrossings found = crossings(arc, x);
  if (found.count == 0) found = crossings(arc, x - same);
  const double center = arc.center.real();
  if (arc.shape == Shape::counterclockwise) {
    if (tool_.real() - same > center) return false;
    follow_arc(found.count == 0 || found.back() > center ? arc.end : LathePoint(found.back(), x), moves);
    return true;
  }
  if (tool_.real() <= center) return false;
  if (found.count == 0) {
    follow_arc(arc.end, moves);
  } else if (found.front() >= center) {
    follow_arc({found.front(), x}, moves);
  }  // else the arc meets the level on its far side only, and cut() lowers the level
  return true;
}

void LatheRoughing::follow_arc(LathePoint end, LatheMoves& moves) {
  moves.arc(segment(), end);
  tool_ = end;
}

bool LatheRoughing::climb(LatheMoves& moves) {
  const LatheSegment& part = segment();
  if (part.is_arc()) return climb_arc(moves);
  if (part.end.imag() + same < part.start.imag()) return false;
  if (!is_same(tool_, part.start)) {
    fault_ = LatheFault::stuck;
    return true;
  }
  moves.line(part.end);
  tool_ = part.end;
  return true;
}

bool LatheRoughing::climb_arc(LatheMoves& moves) {
  const LatheSegment& arc = segment();
  const bool clockwise = arc.shape == Shape::clockwise;
  if (clockwise ? tool_.real() > arc.center.real() : tool_.real() < arc.center.real()) return false;
  const LathePoint to = end_of_climb();
  if (std::abs(tool_ - to) > small) moves.arc(arc, to);
  tool_ = to;
  return clockwise;  // a counterclockwise arc may fall after its top
}

LathePoint LatheRoughing::end_of_climb() const {
  const LatheSegment& arc = segment();
  if (arc.shape == Shape::clockwise || arc.end.real() >= arc.center.real()) return arc.end;
  return arc.center + LathePoint(0, arc.radius());
}

// Follows the part of the segment that rises above the tool, from where the segment has the tool's height.
void LatheRoughing::climb_only(LatheMoves& moves) {
  const LatheSegment& part = segment();
  const LatheCrossings found = crossings(part, tool_.imag());
  if (found.count == 0) return;
  if (!part.is_arc()) {
    if (part.end.imag() < part.start.imag()) return;
    moves.line({found.front(), tool_.imag()});
    moves.line(part.end);
    tool_ = part.end;
    return;
  }
  const bool clockwise = part.shape == Shape::clockwise;
  const double z = clockwise ? found.back() : found.front();
  if (clockwise ? z > part.center.real() : z < part.center.real()) return;
  tool_.real(z);
  moves.line(tool_);
  const LathePoint to = end_of_climb();
  if (std::abs(tool_ - to) > small) moves.arc(part, to);
  tool_ = to;
}

LatheFinishing::LatheFinishing(LatheContour contour, double first_distance, double last_distance, std::int32_t passes)
    : contour_(std::move(contour)),
      first_distance_(first_distance),
      last_distance_(last_distance),
      passes_(passes),
      left_(passes) {}

bool LatheFinishing::step(LatheMoves& moves) {
  if (at_ >= path_.segments.size()) {
    if (left_ == 0) return false;
    --left_;
    path_ = contour_;
    fault_ = path_.offset(left_ * (first_distance_ - last_distance_) / passes_ + last_distance_);
    if (fault_ != LatheFault::none) return false;
    at_ = 1;
    moves.rapid(path_.segments.front().start);
    moves.rapid(path_.segments.front().end);
    return true;
  }
  moves.along(path_.segments[at_++]);
  return true;
}

}  // namespace passo
