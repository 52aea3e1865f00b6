#include "passo/journal/resume_point.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "path_of_program.hpp"

#include "passo/drive/program_stop.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/path/hand_tool_change.hpp"

namespace passo {
namespace {

// The feeds of the lines that were read last. A curve of the smoothed path has a speed along its own parameter.
class FeedsOfLines {
 public:
  void note(const PathItem& item) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment == nullptr || segment->rapid) return;
    feeds_.push_back({.line = segment->source.line, .feed = segment->speed});
    if (feeds_.size() > most) feeds_.pop_front();
  }
  std::optional<MmPerSecond> of(std::uint32_t line) const {
    const auto found =
        std::find_if(feeds_.rbegin(), feeds_.rend(), [&](const Feed& feed) { return feed.line == line; });
    return found != feeds_.rend() ? std::optional(found->feed) : std::nullopt;
  }

 private:
  static constexpr std::size_t most = 256;  // the smoother reads no farther ahead, unless lines are merged
  struct Feed {
    std::uint32_t line = 0;
    MmPerSecond feed{0};
  };
  std::deque<Feed> feeds_;
};

// Keeps what the passed items have set.
class Passed {
 public:
  Passed(ResumePoint& point, const FeedsOfLines& feeds) : point_(point), feeds_(feeds) {}

  void pass(const PathItem& item) {
    if (const auto* segment = std::get_if<Segment>(&item)) {
      note_speed(*segment);
      point_.point = segment->curve.end();
      point_.downs = segment->downs;
      point_.work_zero = segment->work_zero;
      point_.switches = segment->outputs.switches.value_or(point_.switches);
      waits_ = false;
      return;
    }
    const auto& action = std::get<Action>(item);
    const OutputState& before = point_.outputs;
    const bool same = action.outputs.spindle == before.spindle &&
                      action.outputs.revolutions_per_minute == before.revolutions_per_minute;
    if (!same) {
      waits_ = true;
      point_.spindle_wait = Seconds(0);
    } else if (waits_) {
      point_.spindle_wait += action.dwell;
    }
    point_.outputs = action.outputs;
    point_.switches = action.switches.value_or(point_.switches);
    if (changes_tool(action)) point_.tool = action.tool;
    if (is_program_stop(action)) ++point_.stops;
  }

 private:
  void note_speed(const Segment& segment) {
    const Point start = segment.curve.start();
    const Point end = segment.curve.end();
    const bool is_across = start[Axis::x] != end[Axis::x] || start[Axis::y] != end[Axis::y];
    if (!segment.rapid) {
      point_.feed = feeds_.of(segment.source.line).value_or(point_.feed);
    } else if (is_across && start[Axis::z] == end[Axis::z]) {
      point_.clearance = start[Axis::z];
    }
  }

  ResumePoint& point_;
  const FeedsOfLines& feeds_;
  bool waits_ = false;  // the spindle was switched, and nothing has moved since
};

// Goes along a path up to a place.
class PointFinder {
 public:
  PointFinder(PathOfProgram& chain, const MachineDescription& machine, const Point& start,
              const std::vector<ProbeOutcome>& probes)
      : chain_(chain), path_(chain.path()), machine_(machine), probes_(probes) {
    point_.point = start;
    chain.programmed().watch([this](const PathItem& item) { feeds_.note(item); });
  }
  PointFinder(const PointFinder&) = delete;
  PointFinder& operator=(const PointFinder&) = delete;

  std::optional<ResumePoint> find(PathPosition place) {
    while (next_ < place.item) {
      if (!look_ahead()) return {};
      pass();
    }
    look_ahead();
    const auto* action = has_item_ ? std::get_if<Action>(&item_) : nullptr;
    const bool begins_probe = action != nullptr && action->kind == Action::Kind::probe_begin;
    if (begins_probe && point_.probes >= probes_.size()) pass();
    if (!is_amid_probe_) return amid_path(place);
    return chain_.knows_last_probe() ? behind_probe() : before_probe();
  }

 private:
  bool look_ahead() {
    has_item_ = has_item_ || path_.next(item_);
    return has_item_;
  }
  void pass() {
    const auto* action = std::get_if<Action>(&item_);
    if (action != nullptr && action->kind == Action::Kind::probe_begin) {
      is_amid_probe_ = true;
      before_probe_ = point_;
      before_probe_.place = {.item = next_};
    }
    if (is_amid_probe_) on_probe_news();
    passed_.pass(item_);
    if (action != nullptr && action->kind == Action::Kind::probe_end) {
      is_amid_probe_ = false;
      ++point_.probes;
      if (point_.probes <= probes_.size()) point_.point = probes_[point_.probes - 1].rest;
    }
    path_.forget_before(++next_);
    has_item_ = false;
  }

  std::optional<ResumePoint> amid_path(const PathPosition& place) {
    if (point_.probes > probes_.size()) return {};  // nobody knows where the path goes on
    Point beside;                                   // of the motors, amid a segment that takes up backlash
    if (place.s > Mm(0)) {
      const auto* segment = has_item_ ? std::get_if<Segment>(&item_) : nullptr;
      if (segment == nullptr || place.s >= segment->curve.length()) return {};
      point_.point = segment->tool_at(place.s);
      point_.downs = segment->downs;
      point_.work_zero = segment->work_zero;
      beside = segment->curve.at(place.s) - point_.point;
    }
    path_.rewind(place);
    point_.in_thread = machine_.spindle.counts_per_turn > 0 && path_.is_in_thread();
    return point_at(place, beside);
  }
  // The move is over, and its rest is known.
  std::optional<ResumePoint> behind_probe() {
    while (is_amid_probe_ && look_ahead()) pass();
    look_ahead();
    return is_amid_probe_ ? std::nullopt : point_at({.item = next_}, {});
  }
  // The move begins anew.
  std::optional<ResumePoint> before_probe() {
    while (is_amid_probe_ && !before_probe_.probe && look_ahead()) pass();
    if (!before_probe_.probe) return {};
    const PathPosition begins = before_probe_.place;
    point_ = before_probe_;
    return point_at(begins, {});
  }
  void on_probe_news() {
    before_probe_.line = std::visit([](const auto& what) { return what.source.line; }, item_);
    const auto* segment = std::get_if<Segment>(&item_);
    if (segment != nullptr) before_probe_.probe = {.end = segment->curve.end(), .speed = segment->speed};
  }
  std::optional<ResumePoint> point_at(const PathPosition& place, const Point& beside) {
    point_.place = place;
    if (has_item_ && !point_.probe) point_.line = std::visit([](const auto& what) { return what.source.line; }, item_);
    const std::span<const MotorRow> motors = chain_.steps().kinematics.rows();
    for (std::size_t m = 0; m < motors.size(); ++m) {
      point_.steps[m] = std::llround(motors[m].steps_at(point_.point, point_.downs) + motors[m].steps.of(beside));
    }
    return point_;
  }

  PathOfProgram& chain_;
  RewindablePath& path_;
  const MachineDescription& machine_;
  const std::vector<ProbeOutcome>& probes_;
  ResumePoint point_;
  FeedsOfLines feeds_;
  Passed passed_{point_, feeds_};
  PathItem item_;
  bool has_item_ = false;   // the item at next_ was looked at
  std::uint64_t next_ = 0;  // the number of the item that is passed next
  bool is_amid_probe_ = false;
  ResumePoint before_probe_;  // at the beginning of the last probe move
};

}  // namespace

std::optional<ResumePoint> find_resume_point(ProgramReader program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const PathPosition& place,
                                             const std::vector<ProbeOutcome>& probes) {
  PathOfProgram chain(std::move(program), machine, options, probes);
  return PointFinder(chain, machine, options.start, probes).find(place);
}

std::vector<PathItem> way_back_of_probe(const ResumePoint& point, const Point& from) {
  if (!point.probe || from == point.point) return {};
  Segment segment{.curve = Curve::line(from, point.point), .speed = point.probe->speed};
  segment.mode = PathMode::exact_stop;
  segment.work_zero = point.work_zero;
  segment.source.line = point.line;
  return {segment};
}

BoardStop without_lead_in(const ResumePoint& from, std::size_t lead_in, BoardStop rest) {
  for (PathPosition* const place : {&rest.place, &rest.done}) {
    const std::uint64_t first = from.place.item + lead_in;
    const bool is_amid = place->item == first;
    *place = place->item < first
                 ? from.place
                 : PathPosition{.item = place->item - lead_in, .s = place->s + (is_amid ? from.place.s : Mm(0))};
  }
  return rest;
}

}  // namespace passo
