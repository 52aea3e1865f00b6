#include "passo/probing/levelled_program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "plain_code.hpp"

#include "passo/interpreter/frame.hpp"
#include "passo/levelling/levelled_move.hpp"

namespace passo {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double same_height = 1e-9;  // mm
// A piece of an arc that is shorter is written as a line: its ends might be one place as they are written.
constexpr double shortest_arc = 1e-3;  // mm

// A move as the program means it, in work coordinates.
struct Move {
  Point from;
  Point to;
  AxisSet named = {};  // axes that the program names
  bool rapid = false;
  bool levelled = true;
  bool is_first = false;  // nobody knows where it begins
  bool is_arc = false;    // about a centre in X and Y
  double center_x = 0;
  double center_y = 0;
  double sweep = 0;
  double feed = 0;  // mm/min
};

// What comes between moves: a line as it is. Or a move.
struct Item {
  std::string line;
  Move move;
  bool is_move = false;
};

LevelPlace level_place(const Point& place) {
  return {place[Axis::x], place[Axis::y], place[Axis::z]};
}

bool goes_straight_up_or_down(const Move& move) {
  for (const Axis axis : all_axes) {
    if (axis != Axis::z && move.from[axis] != move.to[axis]) return false;
  }
  return !move.is_arc;
}

double sweep_of(double start_angle, double end_angle, std::int32_t turns) {
  double sweep = std::fmod((end_angle - start_angle) * (turns > 0 ? 1 : -1), turn);
  if (sweep < 1e-12) sweep += turn;
  sweep += turn * (std::abs(turns) - 1);
  return turns > 0 ? sweep : -sweep;
}

class Leveller {
 public:
  Leveller(const InterpreterOptions& options, const std::string& file, const HeightMap& map, const LevelOptions& wish,
           Diagnostics& diagnostics, const std::function<void(std::string_view)>& write)
      : map_(map),
        wish_(wish),
        diagnostics_(diagnostics),
        file_(file),
        code_(write),
        highest_(map.highest()),
        place_(options.start),
        height_(options.start[Axis::z]) {}

  // False: the program ends here.
  bool take(const Operation& operation);
  void finish();
  const LevelCount& count() const { return count_; }

 private:
  void take_straight(const Operation& operation, const Point& end, bool rapid);
  void take_arc(const Operation& operation, const operation::ArcFeed& arc);
  void take_upright_arc(const Operation& operation, const operation::ArcFeed& arc);
  bool follow_frame(const Operation& operation);
  void write_frame(const Operation& operation, const Frame& before);
  Move move_to(const Operation& operation, const Point& end, bool rapid) const;
  void refuse(const Operation& operation, std::string code, std::string message, std::string expected);
  void look_beside(const Operation& operation, const Point& end);

  void add(Item item);
  void add_line(std::string line) { add({.line = std::move(line), .move = {}}); }
  void give_run();
  void give(const Item& item);
  void give_move(const Move& move);
  void give_arc_piece(const Move& move, double from_part, const LevelledPiece& piece);

  const HeightMap& map_;
  const LevelOptions& wish_;
  Diagnostics& diagnostics_;
  const std::string& file_;
  PlainCode code_;
  double highest_;
  Frame frame_;
  bool is_reset_ = false;
  bool selects_ = false;  // the operation before has selected a work system
  Point place_;           // where the program is, work coordinates
  bool is_known_ = false;
  double height_;  // Z where the levelled program is
  double feed_ = 0;
  double rotary_feed_ = 0;
  operation::SetPathMode path_mode_;
  // Moves straight up and down, and what is between them, until it is known whether they are a hole.
  std::vector<Item> run_;
  LevelCount count_;
};

void Leveller::refuse(const Operation& operation, std::string code, std::string message, std::string expected) {
  diagnostics_.add({.code = std::move(code),
                    .file = operation.file.empty() ? file_ : std::string(operation.file),
                    .place = {.line = operation.source.line,
                              .column = operation.word.column,
                              .length = std::max<std::uint32_t>(1, operation.word.length)},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(operation.text)});
}

void Leveller::look_beside(const Operation& operation, const Point& end) {
  const double beside = map_.distance_beside(end[Axis::x], end[Axis::y]);
  if (beside <= wish_.beside) return;
  refuse(operation, "level.beside",
         fmt::format("X{:.3f} Y{:.3f} is {:.3f} mm beside the height map", end[Axis::x], end[Axis::y], beside),
         fmt::format("a map that covers all that is milled, or at most {:g} mm beside it", wish_.beside));
}

Move Leveller::move_to(const Operation& operation, const Point& end, bool rapid) const {
  Move move{.from = place_, .to = end, .rapid = rapid};
  for (const Axis axis : all_axes) {
    if (operation.axis_words != nullptr && (*operation.axis_words)[axis].column != 0) move.named.add(axis);
  }
  // Nothing is in the way of a rapid that is high enough all its way. Before the first move nobody knows where it
  // begins.
  const bool ends_clear = rapid && end[Axis::z] >= highest_ + wish_.clear;
  const bool is_clear =
      ends_clear && (!is_known_ || place_[Axis::z] >= highest_ + wish_.clear || goes_straight_up_or_down(move));
  move.levelled = !is_clear && !names_machine_place(operation.text);
  bool is_rotary_only = true;
  for (const Axis axis : all_axes) is_rotary_only = is_rotary_only && (is_rotary(axis) || end[axis] == place_[axis]);
  move.feed = is_rotary_only && end != place_ ? rotary_feed_ : feed_;
  return move;
}

void Leveller::take_straight(const Operation& operation, const Point& end, bool rapid) {
  if (!rapid) look_beside(operation, end);
  add({.line = {}, .move = move_to(operation, end, rapid), .is_move = true});
}

void Leveller::take_arc(const Operation& operation, const operation::ArcFeed& arc) {
  if (arc.plane != Plane::xy) return take_upright_arc(operation, arc);
  look_beside(operation, arc.end);
  Move move = move_to(operation, arc.end, false);
  move.is_arc = true;
  move.center_x = arc.first_center.value();
  move.center_y = arc.second_center.value();
  move.sweep = sweep_of(std::atan2(place_[Axis::y] - move.center_y, place_[Axis::x] - move.center_x),
                        std::atan2(arc.end[Axis::y] - move.center_y, arc.end[Axis::x] - move.center_x), arc.turns);
  add({.line = {}, .move = move, .is_move = true});
}

// On a surface that is not flat, an arc of the planes ZX and YZ is no arc any more: it becomes chords.
void Leveller::take_upright_arc(const Operation& operation, const operation::ArcFeed& arc) {
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
    take_straight(operation, i == chords ? arc.end : end, false);
  }
}

// True: the operation is about the frame, and is done.
bool Leveller::follow_frame(const Operation& operation) {
  const Frame before = frame_;
  if (!frame_.follow(operation)) return false;
  if (is_reset_) write_frame(operation, before);
  give_run();
  const Point after = frame_.work_from_machine(before.machine_from_work(place_));
  height_ += after[Axis::z] - place_[Axis::z];
  place_ = after;
  Point stands = place_;
  stands[Axis::z] = height_;
  code_.stand_at(stands);
  return true;
}

void Leveller::write_frame(const Operation& operation, const Frame& before) {
  if (std::holds_alternative<operation::SetToolOffset>(operation.what)) {
    if (auto words = tool_offset_words(operation.text, frame_.tool_offset())) return add_line(std::move(*words));
    return refuse(operation, "level.cannot", "this tool offset cannot be written again",
                  "G43, G43 H with a number, G43.1, or G49");
  }
  if (frame_.work_system() != before.work_system()) {
    selects_ = true;  // its rotation comes next
    return add_line(code_of_system(frame_.work_system()));
  }
  const bool turns = frame_.rotation_degrees() != before.rotation_degrees();
  const bool changes = frame_.work_offset() != before.work_offset() || frame_.g92_offset() != before.g92_offset();
  if (changes || (turns && !selects_)) {
    refuse(operation, "level.offset", "the program changes the zero of its work itself",
           "offsets that are set before the program (G54 and others)");
  }
}

bool Leveller::take(const Operation& operation) {
  if (std::holds_alternative<operation::Reset>(operation.what) && !is_reset_) {
    is_reset_ = true;
    add_line("G17 G21 G40 G49 G80 G90 G94 " + code_of_system(frame_.work_system()));
    return true;
  }
  if (follow_frame(operation)) return true;
  selects_ = false;
  if (const auto* rapid = std::get_if<operation::StraightTraverse>(&operation.what)) {
    take_straight(operation, rapid->end, true);
  } else if (const auto* feed = std::get_if<operation::StraightFeed>(&operation.what)) {
    take_straight(operation, feed->end, false);
  } else if (const auto* arc = std::get_if<operation::ArcFeed>(&operation.what)) {
    take_arc(operation, *arc);
  } else if (const auto* rate = std::get_if<operation::SetFeedRate>(&operation.what)) {
    feed_ = rate->rate * 60;
    rotary_feed_ = rate->rotary_rate * 60;
  } else if (const auto* mode = std::get_if<operation::SetPathMode>(&operation.what)) {
    path_mode_ = *mode;
    add_line(path_mode_line(*mode, mode->tolerance));
  } else if (const auto* merge = std::get_if<operation::SetMergeTolerance>(&operation.what)) {
    if (merge->tolerance != path_mode_.tolerance) add_line(path_mode_line(path_mode_, merge->tolerance));
  } else if (auto line = plain_line_of(operation)) {
    if (!line->empty()) add_line(std::move(*line));
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
    item.move.is_first = !std::exchange(is_known_, true);
    place_ = item.move.to;
    const bool is_upright = goes_straight_up_or_down(item.move);
    const bool begins = run_.empty() && is_upright && item.move.to[Axis::z] < item.move.from[Axis::z];
    if (begins || (!run_.empty() && is_upright)) {
      run_.push_back(std::move(item));
      return;
    }
    give_run();
    return give(item);
  }
  if (run_.empty()) return give(item);
  run_.push_back(std::move(item));
}

// A run that ends where its first feed began, or higher, is a hole. Below that its heights are those of the program.
void Leveller::give_run() {
  if (run_.empty()) return;
  const auto feed = std::ranges::find_if(run_, [](const Item& item) { return item.is_move && !item.move.rapid; });
  const double top = feed != run_.end() ? feed->move.from[Axis::z] : 0;
  double end = top;
  for (const Item& item : run_) end = item.is_move ? item.move.to[Axis::z] : end;
  const bool is_hole = !wish_.holes && feed != run_.end() && end >= top - same_height;
  if (is_hole) ++count_.holes;
  for (Item& item : run_) {
    if (is_hole && item.move.to[Axis::z] < top - same_height) item.move.levelled = false;
    give(item);
  }
  run_.clear();
}

void Leveller::finish() {
  give_run();
}

void Leveller::give(const Item& item) {
  if (item.is_move) return give_move(item.move);
  code_.line(item.line);
}

void Leveller::give_move(const Move& move) {
  PlainMove plain{.rapid = move.rapid, .feed = move.feed, .named = move.named, .to = move.to};
  const LevelPlace from = level_place(move.from);
  const LevelPlace to = level_place(move.to);
  if (!move.levelled || (move.is_first && !move.is_arc)) {
    plain.to[Axis::z] = move.levelled ? to.z + map_.height(to.x, to.y) : to.z;
    code_.move(plain);
    ++count_.moves_after;
    height_ = plain.to[Axis::z];
    return;
  }
  const auto pieces = move.is_arc ? level_arc(map_, from, to, move.center_x, move.center_y, move.sweep, wish_.tolerance)
                                  : level_line(map_, from, to, wish_.tolerance);
  double part = 0;
  for (const LevelledPiece& piece : pieces) {
    if (move.is_arc) {
      give_arc_piece(move, part, piece);
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
void Leveller::give_arc_piece(const Move& move, double from_part, const LevelledPiece& piece) {
  const double sweep = move.sweep * (piece.part - from_part);
  const int turns = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / turn - 1e-9)));
  const double start_radius = std::hypot(move.from[Axis::x] - move.center_x, move.from[Axis::y] - move.center_y);
  const double end_radius = std::hypot(move.to[Axis::x] - move.center_x, move.to[Axis::y] - move.center_y);
  const double start_angle = std::atan2(move.from[Axis::y] - move.center_y, move.from[Axis::x] - move.center_x);
  const double from_height = height_;
  for (int i = 1; i <= turns; ++i) {
    const double share = static_cast<double>(i) / turns;
    const double part = from_part + (piece.part - from_part) * share;
    PlainMove plain{.rapid = false, .feed = move.feed, .named = move.named, .to = move.to};
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

}  // namespace

LevelCount write_levelled_program(ProgramReader program, const InterpreterOptions& options, const HeightMap& map,
                                  const LevelOptions& wish, Diagnostics& diagnostics,
                                  const std::function<void(std::string_view)>& write) {
  const std::string file = program.name();
  Interpreter interpreter(std::move(program), options, diagnostics);
  Leveller leveller(options, file, map, wish, diagnostics, write);
  Operation operation;
  while (!diagnostics.full() && interpreter.next(operation)) {
    if (!leveller.take(operation)) break;
  }
  leveller.finish();
  return leveller.count();
}

}  // namespace passo
