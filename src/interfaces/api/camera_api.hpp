// CameraApi: the machine's camera, and the stills of jobs in the history. Private to api/.
#pragma once

#include "api_call.hpp"
#include "api_shared.hpp"

namespace passo {

class CameraApi {
 public:
  // Must outlive this object.
  explicit CameraApi(const ApiShared& shared) : shared_(shared) {}

  // The response has the next picture, when it comes.
  WebAnswer still(const ApiCall& call);
  // Returns an error: the server itself serves the stream (WebService::is_pictures).
  WebAnswer stream(const ApiCall& call);
  WebAnswer job_still(const ApiCall& call);

 private:
  const ApiShared& shared_;
};

}  // namespace passo
