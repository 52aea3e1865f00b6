// ServedStatus: the machine's status for an MQTT broker, once a second at most.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "commands.hpp"

#include "passo/api/web_api.hpp"
#include "passo/mqtt/mqtt_publisher.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class ServedStatus {
 public:
  static constexpr std::chrono::seconds between_messages{1};

  // Null, with a message and `code`: the address or the login is not good.
  static std::unique_ptr<ServedStatus> open(const ServeArguments& arguments, const MachineDescription& machine,
                                            int& code);
  // Whether the arguments are good. If not, shows a message.
  static bool check(const ServeArguments& arguments, int& code);

  // `api`: knows the job and the time left; null: nobody does.
  void poll(const MachineSession& session, const WebApi* api);
  std::string name() const { return name_; }

 private:
  ServedStatus(std::unique_ptr<MqttPublisher> broker, const MachineDescription& machine, std::string name)
      : broker_(std::move(broker)), machine_(machine), name_(std::move(name)) {}
  std::string text_of(const MachineStatus& status, const WebApi* api) const;

  std::unique_ptr<MqttPublisher> broker_;
  const MachineDescription& machine_;
  std::string name_;
  std::chrono::steady_clock::time_point told_at_;
  std::string told_;
  unsigned connections_ = 0;
};

}  // namespace passo
