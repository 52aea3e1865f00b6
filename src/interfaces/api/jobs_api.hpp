// JobsApi: programs that run, by themselves or from the queue, probing cycles, what has become of jobs, and a job that
// was broken off. Private to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class JobsApi {
 public:
  // Both outlive this.
  JobsApi(const ApiShared& shared, JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer run(const ApiCall& call);
  WebAnswer way(const ApiCall& call);
  WebAnswer probe(const ApiCall& call);
  WebAnswer log(const ApiCall& call);

  // A job in the queue waits until somebody runs it.
  WebAnswer list_queue(const ApiCall& call);
  WebAnswer queue(const ApiCall& call);
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
  Result<HistoryJob, WebAnswer> queued(std::uint64_t id) const;

  const ApiShared& shared_;
  JobRunner& jobs_;
};

}  // namespace passo
