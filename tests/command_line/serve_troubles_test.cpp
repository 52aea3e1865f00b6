// passo serve where its computer fails it: a full disk, no more files, kill -9, and pages that die without a word.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kit/seed.hpp"
#include "kit/served_http.hpp"
#include "kit/shared_case.hpp"
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/resource.h>

namespace {

using testing::HasSubstr;

class ServeTroubles : public passo::test::ServedHttp {
 protected:
  ~ServeTroubles() override {
    end();
    if (!mounted_.empty()) umount(mounted_.c_str());
  }

  void limit(decltype(RLIMIT_FSIZE) what, rlim_t most) const {
    rlimit limits{};
    ASSERT_EQ(prlimit(pid(), what, nullptr, &limits), 0);
    limits.rlim_cur = most;
    ASSERT_EQ(prlimit(pid(), what, &limits, nullptr), 0);
  }
  // No file grows: each write is refused.
  void fill_disk() const { limit(RLIMIT_FSIZE, 0); }
  void empty_disk() const { limit(RLIMIT_FSIZE, RLIM_INFINITY); }
  // A small file system of its own. Empty: only root can mount one.
  std::string small_disk() {
    const std::string folder = path("disk");
    std::filesystem::create_directory(folder);
    if (mount("none", folder.c_str(), "tmpfs", 0, "size=384k") != 0) return "";
    return mounted_ = folder;
  }
  std::string state_of_job() const { return json("GET", "/status")["job"]["state"]; }
  std::string send_program(const std::string& text) const {
    return std::to_string(json("POST", "/programs?name=a.ngc", text).value("id", 0));
  }
  nlohmann::json run(const std::string& key, const std::string& text) const {
    return json("POST", "/programs/" + send_program(text) + "/run", "", key);
  }
  // Of the jobs at a path.
  std::set<std::int64_t> numbers_in(const std::string& list) const {
    const auto answer = json("GET", list);
    std::set<std::int64_t> numbers;
    for (const auto& job : answer["jobs"]) numbers.insert(job["id"].get<std::int64_t>());
    return numbers;
  }
  // Seconds of a processor that the daemon has used.
  double processor() const {
    std::ifstream file("/proc/" + std::to_string(pid()) + "/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream after(text.substr(text.rfind(')') + 1));
    std::string skipped;
    for (int i = 0; i < 11; ++i) after >> skipped;
    double user = 0;
    double system = 0;
    after >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  std::size_t open_files() const {
    const std::filesystem::directory_iterator all("/proc/" + std::to_string(pid()) + "/fd");
    return static_cast<std::size_t>(std::distance(begin(all), std::filesystem::directory_iterator{}));
  }
  static void say(int line, const std::string& text) {
    EXPECT_EQ(send(line, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  // Until `end` has come.
  static std::string hear(int line, const std::string& end) {
    std::string all;
    char bytes[4096];
    for (ssize_t got = 1; got > 0 && all.find(end) == std::string::npos;) {
      got = recv(line, bytes, sizeof bytes, 0);
      if (got > 0) all.append(bytes, static_cast<std::size_t>(got));
    }
    EXPECT_THAT(all, HasSubstr(end));
    return all;
  }
  int stream() const {
    const int page = connected();
    say(page,
        "GET /api/v1/stream?hz=10 HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    hear(page, "\"state\"");
    return page;
  }
  // A message of a client, with a mask of zeros.
  static std::string frame(const std::string& text) {
    return "\x81" + std::string(1, static_cast<char>(0x80 + text.size())) + std::string(4, '\0') + text;
  }

 private:
  std::string mounted_;
};

// Each answer is true while no file can be written, nothing is half written, and nothing is missing afterwards.
TEST_F(ServeTroubles, tells_of_a_full_disk_and_loses_nothing) {
  const std::string machine =
      write("router.toml", passo::test::read(PASSO_SOURCE_DIR "/examples/machines/router.toml"));
  const std::string text = passo::test::read(machine);
  serve({"--data", path("data"), "-m", machine});
  const std::string key = new_key();
  json("POST", "/work", R"({"place": {"x": 1}})", key);
  const std::string before = passo::test::read(path("data/work.var"));
  const std::string moves = "G21 G90\nG1 X0.5 F3000\nM2\n";
  const std::string id = send_program(moves);
  fill_disk();
  const auto refused = [&](const std::string& to, const std::string& body) {
    const std::string answer = ask("POST", "/api/v1" + to, body, key);
    EXPECT_THAT(answer, HasSubstr(" 507 ")) << to;
    return answer;
  };
  EXPECT_THAT(refused("/work", R"({"place": {"x": 8}})"), HasSubstr("data.unwritten"));
  EXPECT_EQ(json("GET", "/status")["work_offset"]["x"], -1.0);
  EXPECT_THAT(refused("/queue?name=q.ngc", moves), HasSubstr("data.unwritten"));
  EXPECT_THAT(refused("/programs/" + id + "/run", ""), HasSubstr("data.unwritten"));
  EXPECT_THAT(refused("/cam/files?name=a.svg", "<svg/>"), HasSubstr("make.no-room"));
  const auto stamp = json("GET", "/machine/file")["stamp"];
  EXPECT_THAT(refused("/machine/file", nlohmann::json({{"text", text + "# more\n"}, {"stamp", stamp}}).dump()),
              HasSubstr("machine-file.unwritten"));
  EXPECT_EQ(passo::test::read(path("data/work.var")), before);
  EXPECT_EQ(passo::test::read(machine), text);
  EXPECT_TRUE(json("GET", "/queue")["jobs"].empty());
  EXPECT_TRUE(json("GET", "/history")["jobs"].empty());
  EXPECT_TRUE(json("GET", "/cam")["files"].empty());
  EXPECT_EQ(json("GET", "/status")["state"], "Idle");
  // The disk fills up while a job runs.
  empty_disk();
  EXPECT_EQ(run(key, "G21 G90\nG10 L2 P2 X7\nG1 X10 F600\nM2\n")["state"], "checking");
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Run"; }));
  fill_disk();
  EXPECT_TRUE(until([&] { return state_of_job() == "done"; }));
  EXPECT_EQ(json("GET", "/history")["jobs"][0]["state"], "done");
  const std::string unkept = json("GET", "/status")["unkept"];
  EXPECT_THAT(unkept, HasSubstr("the history cannot be written: "));
  EXPECT_THAT(unkept, HasSubstr("the offsets cannot be written: "));
  empty_disk();
  EXPECT_TRUE(until([&] { return json("GET", "/status")["unkept"] == ""; }));
  EXPECT_THAT(passo::test::read(path("data/work.var")), HasSubstr("5241\t7"));
  end(SIGKILL);
  serve({"--data", path("data"), "-m", machine});
  EXPECT_EQ(json("GET", "/history")["jobs"][0]["state"], "done");
}

// The same with a file system that is really full.
TEST_F(ServeTroubles, takes_no_job_that_a_full_file_system_cannot_keep) {
  const std::string disk = small_disk();
  if (disk.empty()) GTEST_SKIP() << "only root can mount a small file system";
  serve({"--data", disk});
  const std::string key = new_key();
  const std::string big = "G21 G90\n(" + std::string(40'000, 'x') + ")\nM2\n";
  std::set<std::int64_t> queued;
  nlohmann::json refused;
  for (int i = 0; i < 40 && refused.is_null(); ++i) {
    const auto job = json("POST", "/queue?name=big.ngc", big);
    if (job.contains("id")) {
      queued.insert(job["id"].get<std::int64_t>());
    } else {
      refused = job;
    }
  }
  EXPECT_EQ(refused["error"]["code"], "data.unwritten") << refused;
  EXPECT_FALSE(queued.empty());
  std::ofstream(disk + "/filler") << std::string(1'000'000, 'x');
  EXPECT_THAT(ask("POST", "/api/v1/work", R"({"place": {"x": 8}})", key), HasSubstr(" 507 "));
  end(SIGKILL);
  std::filesystem::remove(disk + "/filler");
  serve({"--data", disk});
  EXPECT_EQ(numbers_in("/queue"), queued);
}

// Too many open files: the daemon waits for better times without turning in circles, those who are there go on, and a
// newcomer who wants to hold gets in.
TEST_F(ServeTroubles, waits_for_files_without_spinning) {
  serve({"--grbl-tcp", "127.0.0.1:0"});
  const std::string key = new_key();
  run(key, "G21 G90\nG1 X100 F60\nM2\n");
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Run"; }));
  const int page = stream();
  const int sender = connected("tcp:127.0.0.1:");
  hear(sender, "is in control]\r\n");
  json("POST", "/hold");
  EXPECT_TRUE(until([&] { return json("GET", "/status")["rests"] == true; }));
  limit(RLIMIT_NOFILE, open_files() + 1);
  std::vector<int> more;
  for (int i = 0; i < 20; ++i) more.push_back(connected("tcp:127.0.0.1:"));
  for (int i = 0; i < 40; ++i) more.push_back(connected());
  const double used = processor();
  const auto from = std::chrono::steady_clock::now();
  usleep(1'000'000);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
  EXPECT_LT(processor() - used, 0.5 * wall) << "seconds of a processor";
  std::printf("with all files open: %.0f %% of a processor\n", (processor() - used) / wall * 100);
  hear(page, "\"state\"");
  say(sender, "?");
  hear(sender, "<Hold");
  EXPECT_TRUE(until([&] { return more.empty() || (close(more.back()), more.pop_back(), more.size() < 10); }));
  EXPECT_THAT(ask("POST", "/api/v1/stop"), HasSubstr("200 OK"));
  for (const int line : more) close(line);
  limit(RLIMIT_NOFILE, 1024);
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Idle"; }));
  close(page);
  close(sender);
}

// With few files from the beginning, the server keeps some for itself: newcomers get in, and a stop gets through.
TEST_F(ServeTroubles, keeps_files_for_newcomers) {
  rlimit mine{};
  getrlimit(RLIMIT_NOFILE, &mine);
  const rlimit few{.rlim_cur = 64, .rlim_max = 64};
  // The daemon inherits this process's limit, and this process needs more.
  const rlimit soft{.rlim_cur = 64, .rlim_max = mine.rlim_max};
  setrlimit(RLIMIT_NOFILE, &soft);
  serve();
  setrlimit(RLIMIT_NOFILE, &mine);
  ASSERT_EQ(prlimit(pid(), RLIMIT_NOFILE, &few, nullptr), 0);
  std::vector<int> idle;
  for (int i = 0; i < 100; ++i) idle.push_back(connected());
  const auto from = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) EXPECT_THAT(ask("POST", "/api/v1/stop"), HasSubstr("machine.nothing-runs"));
  std::printf("20 stops in %.0f ms\n",
              std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count());
  for (const int line : idle) close(line);
}

// Jobs that were answered with 202 are in the history, whenever the daemon is killed.
class ServeKilled : public ServeTroubles {};

TEST_F(ServeKilled, at_random_moments_misses_no_job_in_its_history) {
  const int rounds = std::getenv("PASSO_RUNS") != nullptr ? std::atoi(std::getenv("PASSO_RUNS")) : 3;
  std::mt19937_64 random = std::mt19937_64(passo::test::seed());
  std::set<std::int64_t> answered;
  std::uniform_int_distribution<int> pause(0, 40'000);
  for (int round = 0; round < rounds; ++round) {
    serve({"--data", path("data")});
    const std::string key = new_key();
    json("DELETE", "/interrupted", "", key);
    for (int i = static_cast<int>(random() % 3); i >= 0; --i) {
      const auto job = run(key, "G21 G90\nG1 X0.1 F6000\nM2\n");
      if (!job.contains("history")) continue;
      answered.insert(job["history"].get<std::int64_t>());
      if (i > 0) until([&] { return state_of_job() == "done"; });
    }
    usleep(static_cast<useconds_t>(pause(random)));
    const std::int64_t last = *answered.rbegin();
    end(SIGKILL);
    serve({"--data", path("data")});
    EXPECT_EQ(numbers_in("/history?most=10000"), answered) << "round " << round;
    EXPECT_EQ(json("GET", "/history?most=1")["jobs"][0]["id"], last) << "the newest comes first, ended or broken off";
    end(SIGKILL);
  }
}

// Killed twice in a cut. The board outlives the server; the tool's life, the history and the place are as in a run that
// nobody has killed.
TEST_F(ServeKilled, in_a_cut_keeps_the_life_of_the_tool_the_history_and_the_place) {
  const std::string machine = PASSO_SOURCE_DIR "/examples/machines/router.toml";
  const std::string board = ServedBoard::serve("", machine);
  const std::vector<std::string> options = {"--data", path("data"), "-m", machine, "--board", board};
  const auto x = [&] { return json("GET", "/status")["place"]["x"].get<double>(); };
  const auto tool = [&] {
    const auto all = json("GET", "/tools");
    for (const auto& one : all["tools"]) {
      if (one["number"] == 3) return one;
    }
    return nlohmann::json{{"cut_mm", 0.0}, {"cut_s", 0.0}};
  };
  const auto cut = [&] { return tool()["cut_mm"].get<double>(); };
  serve(options);
  std::string key = new_key();
  json("POST", "/position", R"({"place": {"x": 0, "y": 0, "z": 0}})", key);
  run(key, "G21 G90 G61 T3 M6\nM3 S1000\nG1 X40 F1800\nG1 Y6\nG1 X0.5\nG0 Y0.25\nM2\n");
  ASSERT_TRUE(until([&] { return json("GET", "/status")["waits_for_tool"] == 3; })) << json("GET", "/status");
  json("POST", "/operator-done", "", key);
  double cut_before = 0;
  for (const double moment : {15.0, 30.0}) {
    ASSERT_TRUE(until([&] { return x() > moment; })) << json("GET", "/status");
    end(SIGKILL);
    serve(options);
    key = new_key();
    const auto told = json("GET", "/interrupted")["interrupted"];
    ASSERT_EQ(told["goes_on"], true) << told;
    EXPECT_EQ(told["line"], 3);
    EXPECT_EQ(json("GET", "/status")["state"], "Idle") << "nothing moves by itself";
    const double rests_at = x();
    EXPECT_GT(rests_at, moment);
    EXPECT_GT(cut(), cut_before);
    EXPECT_LE(cut(), rests_at + 0.01) << "not more than it has cut";
    cut_before = cut();
    json("POST", "/interrupted/resume", "", key);
  }
  ASSERT_TRUE(until([&] { return state_of_job() == "done"; })) << json("GET", "/status");
  EXPECT_NEAR(cut(), 40 + 6 + 39.5, 0.01);
  EXPECT_NEAR(tool()["cut_s"].get<double>(), (40 + 6 + 39.5) / 30, 1) << "each start and stop of the motion takes time";
  EXPECT_EQ(json("GET", "/history")["jobs"].size(), 1U);
  EXPECT_EQ(json("GET", "/history")["jobs"][0]["state"], "done");
  EXPECT_TRUE(json("GET", "/interrupted")["interrupted"].is_null());
  end(SIGKILL);
  serve(options);
  EXPECT_TRUE(json("GET", "/interrupted")["interrupted"].is_null()) << "nothing is left of the journal";
  EXPECT_NEAR(cut(), 40 + 6 + 39.5, 0.01);
  end();
  const auto counts = nlohmann::json::parse(passo("board info --json " + board).out)["status"]["positions"];
  EXPECT_EQ(counts[0], 320);
  EXPECT_EQ(counts[1], 160);
}

// A name in its own letters: in the API, in the history, and of a file that is made of a drawing.
TEST_F(ServeTroubles, keeps_names_in_their_own_letters) {
  serve({"--data", path("data")});
  const std::string key = new_key();
  const std::string written = "%E9%9B%B6%E4%BB%B6%201.ngc";
  const auto program = json("POST", "/programs?name=" + written, "G21 G90\nG1 X0.1 F6000\nM2\n");
  EXPECT_EQ(program["name"], "零件 1.ngc");
  json("POST", "/programs/" + std::to_string(program.value("id", 0)) + "/run", "", key);
  EXPECT_TRUE(until([&] { return state_of_job() == "done"; }));
  EXPECT_EQ(json("GET", "/status")["job"]["name"], "零件 1.ngc");
  EXPECT_EQ(json("GET", "/history")["jobs"][0]["name"], "零件 1.ngc");
  EXPECT_EQ(json("POST", "/queue?name=" + written, "M2\n")["name"], "零件 1.ngc");
  const std::string holes = "M48\nMETRIC\nT1C0.800\n%\nT1\nX10.0Y10.0\nM30\n";
  EXPECT_EQ(json("POST", "/cam/files?name=%E9%9B%B6%E4%BB%B6%201.drl", holes)["files"][0], "零件 1.drl");
  json("POST", "/cam", R"({"job": "drill", "files": ["零件 1.drl"], "options": {"depth": -1.5}})");
  EXPECT_TRUE(until([&] { return json("GET", "/cam")["state"] != "running"; }));
  const auto made = json("GET", "/cam");
  ASSERT_EQ(made["state"], "done") << made;
  EXPECT_EQ(json("GET", "/programs/" + std::to_string(made["program"].get<int>()))["name"], "零件 1-drill.ngc");
  EXPECT_THAT(ask("POST", "/api/v1/programs?name=..%2Fx", "M2\n"), HasSubstr("http.bad-name"));
}

// The case of a user, where it is at hand.
TEST_F(ServeTroubles, shared_case_of_the_names) {
  const auto said = passo::test::run_shared_case("name-lost.sh", "jq curl", path("out"));
  if (!said) GTEST_SKIP() << "no ../shared/cases, or no jq or curl";
  for (const char* name : {"-> my part.ngc", "-> Größe.ngc", "-> 零件.ngc", "-> a&b.ngc"})
    EXPECT_THAT(*said, HasSubstr(name));
}

// A page that dies without a word: its computer has lost its power, or its network. It answers no ping.
TEST_F(ServeTroubles, takes_the_motion_from_a_page_that_answers_no_more) {
  if (std::getenv("PASSO_IN_FULL") == nullptr)
    GTEST_SKIP() << "it waits for 15 s; WebServer and ApiOwner have the parts";
  serve();
  const std::string taken = json("POST", "/owner", R"({"name": "dying page"})").value("key", "");
  const int page = stream();
  say(page, frame(R"({"do":"/api/v1/owner/renew","key":")" + taken + "\"}"));
  hear(page, R"("do":"/api/v1/owner/renew","status":200)");
  EXPECT_EQ(json("GET", "/status")["owner"]["name"], "dying page");
  const auto from = std::chrono::steady_clock::now();
  EXPECT_TRUE(until([&] { return json("GET", "/status")["owner"]["kind"] == "nobody"; }));
  std::printf("ownership ended after %.1f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count());
  close(page);
}

}  // namespace
