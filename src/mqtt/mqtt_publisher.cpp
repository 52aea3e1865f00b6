#include "passo/mqtt/mqtt_publisher.hpp"

#include <atomic>
#include <utility>

#include <mosquitto.h>

namespace passo {
namespace {

constexpr int keep_alive = 20;  // s; a broker that hears nothing for half as long again makes "online" 0
constexpr int at_least_once = 1;
constexpr unsigned longest_pause = 30;  // s, between attempts

}  // namespace

struct MqttPublisher::Client {
  explicit Client(const MqttPlace& place) : online(place.topic + "/online"), topic(place.topic + "/") {
    mosquitto_lib_init();
    line = mosquitto_new(nullptr, true, this);
  }
  ~Client() {
    if (line != nullptr) {
      if (connections > 0) {
        mosquitto_publish(line, nullptr, online.c_str(), 1, "0", at_least_once, true);
        mosquitto_disconnect(line);
      }
      mosquitto_loop_stop(line, connections == 0);
      mosquitto_destroy(line);
    }
    mosquitto_lib_cleanup();
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // In the library's thread.
  static void connected(mosquitto* line, void* self, int result) {
    if (result != 0) return;
    auto& client = *static_cast<Client*>(self);
    mosquitto_publish(line, nullptr, client.online.c_str(), 1, "1", at_least_once, true);
    ++client.connections;
  }

  std::string online;
  std::string topic;
  mosquitto* line = nullptr;
  std::atomic<unsigned> connections = 0;
};

MqttPublisher::MqttPublisher(std::unique_ptr<Client> client) : client_(std::move(client)) {}
MqttPublisher::~MqttPublisher() = default;

Result<std::unique_ptr<MqttPublisher>, std::string> MqttPublisher::open(const MqttPlace& place) {
  auto client = std::make_unique<Client>(place);
  mosquitto* const line = client->line;
  if (line == nullptr) return Failure{std::string("no memory for MQTT")};
  int error = mosquitto_will_set(line, client->online.c_str(), 1, "0", at_least_once, true);
  if (error == MOSQ_ERR_SUCCESS && !place.user.empty()) {
    error = mosquitto_username_pw_set(line, place.user.c_str(), place.password.c_str());
  }
  mosquitto_connect_callback_set(line, Client::connected);
  mosquitto_reconnect_delay_set(line, 1, longest_pause, true);
  // A broker that cannot be reached now is tried again by the library's thread.
  if (error == MOSQ_ERR_SUCCESS) {
    error = mosquitto_connect_async(line, place.host.c_str(), static_cast<int>(place.port), keep_alive);
    if (error == MOSQ_ERR_ERRNO || error == MOSQ_ERR_EAI) error = MOSQ_ERR_SUCCESS;
  }
  if (error == MOSQ_ERR_SUCCESS) error = mosquitto_loop_start(line);
  if (error != MOSQ_ERR_SUCCESS) return Failure{std::string(mosquitto_strerror(error))};
  return std::unique_ptr<MqttPublisher>(new MqttPublisher(std::move(client)));
}

unsigned MqttPublisher::connections() const {
  return client_->connections;
}

void MqttPublisher::tell(std::string_view name, std::string_view text) {
  const std::string topic = client_->topic + std::string(name);
  // At most once: without a broker nothing is kept.
  static_cast<void>(
      mosquitto_publish(client_->line, nullptr, topic.c_str(), static_cast<int>(text.size()), text.data(), 0, true));
}

}  // namespace passo
