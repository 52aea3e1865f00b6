#include "passo/interpreter/explain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "block_in_words.hpp"
#include "block_watcher.hpp"
#include <fmt/format.h>

#include "passo/geometry/curve.hpp"
#include "passo/geometry/nurbs.hpp"
#include "passo/geometry/plane_arc.hpp"
#include "passo/interpreter/canon.hpp"
#include "passo/interpreter/plane_axes.hpp"

namespace passo {
namespace {

// mm. The tool may be on the rotation axis, where the surface stands still.
constexpr double least_radius = 0.01;

double length_of_arc(const Point& start, const operation::ArcFeed& arc, const SurfaceScale& surface) {
  const auto [first, second, normal] = axes_of(arc.plane);
  const double center_first = arc.first_center.value();
  const double center_second = arc.second_center.value();
  if (arc.turns == 0) return Curve::line(start, arc.end, surface).length().value();
  const double sweep =
      sweep_between(std::atan2(start[second] - center_second, start[first] - center_first),
                    std::atan2(arc.end[second] - center_second, arc.end[first] - center_first), arc.turns);
  const Curve::ArcData along = Curve::arc(start, arc.end, first, second, center_first, center_second, sweep).arc_data();
  return Curve::arc(start, arc.end, along, surface).length().value();
}

// Measured along so many chords that no digit which is shown is wrong.
double length_of_spline(const operation::NurbsFeed& spline) {
  constexpr int chords = 10'000;
  Nurbs::Definition definition{.degree = spline.order - 1};
  for (const operation::ControlPoint& point : spline.points) {
    definition.control.push_back({point.x, point.y, 0});
    definition.weights.push_back(point.weight);
  }
  const Result<Nurbs, CurveError> curve = Nurbs::create(std::move(definition));
  if (!curve) return 0;
  const auto [from, to] = curve->range();
  double way = 0;
  Vector3 before = curve->at(from);
  for (int i = 1; i <= chords; ++i) {
    const Vector3 at = curve->at(from + (to - from) * i / chords);
    way += length(at - before);
    before = at;
  }
  return way;
}

// Fills in the explanations of the lines of a range while the program runs.
class Explainer final : public BlockWatcher {
 public:
  Explainer(std::string file, LineRange range, const ExplainedMachine& machine, Explanations& result)
      : file_(std::move(file)), range_(range), machine_(machine), result_(result), unseen_(result.lines.size()) {}

  void before(const Block& block, std::string_view file, const ProgramState& state, const Parameters& parameters,
              const SymbolTable& symbols) override {
    current_ = nullptr;
    if (block.line < range_.first || block.line - range_.first >= result_.lines.size() || file != file_) return;
    Explanation& line = result_.lines[block.line - range_.first];
    if (++line.executions > 1) return;
    if (unseen_ > 0) --unseen_;
    current_ = &line;
    state_before_ = state;
    words_ = word_values(block, parameters, symbols);
    line.before = {state.position, state.machine_position()};
    place_ = state.position;
  }

  void after(const ProgramState& state) override {
    if (current_ == nullptr) return;
    current_->after = {state.position, state.machine_position()};
    current_->words = words_in_words(words_, state_before_, state);
    current_->modes = modes_in_words(state_before_, state);
    for (Explanation::Mode& mode : current_->modes) {
      if (mode.code == "G64" && machine_.angle_tolerance) {
        mode.meaning += fmt::format(", A B C within {:g} degrees", *machine_.angle_tolerance);
      }
    }
  }

  // Follows the feed of the whole program, and the moves of the current block.
  void follow(const Operation& operation) {
    using namespace passo::operation;
    const OperationKind& what = operation.what;
    if (const auto* rate = std::get_if<SetFeedRate>(&what)) feed_ = rate->feed;
    if (const auto* speed = std::get_if<SetSpindleSpeed>(&what)) spindle_speed_ = speed->revolutions_per_minute;
    if (const auto* sync = std::get_if<StartSpeedFeedSync>(&what)) pitch_ = sync->pitch.value();
    if (std::holds_alternative<StopSpeedFeedSync>(what)) pitch_.reset();
    if (current_ == nullptr) return;
    if (const auto* move = std::get_if<StraightTraverse>(&what)) rapid(move->end);
    if (const auto* move = std::get_if<StraightFeed>(&what)) line(move->end);
    if (const auto* move = std::get_if<StraightProbe>(&what)) line(move->end);
    if (const auto* arc = std::get_if<ArcFeed>(&what)) {
      const SurfaceScale surface = surface_to(arc->end);
      feed({.length = length_of_arc(place_, *arc, surface), .timed = length_of_arc(place_, *arc, {})}, arc->end);
    }
    if (const auto* curve = std::get_if<NurbsFeed>(&what)) spline(*curve);
    if (const auto* tap = std::get_if<RigidTap>(&what)) {
      const Point start = place_;
      line(tap->end);
      line(start);
    }
  }

  // The operations of a block come after the block was executed, and before the next block is.
  void add(std::string operation) {
    if (current_ != nullptr) current_->operations.push_back(std::move(operation));
  }
  bool all_seen() const { return unseen_ == 0; }

 private:
  void rapid(const Point& end) {
    current_->moves.rapid_length += Curve::line(place_, end).length().value();
    place_ = end;
  }
  void line(const Point& end) {
    bool turns_only = true;
    for (const Axis axis : all_axes) turns_only &= is_rotary(axis) || end[axis] == place_[axis];
    const SurfaceScale surface = surface_to(end);
    feed({.length = Curve::line(place_, end, surface).length().value(),
          .timed = Curve::line(place_, end).length().value(),
          .turns_only = turns_only,
          .in_degrees = turns_only && !(surface.square_of(end - place_) > 0)},
         end);
  }
  // The end of a spline is its last control point.
  void spline(const operation::NurbsFeed& curve) {
    Point end = place_;
    end[Axis::x] = curve.points.back().x;
    end[Axis::y] = curve.points.back().y;
    const double length = length_of_spline(curve);
    feed({.length = length, .timed = length}, end);
  }
  // Threads keep to their pitch along X, Y and Z.
  SurfaceScale surface_to(const Point& end) {
    SurfaceScale scale;
    for (const Axis axis : {Axis::a, Axis::b, Axis::c}) {
      const std::optional<Mm>& given = machine_.surface_radius[axis];
      if (!given || pitch_ || end[axis] == place_[axis]) continue;
      double radius = given->value();
      if (radius == 0) radius = (std::abs(place_[Axis::z]) + std::abs(end[Axis::z])) / 2;
      radius = std::max(radius, least_radius);
      scale[axis] = radius * std::numbers::pi / 180;
      current_->moves.surface_radius[axis] = radius;
    }
    return scale;
  }
  struct FeedMove {
    double length = 0;  // mm or degrees; with the surfaces
    double timed = 0;   // the same without the surfaces, to which inverse time applies
    bool turns_only = false;
    bool in_degrees = false;
  };
  void feed(const FeedMove& move, const Point& end) {
    Explanation::Moves& moves = current_->moves;
    moves.feed_length += move.length;
    moves.in_degrees = move.in_degrees;
    place_ = end;
    const auto* per_turn = std::get_if<operation::FeedPerRevolution>(&feed_);
    const auto* timed = std::get_if<operation::FeedPerSecond>(&feed_);
    const bool by_time = timed != nullptr && timed->by_time;
    const bool rotary = by_time ? move.turns_only : move.in_degrees;
    double rate = std::visit([&](const auto& feed) { return rotary ? feed.rotary : feed.linear.value(); }, feed_);
    if (pitch_ || per_turn != nullptr) rate = pitch_.value_or(rate) * spindle_speed_ / seconds_per_minute;
    const double length = by_time ? move.timed : move.length;
    if (rate > 0 && moves.feed_time) {
      *moves.feed_time += length / rate;
    } else if (length > 0) {
      moves.feed_time.reset();
    }
  }

  std::string file_;
  LineRange range_;
  const ExplainedMachine& machine_;
  Explanations& result_;
  std::variant<operation::FeedPerSecond, operation::FeedPerRevolution> feed_;
  std::optional<double> pitch_;
  double spindle_speed_ = 0;
  Point place_;  // work coordinates, after the operations so far
  std::size_t unseen_;
  Explanation* current_ = nullptr;
  ProgramState state_before_;
  std::vector<WordValue> words_;
};

// Reads the lines as they are in the file, and counts them.
void read_lines(ProgramReader reader, LineRange range, Explanations& result) {
  Diagnostics ignored;  // the run reports them
  std::string_view text;
  std::uint32_t line = 0;
  while (reader.next_line(text, line, ignored)) {
    // The reader skips a line that cannot be read. Such a line has no text.
    for (std::uint32_t missing = result.lines_in_file + 1; missing <= line; ++missing) {
      if (missing < range.first || missing > range.last) continue;
      Explanation& explanation = result.lines.emplace_back();
      explanation.line = missing;
      if (missing == line) explanation.text = text;
    }
    result.lines_in_file = line;
  }
}

// Without the counter and the N column.
std::string call_alone(const std::string& printed) {
  constexpr std::size_t head = 13;
  const bool counted = printed.size() > head && printed[5] == ' ' && printed[6] == 'N';
  std::string call = counted ? printed.substr(head) : printed;
  if (!call.empty() && call.back() == '\n') call.pop_back();
  return call;
}

}  // namespace

Explanations explain(ProgramReader program, const InterpreterOptions& options, LineRange range,
                     Diagnostics& diagnostics, const ExplainLimits& limits, const ExplainedMachine& machine) {
  Explanations result;
  const std::string file = program.name();
  read_lines(program.again(), range, result);
  Explainer explainer(file, range, machine, result);
  Interpreter interpreter(std::move(program), options, diagnostics);
  interpreter.watch(explainer);

  CanonPrinter printer;
  Operation operation;
  std::string printed;
  std::uint64_t left = limits.operations;
  bool counting = false;
  while (interpreter.next(operation)) {
    explainer.follow(operation);
    printed.clear();
    printer.print(operation, printed);
    // Resets belong to no block: they open and close the program.
    if (!std::holds_alternative<operation::Reset>(operation.what)) explainer.add(call_alone(printed));
    if (!counting && explainer.all_seen()) {
      counting = true;
      left = std::min(left, limits.further_operations);
    }
    if (--left == 0) {
      result.whole_run = false;
      break;
    }
  }
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.file != file || finding.place.line < range.first) continue;
    if (finding.place.line - range.first >= result.lines.size()) continue;
    result.lines[finding.place.line - range.first].findings.push_back(finding);
  }
  return result;
}

}  // namespace passo
