// CameraApi: the machine's camera, and the stills of jobs in the history. Private to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_stills.hpp"

namespace passo {

class CameraApi {
 public:
  // Must outlive this object.
  explicit CameraApi(const ApiShared& shared) : shared_(shared), stills_(shared) {}

  // The response has the next picture, when it comes.
  WebAnswer still(const ApiCall& call);
  // Returns an error: the server itself serves the stream (WebService::is_pictures).
  WebAnswer stream(const ApiCall& call);
  WebAnswer job_still(const ApiCall& call);

  // Takes the stills of the job. Must be called once per iteration of the main loop.
  void poll(const ApiJob& job) { stills_.poll(job); }

 private:
  const ApiShared& shared_;
  JobStills stills_;
};

}  // namespace passo
