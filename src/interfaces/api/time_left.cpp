// MachineApi: the time left of a job, from its planned motion.
#include <algorithm>
#include <utility>

#include "passo/api/machine_api.hpp"

namespace passo {
namespace {

// With less the motion stands still, and nobody knows for how long.
constexpr double least_feed = 0.01;

}  // namespace

bool MachineApi::runs(const StoredProgram& program) const {
  if (parked_ && parked_->job.program == program.id) return true;
  return job_.state == JobState::running && job_.program == program.id;
}

// First the job that runs, with its overrides, then each program that was checked.
void MachineApi::mind_times() {
  if (options_.timer == nullptr) return;
  if (std::optional<MotionTimes> times = options_.timer->take()) {
    const StoredProgram* const program = programs_.find(timed_);
    const bool is_its_path = program != nullptr && program->path == timed_path_;
    if (is_its_path && timed_factors_ == MotionFactors()) programs_.set_planned_time(timed_, times->whole());
    is_timing_ = false;
    times_ = std::move(times);
    times_factors_ = timed_factors_;
  }
  const Overrides overrides = session_.status().overrides;
  const MotionFactors factors{.feed = std::max(overrides.feed, least_feed), .rapids = overrides.rapids};
  const auto wants = [&](const StoredProgram& program) {
    if (program.state != UploadState::good) return false;
    const bool is_timed = timed_ == program.id && timed_path_ == program.path;
    return runs(program) ? !is_timed || timed_factors_ != factors : !program.planned_time && !is_timing_;
  };
  const StoredProgram* const job = job_.state == JobState::running ? programs_.find(job_.program) : nullptr;
  const StoredProgram* next = job;
  if (job == nullptr) {
    for (const auto& [id, program] : programs_.all()) {
      if (wants(program)) next = &program;
    }
  }
  if (next == nullptr || !wants(*next)) return;
  is_timing_ = true;
  if (timed_ != next->id || timed_path_ != next->path) times_.reset();
  timed_ = next->id;
  timed_path_ = next->path;
  timed_factors_ = runs(*next) ? factors : MotionFactors();
  MotionTiming wanted{.name = next->name,
                      .text = next->text,
                      .options = programs_.options_of(*next),
                      .check = next->check,
                      .factors = timed_factors_};
  wanted.options.start = next->checked_from;
  options_.timer->begin(std::move(wanted));
}

// Of other overrides the times are soon known: until then they are stretched.
std::optional<Seconds> MachineApi::time_left(const MachineStatus& status) const {
  const StoredProgram* const program = programs_.find(timed_);
  if (program == nullptr || !runs(*program) || !times_ || !status.progress) return {};
  if (program->path != timed_path_ || status.overrides.feed < least_feed) return {};
  return times_->left_from(program->check.nominal_time * *status.progress) *
         (times_factors_.feed / timed_factors_.feed);
}

}  // namespace passo
