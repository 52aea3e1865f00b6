// passo serve --board grbl: on firmware of other people: Grbl 1.1h on an emulated Uno, and grblHAL's simulator. The API
// does what the web interface does. Times are not judged: the simulators share the computer.
#include <memory>
#include <string>
#include <vector>

#include "kit/real_grbl.hpp"
#include "kit/served_http.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using testing::HasSubstr;
using Json = nlohmann::json;
namespace test = passo::test;

class ServeOnRealGrbl : public test::ServedHttp {
 protected:
  void SetUp() override {
    if (!test::has_grbl_peers()) GTEST_SKIP() << "no ../shared/peers/grbl beside the checkout";
  }
  // A small router, as a machine file made for such a board.
  std::vector<std::string> on(const std::string& board) const {
    return {"--machine", PASSO_SOURCE_DIR "/examples/machines/router.toml", "--board", board};
  }
  bool serve_uno(const std::vector<std::string>& more = {}) {
    const std::string program = test::built_uno(path(""));
    if (program.empty()) return false;
    std::vector<std::string> words = {program, test::grbl_peers + "/grbl-1.1h-uno.elf", path("tty"), "--speed", "1"};
    words.insert(words.end(), more.begin(), more.end());
    board_ = std::make_unique<test::ChildProcess>(words, path(""), path("counts"));
    {
      test::RealTalker talker(test::open_when_there(path("tty")));
      talker.listen(40, std::chrono::seconds(15));
      for (const char* setting : {"$24=100\n", "$25=500\n", "$110=3000\n", "$111=3000\n", "$112=3000\n", "$120=200\n",
                                  "$121=200\n", "$122=200\n"}) {
        talker.ask(setting, 1);
      }
      for (const std::string& setting : settings_) talker.ask(setting + "\n", 1);
    }
    serve(on("grbl:" + path("tty")));
    return true;
  }
  void serve_grblhal() {
    for (const int port : {20000 + getpid() % 10000, 30000 + getpid() % 10000}) {
      const std::vector<std::string> words = {test::grbl_peers + "/grblHAL_sim",
                                              "-n",
                                              "-p",
                                              std::to_string(port),
                                              "-t",
                                              "1",
                                              "-e",
                                              "eeprom",
                                              "-s",
                                              "steps",
                                              "-b",
                                              "blocks",
                                              "-r",
                                              "0.01"};
      board_ = std::make_unique<test::ChildProcess>(words, path(""));
      const int line = test::connect_when_there(port);
      if (line < 0) continue;
      test::RealTalker talker(line);
      talker.listen(2, std::chrono::seconds(1));
      for (const char* setting :
           {"$110=3000\n", "$111=3000\n", "$112=3000\n", "$120=200\n", "$121=200\n", "$122=200\n"}) {
        talker.ask(setting, 1);
      }
      address_ = fmt::format("grbl:tcp:127.0.0.1:{}", port);
      break;
    }
    ASSERT_FALSE(address_.empty());
    serve(on(address_));
  }

  Json status() const { return json("GET", "/status"); }
  std::string state() const { return status().value("state", ""); }
  bool until_state(const std::string& wanted) {
    return until([&] { return state() == wanted; });
  }
  Json post(const std::string& what, const Json& body = Json()) const {
    return json("POST", what, body.is_null() ? "" : body.dump(),
                key_ + (body.is_null() ? "" : "Content-Type: application/json\r\n"));
  }
  // Uploads a program, and begins it.
  Json begin(const std::string& text) const {
    const auto program = json("POST", "/programs?name=p.ngc&dialect=linuxcnc", text);
    return json("POST", fmt::format("/programs/{}/run", program.value("id", 0)), "", key_);
  }
  bool until_job(const std::string& wanted) {
    return until([&] {
      const Json job = status()["job"];
      return job.is_object() && job["state"] == wanted;
    });
  }

  // What people do first: jog, zero, run, hold, override.
  void drive_it() {
    key_ = new_key();
    const Json machine = json("GET", "/machine");
    for (const Json& one : machine["abilities"]) {
      if (one["ability"] == "exact-resume") {
        EXPECT_EQ(one["can"], false);
        EXPECT_THAT(one["why"].get<std::string>(), HasSubstr("line"));
      }
      if (one["ability"] == "jog") EXPECT_EQ(one["can"], true);
    }
    // A held key, which is released.
    ASSERT_TRUE(post("/jog", {{"direction", {{"x", 1}}}, {"speed", 1200}, {"lease", 0.5}}).contains("ticket"));
    for (int i = 0; i < 8; ++i) {
      usleep(100'000);
      post("/jog/renew");
    }
    post("/stop");
    ASSERT_TRUE(until_state("Idle"));
    const double x = status()["place"]["x"];
    EXPECT_GT(x, 1);
    EXPECT_LT(x, 25);
    // A key whose client has gone.
    ASSERT_TRUE(post("/jog", {{"direction", {{"y", 1}}}, {"speed", 600}, {"lease", 0.3}}).contains("ticket"));
    ASSERT_TRUE(until_state("Idle"));
    const double y = status()["place"]["y"];
    EXPECT_GT(y, 0.2);
    EXPECT_LT(y, 6);
    // The zero of the work is on the board.
    EXPECT_TRUE(post("/work", {{"place", {{"x", 0}, {"y", 0}}}}).contains("work_offset"));
    EXPECT_NEAR(status()["work_offset"]["x"], x, 1e-3);
    // A program, held on its way, at half the feed.
    begin("G21 G90\nG1 X20 F1200\nG1 Y10\nG1 X0 Y0\nM2\n");
    ASSERT_TRUE(until([&] { return status()["place"]["x"].get<double>() > x + 2; })) << status();
    post("/hold");
    ASSERT_TRUE(until([&] { return state() == "Hold" && status()["rests"].get<bool>(); }));
    const double held = status()["place"]["x"];
    EXPECT_LT(held, x + 20);
    usleep(500'000);
    EXPECT_EQ(status()["place"]["x"], held);
    EXPECT_EQ(status()["line"], 2);
    post("/override", {{"feed", 0.5}});
    post("/resume");
    ASSERT_TRUE(until_job("done")) << status();
    EXPECT_NEAR(status()["place"]["x"], x, 0.005);
    EXPECT_NEAR(status()["place"]["y"], y, 0.005);
    EXPECT_EQ(status()["overrides"]["feed"], 1.0) << "a program's end ends the overrides";
    // A stop brakes, and what comes next begins there.
    begin("G21 G90\nG1 X40 F1200\nM2\n");
    ASSERT_TRUE(until([&] { return status()["place"]["x"].get<double>() > x + 3; }));
    post("/stop");
    ASSERT_TRUE(until_job("stopped")) << status();
    ASSERT_TRUE(until_state("Idle"));
    // A line of the console.
    EXPECT_FALSE(post("/mdi", {{"line", "G0 X1 Y1"}}).contains("error"));
    ASSERT_TRUE(until([&] {
      return state() == "Idle" && std::abs(status()["place"]["x"].get<double>() - x - 1) < 0.005;
    })) << status();
  }

  std::vector<std::string> settings_;
  std::string address_;
  std::string key_;
  std::unique_ptr<test::ChildProcess> board_;
};

TEST_F(ServeOnRealGrbl, grbl_on_an_uno_jogs_runs_holds_and_stops) {
  if (!serve_uno()) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  drive_it();
}

TEST_F(ServeOnRealGrbl, grblhal_jogs_runs_holds_and_stops) {
  serve_grblhal();
  drive_it();
}

TEST_F(ServeOnRealGrbl, grbl_on_an_uno_homes_probes_and_survives_a_power_cut_and_an_unplugged_line) {
  settings_ = {"$22=1", "$27=1"};
  if (!serve_uno({"--switch-at", "X:500", "--switch-at", "Y:500", "--switch-at", "Z:250", "--probe-at", "Z:-750"})) {
    GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  }
  key_ = new_key();
  post("/home");
  ASSERT_TRUE(until([&] { return status()["trust"] == "homed"; })) << status();
  // Down to the probe.
  begin("G21 G90\nG38.2 Z-8 F200\nG1 Z-2 F400\nM2\n");
  ASSERT_TRUE(until_job("done")) << status();
  EXPECT_NEAR(status()["place"]["z"], -2, 0.005);
  // The line is pulled during a motion.
  begin("G21 G90\nG1 X-30 F600\nM2\n");
  ASSERT_TRUE(until([&] { return status()["place"]["x"].get<double>() < -3; }));
  board_->write("power\n");
  ASSERT_TRUE(until_state("Fault")) << status();
  EXPECT_EQ(status()["lost_place"], true);
  EXPECT_NE(status()["trouble"], "");
  post("/reset");
  ASSERT_TRUE(until_state("Idle")) << status();
  EXPECT_EQ(status()["lost_place"], true);
  post("/home");
  ASSERT_TRUE(until([&] { return status()["trust"] == "homed"; })) << status();
}

}  // namespace
