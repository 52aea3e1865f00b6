// passo serve: what must hold whatever else goes on. A hold gets through, and a restart moves no zero.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "kit/served_http.hpp"
#include <gmock/gmock.h>

namespace {

using testing::HasSubstr;

class ServeSafely : public passo::test::ServedHttp {
 protected:
  // The usual router without switches for homing.
  std::string router_without_switches() {
    std::ifstream file(std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml");
    std::string text;
    bool leaves_out = false;
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("[")) leaves_out = line == "[homing]" || line.ends_with(".home]");
      if (!leaves_out) text += line + "\n";
    }
    return write("router.toml", text);
  }
  void run(const std::string& program, const std::string& key) {
    const auto id = json("POST", "/programs?name=a.ngc", program).value("id", 0);
    json("POST", "/programs/" + std::to_string(id) + "/run", "", key);
    EXPECT_TRUE(until([&] { return json("GET", "/status")["job"]["state"] == "done"; })) << json("GET", "/status");
    EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Idle"; }));
  }
  double counted_x(const std::string& board) const {
    const auto info = nlohmann::json::parse(passo("board info --json " + board).out, nullptr, false);
    return info["status"]["positions"][0].get<double>();
  }
};

// The board has lost no step: the work's zero stays where it was, however the daemon ended.
TEST_F(ServeSafely, keeps_the_zero_of_a_machine_that_is_not_homed_over_restarts) {
  const std::string machine = router_without_switches();
  const std::string board = ServedBoard::serve("", machine);
  const std::vector<std::string> options = {"--data", path("data"), "-m", machine, "--board", board};
  serve(options);
  const std::string key = new_key();
  run("G21 G90\nG1 X5 F3000\nM2\n", key);
  json("POST", "/work", R"({"place": {"x": 0}})", key);
  run("G21 G90\nG1 X2 F3000\nM2\n", key);
  EXPECT_EQ(json("GET", "/status")["place"]["x"], 7.0);
  const double steps_per_mm = counted_x(board) / 7;
  for (const int signal : {SIGTERM, SIGKILL, SIGTERM}) {
    end(signal);
    serve(options);
    const auto status = json("GET", "/status");
    EXPECT_EQ(status["place"]["x"], 7.0) << signal;
    EXPECT_EQ(status["work_offset"]["x"], 5.0);
    EXPECT_EQ(status["trust"], "unknown") << "it goes on counting, and nobody knows where machine zero is";
  }
  run("G21 G90\nG1 X0 F3000\nM2\n", new_key());
  EXPECT_EQ(counted_x(board), std::round(5 * steps_per_mm));
}

// What a person says about the place is written down before anything else happens.
TEST_F(ServeSafely, knows_a_place_that_was_told_after_it_was_killed) {
  const std::string machine = router_without_switches();
  const std::string board = ServedBoard::serve("", machine);
  const std::vector<std::string> options = {"--data", path("data"), "-m", machine, "--board", board};
  serve(options);
  json("POST", "/position", R"({"place": {"x": 11, "y": 0, "z": 0}})", new_key());
  const std::string file = path("state/passo");
  const auto is_written = [&] {
    for (const auto& one : std::filesystem::directory_iterator(file)) {
      if (one.path().extension() == ".place" && passo::test::read(one.path()).find("trust 1") != std::string::npos)
        return true;
    }
    return false;
  };
  EXPECT_TRUE(until(is_written));
  end(SIGKILL);
  serve(options);
  EXPECT_EQ(json("GET", "/status")["place"]["x"], 11.0);
  EXPECT_NE(json("GET", "/status")["trust"], "unknown");
}

// Whoever keeps connections open, and says nothing or little on them, delays no hold and no stop.
TEST_F(ServeSafely, hears_a_hold_beside_hundreds_of_idle_connections) {
  serve();
  const std::string key = new_key();
  json("POST", "/programs?name=long.ngc", "G21 G90\nG1 X100 F300\nM2\n");
  json("POST", "/programs/1/run", "", key);
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Run"; }));
  std::vector<int> lines;
  for (int i = 0; i < 750; ++i) {
    lines.push_back(connected());
    if (i % 3 == 0) static_cast<void>(send(lines.back(), "POST /ap", 8, MSG_NOSIGNAL));
  }
  EXPECT_THAT(ask("POST", "/api/v1/hold"), HasSubstr("200 OK"));
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Hold"; }));
  EXPECT_THAT(ask("POST", "/api/v1/stop"), HasSubstr("200 OK"));
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Idle"; }));
  for (const int line : lines) close(line);
}

// The case of a user, step by step, where it is at hand.
TEST_F(ServeSafely, shared_case_of_the_restart) {
  const std::string file = std::string(PASSO_SOURCE_DIR) + "/../shared/cases/serve/restart-shifts-zero.sh";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  if (std::system("command -v jq curl >/dev/null") != 0) GTEST_SKIP() << "jq or curl is not there";
  const std::string out = path("out");
  const std::string command = "cd " PASSO_SOURCE_DIR " && PASSO=" PASSO_PROGRAM " XDG_STATE_HOME=" + path("state") +
                              " bash " + file + " >" + out + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()) & 0x7F, 0);
  const std::string said = passo::test::read(out);
  const std::string last = said.substr(said.find("after G1 X0"));
  EXPECT_THAT(last, HasSubstr("[32000,")) << said;
}

}  // namespace
