// MqttPublisher: tells short texts to an MQTT broker, for displays and other machines of a workshop. It only publishes
// and never subscribes, so MQTT cannot move the machine.
//
// Each text is retained by the broker, so whoever subscribes later gets the last one. "online" is 1 while this program
// is connected; the broker itself makes it 0 when the connection breaks. A broker that is away is tried again and
// again, and never waited for: what is told meanwhile is dropped.
//
// The connection has a thread of its own. Only mqtt_publisher.cpp sees libmosquitto.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

struct MqttPlace {
  std::string host;
  unsigned port = 1883;
  std::string topic;  // all topics begin with it and '/'
  std::string user;   // empty: nobody logs in
  std::string password;
};

class MqttPublisher {
 public:
  // Begins to connect. The error is a sentence with the reason.
  static Result<std::unique_ptr<MqttPublisher>, std::string> open(const MqttPlace& place);
  ~MqttPublisher();
  MqttPublisher(const MqttPublisher&) = delete;
  MqttPublisher& operator=(const MqttPublisher&) = delete;

  // How often a broker was reached. After each time all is to be told again.
  unsigned connections() const;
  // `name`: the last part of the topic.
  void tell(std::string_view name, std::string_view text);

 private:
  struct Client;
  explicit MqttPublisher(std::unique_ptr<Client> client);

  std::unique_ptr<Client> client_;
};

}  // namespace passo
