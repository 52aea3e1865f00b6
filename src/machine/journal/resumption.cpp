#include "passo/journal/resumption.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "passo/activity/stage_options.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/kinematics/kinematics.hpp"

namespace passo {

std::string_view code_of(ResumeRefusal refusal) {
  switch (refusal) {
    case ResumeRefusal::board_reset: return "resume.board-reset";
    case ResumeRefusal::other_session: return "resume.other-session";
    case ResumeRefusal::not_trusted: return "resume.not-trusted";
    case ResumeRefusal::drivers_off: return "resume.drivers-off";
    case ResumeRefusal::session_ended: return "resume.session-ended";
    case ResumeRefusal::rest_unknown: return "resume.rest-unknown";
    case ResumeRefusal::path_changed: return "resume.path-changed";
    case ResumeRefusal::counts_differ: return "resume.counts-differ";
    case ResumeRefusal::in_thread: return "resume.in-thread";
  }
  return "resume";
}

std::string_view message_of(ResumeRefusal refusal) {
  switch (refusal) {
    case ResumeRefusal::board_reset: return "the board has since been reset: the machine position is no longer certain";
    case ResumeRefusal::other_session: return "another program has run on the board since then";
    case ResumeRefusal::not_trusted:
      return "the board stopped its motors instantly; steps may be lost, so the position is unreliable";
    case ResumeRefusal::drivers_off:
      return "the board disabled the drivers after a time without a host (drivers_off_after_s), and the axes may have "
             "moved";
    case ResumeRefusal::session_ended:
      return "the machine was moved with the board's keypad since, or another program connected to the board";
    case ResumeRefusal::rest_unknown: return "the journal does not contain the position where the board stopped";
    case ResumeRefusal::path_changed: return "the program has a different meaning now";
    case ResumeRefusal::counts_differ: return "the board's step counts differ from those at which the job stopped";
    case ResumeRefusal::in_thread:
      return "the machine is in a thread, which cannot continue: move the tool out of it, and start again";
  }
  return "the job cannot continue";
}

std::optional<ResumeRefusal> refuse_stranger(const Journal& journal, const BoardStatus& status) {
  if (journal.is_of(status)) return {};
  if (status.session != 0) return ResumeRefusal::other_session;
  return status.motors == 0 ? ResumeRefusal::board_reset : ResumeRefusal::session_ended;
}

std::optional<ResumeRefusal> refuse_rest(const Journal& journal, const BoardStatus& status) {
  if (const auto stranger = refuse_stranger(journal, status)) return stranger;
  if ((status.state & board_trusted) == 0) {
    return (status.inputs & drivers_timed_out) != 0 ? ResumeRefusal::drivers_off : ResumeRefusal::not_trusted;
  }
  if (!journal.place_of(status)) return ResumeRefusal::rest_unknown;
  return {};
}

Result<ResumePoint, ResumeRefusal> resume_point_of(const Journal& journal, const BoardStatus& status,
                                                   const ProgramReader& program, const MachineDescription& machine,
                                                   const InterpreterOptions& options) {
  if (const auto refused = refuse_rest(journal, status)) return Failure{*refused};
  const auto place = journal.place_of(status);
  const auto point = find_resume_point(program.again(), machine, options, *place, journal.head().probes);
  if (!point) return Failure{ResumeRefusal::path_changed};
  if (point->in_thread) return Failure{ResumeRefusal::in_thread};
  if (!stands_at(journal.head(), *point, status, machine)) return Failure{ResumeRefusal::counts_differ};
  return *point;
}

namespace {

// How far a motor may be from the straight line on which it makes a probe move.
constexpr double beside_line = 1.5;

// The steps of each motor on the way of an unknown probe move.
MotorPosition steps_of_probe(const ResumePoint& point, const MachineDescription& machine) {
  const Kinematics kinematics = kinematics_of(machine);
  MotorPosition way = kinematics.motors(point.probe->end);
  const MotorPosition from = kinematics.motors(point.point);
  for (std::size_t m = 0; m < way.steps.size(); ++m) way[m] -= from[m];
  return way;
}

bool stands_on_way(const MotorPosition& from_point, const MotorPosition& way, std::size_t motors) {
  std::size_t most = 0;
  for (std::size_t m = 1; m < motors; ++m) {
    if (std::abs(way[m]) > std::abs(way[most])) most = m;
  }
  const double share = way[most] != 0 ? from_point[most] / way[most] : 0;
  const double step = way[most] != 0 ? 1 / std::abs(way[most]) : 0;
  if (share < -step || share > 1 + step) return false;
  for (std::size_t m = 0; m < motors; ++m) {
    if (std::abs(from_point[m] - share * way[m]) > beside_line) return false;
  }
  return true;
}

}  // namespace

bool stands_at(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
               const MachineDescription& machine) {
  MotorPosition from_point;
  bool is_there = true;
  for (std::size_t m = 0; m < head.job_counts.size(); ++m) {
    const std::int64_t steps = status.positions[m] - head.job_counts[m] - point.steps[m];
    is_there = is_there && steps == 0;
    from_point[m] = static_cast<double>(steps);
  }
  if (is_there || !point.probe || takes_up_backlash(step_options(machine))) return is_there;
  return stands_on_way(from_point, steps_of_probe(point, machine), head.job_counts.size());
}

Point place_by_counts(const JournalHead& head, const ResumePoint& point, const BoardStatus& status,
                      const MachineDescription& machine) {
  const MotorPosition motors = steps_since(head.job_counts, status.positions);
  unsigned moved = 0;
  for (std::size_t m = 0; m < head.job_counts.size(); ++m) {
    if (motors[m] != static_cast<double>(point.steps[m])) moved |= 1U << m;
  }
  return kinematics_of(machine).axes_after(point.point, motors, moved);
}

JournalHead head_of_beginning(JournalHead job, const BoardStatus& status,
                              const std::array<std::int64_t, max_motors>& steps, std::size_t motors) {
  job.job_counts.clear();
  for (std::size_t m = 0; m < motors; ++m) {
    job.job_counts.push_back(static_cast<int>(status.positions[m] - steps[m]));
  }
  job.numbers.session_before = status.session;
  job.numbers.executed_before = status.executed;
  return job;
}

JournalHead head_of_resumption(JournalHead before, const BoardStatus& status, const ResumePoint& point) {
  before.numbers.session_before = status.session;
  before.numbers.executed_before = status.executed;
  before.place = point.place;
  // A probe move behind the place is made again.
  if (before.probes.size() > point.probes) before.probes.resize(point.probes);
  return before;
}

}  // namespace passo
