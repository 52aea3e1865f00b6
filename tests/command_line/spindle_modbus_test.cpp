// `passo spindle`, and `passo run` on a board, with a simulated drive at a pseudo-terminal: in real time, as a user has
// it.
#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

#include "kit/served_http.hpp"
#include "kit/simulated_vfd.hpp"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::SimulatedVfd;
using testing::HasSubstr;
using testing::Not;

using Kind = SimulatedVfd::Kind;

bool comes_true(const std::function<bool()>& condition, double seconds = 10) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

class SpindleModbus : public passo::test::ServedHttp {
 protected:
  // The router of the example, with the drive of the test.
  std::string machine(const SimulatedVfd& drive, const std::string& kind, const std::string& more = "") const {
    std::string text = passo::test::read(passo::test::examples / "machines" / "router-vfd.toml");
    const auto replace_line = [&text](const std::string& key, const std::string& line) {
      const std::size_t begin = text.find("\n" + key + " = ") + 1;
      text.replace(begin, text.find('\n', begin) - begin, line);
    };
    replace_line("drive", "drive = \"" + kind + "\"");
    replace_line("device", "device = \"" + drive.device() + "\"");
    replace_line("reach_s", "reach_s = 2" + more);
    return write("m.toml", text);
  }

  // Starts a command in the background. Its output goes to a file, its input is empty.
  pid_t start(const std::string& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    const std::string command =
        "exec " PASSO_PROGRAM " " + arguments + " >" + path("out") + " 2>" + path("err") + " </dev/null";
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  Outcome end_of(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
            .out = passo::test::read(path("out")),
            .err = passo::test::read(path("err"))};
  }
  std::string run_words(const std::string& machine_file, const std::string& program) {
    return "run --quiet " + write("p.ngc", program) + " -m " + machine_file + " --board " +
           ServedBoard::serve("18000000") + from_here;
  }
};

const std::string long_cut = "G21 G90 M3 S12000\nG1 F600 X300\nM2\n";

TEST_F(SpindleModbus, show_run_and_scan_set_up_a_drive) {
  SimulatedVfd drive(Kind::huanyang);
  const std::string file = machine(drive, "huanyang");
  const Outcome shown = passo("spindle show --json -m " + file);
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_EQ(nlohmann::json::parse(shown.out)["rpm"], 0);
  drive.take_highest_hertz();
  const Outcome ran = passo("spindle run 12000 --for 0.5 --json -m " + file);
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  EXPECT_GT(json["reached_s"], 0.05);
  EXPECT_GE(json["ran_s"], 0.5);
  EXPECT_GT(json["stopped_s"], 0.0);
  EXPECT_NEAR(json["highest_current_a"], 5, 0.2);
  EXPECT_NEAR(drive.take_highest_hertz(), 200, 1);
  EXPECT_FALSE(drive.is_told_to_run());
  const Outcome found = passo("spindle scan --addresses 1 --json -m " + file);
  EXPECT_EQ(found.code, 0) << found.err;
  // A pseudo-terminal has no rate: the drive answers at each.
  EXPECT_EQ(nlohmann::json::parse(found.out)[0]["address"], 1);
  const Outcome fast = passo("spindle run 30000 -m " + file);
  EXPECT_EQ(fast.code, 2);
  EXPECT_THAT(fast.err, HasSubstr("[spindle.too-fast]"));
  const Outcome none = passo("spindle show" + passo::test::on_router);
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("[spindle.none]"));
}

TEST_F(SpindleModbus, a_run_waits_for_the_speed_and_ends_with_the_spindle_off) {
  SimulatedVfd drive(Kind::h100, 200);  // a second to 200 Hz
  const pid_t child = start(run_words(machine(drive, "h100"), "G21 G90 M3 S12000\nG1 F3000 X1\nM2\n"));
  ASSERT_TRUE(comes_true([&] { return drive.rpm() > 6000; }));
  const Outcome ended = end_of(child);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_FALSE(drive.is_told_to_run());
  EXPECT_GE(drive.take_highest_hertz(), 190);
}

TEST_F(SpindleModbus, a_silent_drive_ends_a_run_without_a_terminal_and_names_itself) {
  SimulatedVfd drive(Kind::huanyang);
  const pid_t child = start(run_words(machine(drive, "huanyang"), long_cut));
  ASSERT_TRUE(comes_true([&] { return drive.rpm() > 11'900; }));
  drive.is_silent = true;
  const Outcome ended = end_of(child);
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("does not answer: the program was stopped"));
  EXPECT_THAT(ended.err, Not(HasSubstr("X300")));
}

TEST_F(SpindleModbus, a_signal_stops_the_spindle) {
  SimulatedVfd drive(Kind::h100);
  const pid_t child = start(run_words(machine(drive, "h100"), long_cut));
  ASSERT_TRUE(comes_true([&] { return drive.rpm() > 11'900; }));
  kill(child, SIGTERM);
  const Outcome ended = end_of(child);
  EXPECT_NE(ended.code, 0);
  EXPECT_FALSE(drive.is_told_to_run());
}

TEST_F(SpindleModbus, what_is_missing_is_named_before_anything_moves) {
  SimulatedVfd drive(Kind::h100);
  drive.is_silent = true;
  const Outcome silent = passo("spindle show -m " + machine(drive, "h100"));
  EXPECT_EQ(silent.code, 1);
  EXPECT_THAT(silent.err, HasSubstr("does not answer: is it on, and set to this address and speed?"));
  const Outcome table = passo("spindle show -m " + machine(drive, "my-drive.toml"));
  EXPECT_EQ(table.code, 3);
  EXPECT_THAT(table.err, HasSubstr("my-drive.toml: "));
  write("my-drive.toml", "name = \"x\"\n[speed]\nregister = 1\nunit = \"rpm\"\nscale = 0\n");
  const Outcome wrong = passo("spindle show -m " + path("m.toml"));
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("my-drive.toml:5:"));
  EXPECT_THAT(wrong.err, HasSubstr("a table [forward]"));
  const Outcome kind = passo("machine " + machine(drive, "abb"));
  EXPECT_EQ(kind.code, 3);
  EXPECT_THAT(kind.err, HasSubstr("\"huanyang\", \"h100\", or a table file"));
}

// As a browser sees it: the drive is switched on after the server; it fails during a job, and comes back.
TEST_F(SpindleModbus, the_server_shows_the_drive_holds_a_job_for_it_and_resumes) {
  SimulatedVfd drive(Kind::h100);
  drive.is_silent = true;
  const std::string file = machine(drive, "h100");
  ServedHttp::serve({"-m", file, "--board", ServedBoard::serve("18000000")});
  const std::string key = new_key();
  json("POST", "/position", R"({"place": {"x": 0, "y": 0, "z": 0}})", key);
  const std::string program = std::to_string(json("POST", "/programs?name=a.ngc", long_cut).value("id", 0));
  const auto run = [&] { return ask("POST", "/api/v1/programs/" + program + "/run", "", key); };
  EXPECT_FALSE(json("GET", "/status")["spindle_drive"]["answers"]);
  run();
  ASSERT_TRUE(until([&] { return json("GET", "/status")["job"]["state"] == "failed"; })) << json("GET", "/status");
  EXPECT_THAT(json("GET", "/status")["job"]["why"], HasSubstr("the spindle is not ready: its drive does not answer"));

  drive.is_silent = false;
  ASSERT_TRUE(until([&] { return json("GET", "/status")["spindle_drive"]["answers"] == true; }));
  run();
  ASSERT_TRUE(
      until([&] { return json("GET", "/status")["spindle_drive"]["at_speed"] == true && drive.rpm() > 11'000; }));
  ASSERT_TRUE(until([&] { return json("GET", "/status")["spindle_drive"]["load"].is_number(); }));
  drive.is_silent = true;
  ASSERT_TRUE(until([&] { return json("GET", "/status")["state"] == "Hold"; }));
  const auto held = json("GET", "/status");
  EXPECT_EQ(held["spindle_drive"]["fault"]["code"], "spindle.no-answer") << held;
  EXPECT_EQ(held["trouble_sentence"]["code"], "spindle.no-answer");
  EXPECT_THAT(ask("POST", "/api/v1/resume", "", key), HasSubstr("machine.not-ready"));

  drive.is_silent = false;
  ASSERT_TRUE(until([&] { return !drive.is_told_to_run() && json("GET", "/status")["rests"] == true; }));
  bool resumes = false;
  ASSERT_TRUE(until([&] {
    resumes = resumes || ask("POST", "/api/v1/resume", "", key).find("200 OK") != std::string::npos;
    return resumes;
  }));
  ASSERT_TRUE(until([&] { return json("GET", "/status")["state"] == "Run" && drive.rpm() > 11'000; }));
  EXPECT_TRUE(json("GET", "/status")["spindle_drive"]["fault"].is_null());
  json("POST", "/stop", "", key);
  ASSERT_TRUE(until([&] { return !drive.is_told_to_run(); }));
}

}  // namespace
