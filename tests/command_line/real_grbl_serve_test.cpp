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
    return {"--machine", machine_, "--board", board, "--grbl-tcp", "127.0.0.1:0"};
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

  std::string machine_ = PASSO_SOURCE_DIR "/examples/machines/router.toml";
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

// The tool setter is at the board's own probe input, 3 mm below the place after homing, which is Z-1: any tool touches
// at Z-4, and is 0.5 mm long. The board gets no M6, no G43 and no G49.
class ToolChangeOnRealGrbl : public ServeOnRealGrbl {
 protected:
  bool serve_homed() {
    settings_ = {"$22=1", "$27=1"};
    machine_ = write("m.toml", test::read(machine_) +
                                   "\n[tool_change]\nway = 'setter'\nsafe_z_mm = -1.5\nchange_at_mm = [-2, -2]\n"
                                   "measure_at_mm = [-4, -3]\nwindow_mm = [-6, -3]\nseek_mm_s = 5\nlatch_mm_s = 1\n"
                                   "retract_mm = 0.5\nlengths = 'absolute'\nnose_z_mm = -4.5\n");
    if (!serve_uno({"--switch-at", "X:500", "--switch-at", "Y:500", "--switch-at", "Z:250", "--probe-at", "Z:-750"})) {
      return false;
    }
    key_ = new_key();
    post("/home");
    EXPECT_TRUE(until([&] { return status()["trust"] == "homed"; })) << status();
    return true;
  }
  // Sets the probe input. The board reports it a little later.
  void close_setter(bool is_closed) {
    board_->write(is_closed ? "probe 1\n" : "probe 0\n");
    EXPECT_TRUE(until([&] { return status()["inputs"]["probe"] == is_closed; })) << status();
  }
  void expect_at(double x, double z) const {
    EXPECT_NEAR(status()["place"]["x"], x, 0.01);
    EXPECT_NEAR(status()["place"]["z"], z, 0.01);
  }
  void run_a_job_with_two_tools() {
    begin("G21 G90\nT1 M6\nG1 Z-2 X-3 F600\nT2 M6\nG0 Z-2.5\nM2\n");
    ASSERT_TRUE(until_state("Tool")) << status();
    EXPECT_EQ(status()["waits_for_tool"], 1);
    expect_at(-2, -1);
    // The setter is closed already: Passo asks again, and touches nothing.
    close_setter(true);
    post("/operator-done");
    ASSERT_TRUE(until([&] { return status().dump().find("closed already") != std::string::npos; })) << status();
    ASSERT_TRUE(until_state("Tool")) << status();
    close_setter(false);
    post("/operator-done");
    ASSERT_TRUE(until([&] { return state() == "Tool" && status()["waits_for_tool"] == 2; })) << status();
    EXPECT_NEAR(status()["measured_tool"]["length"], 0.5, 0.01);
    post("/operator-done");
    ASSERT_TRUE(until_job("done")) << status();
    expect_at(-3, -2);  // Z-2.5 with a tool that is 0.5 mm long
  }
  // A sender, in Grbl's dialect: it reads the message, and continues with `~`.
  void change_a_tool_by_a_sender() {
    ask("DELETE", "/api/v1/owner", "", key_);
    test::RealTalker sender(connected("tcp:127.0.0.1:"));
    EXPECT_THAT(sender.listen(2, std::chrono::seconds(3)), HasSubstr("Grbl 1.1"));
    std::string said = sender.ask("G21 G90\nT1 M6\nG0 X-2.5 Z-3\n", 1);
    for (int i = 0; i < 100 && said.find("[MSG:put tool 1 into") == std::string::npos; ++i) {
      said += sender.listen(1, std::chrono::milliseconds(200));
    }
    EXPECT_THAT(said, HasSubstr("[MSG:put tool 1 into the spindle, then continue]"));
    ASSERT_TRUE(until_state("Tool")) << status();
    said = sender.ask("~", 1);
    ASSERT_TRUE(until([&] { return std::abs(status()["place"]["z"].get<double>() + 2.5) < 0.01; })) << said << status();
    ASSERT_TRUE(until_state("Idle")) << status();
    expect_at(-2.5, -2.5);
    EXPECT_THAT(sender.ask("$#\n", 12), HasSubstr("[TLO:0.500]"));
  }
};

TEST_F(ToolChangeOnRealGrbl, grbl_on_an_uno_measures_its_tools_in_a_job_and_for_a_sender) {
  if (!serve_homed()) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  ASSERT_NO_FATAL_FAILURE(run_a_job_with_two_tools());
  change_a_tool_by_a_sender();
}

}  // namespace
