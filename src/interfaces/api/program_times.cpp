#include "program_times.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

// With less the motion stands still, and nobody knows for how long.
constexpr double least_feed = 0.01;

}  // namespace

void ProgramTimes::record(const MotionTimes& times) {
  const StoredProgram* const program = shared_.programs.find(timed_);
  const bool is_its_path = program != nullptr && program->path == timed_path_;
  if (is_its_path && timed_factors_ == MotionFactors()) shared_.programs.set_planned_time(timed_, times.whole());
  is_timing_ = false;
  times_ = times;
  times_factors_ = timed_factors_;
}

// Null: all are timed.
const StoredProgram* ProgramTimes::next(const MotionFactors& factors) const {
  const auto wants = [&](const StoredProgram& program) {
    if (program.state != UploadState::good) return false;
    const bool is_timed = timed_ == program.id && timed_path_ == program.path;
    return jobs_.runs(program) ? !is_timed || timed_factors_ != factors : !program.planned_time && !is_timing_;
  };
  const ApiJob& job = jobs_.job();
  if (const auto* const its = job.state == JobState::running ? shared_.programs.find(job.program) : nullptr) {
    return wants(*its) ? its : nullptr;
  }
  const StoredProgram* last = nullptr;
  for (const auto& [id, program] : shared_.programs.all()) {
    if (wants(program)) last = &program;
  }
  return last;
}

void ProgramTimes::poll() {
  MotionTimer* const timer = shared_.options.timer;
  if (timer == nullptr) return;
  const std::uint64_t basis = timer->basis();
  if (std::exchange(basis_, basis) != basis) {
    static_cast<void>(timer->take_times());
    timed_ = 0;
    times_.reset();
    is_timing_ = false;
  }
  if (basis == 0) return;
  if (const std::optional<MotionTimes> times = timer->take_times()) record(*times);
  const Overrides overrides = shared_.session.status().overrides;
  const MotionFactors factors{.feed = std::max(overrides.feed, least_feed), .rapids = overrides.rapids};
  const StoredProgram* const program = next(factors);
  if (program == nullptr) return;
  is_timing_ = true;
  if (timed_ != program->id || timed_path_ != program->path) times_.reset();
  timed_ = program->id;
  timed_path_ = program->path;
  timed_factors_ = jobs_.runs(*program) ? factors : MotionFactors();
  MotionTiming wanted{.name = program->name,
                      .text = program->text,
                      .options = shared_.programs.options_of(*program),
                      .check = program->check,
                      .factors = timed_factors_};
  wanted.options.start = program->checked_from;
  timer->begin(std::move(wanted));
}

// Of other overrides the times are soon known: until then they are stretched.
std::optional<Seconds> ProgramTimes::left(const MachineStatus& status) const {
  const StoredProgram* const program = shared_.programs.find(timed_);
  if (program == nullptr || !jobs_.runs(*program) || !times_ || !status.progress) return {};
  // How much of a file the board has read is no measure of time.
  if (!status.executes.board_file.empty()) return {};
  if (program->path != timed_path_ || status.overrides.feed < least_feed) return {};
  return times_->left_from(program->check.nominal_time * *status.progress) *
         (times_factors_.feed / timed_factors_.feed);
}

}  // namespace passo
