// passo serve --mqtt, with the broker of Debian's package mosquitto.
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "kit/command_line.hpp"
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <mosquitto.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using testing::HasSubstr;

unsigned free_port() {
  const int probe = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(probe, reinterpret_cast<const sockaddr*>(&address), size), 0);
  getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
  close(probe);
  return ntohs(address.sin_port);
}

class ServeMqtt : public passo::test::CommandLine {
 protected:
  ServeMqtt() { mosquitto_lib_init(); }
  ~ServeMqtt() override {
    for (const pid_t one : started_) end(one);
    mosquitto_lib_cleanup();
  }
  void SetUp() override {
    if (!std::filesystem::exists("/usr/sbin/mosquitto")) GTEST_SKIP() << "needs the package mosquitto";
  }

  pid_t start(std::vector<std::string> words, const std::string& said) {
    const pid_t process = fork();
    if (process == 0) {
      if (std::freopen(path(said).c_str(), "w", stdout) == nullptr || dup2(1, 2) < 0) _exit(1);
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(arguments[0], arguments.data());
      _exit(1);
    }
    started_.push_back(process);
    return process;
  }
  void end(pid_t process) {
    if (kill(process, SIGTERM) == 0) waitpid(process, nullptr, 0);
    std::erase(started_, process);
  }
  // The text that the broker keeps for a topic. Empty after a second without one.
  std::string kept(const std::string& topic) const {
    mosquitto* const line = mosquitto_new(nullptr, true, nullptr);
    std::string text;
    mosquitto_user_data_set(line, &text);
    mosquitto_message_callback_set(line, [](mosquitto*, void* all, const mosquitto_message* message) {
      static_cast<std::string*>(all)->assign(static_cast<const char*>(message->payload),
                                             static_cast<std::size_t>(message->payloadlen));
    });
    if (mosquitto_connect(line, "127.0.0.1", static_cast<int>(port_), 10) == MOSQ_ERR_SUCCESS) {
      mosquitto_subscribe(line, nullptr, topic.c_str(), 0);
      for (int i = 0; i < 10 && text.empty(); ++i) mosquitto_loop(line, 100, 1);
      mosquitto_disconnect(line);
    } else {
      usleep(100'000);  // the broker is not there yet
    }
    mosquitto_destroy(line);
    return text;
  }
  // The first text with these words. Empty: none came.
  std::string text_with(const std::string& topic, const std::string& wanted) const {
    for (int i = 0; i < 500; ++i) {
      if (std::string text = kept(topic); text.find(wanted) != std::string::npos) return text;
      usleep(20'000);  // the status is published once a second
    }
    return {};
  }
  bool becomes(const std::string& topic, const std::string& wanted) const { return !text_with(topic, wanted).empty(); }

  unsigned port_ = free_port();
  std::vector<pid_t> started_;
};

// The daemon is there before the broker, tells what it is, and is told of as gone when it is killed.
TEST_F(ServeMqtt, tells_its_status_to_a_broker_that_comes_later) {
  const pid_t daemon = start({PASSO_PROGRAM, "serve", "--grbl-pty", path("tty"), "--mqtt",
                              "127.0.0.1:" + std::to_string(port_), "--mqtt-topic", "shop/router"},
                             "said");
  usleep(200'000);
  start({"/usr/sbin/mosquitto", "-p", std::to_string(port_)}, "broker");
  EXPECT_TRUE(becomes("shop/router/online", "1")) << passo::test::read(path("said"));
  EXPECT_TRUE(becomes("shop/router/state", "Idle"));
  const auto status = nlohmann::json::parse(kept("shop/router/status"), nullptr, false);
  ASSERT_TRUE(status.is_object());
  EXPECT_EQ(status["state"], "Idle");
  EXPECT_EQ(status["position"]["x"], 0.0);
  kill(daemon, SIGKILL);
  waitpid(daemon, nullptr, 0);
  std::erase(started_, daemon);
  EXPECT_TRUE(becomes("shop/router/online", "0"));
}

// Whatever others publish there.
TEST_F(ServeMqtt, obeys_no_message) {
  start({"/usr/sbin/mosquitto", "-p", std::to_string(port_)}, "broker");
  start({PASSO_PROGRAM, "serve", "--grbl-pty", path("tty"), "--mqtt", "127.0.0.1:" + std::to_string(port_),
         "--mqtt-topic", "shop/router"},
        "said");
  ASSERT_TRUE(becomes("shop/router/state", "Idle")) << passo::test::read(path("said"));
  mosquitto* const other = mosquitto_new(nullptr, true, nullptr);
  ASSERT_EQ(mosquitto_connect(other, "127.0.0.1", static_cast<int>(port_), 10), MOSQ_ERR_SUCCESS);
  const auto turn = [other] {
    for (int i = 0; i < 10; ++i) mosquitto_loop(other, 20, 1);
  };
  poll();
  const std::string line = "G91 G0 X30\n";
  for (const char* const topic :
       {"shop/router", "shop/router/command", "shop/router/gcode", "shop/router/status/set"}) {
    mosquitto_publish(other, nullptr, topic, static_cast<int>(line.size()), line.data(), 1, true);
    poll();
  }
  mosquitto_disconnect(other);
  mosquitto_destroy(other);
  EXPECT_EQ(kept("shop/router/gcode"), line) << "the broker has them";
  usleep(1'100'000);  // the status is told once a second
  EXPECT_EQ(kept("shop/router/state"), "Idle");
  EXPECT_EQ(nlohmann::json::parse(kept("shop/router/status"), nullptr, false)["position"]["x"], 0.0);
}

TEST_F(ServeMqtt, tells_the_job_and_the_time_left) {
  if (std::system("command -v jq curl >/dev/null") != 0) GTEST_SKIP() << "jq or curl is not there";
  start({"/usr/sbin/mosquitto", "-p", std::to_string(port_)}, "broker");
  const std::string http = "127.0.0.1:" + std::to_string(free_port());
  start(
      {PASSO_PROGRAM, "serve", "--http", http, "--mqtt", "127.0.0.1:" + std::to_string(port_), "--mqtt-topic", "shop"},
      "said");
  ASSERT_TRUE(becomes("shop/state", "Idle")) << passo::test::read(path("said"));
  EXPECT_THAT(kept("shop/status"), testing::Not(HasSubstr("\"job\"")));
  const std::string program = write("part.ngc", "G21 G90 G1 X-30 F300\nM2\n");
  const std::string api = http + "/api/v1";
  const std::string commands = "key=$(curl -s -X POST -d '{}' " + api +
                               "/owner | jq -r .key); id=$(curl -s --data-binary @" + program + " '" + api +
                               "/programs?name=part.ngc' | jq .id); curl -s -X POST -H " + "\"X-Passo-Key: $key\" " +
                               api + "/programs/$id/run >/dev/null";
  EXPECT_EQ(std::system(commands.c_str()), 0);
  const std::string text = text_with("shop/status", "\"left\"");
  ASSERT_FALSE(text.empty()) << kept("shop/status");
  const auto status = nlohmann::json::parse(text, nullptr, false);
  EXPECT_EQ(status["job"], "part.ngc");
  EXPECT_GT(status["left"], 0);
  EXPECT_LE(status["left"], 7);
  EXPECT_TRUE(status["position"].contains("x"));
}

TEST_F(ServeMqtt, wants_a_good_address_topic_and_login) {
  EXPECT_THAT(passo("serve --check --mqtt :0").err, HasSubstr("--mqtt: expected HOST or HOST:PORT"));
  EXPECT_THAT(passo("serve --check --mqtt a --mqtt-topic 'a/#'").err, HasSubstr("--mqtt-topic"));
  EXPECT_THAT(passo("serve --check --mqtt a --mqtt-login " + write("login", "nobody\n")).err,
              HasSubstr("[serve.bad-login]"));
  EXPECT_EQ(passo("serve --check --mqtt a:1 --mqtt-login " + write("login", "me:word\n")).code, 0);
}

}  // namespace
