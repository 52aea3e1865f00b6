#include "passo/sender/grbl_times.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "passo/activity/nominal_time.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/drive/program_stop.hpp"

namespace passo {

bool GrblTiming::is_known() const {
  bool has_axis = false;
  for (const Axis axis : all_axes) {
    if (limits.steps_per_mm[axis] <= 0) continue;
    has_axis = true;
    if (limits.velocity[axis] <= MmPerSecond(0) || limits.acceleration[axis] <= MmPerSecond2(0)) return false;
  }
  return has_axis;
}

GrblTimes::GrblTimes(const ProgramReader& program, const MachineDescription& machine, const InterpreterOptions& options,
                     const GrblTiming& timing, Listener listener)
    : nominal_limits_(motion_limits(machine)),
      checker_(program.again(), machine, options, unheard_),
      code_(timing.target),
      forecast_(timing.limits, timing.line, options.start, timing.target),
      listener_(std::move(listener)) {
  checker_.watch([this](const PathItem& item) { add(item); });
  forecast_.hear([this](const GrblPhase& phase) { add(phase); });
}

bool GrblTimes::go_on(std::uint64_t items) {
  if (ended_) return true;
  ended_ = checker_.go_on(items);
  if (ended_) listener_(nominal_, forecast_.finish().time);
  return ended_;
}

// The number of the item takes the place of a line, so that each phase can be related to its item.
void GrblTimes::add(const PathItem& item) {
  const Seconds time = nominal_time_of(item, nominal_limits_);
  const auto* const segment = std::get_if<Segment>(&item);
  ++last_number_;
  if (segment != nullptr) {
    items_.push_back(
        {.number = last_number_, .begin = nominal_, .time = time, .length = segment->curve.length().value()});
  }
  nominal_ += time;
  lines_.clear();
  const auto* const action = std::get_if<Action>(&item);
  // What cannot be written is a probe move, or was reported by the check.
  if (code_.write(item, lines_)) {
    for (const std::string& line : lines_) forecast_.add(line, last_number_);
  }
  if (action != nullptr && is_program_stop(*action)) forecast_.add(GrblCode::wait_for_rest, last_number_);
}

void GrblTimes::add(const GrblPhase& phase) {
  while (!items_.empty() && items_.front().number < phase.block.source) items_.pop_front();
  if (items_.empty()) return;
  Item& item = items_.front();
  const auto nominal_at = [&](double done) {
    return item.begin + item.time * (item.length > 0 ? std::min(1.0, done / item.length) : 1.0);
  };
  const double length = (phase.end() - phase.from).value();
  listener_(nominal_at(item.done), phase.begun);
  // The middle of a ramp is not the middle of its way.
  if (phase.acceleration != MmPerSecond2(0)) {
    const Seconds half = phase.duration / 2;
    const Mm way = (phase.speed + phase.acceleration * (half / 2)) * half;
    listener_(nominal_at(item.done + way.value()), phase.begun + half);
  }
  item.done += length;
  listener_(nominal_at(item.done), phase.begun + phase.duration);
}

}  // namespace passo
