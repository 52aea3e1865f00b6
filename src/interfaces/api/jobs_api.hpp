// JobsApi: running programs, directly or from the queue, probing cycles, the outcome of jobs, and the interrupted job.
// Private to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class JobsApi {
 public:
  // Both must outlive this object.
  JobsApi(const ApiShared& shared, JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer run(const ApiCall& call);
  WebAnswer way(const ApiCall& call);
  WebAnswer probe(const ApiCall& call);
  WebAnswer log(const ApiCall& call);

  // A job in the queue waits until a client starts it.
  WebAnswer list_queue(const ApiCall& call);
  WebAnswer queue(const ApiCall& call);
  WebAnswer queue_attempt(const ApiCall& call);
  WebAnswer get_attempt(const ApiCall& call);
  WebAnswer delete_queued(const ApiCall& call);
  WebAnswer run_queued(const ApiCall& call);

  WebAnswer list_history(const ApiCall& call);
  WebAnswer list_alarms(const ApiCall& call);

  WebAnswer get_interrupted(const ApiCall& call);
  WebAnswer drop_interrupted(const ApiCall& call);
  WebAnswer resume_interrupted(const ApiCall& call);
  WebAnswer reenter_interrupted(const ApiCall& call);

 private:
  std::optional<WebAnswer> refuse_interrupted() const;
  struct SentProgram {
    std::string name;
    std::string dialect;
    std::string text;
  };
  static Result<SentProgram, WebAnswer> sent_program(const ApiCall& call);
  Result<HistoryJob, WebAnswer> queued(std::uint64_t id) const;

  const ApiShared& shared_;
  JobRunner& jobs_;
};

}  // namespace passo
