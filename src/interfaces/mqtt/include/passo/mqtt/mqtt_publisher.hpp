// MqttPublisher: publishes short texts to an MQTT broker, for displays and other equipment in a workshop. It never
// subscribes, so the machine cannot be moved by MQTT.
//
// The broker retains each text, so a new subscriber receives the last one. "online" is 1 while this program is
// connected; the broker itself sets it to 0 when the connection is lost. The program keeps trying to reach an
// unavailable broker without blocking; texts published in the meantime are dropped.
//
// The connection has a separate thread. Only mqtt_publisher.cpp uses libmosquitto.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

struct MqttOptions {
  std::string host;
  unsigned port = 1883;
  std::string topic;  // prefix of all topics, followed by '/'
  std::string user;   // empty: no login
  std::string password;
};

class MqttPublisher {
 public:
  // Begins to connect. The error is a sentence with the reason.
  static Result<std::unique_ptr<MqttPublisher>, std::string> open(const MqttOptions& place);
  ~MqttPublisher();
  MqttPublisher(const MqttPublisher&) = delete;
  MqttPublisher& operator=(const MqttPublisher&) = delete;

  // Returns the number of successful connections. After each one, everything must be published again.
  unsigned connections() const;
  // Publishes a text. `name`: the last part of the topic.
  void tell(std::string_view name, std::string_view text);

 private:
  struct Client;
  explicit MqttPublisher(std::unique_ptr<Client> client);

  std::unique_ptr<Client> client_;
};

}  // namespace passo
