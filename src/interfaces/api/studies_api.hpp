// StudiesApi: analyses that run without blocking the machine: the torque that a program needs, and limits for the
// motors. Private to api/.
#pragma once

#include <cstdint>
#include <string>

#include "api_call.hpp"
#include "api_shared.hpp"

namespace passo {

class StudiesApi {
 public:
  // Must outlive this object.
  explicit StudiesApi(const ApiShared& shared) : shared_(shared) {}

  WebAnswer get(const ApiCall& call);
  WebAnswer begin(const ApiCall& call);
  WebAnswer options(const ApiCall& call);
  WebAnswer loads(const ApiCall& call);
  WebAnswer picture(const ApiCall& call);

 private:
  bool is_done() const { return shared_.options.studies->result().state == StudyResult::State::done; }
  WebAnswer state_answer(unsigned status) const;

  const ApiShared& shared_;
  std::string study_;          // the last one ordered
  std::uint64_t studied_ = 0;  // the program of that study; 0: none
};

}  // namespace passo
