#include "levelled_path.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace passo::test {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double rounding = 1e-4;  // of the numbers of a levelled program, and what they make in a few moves

double sweep_of(double start, double end, std::int32_t turns) {
  double sweep = std::fmod((end - start) * (turns > 0 ? 1 : -1), turn);
  if (sweep < 0) sweep += turn;
  if (sweep < 1e-9) sweep += turn;
  sweep += turn * (std::abs(turns) - 1);
  return turns > 0 ? sweep : -sweep;
}

std::pair<Axis, Axis> axes_of_plane(Plane plane) {
  if (plane == Plane::zx) return {Axis::z, Axis::x};
  if (plane == Plane::yz) return {Axis::y, Axis::z};
  return {Axis::x, Axis::y};
}

bool is_near(const Point& a, const Point& b, bool with_z) {
  for (const Axis axis : all_axes) {
    if ((axis != Axis::z || with_z) && std::abs(a[axis] - b[axis]) > rounding) return false;
  }
  return true;
}

class Tracer {
 public:
  explicit Tracer(Interpreter& interpreter, const Point& start) : blocks_(interpreter), place_(start) {}

  void follow(const Operation& operation, std::vector<PathMove>& moves) {
    for (const FrameBlock& block : blocks_.take_executed()) {
      stores_home_ |= block.place.name == "G28.1" || block.place.name == "G30.1";
      if (block.system.empty() || std::exchange(system_, block.system.name) == block.system.name) continue;
      moves.emplace_back().changes_frame = true;
    }
    const bool sets_tool = std::holds_alternative<operation::SetToolOffset>(operation.what);
    if (frame_.follow(operation)) {
      if (begun_) moves.push_back(PathMove());
      if (begun_) moves.back().changes_frame = true;
      if (begun_) moves.back().changes_height_only = sets_tool;
      return;
    }
    begun_ = begun_ || std::holds_alternative<operation::Reset>(operation.what);
    const auto* rapid = std::get_if<operation::StraightTraverse>(&operation.what);
    const auto* feed = std::get_if<operation::StraightFeed>(&operation.what);
    const auto* arc = std::get_if<operation::ArcFeed>(&operation.what);
    if (rapid == nullptr && feed == nullptr && arc == nullptr) return;
    const FrameBlock& block = blocks_.last();
    const Point end = rapid != nullptr ? rapid->end : feed != nullptr ? feed->end : arc->end;
    PathMove move{.line = operation.source.line,
                  .rapid = rapid != nullptr,
                  .incremental = block.incremental,
                  .in_cycle = !block.cycle.empty() && block.place.empty(),
                  .named = block.named,
                  .from = place_,
                  .to = frame_.machine_from_work(end),
                  .frame = frame_};
    const std::string& code = block.place.name;
    const bool is_home = code == "G28" || code == "G30";
    const bool is_second = is_home && std::exchange(homing_, block.number) == block.number;
    move.of_machine = code == "G53" || is_second;
    move.to_stored_home = is_second && stores_home_;
    if (is_second && move.named.empty()) move.named = AxisSet(0x1FF);
    if (arc != nullptr) add_arc(*arc, move);
    place_ = move.to;
    moves.push_back(move);
  }

 private:
  void add_arc(const operation::ArcFeed& arc, PathMove& move) const {
    const auto [first, second] = axes_of_plane(arc.plane);
    const Point from = frame_.work_from_machine(place_);
    move.is_arc = true;
    move.plane = arc.plane;
    move.first_center = arc.first_center.value();
    move.second_center = arc.second_center.value();
    move.sweep =
        sweep_of(std::atan2(from[second] - move.second_center, from[first] - move.first_center),
                 std::atan2(arc.end[second] - move.second_center, arc.end[first] - move.first_center), arc.turns);
  }

  FrameBlocks blocks_;
  Frame frame_;
  Point place_;
  bool begun_ = false;
  std::uint64_t homing_ = 0;
  bool stores_home_ = false;
  std::string system_;
};

// What is known while two paths are compared.
class Comparison {
 public:
  Comparison(const std::vector<PathMove>& levelled, const HeightMap& map, const PathWish& wish)
      : levelled_(levelled), map_(map), wish_(wish) {
    skip();
  }

  std::string take(const PathMove& move) {
    if (move.changes_frame) {
      lose(move);
      return {};
    }
    move_ = &move;
    if (!move.in_cycle) in_cycle_ = false;
    if (move.in_cycle && !move.incremental && !std::exchange(in_cycle_, true)) {
      cycle_start_ = move.from[Axis::z];
      before_cycle_ = height_;
    }
    if (move.of_machine) return handle_machine_move();
    const bool names_xy = move.named.has(Axis::x) || move.named.has(Axis::y);
    bool from_anywhere = false;
    if (names_xy && !move.incremental) {
      from_anywhere = !(move.named.has(Axis::x) ? known_x_ : true) || !(move.named.has(Axis::y) ? known_y_ : true);
      known_x_ = known_x_ || move.named.has(Axis::x);
      known_y_ = known_y_ || move.named.has(Axis::y);
    }
    const bool is_assumed = !knows_place();
    return move.is_arc && move.plane != Plane::xy ? handle_upright_arc(is_assumed)
                                                  : take_along(from_anywhere, is_assumed);
  }

  std::string finish() const {
    return next_ == levelled_.size()
               ? std::string()
               : fmt::format("line {} of the levelled program is too much", levelled_[next_].line);
  }

 private:
  static Point work(const PathMove& move, const Point& machine) { return move.frame.work_from_machine(machine); }
  double height_at(const Point& machine) const {
    const Point place = work(*move_, machine);
    return map_.height(place[Axis::x], place[Axis::y]);
  }

  void lose(const PathMove& move) {
    if (wish_.all_known) return;
    if (height_ == Height::known) height_ = Height::lost;
    if (!move.changes_height_only) known_x_ = known_y_ = false;
  }

  void skip() {
    while (next_ < levelled_.size() && (levelled_[next_].changes_frame || !levelled_[next_].moves())) ++next_;
  }
  const PathMove* pull() {
    if (next_ == levelled_.size()) return nullptr;
    const PathMove* const move = &levelled_[next_++];
    skip();
    return move;
  }

  std::string fault(std::string what) const {
    const std::uint32_t at = next_ > 0 ? levelled_[next_ - 1].line : 0;
    return fmt::format("line {}: {} (near line {} of the levelled program)", move_->line, what, at);
  }

  std::string handle_machine_move() {
    const PathMove& move = *move_;
    if (!wish_.all_known && (move.named.has(Axis::x) || move.named.has(Axis::y))) known_x_ = known_y_ = false;
    const double before = higher_;
    if (move.named.has(Axis::z)) {
      height_ = Height::of_machine;
      higher_ = 0;
    }
    Point from = move.from;
    Point want = move.to;
    from[Axis::z] += before;
    want[Axis::z] += higher_;
    if (is_near(from, want, true)) {
      // It may have been written, or not: a move of nothing.
      const bool comes = next_ < levelled_.size() && levelled_[next_].of_machine;
      if (comes && is_near(levelled_[next_].to, want, true)) pull();
      return {};
    }
    const PathMove* const it = pull();
    if (it == nullptr) return fault("the machine's move is missing");
    if (!it->of_machine || it->rapid != move.rapid) return fault("the machine's move is none in the levelled program");
    for (const Axis axis : all_axes) {
      const double off = std::abs(it->to[axis] - want[axis]);
      const bool turned = move.frame.rotation_degrees() != 0 || move.frame.work_offset() != Point();
      const double bound = move.to_stored_home || !move.named.has(axis) ? rounding : turned ? 1e-9 : 0;
      if (!(off <= bound)) return fault(fmt::format("{} of the machine is {} off", letter_of(axis), off));
    }
    return {};
  }

  // The height that the end of a move has to have, above the program's.
  std::string check_end(double higher, bool is_assumed) {
    const PathMove& move = *move_;
    const double surface = height_at(move.to);
    const bool is_clear =
        (move.rapid || move.in_cycle) && move.end()[Axis::z] >= map_.highest() + wish_.clear - rounding;
    const bool names_height = (move.named.has(Axis::z) && !move.incremental && !move.in_cycle) ||
                              std::abs(move.to[Axis::z] - move.from[Axis::z]) > 1e-9;
    const bool back =
        move.in_cycle && before_cycle_ != Height::known && std::abs(move.to[Axis::z] - cycle_start_) < rounding;
    const double before = higher_;
    higher_ = higher;
    if (back) height_ = before_cycle_;
    if (height_ == Height::of_machine && (!names_height || back)) {
      if (back) return {};
      return std::abs(higher - before) <= rounding ? std::string() : fault("is levelled before there was a Z");
    }
    if (names_height) {
      const bool known = move.in_cycle ? !back : move.named.has(Axis::z) && !move.incremental;
      if (known && !is_incremental_cycle()) height_ = Height::known;
      if (height_ == Height::of_machine) height_ = Height::lost;
    }
    if (is_assumed) return {};
    const bool goes_over = move.in_cycle && before_cycle_ != Height::known && !names_height;
    if (goes_over && std::abs(higher - before) < rounding) return {};
    if (std::abs(higher - surface) <= wish_.tolerance + rounding) return {};
    if (std::abs(higher) <= rounding && (is_clear || (move.rapid && !wish_.all_known && height_ == Height::lost)))
      return {};
    if (back && std::abs(higher - before) < 10) return {};
    return fault(fmt::format("ends at X{:.4f} Y{:.4f} Z{:.4f} {:.4f} higher instead of {:.4f}", move.end()[Axis::x],
                             move.end()[Axis::y], move.end()[Axis::z], higher, surface));
  }
  bool is_incremental_cycle() const { return move_->in_cycle && move_->incremental; }

  std::string take_along(bool from_anywhere, bool is_assumed) {
    const PathMove& move = *move_;
    const double before = higher_;
    const bool was_of_machine = height_ == Height::of_machine;
    const bool names_place = move.named.has(Axis::z) && !move.incremental && !move.in_cycle;
    from_anywhere = from_anywhere || (names_place && height_ != Height::known);
    if (!move.moves()) return take_nothing();
    if (!move.moves_sideways()) {
      // From the height where the levelled program is.
      const bool may_be_nothing =
          next_ == levelled_.size() || !is_near(levelled_[next_].from, levelled_[next_].to, false);
      if (may_be_nothing) return check_end(before - (move.to[Axis::z] - move.from[Axis::z]), is_assumed);
      const PathMove* const it = pull();
      if (it->of_machine || it->is_arc) return fault("goes otherwise");
      if (!is_near(it->to, move.to, false)) return fault("goes sideways");
      return check_end(it->to[Axis::z] - move.to[Axis::z], is_assumed);
    }
    double done = 0;
    levelled_count_ = 0;
    take_first_height();
    const bool stays = move.rapid || was_of_machine;
    while (done < 1) {
      const PathMove* const it = pull();
      if (it == nullptr) return fault("is missing");
      if (it->of_machine) return fault("comes after a move of the machine");
      if (it->rapid != move.rapid) return fault("rapid instead of feed, or the other way");
      const double from = done;
      done = part_of(move, *it, from);
      if (!(done > from)) return fault(fmt::format("stands still or goes back at {}", from));
      if (done > 1 - 1e-6 || (done > 0.99 && is_near(it->to, move.to, false))) done = 1;
      Point there = move.at(done);
      if (!is_near(it->to, there, false))
        return fault(fmt::format("goes another way at {}: X{:.5f} Y{:.5f} instead of X{:.5f} Y{:.5f}", done,
                                 it->to[Axis::x], it->to[Axis::y], there[Axis::x], there[Axis::y]));
      if (from_anywhere || is_assumed || stays) continue;
      for (int i = 1; i < 8; ++i) {
        const double part = from + (done - from) * i / 8;
        const Point want = move.at(part);
        const Point is = it->at(i / 8.0);
        if (!is_near(is, want, false)) return fault("leaves the path");
        const double off = is[Axis::z] - want[Axis::z] - height_at(want);
        if (std::abs(off) > wish_.tolerance + rounding) return fault(fmt::format("is {:.4f} off on its way", off));
      }
    }
    if (from_anywhere && levelled_count_ > 1) return fault("is divided, though nobody knows where it begins");
    return check_end(levelled_[last_].to[Axis::z] - move.to[Axis::z], is_assumed);
  }

  bool knows_place() const { return wish_.all_known || (known_x_ && known_y_); }

  // After a rapid that was not levelled: straight to the height where the move begins.
  void take_first_height() {
    const bool is_straight =
        next_ < levelled_.size() && !levelled_[next_].of_machine && !levelled_[next_].moves_sideways();
    if (!is_straight || levelled_[next_].rapid != move_->rapid) return;
    const double higher = levelled_[next_].to[Axis::z] - move_->from[Axis::z];
    if (std::abs(higher) < rounding || std::abs(higher - height_at(move_->from)) < rounding || !knows_place()) pull();
  }

  // A move of nothing is written if its height was not right yet.
  std::string take_nothing() {
    if (next_ == levelled_.size() || levelled_[next_].of_machine || levelled_[next_].moves_sideways()) return {};
    if (levelled_[next_].rapid != move_->rapid) return {};
    const double higher = levelled_[next_].to[Axis::z] - move_->to[Axis::z];
    const bool is_levelled = std::abs(higher - height_at(move_->to)) < wish_.tolerance + rounding;
    if (!is_levelled && !(move_->rapid && std::abs(higher) < rounding)) return {};
    pull();
    higher_ = higher;
    return {};
  }

  // How far along `move` the end of `it` is.
  double part_of(const PathMove& move, const PathMove& it, double from) {
    last_ = static_cast<std::size_t>(&it - levelled_.data());
    ++levelled_count_;
    if (move.is_arc && it.is_arc) return from + it.sweep / move.sweep;
    if (move.is_arc) {
      const Point place = work(move, it.to);
      const double start =
          std::atan2(move.start()[Axis::y] - move.second_center, move.start()[Axis::x] - move.first_center);
      const double angle = std::atan2(place[Axis::y] - move.second_center, place[Axis::x] - move.first_center);
      double way = std::fmod((angle - start) * (move.sweep > 0 ? 1 : -1), turn);
      while (way / std::abs(move.sweep) < from + 1e-7) way += turn;
      return way / std::abs(move.sweep);
    }
    double along = 0;
    double length = 0;
    for (const Axis axis : all_axes) {
      if (axis == Axis::z) continue;
      const double step = move.to[axis] - move.from[axis];
      along += (it.to[axis] - move.from[axis]) * step;
      length += step * step;
    }
    return along / length;
  }

  // Its chords are within the tolerance of the circle, on the surface.
  std::string handle_upright_arc(bool is_assumed) {
    const PathMove& move = *move_;
    const auto [first, second] = axes_of_plane(move.plane);
    const double radius =
        std::hypot(move.start()[first] - move.first_center, move.start()[second] - move.second_center);
    take_first_height();
    for (int chords = 0; chords < 100000; ++chords) {
      const PathMove* const it = pull();
      if (it == nullptr || it->of_machine || it->rapid) return fault("the upright arc is not whole");
      Point place = work(move, it->to);
      const double higher = map_.height(place[Axis::x], place[Axis::y]);
      place[Axis::z] -= higher;
      const double off = std::hypot(place[first] - move.first_center, place[second] - move.second_center) - radius;
      if (!is_assumed && std::abs(off) > wish_.tolerance + 1e-3)
        return fault(fmt::format("the upright arc is {:.4f} off", off));
      const double off_end = is_assumed ? 0 : std::abs(place[Axis::z] - move.end()[Axis::z]);
      if (!is_near(it->to, move.to, false) || off_end > wish_.tolerance + rounding) continue;
      height_ = height_ == Height::known ? Height::known : Height::lost;
      higher_ = it->to[Axis::z] - move.to[Axis::z];
      return {};
    }
    return fault("the upright arc does not end");
  }

  enum class Height { of_machine, lost, known };
  const std::vector<PathMove>& levelled_;
  const HeightMap& map_;
  const PathWish& wish_;
  const PathMove* move_ = nullptr;
  std::size_t next_ = 0;
  std::size_t last_ = 0;
  int levelled_count_ = 0;
  Height height_ = Height::of_machine;
  double higher_ = 0;
  bool known_x_ = false;
  bool known_y_ = false;
  bool in_cycle_ = false;
  double cycle_start_ = 0;
  Height before_cycle_ = Height::of_machine;
};

}  // namespace

bool PathMove::moves() const {
  return moves_sideways() || std::abs(from[Axis::z] - to[Axis::z]) > 1e-6;
}

bool PathMove::moves_sideways() const {
  if (is_arc && sweep != 0) return true;
  for (const Axis axis : all_axes) {
    if (axis != Axis::z && std::abs(from[axis] - to[axis]) > 1e-5) return true;
  }
  return false;
}

Point PathMove::at(double part) const {
  Point place = from + (to - from) * part;
  if (part == 1) return to;
  if (!is_arc) return place;
  const auto [first, second] = axes_of_plane(plane);
  Point in_work = start() + (end() - start()) * part;
  const double start_angle = std::atan2(start()[second] - second_center, start()[first] - first_center);
  const double start_radius = std::hypot(start()[first] - first_center, start()[second] - second_center);
  const double end_radius = std::hypot(end()[first] - first_center, end()[second] - second_center);
  const double radius = start_radius + (end_radius - start_radius) * part;
  in_work[first] = first_center + radius * std::cos(start_angle + sweep * part);
  in_work[second] = second_center + radius * std::sin(start_angle + sweep * part);
  return frame.machine_from_work(in_work);
}

RunPath path_of(const std::string& program, const InterpreterOptions& options) {
  RunPath path;
  Diagnostics findings;
  Interpreter interpreter(ProgramReader::from_text("it", program), options, findings);
  Tracer tracer(interpreter, options.start);
  Operation operation;
  while (interpreter.next(operation)) tracer.follow(operation, path.moves);
  if (findings.any_error()) path.findings = render(findings, false);
  return path;
}

std::string difference_of(const RunPath& program, const RunPath& levelled, const HeightMap& map, const PathWish& wish) {
  Comparison comparison(levelled.moves, map, wish);
  for (const PathMove& move : program.moves) {
    if (std::string fault = comparison.take(move); !fault.empty()) return fault;
  }
  return comparison.finish();
}

}  // namespace passo::test
