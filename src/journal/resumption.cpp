#include "passo/journal/resumption.hpp"

#include <utility>

namespace passo {

std::string_view code_of(ResumeRefusal refusal) {
  switch (refusal) {
    case ResumeRefusal::board_reset: return "resume.board-reset";
    case ResumeRefusal::other_session: return "resume.other-session";
    case ResumeRefusal::not_trusted: return "resume.not-trusted";
    case ResumeRefusal::rest_unknown: return "resume.rest-unknown";
    case ResumeRefusal::path_changed: return "resume.path-changed";
    case ResumeRefusal::counts_differ: return "resume.counts-differ";
    case ResumeRefusal::in_thread: return "resume.in-thread";
  }
  return "resume";
}

std::string_view message_of(ResumeRefusal refusal) {
  switch (refusal) {
    case ResumeRefusal::board_reset:
      return "the board was reset since: where the machine stands is not certain any more";
    case ResumeRefusal::other_session: return "another program was run on the board since";
    case ResumeRefusal::not_trusted:
      return "the board has stopped its motors at once, and where they are is not certain";
    case ResumeRefusal::rest_unknown: return "the journal does not know where the board has come to rest";
    case ResumeRefusal::path_changed: return "the program does not mean any more what it meant";
    case ResumeRefusal::counts_differ: return "the board's step counts are not those of the place where the job ended";
    case ResumeRefusal::in_thread:
      return "the machine stands in a thread, which cannot go on there: move the tool out of it, and start anew";
  }
  return "the job cannot go on";
}

std::optional<ResumeRefusal> refuse_stranger(const Journal& journal, const BoardStatus& status) {
  if (journal.is_of(status)) return {};
  const bool reset = status.session == 0 && status.motors == 0;
  return reset ? ResumeRefusal::board_reset : ResumeRefusal::other_session;
}

std::optional<ResumeRefusal> refuse_rest(const Journal& journal, const BoardStatus& status) {
  if (const auto stranger = refuse_stranger(journal, status)) return stranger;
  if ((status.state & board_trusted) == 0) return ResumeRefusal::not_trusted;
  if (!journal.place_of(status)) return ResumeRefusal::rest_unknown;
  return {};
}

Result<ResumePoint, ResumeRefusal> resume_point_of(const Journal& journal, const BoardStatus& status,
                                                   const ProgramReader& program, const MachineDescription& machine,
                                                   const InterpreterOptions& options) {
  if (const auto refused = refuse_rest(journal, status)) return Failure{*refused};
  const auto place = journal.place_of(status);
  const auto point = find_resume_point(program.again(), machine, options, *place);
  if (!point) return Failure{ResumeRefusal::path_changed};
  if (point->in_thread) return Failure{ResumeRefusal::in_thread};
  if (!stands_at(journal.head(), *point, status)) return Failure{ResumeRefusal::counts_differ};
  return *point;
}

bool stands_at(const JournalHead& head, const ResumePoint& point, const BoardStatus& status) {
  for (std::size_t m = 0; m < head.job_counts.size(); ++m) {
    if (status.positions[m] != head.job_counts[m] + point.steps[m]) return false;
  }
  return true;
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
  return before;
}

}  // namespace passo
