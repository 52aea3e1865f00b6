// MachineFileApi: the machine file for an editor: its text and values, a preview of a change, and writing it. Private
// to api/.
#pragma once

#include <optional>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class MachineFileApi {
 public:
  // Both must outlive this object.
  MachineFileApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer get(const ApiCall& call);
  WebAnswer draft(const ApiCall& call);
  WebAnswer write(const ApiCall& call);

 private:
  std::optional<WebAnswer> refuse_while_moving() const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
};

}  // namespace passo
