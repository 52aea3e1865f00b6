#include "passo/probing/levelled_program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "leveller.hpp"

#include "passo/interpreter/is_any_of.hpp"

namespace passo {
namespace {

double sweep_of(double start_angle, double end_angle, std::int32_t turns) {
  double sweep = std::fmod((end_angle - start_angle) * (turns > 0 ? 1 : -1), full_turn);
  if (sweep < 0) sweep += full_turn;
  if (sweep < 1e-12) sweep += full_turn;
  sweep += full_turn * (std::abs(turns) - 1);
  return turns > 0 ? sweep : -sweep;
}

}  // namespace

Leveller::Leveller(Interpreter& interpreter, const InterpreterOptions& options, const std::string& file,
                   const HeightMap& map, const LevelOptions& wish, Diagnostics& diagnostics,
                   const std::function<void(std::string_view)>& write)
    : blocks_(interpreter),
      map_(map),
      wish_(wish),
      diagnostics_(diagnostics),
      file_(file),
      writer_(map, wish, options.start[Axis::z], write),
      machine_unit_(options.machine_units == LengthUnits::inch ? 25.4 : 1),
      has_tools_(!options.tools.name.empty()),
      place_(options.start) {}

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
         fmt::format("X{:.3f} Y{:.3f} is {:.3f} mm outside the height map", end[Axis::x], end[Axis::y], beside),
         fmt::format("a map that covers the whole milled area, or moves at most {:g} mm outside it", wish_.beside));
}

double Leveller::feed_of(const Point& end) const {
  bool is_rotary_only = true;
  for (const Axis axis : all_axes)
    is_rotary_only = is_rotary_only && (is_rotary(axis) || is_same_place(end[axis], place_[axis]));
  const bool is_rotary_feed = is_rotary_only && !is_same_place(end, place_);
  return (is_rotary_feed ? feed_.rotary : feed_.linear.value()) * seconds_per_minute;
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
    move.from_anywhere = move.from_anywhere || (move.absolute.has(axis) && !said_.has(axis));
  }
  const bool is_of_machine = said_.height() == LevelHeight::of_machine;
  const bool names_height = move.absolute.has(Axis::z) || !is_same_place(end[Axis::z], place_[Axis::z]);
  move.from_above = said_.height() != LevelHeight::known && move.absolute.has(Axis::z);
  // Nothing is in the way of a rapid that is high enough all its way.
  const double clear = writer_.highest() + wish_.clear;
  const bool is_clear =
      rapid && end[Axis::z] >= clear && (is_of_machine || place_[Axis::z] >= clear || move.is_upright());
  move.levelled = !is_clear && (names_height || !is_of_machine);
  if (!rapid && !move.levelled && !std::exchange(told_height_, true)) {
    report(operation, Severity::warning, "level.height",
           "the height map is not applied to this feed move, because the program has not set a work Z yet",
           "first a move to a Z in work coordinates");
  }
  const bool is_assumed = !move.from_anywhere && (!said_.has(Axis::x) || !said_.has(Axis::y));
  if (move.levelled && is_assumed && !std::exchange(told_place_, true)) {
    report(
        operation, Severity::warning, "level.place",
        fmt::format("the program has not set work X and Y yet; X{:.3f} Y{:.3f} is assumed", end[Axis::x], end[Axis::y]),
        "first a move to X and Y in work coordinates");
  }
  move.is_new_place = !said_.has_all(move.absolute);
  said_.note_move(move.absolute, names_height);
  return move;
}

void Leveller::handle_straight(const Operation& operation, const Point& end, bool rapid) {
  const LevelledMove move = move_to(operation, end, rapid);
  if (is_same_place(move.from, move.to) && !move.is_new_place) return;
  if (!rapid && move.levelled) check_lead(operation, end);
  writer_.add(move);
  place_ = move.to;
}

void Leveller::handle_arc(const Operation& operation, const operation::ArcFeed& arc) {
  if (arc.plane != Plane::xy) return handle_upright_arc(operation, arc);
  LevelledMove move = move_to(operation, arc.end, false);
  if (move.levelled) check_lead(operation, arc.end);
  if (move.from_above && std::abs(arc.turns) > 1) {
    refuse(operation, "level.height", "a helix of several turns starts at a height that the program has not set",
           "first a move to a Z");
  }
  move.is_arc = true;
  move.center_x = arc.first_center.value();
  move.center_y = arc.second_center.value();
  move.sweep = sweep_of(std::atan2(place_[Axis::y] - move.center_y, place_[Axis::x] - move.center_x),
                        std::atan2(arc.end[Axis::y] - move.center_y, arc.end[Axis::x] - move.center_x), arc.turns);
  writer_.add(move);
  place_ = move.to;
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

bool Leveller::handle(const Operation& operation) {
  if (cycle_.block != blocks_.last().number) end_cycle();
  for (const FrameBlock& block : blocks_.take_executed()) read_block(block);
  if (std::holds_alternative<operation::Reset>(operation.what) && !is_reset_) {
    is_reset_ = true;
    writer_.add_line("G17 G21 G40 G80 G90 G94");
    return true;
  }
  if (keeps_cycle(operation)) return true;
  if (follow_frame(operation)) return true;
  if (is_any_of<operation::StraightTraverse, operation::StraightFeed, operation::ArcFeed>(operation)) {
    handle_move(operation);
  } else if (const auto* rate = std::get_if<operation::SetFeedRate>(&operation.what)) {
    // G95 was refused.
    if (const auto* feed = std::get_if<operation::FeedPerSecond>(&rate->feed)) feed_ = *feed;
  } else if (const auto* mode = std::get_if<operation::SetPathMode>(&operation.what)) {
    path_mode_ = *mode;
    writer_.add_line(path_mode_line(*mode, mode->tolerance));
  } else if (const auto* merge = std::get_if<operation::SetMergeTolerance>(&operation.what)) {
    if (merge->tolerance != path_mode_.tolerance) writer_.add_line(path_mode_line(path_mode_, merge->tolerance));
  } else if (auto line = plain_line_of(operation)) {
    if (!line->empty() && !off_codes_.is_off_already(*line)) writer_.add_line(std::move(*line));
  } else {
    refuse(operation, "level.cannot", "the height map cannot be applied to this operation",
           "lines, arcs and canned cycles; no probing, threading, tapping, splines or inputs");
  }
  return !std::holds_alternative<operation::ProgramEnd>(operation.what) &&
         !std::holds_alternative<operation::Finish>(operation.what);
}

void Leveller::finish() {
  end_cycle();
  writer_.end_run();
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
