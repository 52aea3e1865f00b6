#include "served_status.hpp"

#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "program_input.hpp"
#include "serve_addresses.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace passo {
namespace {

constexpr unsigned usual_mqtt_port = 1883;

// Where the broker is, and the login. Empty, with a message and `code`.
std::optional<MqttOptions> mqtt_options(const ServeArguments& arguments, int& code) {
  auto address = read_address(arguments.mqtt.broker);
  if (!address && arguments.mqtt.broker.find(':') == std::string::npos)
    address = HostAndPort{arguments.mqtt.broker, usual_mqtt_port};
  if (!address || address->port == 0 || address->host.empty()) {
    code =
        fail(exit_bad_program, "--mqtt: expected HOST or HOST:PORT, e.g. 127.0.0.1:1883, not " + arguments.mqtt.broker);
    return {};
  }
  MqttOptions place{
      .host = address->host, .port = address->port, .topic = arguments.mqtt.topic, .user = {}, .password = {}};
  if (place.topic.empty() || place.topic.find_first_of("#+") != std::string::npos || place.topic.back() == '/') {
    code =
        fail(exit_bad_program, "--mqtt-topic: expected a topic without # and +, e.g. shop/router, not " + place.topic);
    return {};
  }
  if (arguments.mqtt.login.empty()) return place;
  std::ifstream file(arguments.mqtt.login);
  std::string line;
  std::getline(file, line);
  const std::size_t colon = line.find(':');
  if (colon == std::string::npos || colon == 0) {
    code = fail(exit_bad_program, "--mqtt-login " + arguments.mqtt.login +
                                      ": expected a file whose first line is USER:PASSWORD [serve.bad-login]");
    return {};
  }
  place.user = line.substr(0, colon);
  place.password = line.substr(colon + 1);
  return place;
}

}  // namespace

bool ServedStatus::check(const ServeArguments& arguments, int& code) {
  return mqtt_options(arguments, code).has_value();
}

std::unique_ptr<ServedStatus> ServedStatus::open(const ServeArguments& arguments, const MachineDescription& machine,
                                                 int& code) {
  const auto place = mqtt_options(arguments, code);
  if (!place) return nullptr;
  auto broker = MqttPublisher::open(*place);
  if (!broker) {
    code = fail(exit_failed, "--mqtt: " + broker.error());
    return nullptr;
  }
  std::string name = fmt::format("mqtt://{}:{}/{}", place->host, place->port, place->topic);
  return std::unique_ptr<ServedStatus>(new ServedStatus(std::move(*broker), machine, std::move(name)));
}

// Axes are named as by HTTP.
std::string ServedStatus::text_of(const MachineStatus& status, const WebApi* api) const {
  nlohmann::ordered_json place = nlohmann::ordered_json::object();
  for (const AxisDescription& axis : machine_.axes) {
    const char name = static_cast<char>(letter_of(axis.axis) - 'A' + 'a');
    place[std::string{name}] = std::round(status.now_at[axis.axis] * 1e4) / 1e4;
  }
  nlohmann::ordered_json all = {{"machine", machine_.name}, {"state", name_of(status.state)}, {"position", place}};
  if (status.executes.line != 0) all["line"] = status.executes.line;
  if (status.progress) all["progress"] = std::round(*status.progress * 1e3) / 1e3;
  if (api != nullptr && api->job().state == JobState::running) {
    all["job"] = api->job().name;
    if (const auto left = api->time_left()) all["left"] = std::round(left->value());
  }
  if (!status.trouble_sentence.text.empty()) all["trouble"] = status.trouble_sentence.text;
  return all.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void ServedStatus::poll(const MachineSession& session, const WebApi* api) {
  const auto now = std::chrono::steady_clock::now();
  if (now - told_at_ < between_messages) return;
  told_at_ = now;
  if (std::exchange(connections_, broker_->connections()) != broker_->connections()) told_.clear();
  if (connections_ == 0) return;
  const MachineStatus status = session.status();
  std::string text = text_of(status, api);
  if (text == told_) return;
  broker_->tell("state", name_of(status.state));
  broker_->tell("status", text);
  told_ = std::move(text);
}

}  // namespace passo
