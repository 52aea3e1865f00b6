#include "passo/journal/resume_point.hpp"

#include <cmath>
#include <utility>

#include "path_of_program.hpp"

namespace passo {
namespace {

// Keeps what the passed items have set.
class Passed {
 public:
  explicit Passed(ResumePoint& point) : point_(point) {}

  void pass(const PathItem& item) {
    if (const auto* segment = std::get_if<Segment>(&item)) {
      note_speed(*segment);
      point_.point = segment->curve.end();
      point_.downs = segment->downs;
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
    if (action.kind == Action::Kind::tool_change) point_.tool = action.tool;
  }

 private:
  void note_speed(const Segment& segment) {
    const Point start = segment.curve.start();
    const Point end = segment.curve.end();
    const bool is_across = start[Axis::x] != end[Axis::x] || start[Axis::y] != end[Axis::y];
    if (!segment.rapid) {
      point_.feed = segment.speed;
    } else if (is_across && start[Axis::z] == end[Axis::z]) {
      point_.clearance = start[Axis::z];
    }
  }

  ResumePoint& point_;
  bool waits_ = false;  // the spindle was switched, and nothing has moved since
};

}  // namespace

std::optional<ResumePoint> find_resume_point(ProgramReader program, const MachineDescription& machine,
                                             const InterpreterOptions& options, const PathPlace& place) {
  PathOfProgram chain(std::move(program), machine, options);
  RewindablePath& path = chain.path();
  const StepOptions& steps = chain.steps();
  ResumePoint point;
  point.place = place;
  point.point = options.start;
  Passed passed(point);
  PathItem item;
  for (std::uint64_t number = 0; number < place.item; ++number) {
    if (!path.next(item)) return {};
    passed.pass(item);
    path.forget_before(number + 1);
  }
  const bool more = path.next(item);
  if (more) point.line = std::visit([](const auto& what) { return what.source.line; }, item);
  Point beside;  // of the motors, amid a segment that takes up backlash
  if (place.s > Mm(0)) {
    const auto* segment = more ? std::get_if<Segment>(&item) : nullptr;
    if (segment == nullptr || place.s >= segment->curve.length()) return {};
    point.point = segment->tool_at(place.s);
    point.downs = segment->downs;
    beside = segment->curve.at(place.s) - point.point;
  }
  path.rewind(place);
  point.in_thread = machine.spindle.counts_per_turn > 0 && path.is_in_thread();
  for (std::size_t m = 0; m < steps.motor_count; ++m) {
    const Motor& motor = steps.motors[m];
    const double motor_place = motor.steps_at(point.point[motor.axis], point.downs.has(motor.axis));
    point.steps[m] = std::llround(motor_place + beside[motor.axis] * motor.steps_per_unit);
  }
  return point;
}

}  // namespace passo
