#include "passo/report/path_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "polyline_joining.hpp"

#include "passo/interpreter/used_tools.hpp"
#include "passo/path/hand_tool_change.hpp"

namespace passo {
namespace {

constexpr std::array<Axis, 3> space = {Axis::x, Axis::y, Axis::z};
// The number of speeds that a picture can show as different.
constexpr double speed_steps = 32;
constexpr std::uint64_t stretch = 64;  // moves or vertices that are kept or left out together

double diagonal(const Box& box) {
  return std::hypot(box.high[Axis::x] - box.low[Axis::x], box.high[Axis::y] - box.low[Axis::y],
                    box.high[Axis::z] - box.low[Axis::z]);
}

// How many chords an arc needs. The chords may leave the arc by `tolerance`, or by 1/2000 of the radius if that is
// more, because nobody sees that. `angle` is the whole angle in radians.
double chords_of(double radius, double angle, double tolerance) {
  if (!(radius > 0)) return 1;
  const double sagitta = std::min(std::max(tolerance, radius / 2000), radius);
  return angle / std::sqrt(8 * sagitta / radius);
}

// How many chords a part of the curve needs that has this `length`. A cubic counts as an arc with the cubic's sharpest
// bend.
double chords_of(const Curve& curve, double length, double tolerance) {
  switch (curve.shape()) {
    case Curve::Shape::arc: {
      const Curve::ArcData& arc = curve.arc_data();
      const double angle = std::abs(arc.sweep) * length / curve.length().value();
      return chords_of(std::max(arc.start_radius, arc.end_radius), angle, tolerance);
    }
    case Curve::Shape::cubic: {
      const double bend = curve.turning() / curve.length().value();
      return bend > 0 ? chords_of(1 / bend, length * bend, tolerance) : 1;
    }
    case Curve::Shape::line: break;
  }
  return 1;
}

}  // namespace

void PathRecorder::watch(const MotionItem& item, const Point& machine_minus_work) {
  if (const auto* move = std::get_if<PlannedMove>(&item)) {
    watch_move(*move, machine_minus_work);
  } else if (const auto& action = std::get<Action>(item); action.kind == Action::Kind::dwell) {
    time_ += action.dwell;
  } else if (changes_tool(action)) {
    change_tool(action.tool);
  }
}

void PathRecorder::change_tool(std::int32_t tool) {
  const auto itself = [tool] { return tool; };
  tool_ = static_cast<std::uint8_t>(index_of_tool(tools_, tool, std::identity(), most_tools, itself));
}

void PathRecorder::watch_move(const PlannedMove& move, const Point& origin) {
  time_ += move.duration();
  const Box box = move.segment.lead ? move.segment.tool_curve().extents() : move.segment.curve.extents();
  if (!(diagonal(box) > 0)) return;  // only other axes move

  if (!any_) {
    any_ = true;
    base_ = move.segment.tool_at(Mm(0));
    extents_ = box;
  }
  for (const Axis axis : space) {
    extents_.low[axis] = std::min(extents_.low[axis], box.low[axis]);
    extents_.high[axis] = std::max(extents_.high[axis], box.high[axis]);
  }
  if (!move.segment.rapid) {
    if (!std::exchange(any_feed_, true)) feed_extents_ = box;
    for (const Axis axis : space) {
      feed_extents_.low[axis] = std::min(feed_extents_.low[axis], box.low[axis]);
      feed_extents_.high[axis] = std::max(feed_extents_.high[axis], box.high[axis]);
    }
  }
  constexpr std::size_t most_origins = 9;
  if (origins_.size() < most_origins && std::ranges::find(origins_, origin) == origins_.end()) {
    origins_.push_back(origin);
  }
  record(move);
}

void PathRecorder::record(const PlannedMove& move) {
  if (move.segment.takes_up_backlash) return;  // the tool stands
  if (!move.segment.rapid) {
    for (const Phase& phase : move) {
      fastest_feed_ = std::max({fastest_feed_, phase.velocity.value(), phase.velocity_at(phase.duration).value()});
    }
  }
  if (moves_++ / stretch % keep_one_of_ != 0) return;
  const Vertex before = vertices_.empty() ? Vertex{} : vertices_.back();
  add(move.segment.tool_at(move.from()), 0, Kind::jump);
  const Vertex& begin = vertices_.back();
  const bool continues = vertices_.size() > 1 && before.x == begin.x && before.y == begin.y && before.z == begin.z;
  if (continues) vertices_.pop_back();
  for (const Phase& phase : move) {
    // A phase ends exactly where the next phase begins.
    record(move, phase, &phase + 1 == move.end() ? move.to : (&phase + 1)->start);
  }
}

void PathRecorder::record(const PlannedMove& move, const Phase& phase, Mm end) {
  const Curve& curve = move.segment.curve;
  const double from = phase.start.value();
  const double to = end.value();
  if (!(to > from)) return;

  double pieces = chords_of(curve, to - from, tolerance_);
  if (!move.segment.rapid) {
    // Cuts where the speed changes, but not finer than the path itself is kept.
    const double change = std::abs(phase.velocity_at(phase.duration).value() - phase.velocity.value());
    const double steps = change > 0 ? change / (fastest_feed_ / speed_steps) : 1;
    pieces = std::max(pieces, tolerance_ > 0 ? std::min(steps, (to - from) / tolerance_) : steps);
  }
  constexpr double most_pieces = 10'000;
  const auto count = static_cast<int>(std::ceil(std::clamp(pieces, 1.0, most_pieces)));
  const Kind kind = move.segment.rapid ? Kind::rapid : Kind::feed;
  const Seconds step = phase.duration / count;
  double last = from;
  for (int i = 1; i <= count; ++i) {
    const double s = i == count ? to : phase.position_at(step * i).value();
    add(move.segment.lead ? move.segment.tool_at(Mm(s)) : curve.at(Mm(s)), (s - last) / step.value(), kind);
    last = s;
  }
}

void PathRecorder::add(const Point& point, double speed, Kind kind) {
  if (vertices_.size() == most_vertices) make_room();
  if (vertices_.capacity() == 0) vertices_.reserve(1024);
  vertices_.push_back({.x = static_cast<float>(point[Axis::x] - base_[Axis::x]),
                       .y = static_cast<float>(point[Axis::y] - base_[Axis::y]),
                       .z = static_cast<float>(point[Axis::z] - base_[Axis::z]),
                       .speed = static_cast<float>(speed),
                       .kind = kind,
                       .tool = tool_,
                       .load = load_});
}

void PathRecorder::make_room() {
  // About a pixel of a large picture. A coarser polyline would no longer look like the path.
  const double coarsest = diagonal(extents_) / 2000;
  double speed_step = fastest_feed_ / (speed_steps / 2);
  if (tolerance_ > 0) join_pieces(vertices_, tolerance_, speed_step);
  while (vertices_.size() > most_vertices / 2 && tolerance_ < coarsest) {
    tolerance_ = std::max(2 * tolerance_, coarsest / 64);
    join_pieces(vertices_, tolerance_, speed_step);
  }
  // Coarser colours are better than gaps.
  for (int pass = 0; pass < 2 && vertices_.size() > most_vertices / 2; ++pass) {
    speed_step *= 2;
    join_pieces(vertices_, tolerance_, speed_step);
  }
  while (vertices_.size() > most_vertices / 8 * 7) thin();
}

void PathRecorder::thin() {
  keep_one_of_ *= 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (i / stretch % 2 != 0) continue;
    vertices_[kept] = vertices_[i];
    if (i % stretch == 0) vertices_[kept].kind = Kind::jump;
    ++kept;
  }
  vertices_.resize(kept);
}

}  // namespace passo
