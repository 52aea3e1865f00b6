// The serial ports of the server's computer, and the first contact with a machine on one of them, over the API.
#include <map>

#include "api_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::ApiRun;
using test::Json;

// Two ports: an Uno that is free, and one that cncjs uses.
class FakeContact final : public FirstContact {
 public:
  const std::string& board() const override { return board_; }
  std::string ports() override {
    return R"({"ports": [
      {"device": "/dev/ttyACM0", "lasting_name": "/dev/serial/by-id/uno", "usb": {"vendor": "2341"}, "users": []},
      {"device": "/dev/ttyUSB0", "lasting_name": "/dev/ttyUSB0", "usb": {"vendor": "1a86"},
       "users": [{"process": 4711, "program": "cncjs"}, {"process": null, "program": ""}]}],
      "sees_all_programs": true})";
  }
  bool begin(const std::string& device, const std::string& board) override {
    if (now.state == ContactResult::State::running) return false;
    opened.push_back(board);
    now = {.state = ContactResult::State::running, .device = device, .board = board};
    return true;
  }
  const ContactResult& result() override { return now; }
  bool keeps(const std::string& name) const override { return files.count(name) > 0; }
  Result<KeptMachine, std::string> keep(const std::string& name, const std::string& text) override {
    if (disk_is_full) return Failure<std::string>{"no space left on device"};
    files[name] = text;
    return KeptMachine{.path = "/data/machines/" + name, .command = "passo serve -m " + name};
  }

  ContactResult now;
  std::vector<std::string> opened;
  std::map<std::string, std::string> files;
  bool disk_is_full = false;

 private:
  std::string board_ = "virtual";
};

class ApiPorts : public testing::Test {
 protected:
  std::string code_of(const Json& answer) const { return answer["error"].value("code", ""); }

  FakeContact contact;
  ApiRun run{test::GrblRun::at_zero(), nullptr, {}, nullptr, {}, nullptr, &contact};
};

TEST_F(ApiPorts, are_listed_with_those_who_use_them_and_none_is_opened) {
  const Json list = run.get("/ports");
  EXPECT_EQ(run.status, 200U);
  EXPECT_EQ(list["board"], "virtual");
  EXPECT_EQ(list["ports"][1]["users"][0]["program"], "cncjs");
  EXPECT_EQ(run.get("/ports/open")["state"], "none");
  EXPECT_TRUE(contact.opened.empty());
}

TEST_F(ApiPorts, are_opened_by_the_client_in_control_only) {
  run.ask("POST", "/ports/open", R"({"device": "/dev/ttyACM0"})", "nobody");
  EXPECT_EQ(run.status, 403U);
  EXPECT_TRUE(contact.opened.empty());
  run.own();
  const Json begun = run.post("/ports/open", R"({"device": "/dev/ttyACM0"})");
  EXPECT_EQ(run.status, 202U);
  EXPECT_EQ(begun["state"], "running");
  EXPECT_EQ(begun["board"], "grbl:/dev/serial/by-id/uno");
  EXPECT_EQ(code_of(run.post("/ports/open", R"({"device": "/dev/ttyACM0"})")), "ports.reading");
  contact.now.state = ContactResult::State::done;
  contact.now.report = R"({"machine_file": "name = 'x'"})";
  EXPECT_EQ(run.get("/ports/open")["report"]["machine_file"], "name = 'x'");
  run.post("/ports/open", R"({"device": "/dev/serial/by-id/uno", "baud": 250000})");
  EXPECT_EQ(contact.opened,
            (std::vector<std::string>{"grbl:/dev/serial/by-id/uno", "grbl:/dev/serial/by-id/uno@250000"}));
}

TEST_F(ApiPorts, that_are_in_use_or_not_listed_are_not_opened) {
  run.own();
  const Json busy = run.post("/ports/open", R"({"device": "/dev/ttyUSB0"})");
  EXPECT_EQ(run.status, 409U);
  EXPECT_EQ(code_of(busy), "ports.busy");
  EXPECT_EQ(busy["error"]["sentence"]["arguments"]["users"], "cncjs (4711), ?");
  for (const char* file : {"/etc/passwd", "tcp:a b:1", "/dev/ttyS0", "", "/dev/serial/by-id/../../sda"}) {
    EXPECT_EQ(code_of(run.post("/ports/open", Json({{"device", file}}).dump())), "ports.unknown") << file;
  }
  for (const char* body : {"{}", R"({"device": 3})", R"({"device": "/dev/ttyACM0", "baud": -1})",
                           R"({"device": "/dev/ttyACM0", "baud": "fast"})"}) {
    EXPECT_EQ(code_of(run.post("/ports/open", body)), "http.bad-body") << body;
  }
  EXPECT_TRUE(contact.opened.empty());
}

TEST_F(ApiPorts, may_be_addresses_in_the_network) {
  run.own();
  const Json begun = run.post("/ports/open", R"({"device": "tcp:192.168.1.20:23"})");
  EXPECT_EQ(run.status, 202U) << begun;
  EXPECT_EQ(begun["board"], "grbl:tcp:192.168.1.20:23");
  EXPECT_EQ(contact.opened, (std::vector<std::string>{"grbl:tcp:192.168.1.20:23"}));
}

TEST_F(ApiPorts, wait_while_the_machine_moves) {
  run.own();
  run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 5, "lease": 5})");
  ASSERT_EQ(run.status, 200U);
  EXPECT_EQ(code_of(run.get("/ports")), "machine.busy");
  EXPECT_EQ(code_of(run.post("/ports/open", R"({"device": "/dev/ttyACM0"})")), "machine.busy");
  EXPECT_TRUE(contact.opened.empty());
}

TEST_F(ApiPorts, give_a_machine_file_that_is_kept_under_a_new_name_only) {
  run.own();
  Diagnostics diagnostics;
  const std::string text =
      machine_file_text(PASSO_SOURCE_DIR "/examples/machines/router.toml", diagnostics).value_or("");
  const auto keep = [&](const std::string& name, const std::string& content) {
    return run.post("/machine/files", Json({{"name", name}, {"text", content}}).dump());
  };
  const Json kept = keep("my-uno.toml", text);
  EXPECT_EQ(run.status, 201U) << kept;
  EXPECT_EQ(kept["path"], "/data/machines/my-uno.toml");
  EXPECT_EQ(kept["command"], "passo serve -m my-uno.toml");
  EXPECT_EQ(contact.files["my-uno.toml"], text);
  EXPECT_EQ(code_of(keep("my-uno.toml", text)), "machine-file.exists");
  for (const char* name : {"", ".toml", "../x.toml", "a/b.toml", ".hidden.toml", "-m.toml", "x.txt", "a b.toml"}) {
    EXPECT_EQ(code_of(keep(name, text)), "machine-file.bad-name") << name;
  }
  EXPECT_EQ(code_of(keep("other.toml", "name = 3")), "machine-file.unsound");
  contact.disk_is_full = true;
  EXPECT_EQ(code_of(keep("other.toml", text)), "machine-file.unwritten");
  EXPECT_EQ(contact.files.size(), 1U);
}

}  // namespace
}  // namespace passo
