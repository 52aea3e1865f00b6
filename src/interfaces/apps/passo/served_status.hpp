// ServedStatus: publishes the machine's status to an MQTT broker, at most once a second.
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

  // Null, with a message and `code`, if the address or the login is invalid.
  static std::unique_ptr<ServedStatus> open(const ServeArguments& arguments, const MachineDescription& machine,
                                            int& code);
  // Returns whether the arguments are valid. If not, shows a message.
  static bool check(const ServeArguments& arguments, int& code);

  // `api`: provides the job and the remaining time; null: not available.
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
