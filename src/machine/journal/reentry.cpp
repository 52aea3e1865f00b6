#include "passo/journal/reentry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "path_of_program.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/path/run_up.hpp"

namespace passo {
namespace {

// For a way down where the program has fed nothing yet.
constexpr MmPerSecond careful_feed{2};

// By how much a switch may close elsewhere the next time, mm or degrees.
constexpr double repeatable_within = 0.05;
// A motor that gets its current again turns to the nearest place where the driver's field holds it: with 32
// microsteps, 64 of them.
constexpr double steps_to_the_field = 64;

// What is known of the lines of a program from its path: before it is smoothed, and after. Each time that the path
// comes to a line is a visit. The smoother merges lines that go straight on, and the merged one has the mark of the
// first: so visits, and not lines, are the marks.
class VisitsOfLines {
 public:
  void note_other_file(std::uint32_t line) { in_other_files_.insert(line); }
  // Puts the number of the visit in the place of the line.
  void mark(PathItem& item) {
    const auto* action = std::get_if<Action>(&item);
    probes_ = probes_ || (action != nullptr && action->kind == Action::Kind::probe_end);
    if (action != nullptr) return;
    std::uint32_t& line = std::get<Segment>(item).source.line;
    if (visits_.empty() || visits_.back().line != line) visits_.push_back({.line = line, .is_after_probe = probes_});
    line = static_cast<std::uint32_t>(visits_.size() - 1);
  }
  void note_smoothed(const PathItem& item, std::uint64_t number) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment == nullptr) return;
    Visit& here = visits_[segment->source.line];
    here.item = std::min(here.item, number);
  }

  // Where the motion of this line begins, or that of the next line with motion. If that visit was merged, where the
  // merged one begins.
  Result<PathPosition, LineProblem> find(std::uint32_t line, std::uint32_t pass) const {
    std::uint32_t next = UINT32_MAX;
    for (const Visit& visit : visits_) {
      if (visit.line >= line) next = std::min(next, visit.line);
    }
    if (next == UINT32_MAX) return Failure{LineProblem{ReentryRefusal::no_motion}};
    if (in_other_files_.contains(next)) return Failure{LineProblem{ReentryRefusal::other_file}};
    std::uint32_t times = 0;
    std::size_t chosen = visits_.size();
    for (std::size_t i = 0; i < visits_.size(); ++i) {
      if (visits_[i].line == next && ++times == std::max(pass, 1U)) chosen = i;
    }
    if (pass == 0 && times > 1) return Failure{LineProblem{ReentryRefusal::done_often, times}};
    if (pass > times) return Failure{LineProblem{ReentryRefusal::no_pass, times}};
    return begin_of(chosen);
  }

 private:
  static constexpr std::uint64_t none = UINT64_MAX;
  struct Visit {
    std::uint64_t item = none;  // of the smoothed path
    std::uint32_t line = 0;
    bool is_after_probe = false;
  };
  Result<PathPosition, LineProblem> begin_of(std::size_t visit) const {
    for (;; --visit) {
      if (visits_[visit].is_after_probe) return Failure{LineProblem{ReentryRefusal::after_probe}};
      if (visits_[visit].item != none) return PathPosition{.item = visits_[visit].item};
      if (visit == 0) return Failure{LineProblem{ReentryRefusal::path_changed}};
    }
  }

  std::vector<Visit> visits_;
  std::set<std::uint32_t> in_other_files_;
  bool probes_ = false;
};

// The place so much farther along the path. What a probe move finds is not known.
Result<PathPosition, LineProblem> farther(const ProgramReader& program, const MachineDescription& machine,
                                          const InterpreterOptions& options, const PathPosition& from, Mm after) {
  if (after <= Mm(0)) return from;
  PathOfProgram chain(program.again(), machine, options);
  RewindablePath& path = chain.path();
  path.begin_at(from);
  path.forget_passed();
  PathItem item;
  for (std::uint64_t number = from.item; path.next(item); ++number) {
    if (const auto* action = std::get_if<Action>(&item)) {
      if (action->kind == Action::Kind::probe_begin) return Failure{LineProblem{ReentryRefusal::after_probe}};
      continue;
    }
    const Mm length = std::get<Segment>(item).curve.length();
    if (after < length) return PathPosition{.item = number, .s = after};
    after -= length;
  }
  return Failure{LineProblem{ReentryRefusal::beyond_end}};
}

std::string place_words(const MachineDescription& machine, const Point& place, bool with_z) {
  std::string words;
  for (const AxisDescription& axis : machine.axes) {
    if (axis.axis == Axis::z && !with_z) continue;
    // No minus sign before a zero.
    const double rounded = std::round(place[axis.axis] * 1000) / 1000 + 0.0;
    words += fmt::format("{}{}{:.3f}", words.empty() ? "" : " ", letter_of(axis.axis), rounded);
  }
  return words;
}

// Writes the lead-in, and the same for people.
class LeadIn {
 public:
  LeadIn(const MachineDescription& machine, const ResumePoint& at, const Point& from, Reentry& way)
      : machine_(machine), at_(at), now_(from), way_(way) {}

  void plan() {
    const auto z = std::ranges::find(machine_.axes, Axis::z, &AxisDescription::axis);
    const bool has_z = z != machine_.axes.end();
    const double top = has_z ? std::max(z->travel_high, now_[Axis::z]) : now_[Axis::z];
    if (at_.tool > 0)
      say("way.tool", "tool {tool} is in the spindle (nothing is changed)", {{"tool", std::to_string(at_.tool)}});
    if (has_z) go_to_height(top, {});
    switch_on();
    Point over = at_.point;
    over[Axis::z] = now_[Axis::z];
    if (over != now_) {
      say("way.over", "over to {place}, at rapid speed", {{"place", place_words(machine_, over, !has_z)}});
      go_to(over, {});
    }
    if (outputs_.flood != at_.outputs.flood || outputs_.mist != at_.outputs.mist) {
      say_coolant();
      act(Action::Kind::outputs, at_.outputs, Seconds(0));
    }
    const double clearance = at_.clearance.value_or(top);
    if (clearance > at_.point[Axis::z] && clearance < now_[Axis::z]) go_to_height(clearance, {});
    go_to_height(at_.point[Axis::z], at_.feed > MmPerSecond(0) ? at_.feed : careful_feed);
    if (at_.line == 0) {
      say("way.end", "the program ends", {});
    } else {
      say("way.goes-on", "the program continues at line {line}", {{"line", std::to_string(at_.line)}});
    }
    // A lead-in is never empty: the spindle is switched on in it.
    if (way_.lead_in.empty()) act(Action::Kind::outputs, at_.outputs, Seconds(0));
  }

 private:
  void say(const char* code, std::string_view words, SentenceArguments arguments) {
    std::string text = filled(words, arguments);
    way_.steps.push_back({code, std::move(arguments), std::move(text)});
  }
  void say_coolant() {
    const auto& [flood, mist] = std::pair(at_.outputs.flood, at_.outputs.mist);
    if (flood && mist) return say("way.coolant.both", "coolant on: flood mist", {});
    say(flood ? "way.coolant.flood" : "way.coolant.mist", flood ? "coolant on: flood" : "coolant on: mist", {});
  }
  // Without a speed: a rapid.
  void go_to(const Point& place, std::optional<MmPerSecond> speed) {
    Segment segment{.curve = Curve::line(now_, place),
                    .speed = speed.value_or(MmPerSecond(std::numeric_limits<double>::infinity()))};
    segment.rapid = !speed;
    segment.mode = PathMode::exact_stop;
    segment.work_zero = at_.work_zero;
    segment.source.line = at_.line;
    way_.lead_in.emplace_back(segment);
    now_ = place;
  }
  void go_to_height(double height, std::optional<MmPerSecond> speed) {
    if (now_[Axis::z] == height) return;
    Point place = now_;
    place[Axis::z] = height;
    const std::string z = fmt::format("{:.3f}", height);
    if (speed) {
      say("way.down-feed", "down to Z{z}, at {feed}",
          {{"z", z}, {"feed", fmt::format("{:.0f} mm/min", speed->value() * 60)}});
    } else if (height > now_[Axis::z]) {
      say("way.up", "up to Z{z}, at rapid speed", {{"z", z}});
    } else {
      say("way.down", "down to Z{z}, at rapid speed", {{"z", z}});
    }
    go_to(place, speed);
  }
  void act(Action::Kind kind, const OutputState& outputs, Seconds dwell) {
    Action action{.kind = kind, .dwell = dwell, .outputs = outputs};
    action.source.line = at_.line;
    way_.lead_in.emplace_back(action);
    outputs_ = outputs;
  }
  void switch_on() {
    if (at_.outputs.spindle == SpindleDirection::off) return;
    const Seconds run_up = run_up_time({}, at_.outputs, machine_.spindle.run_up);
    const Seconds wait = std::max({at_.spindle_wait, machine_.silence.spindle_wait, run_up});
    OutputState spindle = at_.outputs;
    spindle.mist = spindle.flood = false;
    const bool is_clockwise = spindle.spindle == SpindleDirection::clockwise;
    say(is_clockwise ? "way.spindle.clockwise" : "way.spindle.counterclockwise",
        is_clockwise ? "spindle on, clockwise at {speed} rpm, and a wait of {wait} s"
                     : "spindle on, counterclockwise at {speed} rpm, and a wait of {wait} s",
        {{"speed", fmt::format("{:.0f}", spindle.revolutions_per_minute)},
         {"wait", fmt::format("{:g}", wait.value())}});
    act(Action::Kind::outputs, spindle, Seconds(0));
    act(Action::Kind::dwell, spindle, wait);
    if (machine_.spindle.modbus) act(Action::Kind::await_speed, spindle, Seconds(0));
  }

  const MachineDescription& machine_;
  const ResumePoint& at_;
  Point now_;
  Reentry& way_;
  OutputState outputs_ = {};
};

}  // namespace

std::string_view code_of(ReentryRefusal refusal) {
  switch (refusal) {
    case ReentryRefusal::no_motion: return "reentry.no-motion";
    case ReentryRefusal::done_often: return "reentry.done-often";
    case ReentryRefusal::no_pass: return "reentry.no-pass";
    case ReentryRefusal::beyond_end: return "reentry.beyond-end";
    case ReentryRefusal::other_file: return "reentry.other-file";
    case ReentryRefusal::after_probe: return "reentry.after-probe";
    case ReentryRefusal::path_changed: return "reentry.path-changed";
    case ReentryRefusal::in_thread: return "reentry.in-thread";
    case ReentryRefusal::backlash: return "reentry.backlash";
    case ReentryRefusal::bad_program: return "reentry.bad-program";
  }
  return "reentry";
}

std::string_view message_of(ReentryRefusal refusal) {
  switch (refusal) {
    case ReentryRefusal::no_motion: return "there is no motion from that line on";
    case ReentryRefusal::done_often: return "that line runs more than once, in a loop or a subroutine";
    case ReentryRefusal::no_pass: return "that line has fewer passes";
    case ReentryRefusal::beyond_end: return "the path ends before that distance after the line";
    case ReentryRefusal::other_file:
      return "a subroutine in another file also has a line with that number: choose another line";
    case ReentryRefusal::after_probe:
      return "the path to that line depends on the result of a probe move: start before it";
    case ReentryRefusal::path_changed: return "the program has a different meaning now";
    case ReentryRefusal::in_thread: return "that position is in a thread, which can start only at its beginning";
    case ReentryRefusal::backlash:
      return "this machine compensates backlash, and the return to a path does not support that yet";
    case ReentryRefusal::bad_program: return "the program has errors";
  }
  return "the return to the path is not possible";
}

std::string message_of(const LineProblem& problem) {
  switch (problem.refusal) {
    case ReentryRefusal::done_often:
      return fmt::format("that line runs {} times, in a loop or a subroutine: choose one of these passes",
                         problem.times);
    case ReentryRefusal::no_pass: return fmt::format("the number of passes of that line is {}", problem.times);
    default: return std::string(message_of(problem.refusal));
  }
}

Result<ResumePoint, LineProblem> find_line(const ProgramReader& program, const MachineDescription& machine,
                                           const InterpreterOptions& options, const LinePlace& wanted) {
  PathOfProgram chain(program.again(), machine, options);
  VisitsOfLines visits;
  chain.operations().watch([&](const Operation& operation) {
    if (!operation.file.empty() && operation.file != program.name()) visits.note_other_file(operation.source.line);
  });
  chain.programmed().watch([&](PathItem& item) { visits.mark(item); });
  RewindablePath& path = chain.path();
  path.forget_passed();
  PathItem item;
  for (std::uint64_t number = 0; path.next(item); ++number) visits.note_smoothed(item, number);
  if (chain.any_error()) return Failure{LineProblem{ReentryRefusal::bad_program}};
  auto place = visits.find(wanted.line, wanted.pass);
  if (place) place = farther(program, machine, options, *place, wanted.after);
  if (!place) return Failure{place.error()};
  const auto point = find_resume_point(program.again(), machine, options, *place);
  if (!point) return Failure{LineProblem{ReentryRefusal::path_changed}};
  return *point;
}

namespace {

void widen(Box& box, const Box& other) {
  for (const Axis axis : all_axes) {
    box.low[axis] = std::min(box.low[axis], other.low[axis]);
    box.high[axis] = std::max(box.high[axis], other.high[axis]);
  }
}

}  // namespace

std::optional<Box> range_between(ProgramReader program, const MachineDescription& machine,
                                 const InterpreterOptions& options, const PathPosition& first, const PathPosition& last,
                                 const std::vector<ProbeOutcome>& probes) {
  PathOfProgram chain(std::move(program), machine, options, probes);
  RewindablePath& path = chain.path();
  path.begin_at(first);
  path.forget_passed();
  std::optional<Box> range;
  PathItem item;
  for (std::uint64_t number = first.item; number <= last.item && path.next(item); ++number) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment == nullptr) continue;
    const Box box = segment->curve.extents();
    range ? widen(*range, box) : static_cast<void>(range = box);
  }
  return range;
}

std::string words_of_shift(const MachineDescription& machine, const std::vector<HomedAxis>& homed, const Box& range,
                           const Point& went) {
  for (const HomedAxis& one : homed) {
    const auto axis = std::ranges::find(machine.axes, one.axis, &AxisDescription::axis);
    if (axis == machine.axes.end() || !axis->home) continue;
    const double stood = axis->home->switch_at - one.way - went[one.axis];
    const double may_differ = repeatable_within + steps_to_the_field / kinematics_of(machine).steps_per_unit(one.axis);
    const double low = range.low[one.axis] - may_differ;
    const double high = range.high[one.axis] + may_differ;
    if (stood >= low && stood <= high) continue;
    return fmt::format(
        "according to its switch, {} was at {:.3f} when the board lost its position, but the path only allows {:.3f} "
        "to {:.3f}: the axis or its switch was moved",
        letter_of(one.axis), stood, low, high);
  }
  return {};
}

Result<Reentry, ReentryRefusal> plan_reentry(const MachineDescription& machine, const ResumePoint& at,
                                             const Point& from) {
  if (at.in_thread) return Failure{ReentryRefusal::in_thread};
  if (takes_up_backlash(step_options(machine))) return Failure{ReentryRefusal::backlash};
  Reentry way{.at = at, .lead_in = {}, .steps = {}};
  LeadIn(machine, at, from, way).plan();
  return way;
}

Result<Reentry, LineProblem> reentry_at_line(const ProgramReader& program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const LinePlace& wanted) {
  const auto at = find_line(program, machine, options, wanted);
  if (!at) return Failure{at.error()};
  auto way = plan_reentry(machine, *at, options.start);
  if (!way) return Failure{LineProblem{.refusal = way.error()}};
  return std::move(*way);
}

}  // namespace passo
