#include "owner_api.hpp"

#include <algorithm>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {

void OwnerApi::hear(std::string_view key) {
  if (shared_.owner.is_client(key)) heard_ = shared_.session.now();
}

void OwnerApi::hear(std::string_view key, std::uint64_t client) {
  if (shared_.owner.is_client(key)) streams_.insert(client);
}

void OwnerApi::gone(std::uint64_t client) {
  if (streams_.erase(client) > 0 && streams_.empty()) stream_lost_ = shared_.session.now();
}

// An owner who once spoke by the stream is there as long as one of its streams is, or it asks by HTTP.
bool OwnerApi::is_gone() const {
  if (shared_.owner.kind() != MachineControl::Kind::client) return false;
  if (!streams_.empty() || !stream_lost_) return false;
  return shared_.session.now() - std::max(*stream_lost_, heard_) > MachineControl::returns_within;
}

// The machine rests, and nothing moves it without somebody's wish.
bool OwnerApi::may_pass_on() const {
  const MachineSession& session = shared_.session;
  if (shared_.owner.kind() == MachineControl::Kind::nobody || !session.busy() || is_gone()) return true;
  const MachineState state = session.state();
  const bool rests = session.status().rests;
  return rests && (state == MachineState::await_line || state == MachineState::hold || state == MachineState::door);
}

// A sender's program that waits for its next line ends here.
WebAnswer OwnerApi::claim(const ApiCall& call) {
  MachineControl& owner = shared_.owner;
  MachineSession& session = shared_.session;
  if (!may_pass_on() || jobs_.is_checking()) {
    return error_answer(
        409, "owner.moves",
        Sentence{.code = "owner.moves",
                 .arguments = {{"name", owner.name()}},
                 .text = fmt::format("the machine is moving for {}: hold it first, or wait", owner.name())});
  }
  heard_ = session.now();
  streams_.clear();
  stream_lost_.reset();
  const Json name = call.members().value("name", Json());
  const bool was_sender = owner.is_sender();
  std::string key = shared_.options.make_key();
  owner.claim_for_client(words_from(name.is_string() ? name.get<std::string>() : "", "client"), key);
  if (was_sender && session.busy()) static_cast<void>(session.request(request::Stop{}).has_value());
  Json answer = as_json(owner);
  answer["key"] = std::move(key);
  return json_answer(200, answer);
}

// It was heard, and that is all.
WebAnswer OwnerApi::renew(const ApiCall&) {
  return json_answer(200, as_json(shared_.owner));
}

WebAnswer OwnerApi::release(const ApiCall& call) {
  if (!shared_.owner.is_client(call.request.key)) {
    return error_answer(403, "owner.not-you", "another client is in control");
  }
  shared_.owner.release();
  return json_answer(200, as_json(shared_.owner));
}

void OwnerApi::poll() {
  if (shared_.owner.kind() != MachineControl::Kind::client || shared_.session.busy()) return;
  const bool is_silent = shared_.session.now() - heard_ > MachineControl::silent_for;
  if (is_silent || is_gone()) shared_.owner.release();
}

}  // namespace passo
