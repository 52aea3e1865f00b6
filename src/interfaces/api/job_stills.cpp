#include "job_stills.hpp"

#include <utility>

namespace passo {
namespace {

constexpr Seconds still_within{5};
constexpr std::size_t most_wanted = 8;

}  // namespace

void JobStills::poll(const ApiJob& job) {
  if (!shared_.camera || shared_.options.history == nullptr) return;
  const bool runs = job.state == JobState::running;
  const bool has_ended = job.state != JobState::none && job.state != JobState::checking && !runs;
  const bool has_run = started_ == job.id || job.state == JobState::done;
  if (runs && std::exchange(started_, job.id) != job.id) want(job, "start");
  if (has_ended && has_run && std::exchange(ended_, job.id) != job.id) want(job, "end");
  std::erase_if(wanted_, [this](const Wanted& one) { return settle(one); });
}

void JobStills::want(const ApiJob& job, std::string_view moment) {
  const StoredProgram* const program = shared_.programs.find(job.program);
  if (job.history == 0 || (program != nullptr && program->is_small) || wanted_.size() >= most_wanted) return;
  wanted_.push_back({.job = job.history,
                     .moment = moment,
                     .before = shared_.camera->pictures->want_picture(),
                     .until = shared_.session.now() + still_within});
}

// Returns true if the still has been stored, or will not come.
bool JobStills::settle(const Wanted& wanted) const {
  const CameraPicture newest = shared_.camera->pictures->newest();
  if (newest.number <= wanted.before) return shared_.session.now() >= wanted.until;
  shared_.options.history->record_still(wanted.job, wanted.moment, shared_.wall_time(), *newest.jpeg);
  return true;
}

}  // namespace passo
