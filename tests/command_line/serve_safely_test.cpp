// passo serve: what must hold whatever else goes on. A hold gets through, and a restart moves no zero.
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "kit/board_on_port.hpp"
#include "kit/firmware_fakes.hpp"
#include "kit/served_http.hpp"
#include "kit/shared_case.hpp"
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
  bool is(const std::string& state) { return json("GET", "/status")["state"] == state; }
  static void say(int line, const std::string& text) {
    EXPECT_EQ(send(line, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  // Until `end` has come.
  static void hear(int line, const std::string& end) {
    std::string all;
    char bytes[4096];
    for (ssize_t got = 1; got > 0 && all.find(end) == std::string::npos;) {
      got = recv(line, bytes, sizeof bytes, 0);
      if (got > 0) all.append(bytes, static_cast<std::size_t>(got));
    }
    EXPECT_THAT(all, HasSubstr(end));
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

// The time of an emulated board passes only while the daemon waits for it. The journal of a job names the board's
// session before the job begins.
TEST_F(ServeSafely, begins_a_job_that_is_kept_on_an_emulated_board) {
  const auto info = passo("board info --json sim:uno");
  if (passo::test::lacks_an_emulator(info)) GTEST_SKIP() << info.err;
  serve({"--data", path("data"), "-m", PASSO_SOURCE_DIR "/examples/machines/uno.toml", "--board", "sim:uno"});
  run("G21 G90\nG1 X1 F3000\nM2\n", new_key());
  EXPECT_EQ(json("GET", "/status")["place"]["x"], 1.0);
}

// The board was switched off and on: its counts begin anew, and the work's zero of before is somewhere else.
TEST_F(ServeSafely, begins_no_program_where_the_board_has_lost_its_count) {
  const std::string machine = router_without_switches();
  std::string board = ServedBoard::serve("", machine);
  std::vector<std::string> options = {"--data", path("data"), "-m", machine, "--board", board};
  const auto place_file = [&] {
    std::string name = board;
    for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
    return path("state/passo/" + name + ".place");
  };
  serve(options);
  run("G21 G90\nG1 X5 F3000\nM2\n", new_key());
  end();
  const std::string written = passo::test::read(place_file());
  options.back() = board = ServedBoard::serve("", machine);
  std::ofstream(place_file()) << written;
  for (int i = 0; i < 2; ++i) {  // another restart of the daemon finds nothing out
    serve(options);
    const std::string key = new_key();
    const auto id = json("POST", "/programs?name=a.ngc", "G21 G90\nG1 X5 F3000\nM2\n").value("id", 0);
    const auto refused = json("POST", "/programs/" + std::to_string(id) + "/run", "", key);
    EXPECT_EQ(refused["error"]["code"], "run.place-unknown") << refused;
    EXPECT_EQ(json("POST", "/mdi", R"({"line": "G0 X1"})", key)["error"]["code"], "run.place-unknown");
    json("POST", "/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 1})", key);
    EXPECT_TRUE(until([&] { return json("GET", "/status")["place"]["x"] == i + 1.0; })) << "it jogs";
    EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Idle"; }));
    if (i == 0) end();
  }
  const std::string key = new_key();
  json("POST", "/position", R"({"place": {"x": 3, "y": 0, "z": 0}})", key);
  run("G21 G90\nG1 X5 F3000\nM2\n", key);
  EXPECT_EQ(json("GET", "/status")["place"]["x"], 5.0);
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

// Whoever keeps connections open, and says nothing or little on them, delays no hold and no stop. By each door a hold
// is the next thing that happens. The times are for a person to read; no time decides.
TEST_F(ServeSafely, holds_by_each_door_beside_700_idle_connections) {
  serve({"--grbl-tcp", "127.0.0.1:0"});
  const std::string key = new_key();
  json("POST", "/programs?name=long.ngc", "G21 G90\nG1 X100 F60\nM2\n");
  json("POST", "/programs/1/run", "", key);
  EXPECT_TRUE(until([&] { return is("Run"); }));
  const int sender = connected("tcp:127.0.0.1:");
  hear(sender, "is in control]\r\n");
  const int page = connected();
  say(page,
      "GET /api/v1/stream?hz=10 HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  hear(page, "\"state\"");
  std::vector<int> idle;
  for (int i = 0; i < 750; ++i) {
    idle.push_back(connected());
    if (i % 3 == 0) say(idle.back(), "POST /ap");
  }
  const std::string asks = R"({"do": "/api/v1/hold"})";
  const std::pair<const char*, std::function<void()>> doors[] = {
      {"HTTP", [&] { EXPECT_THAT(ask("POST", "/api/v1/hold"), HasSubstr("200 OK")); }},
      {"a sender's !", [&] { say(sender, "!?"), hear(sender, "<Hold"); }},
      {"the page's stream",
       [&] {
         say(page, "\x81" + std::string(1, static_cast<char>(0x80 + asks.size())) + std::string(4, '\0') + asks),
             hear(page, "\"do\":\"/api/v1/hold\"");
       }},
      {"HTTP stop", [&] { EXPECT_THAT(ask("POST", "/api/v1/stop"), HasSubstr("200 OK")); }}};
  for (const auto& [name, hold] : doors) {
    std::vector<double> times;
    const bool stops = std::string(name) == "HTTP stop";
    for (int round = 0; round < (stops ? 1 : 15); ++round) {
      const auto from = std::chrono::steady_clock::now();
      hold();
      times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count());
      EXPECT_TRUE(until([&] { return is(stops ? "Idle" : "Hold"); })) << name;
      if (stops) break;
      EXPECT_TRUE(until([&] { return json("GET", "/status")["rests"] == true; }));
      json("POST", "/resume", "", key);
      EXPECT_TRUE(until([&] { return is("Run"); }));
    }
    std::ranges::sort(times);
    std::printf("%s: least %.1f ms, middle %.1f ms, most %.1f ms\n", name, times.front(), times[times.size() / 2],
                times.back());
  }
  for (const int line : idle) close(line);
  close(sender);
  close(page);
}

// A board of the first contact is written to by another process, whose words everybody on the computer can read.
TEST_F(ServeSafely, no_password_of_a_board_is_in_the_list_of_processes) {
  passo::test::FirmwareTraits traits = passo::test::fluidnc();
  traits.settings.emplace_back("Sta/Password", "old-secret");
  const passo::test::BoardOnPort<passo::test::FirmwareFake> board{passo::test::FirmwareFake(traits)};
  serve();
  const std::string key = new_key();
  const std::string port = board.address().substr(std::string("grbl:").size());
  json("POST", "/ports/open", R"({"device":")" + port + R"("})", key);
  ASSERT_TRUE(until([&] { return json("GET", "/ports/open")["state"] == "done"; })) << json("GET", "/ports/open");
  const auto begun =
      json("POST", "/board/settings", R"({"order":"write","values":{"$Sta/Password":"new-secret"}})", key);
  ASSERT_EQ(begun["state"], "running") << begun;
  bool is_seen = false;
  EXPECT_TRUE(until([&] {
    for (const auto& one : std::filesystem::directory_iterator("/proc")) {
      is_seen = is_seen || passo::test::read(one.path() / "cmdline").find("new-secret") != std::string::npos;
    }
    return json("GET", "/board/settings")["state"] != "running";
  }));
  EXPECT_FALSE(is_seen);
  const auto report = json("GET", "/board/settings")["report"];
  ASSERT_EQ(report["changes"].size(), 1U) << json("GET", "/board/settings");
  // It has reached the board, which takes it from its YAML file only.
  EXPECT_THAT(report["changes"][0].dump(), HasSubstr("the board rejects $Sta/Password=********"));
}

// The cases of users, where they are at hand.
TEST_F(ServeSafely, shared_case_of_the_restart) {
  const auto said = passo::test::run_shared_case("restart-shifts-zero.sh", "jq curl", path("out"));
  if (!said) GTEST_SKIP() << "no ../shared/cases, or no jq or curl";
  EXPECT_THAT(said->substr(said->find("after G1 X0")), HasSubstr("[32000,")) << *said;
}

TEST_F(ServeSafely, shared_case_of_the_sender_that_has_left) {
  const auto said = passo::test::run_shared_case("line-state.sh", "jq curl nc", path("out"));
  if (!said) GTEST_SKIP() << "no ../shared/cases, or no jq, curl or nc";
  EXPECT_THAT(*said, testing::StartsWith("[\"Idle\","));
  EXPECT_THAT(*said, HasSubstr("\"ticket\"")) << "a jog begins";
}

}  // namespace
