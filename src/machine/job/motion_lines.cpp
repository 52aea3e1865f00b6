#include "passo/job/motion_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// A move is looked at in straight pieces of about this length.
constexpr double piece_length = 1;
constexpr double most_pieces_of_a_move = 32;

double distance_to(const Point& from, const Point& to, const Point& place) {
  const Point way = to - from;
  const double squared = dot(way, way);
  const double share = squared > 0 ? std::clamp(dot(place - from, way) / squared, 0.0, 1.0) : 0;
  return distance(place, from + way * share);
}

}  // namespace

void LatestMotion::watch(const MotionItem& motion) {
  const auto* move = std::get_if<PlannedMove>(&motion);
  if (move == nullptr) return;
  const double length = (move->to - move->from()).value();
  const double count = std::clamp(std::ceil(length / piece_length), 1.0, most_pieces_of_a_move);
  Point from = move->segment.curve.at(move->from());
  for (double i = 1; i <= count; ++i) {
    const Point to = move->segment.curve.at(move->from() + Mm(length * i / count));
    pieces_.push_back({.line = move->segment.source.line, .from = from, .to = to});
    from = to;
  }
  while (pieces_.size() > most_pieces) pieces_.pop_front();
}

std::uint32_t LatestMotion::line_at(const Point& place) const {
  constexpr double as_near = 1e-3;  // mm, below a step
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t line = 0;
  for (const Piece& piece : pieces_) {
    const double away = distance_to(piece.from, piece.to, place);
    if (away >= nearest - as_near) continue;
    nearest = away;
    line = piece.line;
  }
  return line;
}

void PlannedLines::watch(const MotionItem& motion) {
  if (const auto* move = std::get_if<PlannedMove>(&motion)) {
    planned_ += move->duration();
    const std::uint32_t line = move->segment.source.line;
    if (!ahead_.empty() && ahead_.back().line == line) {
      ahead_.back().end = planned_;
    } else {
      ahead_.push_back({.end = planned_, .line = line});
    }
    return;
  }
  const auto& action = std::get<Action>(motion);
  if (action.kind != Action::Kind::dwell) return;
  planned_ += action.dwell;
  ahead_.push_back({.end = planned_, .line = action.source.line});
}

std::uint32_t PlannedLines::line_at(Seconds time) const {
  const auto found = std::ranges::lower_bound(ahead_, time, {}, &Planned::end);
  if (found != ahead_.end()) return found->line;
  return ahead_.empty() ? 0 : ahead_.back().line;
}

void PlannedLines::forget_before(Seconds time) {
  while (ahead_.size() > 1 && ahead_.front().end < time) ahead_.pop_front();
}

}  // namespace passo
