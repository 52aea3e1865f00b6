// PortsApi: the serial ports of the server's computer, and the first contact with a machine on one of them. Private to
// api/.
#pragma once

#include <optional>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class PortsApi {
 public:
  // Both must outlive this object.
  PortsApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer list(const ApiCall& call);
  WebAnswer open(const ApiCall& call);
  WebAnswer opened(const ApiCall& call);
  WebAnswer keep_machine(const ApiCall& call);

 private:
  WebAnswer open_board(const std::string& device, const std::string& board);
  FirstContact& contact() const { return *shared_.options.contact; }
  std::optional<WebAnswer> refuse_while_moving() const;
  WebAnswer state_answer(unsigned status) const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
};

}  // namespace passo
