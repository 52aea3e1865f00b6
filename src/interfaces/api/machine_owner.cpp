// MachineApi: who owns the motion, what a client of the stream says, and an owner who is gone.
#include <algorithm>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {

std::string MachineApi::hear(std::string_view message, std::uint64_t client) {
  const Json said = Json::parse(message, nullptr, false);
  const auto text = [&](const char* key) {
    const auto found = said.is_object() ? said.find(key) : said.end();
    return said.is_object() && found != said.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  const std::string path = text("do");
  const std::string key = text("key");
  const bool has_body = said.is_object() && said.contains("body");
  const WebAnswer answer = this->answer({.method = "POST",
                                         .path = path,
                                         .key = key,
                                         .type = "application/json",
                                         .body = has_body ? said["body"].dump() : std::string()});
  if (owner_.is_client(key)) owner_streams_.insert(client);
  return Json({{"do", path}, {"status", answer.status}, {"body", Json::parse(answer.body, nullptr, false)}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

void MachineApi::gone(std::uint64_t client) {
  if (owner_streams_.erase(client) > 0 && owner_streams_.empty()) stream_lost_ = session_.now();
}

// An owner who once spoke by the stream is there as long as one of its streams is, or it asks by HTTP.
bool MachineApi::is_owner_gone() const {
  if (owner_.kind() != MotionOwner::Kind::client) return false;
  if (!owner_streams_.empty() || !stream_lost_) return false;
  return session_.now() - std::max(*stream_lost_, owner_heard_) > owner_returns_within;
}

// The machine rests, and nothing moves it without somebody's wish.
bool MachineApi::may_pass_on() const {
  if (owner_.kind() == MotionOwner::Kind::nobody || !session_.busy() || is_owner_gone()) return true;
  const MachineState state = session_.state();
  const bool rests = session_.status().rests;
  return rests && (state == MachineState::await_line || state == MachineState::hold || state == MachineState::door);
}

// A sender's program that waits for its next line ends here.
WebAnswer MachineApi::take_ownership(const WebRequest& request) {
  const Json body = request.body.empty() ? Json::object() : Json::parse(request.body, nullptr, false);
  if (!may_pass_on() || job_.state == JobState::checking) {
    return error_answer(409, "owner.moves",
                        fmt::format("the machine moves for {}: hold it first, or wait", owner_.name()));
  }
  owner_heard_ = session_.now();
  owner_streams_.clear();
  stream_lost_.reset();
  const auto name = body.find("name");
  const bool was_sender = owner_.is_sender();
  std::string key = options_.make_key();
  const std::string said = name != body.end() && name->is_string() ? name->get<std::string>() : "";
  owner_.take_for_client(words_from(said, "client"), key);
  if (was_sender && session_.busy()) static_cast<void>(session_.request(request::Stop{}).has_value());
  Json answer = as_json(owner_);
  answer["key"] = std::move(key);
  return json_answer(200, answer);
}

WebAnswer MachineApi::change_owner(const FoundRoute& found, const WebRequest& request) {
  if (found.route->moves) return json_answer(200, as_json(owner_));  // it was heard, and that is all
  if (request.method == "POST") return take_ownership(request);
  if (!owner_.is_client(request.key)) return error_answer(403, "owner.not-you", "somebody else owns the motion");
  owner_.give_back();
  return json_answer(200, as_json(owner_));
}

// While the machine moves for an owner who is gone, it keeps an owner: a sender would take what nobody owns. Whoever
// asks gets it.
void MachineApi::mind_owner() {
  if (owner_.kind() != MotionOwner::Kind::client || session_.busy()) return;
  const bool is_silent = session_.now() - owner_heard_ > silent_owner;
  if (is_silent || is_owner_gone()) owner_.give_back();
}

}  // namespace passo
