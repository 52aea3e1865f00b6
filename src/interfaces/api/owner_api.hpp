// OwnerApi: the owner of motion: who takes it, whether it is still there, and when it is given back. Private to api/.
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
  // Both outlive this.
  OwnerApi(const ApiShared& shared, const JobRunner& jobs) : shared_(shared), jobs_(jobs) {}

  WebAnswer claim(const ApiCall& call);
  WebAnswer renew(const ApiCall& call);
  WebAnswer release(const ApiCall& call);

  // A request has come with this key.
  void hear(std::string_view key);
  // A client of the stream has shown this key, and has left.
  void hear(std::string_view key, std::uint64_t client);
  void gone(std::uint64_t client);
  // While the machine moves for an owner who is gone, it keeps an owner: a sender would take what nobody owns. Whoever
  // asks gets it.
  void poll();

 private:
  bool is_gone() const;
  bool may_pass_on() const;

  const ApiShared& shared_;
  const JobRunner& jobs_;
  Seconds heard_{0};
  std::set<std::uint64_t> streams_;     // clients of the stream that have shown the owner's key
  std::optional<Seconds> stream_lost_;  // when the last of them went; empty: none has gone
};

}  // namespace passo
