#include "passo/path/path_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "path_sentences.hpp"
#include "spline_pieces.hpp"
#include "turn_scale.hpp"
#include <fmt/format.h>

#include "passo/geometry/plane_arc.hpp"
#include "passo/interpreter/plane_axes.hpp"

namespace passo {
namespace {

// A coordinate that changes by less than this (mm or degrees) did not change. Such changes are rounding errors of
// frames and inches.
constexpr double still = 1e-9;

// How far the curve of a program may be left in all where the path is exact: by pieces that stand for the curve, and by
// rounding their joints. The pieces take half.
constexpr Mm exact_tolerance{0.001};
constexpr double piece_share = 0.5;

// How far the pieces of a spline may leave it where the path is not exact: this share of its tolerance.
constexpr double spline_share = 0.1;
constexpr Mm least_spline_tolerance{1e-5};

// How far a merged line may leave the path if the program does not say: this share of the tolerance.
constexpr double merge_share = 0.05;

// The operations that add() ignores, because other parts of the program act on them. A new operation must be named
// here or handled in add(). Otherwise add() does not compile.
template <class What, class... Others>
inline constexpr bool is_one_of = (std::is_same_v<What, Others> || ...);
template <class What>
concept OfOthers =
    is_one_of<What, operation::SetWorkOffset, operation::SetG92Offset, operation::SetRotation, operation::SetToolOffset,
              operation::ReloadTools, operation::SelectPlane, operation::SelectTool, operation::StartToolChange,
              operation::SetToolTableEntry, operation::PalletShuttle, operation::SetFeedMode, operation::Finish,
              operation::TurnProbe, operation::Comment, operation::Message, operation::Print, operation::Log,
              operation::Reset, operation::SetFeedReference>;

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

PathBuilder::PathBuilder(Source<Operation>& operations, const PathOptions& options, Diagnostics& diagnostics,
                         const MachineResults& answers)
    : operations_(operations),
      options_(options),
      has_surfaces_(std::ranges::any_of(options.surface_radius.values, [](const auto& r) { return r.has_value(); })),
      diagnostics_(diagnostics),
      answers_(answers),
      spline_(std::make_unique<SplinePieces>()) {
  position_ = options.start;
  tolerance_ = options.tolerance;
  merge_ = options.tolerance * merge_share;
}

PathBuilder::~PathBuilder() = default;

bool PathBuilder::next(PathItem& item) {
  if (!held_.empty()) {
    item = held_.front();
    held_.pop_front();
    return true;
  }
  bool has_item = next_chord(item) || next_spline_piece(item) || next_probe_step(item) || next_tap_step(item) ||
                  next_end_step(item);
  while (!has_item && next_operation()) has_item = add(operation_, item);
  if (!has_item && !options_.open_ended) switch_off();
  // A change of the outputs, and the wait for the index, come before the item in hand. At the end of the operations
  // there is no item in hand.
  const bool switches = must_switch(has_item, item);
  if (outputs() != handed_on_) {
    in_step_ = false;
    speed_wait_.run_up_left = run_up_after(handed_on_);
    if (options_.awaits_spindle_speed) record_new_speed();
  }
  const bool awaits_index = has_item && must_await_index(item);
  const bool awaits_speed = has_item && must_await_speed(item);
  const bool awaits_run_up = has_item && must_await_run_up(item);
  if (!switches && !awaits_index && !awaits_speed && !awaits_run_up) return has_item;
  if (has_item) held_.push_back(item);
  if (awaits_index) held_.emplace_front(outputs_action(Action::Kind::await_index));
  if (awaits_speed) held_.emplace_front(outputs_action(Action::Kind::await_speed));
  if (awaits_run_up)
    held_.emplace_front(outputs_action(Action::Kind::dwell, std::exchange(speed_wait_.run_up_left, Seconds(0))));
  if (switches) held_.emplace_front(outputs_action());
  if (switches) in_motion_.hand_on();
  handed_on_ = outputs();
  return next(item);
}

// Some operations stand for several operations. These come before the next operation of the program.
bool PathBuilder::next_operation() {
  if (tap_step_ == tap_.size()) return operations_.next(operation_);
  operation_.what = tap_[tap_step_++];
  return true;
}

// Switches off what the program left on, wherever the program ends.
void PathBuilder::switch_off() {
  if (outputs() != OutputState{}) outputs_source_ = operation_.source;
  commanded_ = OutputState{};
  in_motion_.switch_off();
}

bool PathBuilder::add(const Operation& operation, PathItem& item) {
  hand_.watch(operation);
  if (frame_.follow(operation)) return false;
  const auto act = [&](Action::Kind kind, Seconds dwell = Seconds(0), std::int32_t tool = 0) {
    item = Action{
        .kind = kind, .dwell = dwell, .outputs = outputs(), .tool = tool, .heeds = heeds(), .source = operation.source};
    return true;
  };
  const auto change_tool = [&](std::int32_t tool, bool by_machine) {
    act(Action::Kind::tool_change, Seconds(0), tool);
    return std::get<Action>(item).by_machine = by_machine, true;
  };
  const auto set_output = [&](auto& output, auto value) {
    output = value;
    outputs_source_ = operation.source;
    return false;
  };
  return std::visit(
      Overloaded{
          [&](const operation::StraightTraverse& move) { return add_line(move.end, true, item); },
          [&](const operation::StraightFeed& move) { return add_line(move.end, false, item); },
          [&](const operation::StraightProbe& probe) { return add_probe(probe, item); },
          [&](const operation::ArcFeed& arc) { return add_arc(arc, item); },
          [&](const operation::NurbsFeed& curve) { return begin_spline(curve, item); },
          [&](const operation::SetLengthUnits& set) { return units_ = set.units, false; },
          [&](const operation::SetFeedRate& rate) { return feed_rate_ = rate, false; },
          [&](const operation::RigidTap& tap) { return begin_tap(tap, item); },
          [&](const operation::StartSpeedFeedSync& sync) { return synchronised_pitch_ = sync.pitch, false; },
          [&](const operation::StopSpeedFeedSync&) { return synchronised_pitch_.reset(), false; },
          [&](const operation::SetPathMode& mode) { return set_path_mode(mode), false; },
          [&](const operation::SetMergeTolerance& merge) { return set_merge_tolerance(merge.tolerance), false; },
          [&](const operation::SetFeedOverride& set) { return heeds_.feed_override = set.on, false; },
          [&](const operation::SetAdaptiveFeed& set) { return heeds_.adaptive_feed = set.on, false; },
          [&](const operation::SetFeedHold& set) { return heeds_.feed_hold = set.on, false; },
          [&](const operation::SetSpeedOverride& set) {
            if (set.spindle == 0) heeds_.spindle_override = set.on;
            return false;
          },
          [&](const operation::SetSpindleMode& mode) { return refuse_surface_speed(mode), false; },
          [&](const operation::OrientSpindle&) { return lacks(TorqueShortage::orientation), false; },
          [&](const operation::AwaitSpindle&) { return false; },  // already reported with OrientSpindle
          [&](const operation::SetDigitalOutput& set) { return set_digital(set); },
          [&](const operation::SetAnalogOutput& set) { return set_analog(set); },
          [&](const operation::UserCode&) { return lacks(TorqueShortage::user_codes), false; },
          [&](const operation::ReadInput& input) {
            lacks(TorqueShortage::inputs);
            return input.timeout > Seconds(0) && act(Action::Kind::dwell, input.timeout);
          },
          [&](const operation::SetSpindleSpeed& speed) {
            if (options_.outputs.laser) return set_power(speed.revolutions_per_minute);
            set_spindle_speed(speed.revolutions_per_minute);
            return set_output(commanded_.revolutions_per_minute, commanded_.revolutions_per_minute);
          },
          [&](const operation::TurnSpindle& turn) {
            if (!options_.outputs.laser) return set_output(commanded_.spindle, turn.direction);
            return in_motion_.turn_laser(turn.direction), false;
          },
          [&](const operation::SetMist& mist) { return set_output(commanded_.mist, mist.on); },
          [&](const operation::SetFlood& flood) { return set_output(commanded_.flood, flood.on); },
          [&](const operation::Dwell& dwell) { return act(Action::Kind::dwell, dwell.time); },
          [&](const operation::ChangeTool& change) { return change_tool(change.tool, change.by_machine); },
          [&](const operation::SetToolNumber& set) { return change_tool(set.tool, true); },  // it is in the spindle
          [&](const operation::ProgramStop&) { return act(Action::Kind::program_stop, Seconds(0), hand_.at_stop()); },
          [&](const operation::OptionalProgramStop&) { return act(Action::Kind::optional_stop); },
          [&](const operation::ProgramEnd&) {
            switch_off();
            end_step_ = EndStep::rise;
            return next_end_step(item);
          },
          []<OfOthers What>(const What&) { return false; },
      },
      operation.what);
}

bool PathBuilder::add_line(const Point& work_end, bool rapid, PathItem& item) {
  const Point end = machine_end(work_end);
  const SurfaceScale surface = surface_to(end, rapid);
  return add_curve(Curve::line(position_, end, surface), rapid, item, surface);
}

bool PathBuilder::add_probe(const operation::StraightProbe& probe, PathItem& item) {
  probe_step_ = ProbeStep::move;
  probe_end_ = probe.end;
  item = Action{.kind = Action::Kind::probe_begin,
                .outputs = outputs(),
                .probe_toward = probe.toward,
                .place = position_,
                .source = operation_.source};
  return true;
}

bool PathBuilder::next_probe_step(PathItem& item) {
  if (probe_step_ == ProbeStep::move) {
    probe_step_ = ProbeStep::end;
    const bool refused = answers_.probe() != nullptr && answers_.probe()->refused;
    if (!refused && add_line(probe_end_, false, item)) {
      std::get<Segment>(item).mode = PathMode::exact_stop;
      std::get<Segment>(item).outputs.power = 0;
      return true;
    }
  }
  if (probe_step_ == ProbeStep::end) {
    probe_step_ = ProbeStep::rest;
    item =
        Action{.kind = Action::Kind::probe_end, .outputs = outputs(), .place = position_, .source = operation_.source};
    return true;
  }
  if (probe_step_ == ProbeStep::rest && answers_.probe() != nullptr) position_ = answers_.probe()->rest;
  probe_step_ = ProbeStep::none;
  return false;
}

bool PathBuilder::next_end_step(PathItem& item) {
  const auto go = [&](const Point& end) { return add_curve(Curve::line(position_, end), true, item); };
  if (end_step_ == EndStep::rise) {
    end_step_ = EndStep::park;
    Point end = position_;
    end[Axis::z] = std::max(end[Axis::z], options_.end_height.value_or(end[Axis::z]));
    if (options_.end_height && go(end)) return true;
  }
  if (end_step_ == EndStep::park) {
    end_step_ = EndStep::end;
    Point end = position_;
    for (const Axis axis : {Axis::x, Axis::y}) end[axis] = options_.park ? (*options_.park)[axis] : end[axis];
    if (options_.park && go(end)) return true;
  }
  if (end_step_ != EndStep::end) return false;
  end_step_ = EndStep::none;
  item = Action{.kind = Action::Kind::program_end, .outputs = outputs(), .heeds = heeds(), .source = operation_.source};
  return true;
}

// Each thing that the machine lacks is reported once.
void PathBuilder::lacks(TorqueShortage what) {
  if (std::exchange(told_[static_cast<std::size_t>(what)], true)) return;
  switch (what) {
    case TorqueShortage::orientation:
      return report(Severity::error, "path.no-orientation", "the machine cannot turn its spindle to an angle (M19)",
                    "a program without M19");
    case TorqueShortage::outputs:
      return report(Severity::warning, "path.no-outputs", "the machine has no such output, so nothing is switched",
                    "a program without M62 to M65, M67 and M68");
    case TorqueShortage::inputs:
      return report(Severity::warning, "path.no-inputs",
                    "the machine has no inputs: reading one gives 0, and waiting for one lasts until the timeout",
                    "a program without M66");
    case TorqueShortage::user_codes:
      return report(Severity::warning, "path.no-user-codes", "user codes run no program, so nothing happens",
                    "a program without M100 to M199");
  }
}

void PathBuilder::refuse_surface_speed(const operation::SetSpindleMode& mode) {
  if (mode.surface_limit == 0) return;
  report(Severity::error, "path.no-surface-speed", "the machine cannot hold a constant surface speed (G96)",
         "G97 and S in rpm");
}

bool PathBuilder::add_arc(const operation::ArcFeed& arc, PathItem& item) {
  if (frame_.rotation_degrees() != 0 && arc.plane != Plane::xy) return add_tilted_arc(arc, item);
  const auto [first, second, normal] = axes_of(arc.plane);
  const Point end = machine_end(arc.end);
  Point work_center = arc.end;
  work_center[first] = arc.first_center.value();
  work_center[second] = arc.second_center.value();
  const Point center = frame_.machine_from_work(work_center);

  const double start_first = position_[first] - center[first];
  const double start_second = position_[second] - center[second];
  const double end_first = end[first] - center[first];
  const double end_second = end[second] - center[second];
  const double start_radius = std::hypot(start_first, start_second);
  const double end_radius = std::hypot(end_first, end_second);
  const SurfaceScale surface = surface_to(end, false);
  if (arc.turns == 0 || std::max(start_radius, end_radius) < still) {
    return add_curve(Curve::line(position_, end, surface), false, item, surface);
  }

  const double start_angle = std::atan2(start_second, start_first);
  const Curve::ArcData data{.first = first,
                            .second = second,
                            .first_center = center[first],
                            .second_center = center[second],
                            .start_radius = start_radius,
                            .end_radius = end_radius,
                            .start_angle = start_angle,
                            .sweep = sweep_between(start_angle, std::atan2(end_second, end_first), arc.turns)};
  return add_curve(Curve::arc(position_, end, data, surface), false, item, surface);
}

// In the work frame the arc lies in its plane. So the sweep is computed, and the arc is cut into chords, in the work
// frame.
bool PathBuilder::add_tilted_arc(const operation::ArcFeed& arc, PathItem& item) {
  const PlaneAxes axes = axes_of(arc.plane);
  const Point start = frame_.work_from_machine(position_);
  const double first_center = arc.first_center.value();
  const double second_center = arc.second_center.value();
  const auto angle_of = [&](const Point& point) {
    return std::atan2(point[axes.second] - second_center, point[axes.first] - first_center);
  };
  const double radius = std::hypot(start[axes.first] - first_center, start[axes.second] - second_center);
  if (arc.turns == 0 || radius < still) return add_line(arc.end, false, item);
  const double sweep = sweep_between(angle_of(start), angle_of(arc.end), arc.turns);
  // A chord of angle a leaves its arc by r (1 - cos(a/2)).
  const Mm allowed = tolerance_ > Mm(0) ? std::min(tolerance_, exact_tolerance) : exact_tolerance;
  piece_tolerance_ = allowed * piece_share;
  const double chord = 2 * std::acos(std::max(0.0, 1 - piece_tolerance_.value() / radius));
  const auto chords = static_cast<std::uint32_t>(std::ceil(std::abs(sweep) / chord));
  tilted_ = TiltedArc{.work = Curve::arc(start, arc.end, axes.first, axes.second, first_center, second_center, sweep),
                      .next = 0,
                      .chords = std::max(chords, 1U)};
  return next_chord(item);
}

bool PathBuilder::next_chord(PathItem& item) {
  while (tilted_) {
    TiltedArc& arc = *tilted_;
    ++arc.next;
    const bool last = arc.next == arc.chords;
    const Point end =
        last ? arc.work.end() : arc.work.at(arc.work.length() * (static_cast<double>(arc.next) / arc.chords));
    if (last) tilted_.reset();
    if (!add_line(end, false, item)) continue;
    be_piece(last, std::get<Segment>(item));
    return true;
  }
  return false;
}

// A frame is an affine map. So the converted spline is the spline of the converted control points.
bool PathBuilder::begin_spline(const operation::NurbsFeed& curve, PathItem& item) {
  const Point start = frame_.work_from_machine(position_);
  const auto machine_of = [&](const operation::ControlPoint& point) {
    Point work = start;
    work[Axis::x] = point.x;
    work[Axis::y] = point.y;
    return machine_end(work);
  };
  spline_->clear();
  for (const operation::ControlPoint& point : curve.points) {
    spline_->add(Vector3::of(machine_of(point)), point.weight);
  }
  piece_tolerance_ =
      tolerance_ > Mm(0) ? std::max(tolerance_ * spline_share, least_spline_tolerance) : exact_tolerance * piece_share;
  const auto error = spline_->begin(curve.order - 1, piece_tolerance_);
  if (!error) return next_spline_piece(item);
  report(Severity::error, "path.bad-spline", "this spline cannot be followed", error->message);
  position_ = machine_of(curve.points.back());
  return false;
}

// Where pieces of a curve meet, the curve goes on: the path does too, whatever the mode. What the pieces leave of the
// tolerance is for rounding.
void PathBuilder::be_piece(bool last, Segment& segment) const {
  const Mm allowed = tolerance_ > Mm(0) ? tolerance_ : exact_tolerance;
  segment.merge = Mm(0);
  segment.tolerance = std::max(allowed - piece_tolerance_, Mm(0));
  if (!last) segment.mode = PathMode::continuous;
}

bool PathBuilder::next_spline_piece(PathItem& item) {
  SplinePiece piece;
  while (spline_->next(piece)) {
    if (!add_curve(piece.curve_from(position_), false, item)) continue;
    be_piece(spline_->at_end(), std::get<Segment>(item));
    return true;
  }
  return false;
}

bool PathBuilder::add_curve(const Curve& curve, bool rapid, PathItem& item, const SurfaceScale& surface) {
  if (!curve.has_length()) return false;
  check_axes(curve);
  check_travel(curve);
  position_ = curve.end();
  const MmPerSecond speed = rapid ? MmPerSecond(std::numeric_limits<double>::infinity()) : feed_along(curve, surface);
  if (!rapid && lock() != SpindleLock::none) check_thread(curve, speed);
  item = Segment{.curve = curve,
                 .speed = speed,
                 .rapid = rapid,
                 .mode = path_mode_,
                 .tolerance = tolerance_,
                 .merge = merge_,
                 .turn_tolerance = tolerance_ > Mm(0) ? options_.turn_tolerance : 0,
                 .surface = surface,
                 .work_zero = frame_.work_zero(),
                 .heeds = heeds(),
                 .lock = rapid ? SpindleLock::none : lock(),
                 .pitch = pitch(),
                 .outputs = in_motion_.begin_segment(!rapid, options_.outputs.has_digital()),
                 .source = operation_.source};
  return true;
}

// An axis that does not move keeps its value bit for bit. The conversion by the frame could change its last bits.
// Angles have 52 bits, so that PathSmoother can measure them in other units and back without rounding (turn_scale.hpp).
Point PathBuilder::machine_end(const Point& work_end) const {
  Point end = frame_.machine_from_work(work_end);
  for (const Axis axis : all_axes) {
    if (is_rotary(axis)) end[axis] = with_52_bits(end[axis]);
    if (std::abs(end[axis] - position_[axis]) < still) end[axis] = position_[axis];
  }
  return end;
}

// G61 and G61.1 allow no deviation from the path, so the tolerance is 0.
void PathBuilder::set_path_mode(const operation::SetPathMode& mode) {
  path_mode_ = mode.mode;
  if (mode.mode != PathMode::continuous) {
    tolerance_ = Mm(0);
  } else {
    tolerance_ = mode.tolerance > Mm(0) ? mode.tolerance : options_.tolerance;
  }
  gives_tolerance_ = mode.tolerance > Mm(0);
  merge_ = tolerance_ * merge_share;
}

// For G64 P without Q the interpreter gives a merge tolerance of P, and for G64 alone 0. Neither is the program's own.
// Of the program's own merge tolerance at most half the path tolerance is used, so that something is left for the
// junctions.
void PathBuilder::set_merge_tolerance(Mm given) {
  const bool is_own = given < tolerance_ && gives_tolerance_;
  merge_ = is_own ? std::min(given, tolerance_ / 2) : tolerance_ * merge_share;
}

OutputState PathBuilder::outputs() const {
  OutputState state = commanded_;
  if (state.spindle == SpindleDirection::off) state.revolutions_per_minute = 0;
  return state;
}

// A thread heeds no factor on the feed and no feed hold.
OverridePermissions PathBuilder::heeds() const {
  if (!synchronised_pitch_) return heeds_;
  return {.feed_override = false,
          .spindle_override = heeds_.spindle_override && !options_.threads_hold_speed,
          .adaptive_feed = false,
          .feed_hold = false};
}

// A tap that does not follow the spindle through the reversal (expand()) is locked to the speed alone: its way down
// ends where the spindle is reversed.
SpindleLock PathBuilder::lock() const {
  if (synchronised_pitch_) return tap_step_ == tap_.size() ? SpindleLock::place : SpindleLock::speed;
  const bool is_per_revolution = std::holds_alternative<operation::FeedPerRevolution>(feed_rate_.feed);
  return is_per_revolution ? SpindleLock::speed : SpindleLock::none;
}

// Without a lock the pitch means nothing. It is the feed all the same: the fingerprints of kept journals count it.
Mm PathBuilder::pitch() const {
  if (synchronised_pitch_) return *synchronised_pitch_;
  return std::visit([](const auto& feed) { return Mm(feed.linear.value()); }, feed_rate_.feed);
}

Action PathBuilder::outputs_action(Action::Kind kind, Seconds dwell) const {
  Action action{
      .kind = kind, .dwell = dwell, .outputs = outputs(), .tool = 0, .heeds = heeds(), .source = outputs_source_};
  if (options_.outputs.has_digital()) action.switches = in_motion_.at_rest();
  return action;
}

void PathBuilder::report(Severity severity, std::string code, FindingWords message, FindingWords expected,
                         std::optional<Axis> axis) {
  WordPlace word = operation_.word;
  if (axis && operation_.axis_words != nullptr && (*operation_.axis_words)[*axis].column != 0) {
    word = (*operation_.axis_words)[*axis];
  }
  diagnostics_.add(
      {.severity = severity,
       .code = std::move(code),
       .file = operation_.file.empty() ? options_.file : std::string(operation_.file),
       .place = {.line = operation_.source.line, .column = word.column, .length = std::max(word.length, 1U)},
       .message = std::move(message),
       .expected = std::move(expected),
       .text = std::string(operation_.text)});
}

}  // namespace passo
