#include "levelled_writer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo {
namespace {

constexpr double same_height = 1e-9;  // mm; degrees
constexpr double coarsest = 1e6;      // mm: an arc is not divided
constexpr double least_step = 1e-5;   // mm, that is written
// A piece of an arc that is shorter is written as a line: its ends might be one place as they are written.
constexpr double shortest_arc = 1e-3;  // mm

LevelPoint level_point(const Point& place) {
  return {place[Axis::x], place[Axis::y], place[Axis::z]};
}

}  // namespace

bool is_same_place(double a, double b) {
  return std::abs(a - b) < same_height;
}
bool is_same_place(const Point& a, const Point& b) {
  return std::ranges::all_of(all_axes, [&](Axis axis) { return is_same_place(a[axis], b[axis]); });
}

// From anywhere: no way is known to be straight up.
bool LevelledMove::is_upright() const {
  for (const Axis axis : all_axes) {
    if (axis != Axis::z && !is_same_place(from[axis], to[axis])) return false;
  }
  return !is_arc && !from_anywhere;
}

void LevelledWriter::add(Item item) {
  if (item.is_move) {
    ++count_.moves_before;
    any_levelled_ = any_levelled_ || item.move.levelled;
    const LevelledMove& move = item.move;
    const bool goes_down = move.to[Axis::z] < move.from[Axis::z] || move.from_above;
    if (move.is_upright() && (goes_down || !run_.empty())) {
      run_.push_back(std::move(item));
      return;
    }
    end_run();
    return emit(item);
  }
  if (run_.empty()) return emit(item);
  run_.push_back(std::move(item));
}

// A run that ends where its first feed began, or higher, is a hole. Below that its heights are those of the program. If
// nobody knows where it began, it is a hole if the tool comes up again.
void LevelledWriter::end_run(bool rises) {
  if (run_.empty()) return;
  const auto feed = std::ranges::find_if(run_, [](const Item& item) { return item.is_move && !item.move.rapid; });
  double top = feed != run_.end() ? feed->move.from[Axis::z] : 0;
  double end = top;
  for (const Item& item : run_) end = item.is_move ? item.move.to[Axis::z] : end;
  if (feed != run_.end() && feed->move.from_above) {
    rises = rises || end > feed->move.to[Axis::z] + same_height;
    top = std::max(end, feed->move.to[Axis::z] + 2 * same_height);
  }
  const bool is_hole = !wish_.holes && feed != run_.end() && (rises || end >= top - same_height);
  if (is_hole) ++count_.holes;
  for (Item& item : run_) {
    if (is_hole && item.move.to[Axis::z] < top - same_height) item.move.levelled = false;
    emit(item);
  }
  run_.clear();
}

void LevelledWriter::emit(const Item& item) {
  if (item.is_move) return emit_move(item.move);
  code_.line(item.line);
}

// After a rapid that was not levelled: the whole way of this move is levelled, from its beginning.
void LevelledWriter::begin_at_height(const LevelledMove& move) {
  const double height = move.from[Axis::z] + map_.height(move.from[Axis::x], move.from[Axis::y]);
  if (move.from_anywhere || move.from_above || std::abs(height - height_) < least_step) return;
  PlainMove plain{.rapid = move.rapid, .feed = move.feed, .to = move.from};
  plain.to[Axis::z] = height_ = height;
  code_.move(plain);
  ++count_.moves_after;
}

void LevelledWriter::emit_move(const LevelledMove& move) {
  PlainMove plain{
      .rapid = move.rapid, .feed = move.feed, .named = move.named, .absolute = move.absolute, .to = move.to};
  const LevelPoint from = level_point(move.from);
  const LevelPoint to = level_point(move.to);
  if (move.is_arc && !move.levelled) return emit_arc_piece(move, 0, {.end = to});
  const bool is_whole = (move.from_anywhere || move.from_above) && !move.is_arc;
  if (!move.levelled || is_whole || move.is_upright()) {
    plain.to[Axis::z] = move.levelled ? to.z + map_.height(to.x, to.y) : to.z;
    code_.move(plain);
    ++count_.moves_after;
    height_ = plain.to[Axis::z];
    return;
  }
  begin_at_height(move);
  const double tolerance = move.from_above ? coarsest : wish_.tolerance;
  const auto pieces = move.is_arc ? level_arc(map_, from, to, move.center_x, move.center_y, move.sweep, tolerance)
                                  : level_line(map_, from, to, tolerance);
  double part = 0;
  for (const LevelledPiece& piece : pieces) {
    if (move.is_arc) {
      emit_arc_piece(move, part, piece);
    } else {
      plain.to = move.from + (move.to - move.from) * piece.part;
      if (piece.part == 1) plain.to = move.to;
      plain.to[Axis::z] = height_ = piece.end.z;
      code_.move(plain);
      ++count_.moves_after;
    }
    part = piece.part;
  }
}

// Whole turns are written one by one.
void LevelledWriter::emit_arc_piece(const LevelledMove& move, double from_part, const LevelledPiece& piece) {
  const double sweep = move.sweep * (piece.part - from_part);
  const int turns = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / full_turn - 1e-9)));
  const double start_radius = std::hypot(move.from[Axis::x] - move.center_x, move.from[Axis::y] - move.center_y);
  const double end_radius = std::hypot(move.to[Axis::x] - move.center_x, move.to[Axis::y] - move.center_y);
  const double start_angle = std::atan2(move.from[Axis::y] - move.center_y, move.from[Axis::x] - move.center_x);
  const double from_height = height_;
  for (int i = 1; i <= turns; ++i) {
    const double share = static_cast<double>(i) / turns;
    const double part = from_part + (piece.part - from_part) * share;
    PlainMove plain{.rapid = false, .feed = move.feed, .named = move.named, .absolute = move.absolute, .to = move.to};
    if (part != 1) {
      const double radius = start_radius + (end_radius - start_radius) * part;
      plain.to = move.from + (move.to - move.from) * part;
      plain.to[Axis::x] = move.center_x + radius * std::cos(start_angle + move.sweep * part);
      plain.to[Axis::y] = move.center_y + radius * std::sin(start_angle + move.sweep * part);
    }
    plain.to[Axis::z] = height_ = i == turns ? piece.end.z : from_height + (piece.end.z - from_height) * share;
    if (std::abs(sweep) / turns * std::max(start_radius, end_radius) >= shortest_arc) {
      plain.arc = PlainMove::Arc{.center_x = move.center_x, .center_y = move.center_y, .clockwise = sweep < 0};
    }
    code_.move(plain);
    ++count_.moves_after;
  }
}

}  // namespace passo
