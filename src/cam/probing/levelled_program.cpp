#include "passo/probing/levelled_program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "leveller.hpp"

#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double same_height = 1e-9;  // mm; degrees
constexpr double coarsest = 1e6;      // mm: an arc is not divided
constexpr double least_step = 1e-5;   // mm, that is written
// A piece of an arc that is shorter is written as a line: its ends might be one place as they are written.
constexpr double shortest_arc = 1e-3;  // mm

LevelPlace level_place(const Point& place) {
  return {place[Axis::x], place[Axis::y], place[Axis::z]};
}

double sweep_of(double start_angle, double end_angle, std::int32_t turns) {
  double sweep = std::fmod((end_angle - start_angle) * (turns > 0 ? 1 : -1), turn);
  if (sweep < 0) sweep += turn;
  if (sweep < 1e-12) sweep += turn;
  sweep += turn * (std::abs(turns) - 1);
  return turns > 0 ? sweep : -sweep;
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

Leveller::Leveller(Interpreter& interpreter, const InterpreterOptions& options, const std::string& file,
                   const HeightMap& map, const LevelOptions& wish, Diagnostics& diagnostics,
                   const std::function<void(std::string_view)>& write)
    : blocks_(interpreter),
      map_(map),
      wish_(wish),
      diagnostics_(diagnostics),
      file_(file),
      code_(write),
      highest_(map.highest()),
      machine_unit_(options.machine_units == LengthUnits::inch ? 25.4 : 1),
      has_tools_(!options.tools.name.empty()),
      place_(options.start),
      height_(options.start[Axis::z]) {}

void Leveller::report(const Operation& operation, Severity severity, std::string code, std::string message,
                      std::string expected) {
  diagnostics_.add({.severity = severity,
                    .code = std::move(code),
                    .file = operation.file.empty() ? file_ : std::string(operation.file),
                    .place = {.line = operation.source.line,
                              .column = operation.word.column,
                              .length = std::max<std::uint32_t>(1, operation.word.length)},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(operation.text)});
}

void Leveller::refuse(const FrameBlock& block, std::string code, std::string message, std::string expected) {
  diagnostics_.add(
      {.code = std::move(code),
       .file = block.file,
       .place = {.line = block.line, .column = block.place.place.column, .length = block.place.place.length},
       .message = std::move(message),
       .expected = std::move(expected),
       .text = block.text});
}

void Leveller::check_lead(const Operation& operation, const Point& end) {
  const double beside = map_.distance_beside(end[Axis::x], end[Axis::y]);
  if (beside <= wish_.beside) return;
  refuse(operation, "level.beside",
         fmt::format("X{:.3f} Y{:.3f} is {:.3f} mm beside the height map", end[Axis::x], end[Axis::y], beside),
         fmt::format("a map that covers all that is milled, or at most {:g} mm beside it", wish_.beside));
}

double Leveller::feed_of(const Point& end) const {
  bool is_rotary_only = true;
  for (const Axis axis : all_axes)
    is_rotary_only = is_rotary_only && (is_rotary(axis) || is_same_place(end[axis], place_[axis]));
  return is_rotary_only && !is_same_place(end, place_) ? rotary_feed_ : feed_;
}

LevelledMove Leveller::move_to(const Operation& operation, const Point& end, bool rapid) {
  const FrameBlock& block = blocks_.last();
  LevelledMove move{.from = place_, .to = end, .rapid = rapid, .feed = feed_of(end)};
  for (const Axis axis : all_axes) {
    const bool is_word = operation.axis_words != nullptr && (*operation.axis_words)[axis].column != 0;
    const bool is_polar =
        block.line == operation.source.line && (block.has('@') || block.has('^')) && block.named.has(axis);
    if (is_word || is_polar) move.named.add(axis);
  }
  if (!block.incremental) move.absolute = move.named;
  for (const Axis axis : {Axis::x, Axis::y}) {
    move.from_anywhere = move.from_anywhere || (move.absolute.has(axis) && !known_.has(axis));
  }
  const bool is_of_machine = at_ == LevelHeight::of_machine;
  const bool names_height = move.absolute.has(Axis::z) || !is_same_place(end[Axis::z], place_[Axis::z]);
  move.from_above = at_ != LevelHeight::known && move.absolute.has(Axis::z);
  // Nothing is in the way of a rapid that is high enough all its way.
  const double clear = highest_ + wish_.clear;
  const bool is_clear =
      rapid && end[Axis::z] >= clear && (is_of_machine || place_[Axis::z] >= clear || move.is_upright());
  move.levelled = !is_clear && (names_height || !is_of_machine);
  if (!rapid && !move.levelled && !std::exchange(told_height_, true)) {
    report(operation, Severity::warning, "level.height",
           "this feed is not levelled: the program has not given a Z of the work yet",
           "a move to a Z in work coordinates before");
  }
  const bool is_assumed = !move.from_anywhere && (!known_.has(Axis::x) || !known_.has(Axis::y));
  if (move.levelled && is_assumed && !std::exchange(told_place_, true)) {
    report(operation, Severity::warning, "level.place",
           fmt::format("the program has not given X and Y of the work yet: X{:.3f} Y{:.3f} is assumed", end[Axis::x],
                       end[Axis::y]),
           "a move to X and Y in work coordinates before");
  }
  if (names_height) {
    const bool becomes_known = at_ == LevelHeight::known || move.absolute.has(Axis::z);
    at_ = becomes_known ? LevelHeight::known : LevelHeight::of_work;
  }
  move.is_new_place = (move.absolute.bits() & ~known_.bits()) != 0;
  for (const Axis axis : all_axes) {
    if (move.absolute.has(axis)) known_.add(axis);
  }
  return move;
}

void Leveller::handle_straight(const Operation& operation, const Point& end, bool rapid) {
  const LevelledMove move = move_to(operation, end, rapid);
  if (is_same_place(move.from, move.to) && !move.is_new_place) return;
  if (!rapid && move.levelled) check_lead(operation, end);
  add({.line = {}, .move = move, .is_move = true});
}

void Leveller::handle_arc(const Operation& operation, const operation::ArcFeed& arc) {
  if (arc.plane != Plane::xy) return handle_upright_arc(operation, arc);
  LevelledMove move = move_to(operation, arc.end, false);
  if (move.levelled) check_lead(operation, arc.end);
  if (move.from_above && std::abs(arc.turns) > 1) {
    refuse(operation, "level.height", "a helix of several turns begins at a height that the program has not given",
           "a move to a Z before");
  }
  move.is_arc = true;
  move.center_x = arc.first_center.value();
  move.center_y = arc.second_center.value();
  move.sweep = sweep_of(std::atan2(place_[Axis::y] - move.center_y, place_[Axis::x] - move.center_x),
                        std::atan2(arc.end[Axis::y] - move.center_y, arc.end[Axis::x] - move.center_x), arc.turns);
  add({.line = {}, .move = move, .is_move = true});
}

// On a surface that is not flat, an arc of the planes ZX and YZ is no arc any more: it becomes chords.
void Leveller::handle_upright_arc(const Operation& operation, const operation::ArcFeed& arc) {
  const Axis first = arc.plane == Plane::zx ? Axis::z : Axis::y;
  const Axis second = arc.plane == Plane::zx ? Axis::x : Axis::z;
  const Point from = place_;
  const double a = arc.first_center.value();
  const double b = arc.second_center.value();
  const double start = std::atan2(from[second] - b, from[first] - a);
  const double sweep = sweep_of(start, std::atan2(arc.end[second] - b, arc.end[first] - a), arc.turns);
  const double start_radius = std::hypot(from[first] - a, from[second] - b);
  const double end_radius = std::hypot(arc.end[first] - a, arc.end[second] - b);
  const double share = std::min(1.0, wish_.tolerance / 2 / std::max({start_radius, end_radius, wish_.tolerance}));
  const auto chords = static_cast<int>(std::clamp(std::ceil(std::abs(sweep) / (2 * std::acos(1 - share))), 1.0, 1e6));
  for (int i = 1; i <= chords; ++i) {
    const double part = static_cast<double>(i) / chords;
    const double radius = start_radius + (end_radius - start_radius) * part;
    Point end = from + (arc.end - from) * part;
    end[first] = a + radius * std::cos(start + sweep * part);
    end[second] = b + radius * std::sin(start + sweep * part);
    handle_straight(operation, i == chords ? arc.end : end, false);
  }
}

void Leveller::handle_move(const Operation& operation) {
  const auto* rapid = std::get_if<operation::StraightTraverse>(&operation.what);
  const auto* feed = std::get_if<operation::StraightFeed>(&operation.what);
  if (rapid == nullptr && feed == nullptr) return handle_arc(operation, std::get<operation::ArcFeed>(operation.what));
  const Point& end = rapid != nullptr ? rapid->end : feed->end;
  const std::string& code = blocks_.last().place.name;
  if (code == "G53") return handle_machine_move(end, rapid != nullptr);
  if ((code == "G28" || code == "G30") && handle_home(end)) return;
  handle_straight(operation, end, rapid != nullptr);
}

// The end of a program switches off what the program has switched off, and M9 stands for two operations.
bool Leveller::is_off_already(std::string_view line) {
  if (line == "M5") return std::exchange(spindle_is_off_, true);
  if (line == "M9") return std::exchange(coolant_is_off_, true);
  if (line == "M3" || line == "M4") spindle_is_off_ = false;
  if (line == "M7" || line == "M8") coolant_is_off_ = false;
  return false;
}

bool Leveller::handle(const Operation& operation) {
  if (cycle_.block != blocks_.last().number) end_cycle();
  for (const FrameBlock& block : blocks_.take_executed()) read_block(block);
  if (std::holds_alternative<operation::Reset>(operation.what) && !is_reset_) {
    is_reset_ = true;
    add_line("G17 G21 G40 G80 G90 G94");
    return true;
  }
  if (keeps_cycle(operation)) return true;
  if (follow_frame(operation)) return true;
  if (is_any_of<operation::StraightTraverse, operation::StraightFeed, operation::ArcFeed>(operation)) {
    handle_move(operation);
  } else if (const auto* rate = std::get_if<operation::SetFeedRate>(&operation.what)) {
    feed_ = rate->rate * 60;
    rotary_feed_ = rate->rotary_rate * 60;
  } else if (const auto* mode = std::get_if<operation::SetPathMode>(&operation.what)) {
    path_mode_ = *mode;
    add_line(path_mode_line(*mode, mode->tolerance));
  } else if (const auto* merge = std::get_if<operation::SetMergeTolerance>(&operation.what)) {
    if (merge->tolerance != path_mode_.tolerance) add_line(path_mode_line(path_mode_, merge->tolerance));
  } else if (auto line = plain_line_of(operation)) {
    if (!line->empty() && !is_off_already(*line)) add_line(std::move(*line));
  } else {
    refuse(operation, "level.cannot", "this cannot be written as moves that are levelled",
           "lines, arcs, cycles and what is between them; no probing, threads, taps, splines, inputs");
  }
  return !std::holds_alternative<operation::ProgramEnd>(operation.what) &&
         !std::holds_alternative<operation::Finish>(operation.what);
}

void Leveller::add(Item item) {
  if (item.is_move) {
    ++count_.moves_before;
    place_ = item.move.to;
    any_levelled_ = any_levelled_ || item.move.levelled;
    const LevelledMove& move = item.move;
    const bool goes_down = move.to[Axis::z] < move.from[Axis::z] || move.from_above;
    if (move.is_upright() && (goes_down || !run_.empty())) {
      run_.push_back(std::move(item));
      return;
    }
    emit_run();
    return emit(item);
  }
  if (run_.empty()) return emit(item);
  run_.push_back(std::move(item));
}

// A run that ends where its first feed began, or higher, is a hole. Below that its heights are those of the program. If
// nobody knows where it began, it is a hole if the tool comes up again.
void Leveller::emit_run(bool rises) {
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

void Leveller::finish() {
  end_cycle();
  emit_run();
}

void Leveller::emit(const Item& item) {
  if (item.is_move) return emit_move(item.move);
  code_.line(item.line);
}

// After a rapid that was not levelled: the whole way of this move is levelled, from its beginning.
void Leveller::begin_at_height(const LevelledMove& move) {
  const double height = move.from[Axis::z] + map_.height(move.from[Axis::x], move.from[Axis::y]);
  if (move.from_anywhere || move.from_above || std::abs(height - height_) < least_step) return;
  PlainMove plain{.rapid = move.rapid, .feed = move.feed, .to = move.from};
  plain.to[Axis::z] = height_ = height;
  code_.move(plain);
  ++count_.moves_after;
}

void Leveller::emit_move(const LevelledMove& move) {
  PlainMove plain{
      .rapid = move.rapid, .feed = move.feed, .named = move.named, .absolute = move.absolute, .to = move.to};
  const LevelPlace from = level_place(move.from);
  const LevelPlace to = level_place(move.to);
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
void Leveller::emit_arc_piece(const LevelledMove& move, double from_part, const LevelledPiece& piece) {
  const double sweep = move.sweep * (piece.part - from_part);
  const int turns = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / turn - 1e-9)));
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

LevelCount write_levelled_program(ProgramReader program, const InterpreterOptions& options, const HeightMap& map,
                                  const LevelOptions& wish, Diagnostics& diagnostics,
                                  const std::function<void(std::string_view)>& write) {
  const std::string file = program.name();
  Interpreter interpreter(std::move(program), options, diagnostics);
  Leveller leveller(interpreter, options, file, map, wish, diagnostics, write);
  Operation operation;
  while (!diagnostics.full() && interpreter.next(operation)) {
    if (!leveller.handle(operation)) break;
  }
  leveller.finish();
  return leveller.count();
}

}  // namespace passo
