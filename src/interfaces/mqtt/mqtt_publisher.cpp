#include "passo/mqtt/mqtt_publisher.hpp"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "mosquitto_library.hpp"

namespace passo {
namespace {

constexpr int keep_alive = 20;  // s; a broker that hears nothing for half as long again makes "online" 0
constexpr int at_least_once = 1;
constexpr int look = 100;  // ms
constexpr int looks_between_attempts = 20;

}  // namespace

struct MqttPublisher::Client {
  Client(const MqttOptions& its_place, const MosquittoLibrary& its_library)
      : library(its_library), place(its_place), online(place.topic + "/online") {
    library.mosquitto_lib_init();
    line = library.mosquitto_new(nullptr, true, this);
  }
  ~Client() {
    ends = true;
    if (thread.joinable()) thread.join();
    if (line != nullptr) library.mosquitto_destroy(line);
    library.mosquitto_lib_cleanup();
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // In the client's thread.
  static void connected(mosquitto* line, void* self, int result) {
    if (result != 0) return;
    auto& client = *static_cast<Client*>(self);
    client.library.mosquitto_publish(line, nullptr, client.online.c_str(), 1, "1", at_least_once, true);
    ++client.connections;
  }
  // The library's own thread gives up a broker that refuses the first attempt; this one does not.
  void run() {
    while (!ends) {
      const int begun =
          library.mosquitto_connect_async(line, place.host.c_str(), static_cast<int>(place.port), keep_alive);
      while (begun == MOSQ_ERR_SUCCESS && !ends && library.mosquitto_loop(line, look, 1) == MOSQ_ERR_SUCCESS) continue;
      for (int i = 0; i < looks_between_attempts && !ends; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(look));
      }
    }
    library.mosquitto_publish(line, nullptr, online.c_str(), 1, "0", at_least_once, true);
    library.mosquitto_disconnect(line);
    for (int i = 0; i < 5 && library.mosquitto_loop(line, look, 1) == MOSQ_ERR_SUCCESS; ++i) continue;
  }

  const MosquittoLibrary& library;
  MqttOptions place;
  std::string online;
  mosquitto* line = nullptr;
  std::atomic<unsigned> connections = 0;
  std::atomic<bool> ends = false;
  std::thread thread;
};

MqttPublisher::MqttPublisher(std::unique_ptr<Client> client) : client_(std::move(client)) {}
MqttPublisher::~MqttPublisher() = default;

Result<std::unique_ptr<MqttPublisher>, std::string> MqttPublisher::open(const MqttOptions& place) {
  const MosquittoLibrary* const library = lazy_library<MosquittoLibrary>();
  if (library == nullptr)
    return Failure{std::string("libmosquitto is not installed: scripts/install.sh --build gets it")};
  auto client = std::make_unique<Client>(place, *library);
  mosquitto* const line = client->line;
  if (line == nullptr) return Failure{std::string("no memory for MQTT")};
  library->mosquitto_threaded_set(line, true);
  int error = library->mosquitto_will_set(line, client->online.c_str(), 1, "0", at_least_once, true);
  if (error == MOSQ_ERR_SUCCESS && !place.user.empty()) {
    error = library->mosquitto_username_pw_set(line, place.user.c_str(), place.password.c_str());
  }
  if (error != MOSQ_ERR_SUCCESS) return Failure{std::string(library->mosquitto_strerror(error))};
  library->mosquitto_connect_callback_set(line, Client::connected);
  client->thread = std::thread([all = client.get()] { all->run(); });
  return std::unique_ptr<MqttPublisher>(new MqttPublisher(std::move(client)));
}

unsigned MqttPublisher::connections() const {
  return client_->connections;
}

void MqttPublisher::tell(std::string_view name, std::string_view text) {
  const std::string topic = client_->place.topic + "/" + std::string(name);
  // At most once: without a broker nothing is kept.
  static_cast<void>(client_->library.mosquitto_publish(client_->line, nullptr, topic.c_str(),
                                                       static_cast<int>(text.size()), text.data(), 0, true));
}

}  // namespace passo
