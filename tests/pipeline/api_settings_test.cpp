// The settings of a Grbl board over the API: who may write them, and what is asked of the board.
#include "api_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::ApiRun;
using test::Json;

class FakeSettings final : public BoardSettings {
 public:
  bool has_board() const override { return connected; }
  bool begin(const SettingsOrder& order) override {
    if (now.state == SettingsResult::State::running) return false;
    orders.push_back(order);
    now = {.state = SettingsResult::State::running, .board = "grbl:/dev/ttyACM0"};
    return true;
  }
  const SettingsResult& result() override { return now; }

  SettingsResult now;
  std::vector<SettingsOrder> orders;
  bool connected = true;
};

class ApiSettings : public testing::Test {
 protected:
  static std::string code_of(const Json& answer) { return answer["error"].value("code", ""); }
  void finish() {
    settings.now.state = SettingsResult::State::done;
    settings.now.report = R"({"settings": [{"name": "$110", "value": "500"}], "changes": []})";
    settings.now.file = "$110=500\n";
  }

  FakeSettings settings;
  ApiRun run{test::GrblRun::at_zero(), nullptr, {}, nullptr, {}, nullptr, nullptr, &settings};
};

TEST_F(ApiSettings, are_read_and_written_by_the_client_in_control_only) {
  run.ask("POST", "/board/settings", R"({"order": "read"})", "nobody");
  EXPECT_EQ(run.status, 403U);
  EXPECT_EQ(run.get("/board/settings")["state"], "none");
  EXPECT_EQ(code_of(run.get("/board/settings/file")), "settings.unread");
  run.own();
  EXPECT_EQ(run.post("/board/settings", R"({"order": "read"})")["state"], "running");
  EXPECT_EQ(run.status, 202U);
  EXPECT_EQ(code_of(run.post("/board/settings", R"({"order": "read"})")), "settings.busy");
  finish();
  EXPECT_EQ(run.get("/board/settings")["report"]["settings"][0]["value"], "500");
  run.post("/board/settings", R"({"order": "write", "values": {"$110": "600", "$132": "80.5"}})");
  EXPECT_EQ(run.status, 202U);
  ASSERT_EQ(settings.orders.size(), 2U);
  EXPECT_EQ(settings.orders[0].kind, SettingsOrder::Kind::read);
  const std::vector<std::pair<std::string, std::string>> wanted{{"$110", "600"}, {"$132", "80.5"}};
  EXPECT_EQ(settings.orders[1].values, wanted);
}

TEST_F(ApiSettings, are_compared_with_a_file_and_restored_from_one) {
  run.own();
  run.post("/board/settings", R"({"order": "compare", "file": "$110=1\n"})");
  finish();
  run.post("/board/settings", R"({"order": "restore", "file": "$110=2\n"})");
  ASSERT_EQ(settings.orders.size(), 2U);
  EXPECT_EQ(settings.orders[0].kind, SettingsOrder::Kind::compare);
  EXPECT_EQ(settings.orders[0].file, "$110=1\n");
  EXPECT_EQ(settings.orders[1].kind, SettingsOrder::Kind::restore);
}

// A line end would make a second line of a value, e.g. one that moves.
TEST_F(ApiSettings, with_values_that_are_no_single_words_are_refused) {
  run.own();
  for (const char* body :
       {"{}", R"({"order": "all"})", R"({"order": "write"})", R"({"order": "write", "values": {}})",
        R"({"order": "write", "values": {"$110": 5}})", R"({"order": "write", "values": {"$110": "5\n$J=X9F100"}})",
        R"({"order": "write", "values": {"$110=5\n$1": "5"}})", R"({"order": "write", "values": {"G0X9": "5"}})",
        R"({"order": "write", "values": {"$": "5"}})", R"({"order": "restore"})", R"({"order": "read", "more": 1})"}) {
    EXPECT_EQ(code_of(run.post("/board/settings", body)), "http.bad-body") << body;
  }
  EXPECT_TRUE(settings.orders.empty());
}

TEST_F(ApiSettings, need_a_board_at_rest) {
  run.own();
  settings.connected = false;
  EXPECT_EQ(code_of(run.post("/board/settings", R"({"order": "read"})")), "settings.no-board");
  settings.connected = true;
  run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 5, "lease": 5})");
  EXPECT_EQ(code_of(run.post("/board/settings", R"({"order": "read"})")), "machine.busy");
  EXPECT_TRUE(settings.orders.empty());
}

}  // namespace
}  // namespace passo
