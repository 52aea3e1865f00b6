// A build without libmosquitto.
#include "passo/mqtt/mqtt_publisher.hpp"

namespace passo {

struct MqttPublisher::Client {};

MqttPublisher::MqttPublisher(std::unique_ptr<Client> client) : client_(std::move(client)) {}
MqttPublisher::~MqttPublisher() = default;

Result<std::unique_ptr<MqttPublisher>, std::string> MqttPublisher::open(const MqttOptions&) {
  return Failure{std::string("this passo was built without libmosquitto: scripts/install.sh --build gets it")};
}
unsigned MqttPublisher::connections() const {
  return 0;
}
void MqttPublisher::tell(std::string_view, std::string_view) {}

}  // namespace passo
