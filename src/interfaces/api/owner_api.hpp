// OwnerApi: control of the machine: taking it, keeping it alive, and releasing it. Private to api/.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string_view>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "job_runner.hpp"

namespace passo {

class OwnerApi {
 public:
  // Both must outlive this object.
  OwnerApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer claim(const ApiCall& call);
  WebAnswer renew(const ApiCall& call);
  WebAnswer release(const ApiCall& call);

  // Notes a request with this key.
  void hear(std::string_view key);
  // Notes that a client of the stream with this key has disconnected.
  void hear(std::string_view key, std::uint64_t client);
  void gone(std::uint64_t client);
  // While the machine moves for an owner that is gone, control is not released, because a sender would take it. Any
  // client that requests control gets it.
  void poll();

 private:
  bool is_gone() const;
  bool may_pass_on() const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
  Seconds heard_{0};
  std::set<std::uint64_t> streams_;     // stream clients that have presented the owner's key
  std::optional<Seconds> stream_lost_;  // when the last of them disconnected; empty: none has
};

}  // namespace passo
