// SmallJobsApi: jobs whose programs are made on request: framing a job, and going to a known place. They are checked
// and run by the JobRunner like any other program. Private to api/.
#pragma once

#include <cstdint>
#include <string>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class SmallJobsApi {
 public:
  // Both must outlive this object.
  SmallJobsApi(const ApiShared& shared, JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer frame(const ApiCall& call);
  WebAnswer go_to(const ApiCall& call);

 private:
  // Why the machine cannot begin a small job now. Empty: it can.
  std::optional<WebAnswer> refuse() const;
  WebAnswer run(std::string name, std::string text);

  const ApiShared& shared_;
  JobRunner& jobs_;
  std::uint64_t last_ = 0;  // the program of the last small job; the next one replaces it
};

}  // namespace passo
