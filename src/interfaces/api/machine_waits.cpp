// MachineApi: a job that waits for a person, who jogs, probes or sets a zero meanwhile, and goes on.
//
// The motion of such a job ends where it waits, so that the machine is free. Going on is a new start behind the same
// stop: the program is interpreted anew with the zeros and tools that count now, and the tool is led back to where the
// program has left it, in these zeros. See docs/decisions/0157.
#include <algorithm>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/journal/stop_place.hpp"

namespace passo {
namespace {

// How long a machine at rest may take to end its job.
constexpr Seconds a_turn{0.005};
constexpr int most_turns = 400;

bool is_changed(const SavedParameters& before, const SavedParameters& now, int system) {
  const auto differs = [&](int number) { return saved_value(before, number) != saved_value(now, number); };
  const int first = work_offset_parameter(system);
  return saved_point(before, first) != saved_point(now, first) || differs(rotation_parameter(system));
}

}  // namespace

// The spindle stands, and the machine can be led back onto the path.
bool MachineApi::is_free_to_move(const MachineStatus& status) const {
  if (parked_ || !ticket_ || job_.state != JobState::running || !status.waits_for || !status.rests) return false;
  return status.outputs.spindle == SpindleDirection::off &&
         !status.holds.any_of({HoldReason::operator_hold, HoldReason::door, HoldReason::stop}) &&
         !takes_up_backlash(step_options(machine_));
}

void MachineApi::step_aside() {
  const MachineStatus status = session_.status();
  if (!is_free_to_move(status)) return;
  parked_ = ParkedJob{.job = job_,
                      .wait = *status.waits_for,
                      .parameters = programs_.parameters(),
                      .tools = programs_.tools(),
                      .start = job_start_,
                      .probes = probes_};
  ticket_.reset();
  if (std::exchange(named_, false)) kept_->end(false);
  static_cast<void>(session_.request(request::Stop{}).has_value());
  for (int turns = 0; session_.busy() && turns < most_turns; ++turns) session_.turn(a_turn);
  mdi_.begin_anew();
}

Result<Reentry, ReentryProblem> MachineApi::way_behind_stop() const {
  const auto refused = [](std::string_view code, std::string_view why) {
    return Failure{ReentryProblem{.code = code, .why = std::string(why)}};
  };
  const auto refused_for = [&](ReentryRefusal refusal) { return refused(code_of(refusal), message_of(refusal)); };
  const StoredProgram* const program = programs_.find(parked_->job.program);
  if (program == nullptr) return refused_for(ReentryRefusal::path_changed);
  InterpreterOptions options = programs_.options_of(*program);
  options.start = parked_->start;
  const auto stop = find_stop(ProgramReader::from_text(program->name, program->text), machine_, options,
                              parked_->wait.number, parked_->probes);
  if (!stop) return refused_for(ReentryRefusal::bad_program);
  if (stop->line != parked_->wait.line) return refused_for(ReentryRefusal::path_changed);
  std::vector<int> changed;
  for (int system = 1; system <= work_systems; ++system) {
    if (is_changed(parked_->parameters, programs_.parameters(), system)) changed.push_back(system);
  }
  const bool any_changed = !changed.empty() || parked_->tools != programs_.tools();
  if (any_changed && stop->sets_own_zero) {
    return refused("waits.own-zero",
                   "the program has set a zero or a tool itself before, which hides what was set now: stop it, and "
                   "begin from a line");
  }
  if (!changed.empty() && std::ranges::find(changed, int{stop->system}) == changed.end()) {
    return refused(
        "waits.other-zero",
        fmt::format("the program works with {}, and another zero was set: set that one, or set the other back",
                    name_of_system(stop->system)));
  }
  auto way = plan_reentry(machine_, stop->at, session_.status().position.place);
  if (!way) return refused_for(way.error());
  return std::move(*way);
}

// The job is checked with what counts now, and begins behind its stop.
WebAnswer MachineApi::go_on_behind_stop() {
  if (session_.state() != MachineState::idle || job_.state == JobState::checking) {
    return error_answer(409, "machine.busy", fmt::format("the machine is not idle: {}", name_of(session_.state())));
  }
  if (const auto refused = session_.closed_limit()) return error_answer(409, code_of(refused->code), refused->message);
  if (const auto refused = session_.lost_place()) return error_answer(409, code_of(refused->code), refused->message);
  if (const auto way = way_behind_stop(); !way) return error_answer(409, way.error().code, way.error().why);
  job_ = parked_->job;
  job_.state = JobState::checking;
  job_.why.clear();
  goes_on_ = true;
  resumes_ = reenters_ = named_ = false;
  from_.reset();
  map_for_ = 0;
  job_owner_ = owner_.changes();
  programs_.check(job_.program, machine_, parked_->start);
  return ticket_answer(0);
}

WebAnswer MachineApi::stop_parked_job() {
  job_ = parked_->job;
  end_job(JobState::stopped, stopped_by_.empty() ? "it was stopped" : "stopped by " + stopped_by_);
  return ticket_answer(0);
}

WebAnswer MachineApi::parked_refusal() const {
  return error_answer(
      409, "jobs.waits",
      fmt::format("{} waits at line {}: go on with it or stop it first", parked_->job.name, parked_->wait.line));
}

void MachineApi::leave() {
  leaves_ = true;
  stopped_by_.clear();
  if (!parked_) return;
  job_ = parked_->job;
  end_job(JobState::stopped, "passo serve was told to end");
}

}  // namespace passo
