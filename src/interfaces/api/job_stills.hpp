// JobStills: a picture of the camera at the start and at the end of each job, for the history. Private to api/.
//
// The next picture that comes is stored. A camera that sends none delays nothing: after some seconds the still is left
// out. Small jobs, such as framing, have none.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "api_shared.hpp"

#include "passo/api/api_job.hpp"

namespace passo {

class JobStills {
 public:
  // Must outlive this object.
  explicit JobStills(const ApiShared& shared) : shared_(shared) {}

  // Must be called once per iteration of the main loop. `job`: the current or the last job.
  void poll(const ApiJob& job);

 private:
  struct Wanted {
    std::int64_t job = 0;  // its number in the history
    std::string_view moment;
    std::uint64_t before = 0;  // the number of the last picture that was too early
    Seconds until{0};
  };
  void want(const ApiJob& job, std::string_view moment);
  bool settle(const Wanted& wanted) const;

  const ApiShared& shared_;
  std::vector<Wanted> wanted_;
  std::uint64_t started_ = 0;  // the job whose first still was wanted
  std::uint64_t ended_ = 0;    // and the last
};

}  // namespace passo
