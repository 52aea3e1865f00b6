#include "passo/cutting/simulated_path.hpp"

#include <cmath>
#include <utility>

#include "passo/activity/nominal_time.hpp"
#include "passo/path/hand_tool_change.hpp"

namespace passo {
namespace {

constexpr double no_limit = 1e9;  // mm

PathOptions path_options_of(const MachineDescription* machine, const std::string& program, const Point& start,
                            AxisSet beside) {
  PathOptions options;
  if (machine != nullptr) {
    options = path_options(*machine, program, start);
  } else {
    options.axes = beside;
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) options.axes.add(axis);
    options.start = start;
    options.file = program;
  }
  // Whether the work fits the machine is for `passo check` to say.
  for (const Axis axis : all_axes) options.travel[axis] = {-no_limit, no_limit};
  return options;
}

}  // namespace

SimulatedPath::SimulatedPath(ProgramReader program, const InterpreterOptions& options,
                             const MachineDescription* machine, Diagnostics& diagnostics, AxisSet beside)
    : diagnostics_(diagnostics),
      path_options_(path_options_of(machine, program.name(), options.start, beside)),
      interpreter_(std::move(program), options, diagnostics),
      builder_(interpreter_, path_options_, diagnostics),
      watched_(builder_) {
  watched_.watch([this](const PathItem& item) { record_zeros(item); });
  if (machine == nullptr) return;
  limits_ = motion_limits(*machine);
  smoother_ = std::make_unique<PathSmoother>(watched_, smoothness(*machine), smoothing_share(*machine));
}

void SimulatedPath::record_zeros(const PathItem& item) {
  const auto* const segment = std::get_if<Segment>(&item);
  if (segment == nullptr) return;
  const Point& tool = builder_.frame().tool_offset();
  const bool is_known = !zeros_.empty() && zeros_.back().work == segment->work_zero && zeros_.back().tool == tool;
  if (!is_known) zeros_.push_back({segment->work_zero, tool});
}

Point SimulatedPath::zero_of(const Segment& segment) {
  while (zeros_.size() > 1 && zeros_.front().work != segment.work_zero) zeros_.pop_front();
  const Point& tool = zeros_.front().tool;
  if (!first_zero_) first_zero_ = zeros_.front().work - tool;
  return *first_zero_ + tool;
}

bool SimulatedPath::next(TipMove& move) {
  while (!diagnostics_.full() && (smoother_ ? smoother_->next(item_) : watched_.next(item_))) {
    if (const auto* const action = std::get_if<Action>(&item_)) {
      if (changes_tool(*action)) tool_ = action->tool;
      const OutputState& outputs = action->outputs;
      revolutions_per_minute_ = outputs.spindle == SpindleDirection::off ? 0 : outputs.revolutions_per_minute;
      continue;
    }
    const Segment& segment = std::get<Segment>(item_);
    move.segment = &segment;
    move.zero = zero_of(segment);
    move.tool = tool_ != 0 ? tool_ : builder_.named_tool();
    move.revolutions_per_minute = revolutions_per_minute_;
    move.time = Seconds(0);
    if (limits_) {
      move.time = nominal_time_of(item_, *limits_);
    } else if (!segment.rapid && segment.speed > MmPerSecond(0) && std::isfinite(segment.speed.value())) {
      move.time = segment.curve.length() / segment.speed;
    }
    return true;
  }
  return false;
}

}  // namespace passo
