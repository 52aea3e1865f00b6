// passo serve --http: the program itself, spoken to over a socket.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "kit/served_http.hpp"
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using passo::test::read;
using testing::HasSubstr;
using testing::Not;

// A socket for what a daemon tells its service manager.
struct Manager {
  explicit Manager(const std::string& path) : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Manager() { close(socket_); }
  // What was told since the last call, a line each.
  std::string told() const {
    std::string all;
    char bytes[512];
    for (ssize_t got = 0; (got = recv(socket_, bytes, sizeof bytes, 0)) > 0; all += '\n') {
      all.append(bytes, static_cast<std::size_t>(got));
    }
    return all;
  }
  int socket_;
};

class ServeHttp : public passo::test::ServedHttp {};

TEST_F(ServeHttp, runs_a_program_that_was_uploaded) {
  serve();
  EXPECT_EQ(json("GET", "/status")["state"], "Idle");
  EXPECT_EQ(json("GET", "/openapi.json")["openapi"], "3.1.0");
  const std::string key = "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n";
  const auto program = json("POST", "/programs?name=p.ngc", "G21 G90\nG1 X1 F3000\nM2\n");
  const std::string id = std::to_string(program.value("id", 0));
  EXPECT_EQ(json("POST", "/programs/" + id + "/run", "", key)["state"], "checking");
  EXPECT_TRUE(until([&] { return json("GET", "/status")["job"]["state"] == "done"; })) << json("GET", "/status");
  EXPECT_EQ(json("GET", "/status")["place"]["x"], 1.0);
  EXPECT_THAT(ask("GET", "/api/v1/metrics"), HasSubstr("passo_jobs_ended_total 1\n"));
  EXPECT_THAT(ask("GET", "/nothing"), HasSubstr("404 Not Found"));
}

// Ten minutes in real time.
TEST_F(ServeHttp, runs_a_simulated_machine_faster_than_real_time) {
  serve({"--virtual-speed", "1000"});
  const std::string key = new_key();
  const auto program = json("POST", "/programs?name=p.ngc", "G21 G90\nG1 X1 F3000\nG4 P600\nG1 X2\nM2\n");
  json("POST", "/programs/" + std::to_string(program.value("id", 0)) + "/run", "", key);
  EXPECT_TRUE(until([&] { return json("GET", "/status")["job"]["state"] == "done"; })) << json("GET", "/status");
  EXPECT_EQ(json("GET", "/status")["place"]["x"], 2.0);
  const auto refused = passo("serve --virtual-speed 2 -b serial:/dev/null --http 127.0.0.1:0");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("[serve.virtual-speed]"));
}

TEST_F(ServeHttp, brakes_before_it_ends) {
  serve();
  const std::string key = "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n";
  json("POST", "/jog", R"({"direction": {"x": 1}, "speed": 600, "lease": 10})", key);
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Jog"; }));
  EXPECT_EQ(end(SIGTERM), 0);
  EXPECT_EQ(ask("GET", "/api/v1/status"), "nobody is there");
}

// kill -9 amid a job: the job is known, and so is what waits.
TEST_F(ServeHttp, keeps_its_jobs_when_it_is_killed) {
  serve({"--data", path("data")});
  const std::string key = "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n";
  json("POST", "/queue?name=a.ngc", "G21 G90\nG1 X100 F600\nM2\n");
  json("POST", "/queue?name=b.ngc", "M2\n");
  json("POST", "/queue/1/run", "", key);
  EXPECT_TRUE(until([&] { return json("GET", "/status")["state"] == "Run"; }));
  const auto second = passo("serve --http 127.0.0.1:0 --data " + path("data"));
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.err, HasSubstr("serve.data"));
  EXPECT_EQ(end(SIGKILL), -SIGKILL);
  serve({"--data", path("data")});
  EXPECT_EQ(json("GET", "/queue")["jobs"][0]["name"], "b.ngc");
  EXPECT_EQ(json("GET", "/history")["jobs"][0]["state"], "interrupted");
  EXPECT_EQ(json("GET", "/status")["state"], "Idle") << "it starts nothing by itself";
  EXPECT_EQ(passo("serve --data " + path("data")).code, 2) << "without --http";
}

// kill -9 amid a move, twice; and a job that is told to end. The board counts as if nothing had been.
TEST_F(ServeHttp, resumes_a_job_amid_a_move_after_it_was_killed) {
  const std::string router = std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml";
  const std::string text =
      "G21 G90 G64 P.02 F2400 M3 S1000\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X30 Y3\nX12 Z-1\nX2 Y2\nM2\n";
  const std::string board = ServedBoard::serve("", router);
  const std::vector<std::string> options = {"--data", path("data"), "-m", router, "--board", board};
  const auto key = [&] { return "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n"; };
  const auto is_amid = [&](double x) { return until([&] { return json("GET", "/status")["place"]["x"] > x; }); };
  serve(options);
  json("POST", "/position", R"({"place": {"x": 0, "y": 0, "z": 0}})", key());
  const auto id = json("POST", "/programs?name=part.ngc", text).value("id", 0);
  json("POST", "/programs/" + std::to_string(id) + "/run", "", key());
  EXPECT_TRUE(is_amid(3));
  EXPECT_EQ(end(SIGKILL), -SIGKILL);
  for (const int signal : {SIGKILL, SIGTERM}) {
    serve(options);
    const auto told = json("GET", "/interrupted")["interrupted"];
    EXPECT_EQ(told["goes_on"], true) << told;
    EXPECT_EQ(told["job"]["name"], "part.ngc");
    EXPECT_EQ(json("POST", "/interrupted/resume", "", key())["state"], "checking");
    EXPECT_TRUE(is_amid(signal == SIGKILL ? 10 : 20));
    end(signal);
  }
  serve(options);
  json("POST", "/interrupted/resume", "", key());
  EXPECT_TRUE(until([&] { return json("GET", "/status")["job"]["state"] == "done"; })) << json("GET", "/status");
  end();
  const auto alone = nlohmann::json::parse(passo("run " + write("p.ngc", text) + " --json -m " + router).out)["steps"];
  const auto counted = nlohmann::json::parse(passo("board info --json " + board).out)["status"]["positions"];
  EXPECT_EQ(counted[0], alone["X"]["net"]);
  EXPECT_EQ(counted[1], alone["Y"]["net"]);
  EXPECT_EQ(counted[2], alone["Z"]["net"]);
}

// A virtual board dies with its host, as by a power cut: the machine homes, goes back onto the path and makes the part.
TEST_F(ServeHttp, goes_on_with_a_job_of_a_virtual_board_that_died_with_it) {
  std::string text =
      "name = \"Small\"\n[board]\nclock_hz = 16_000_000\nmax_event_rate_hz = 20_000\n[homing]\norder = \"Z(XY)\"\n";
  for (const char axis : {'X', 'Y', 'Z'}) {
    text += fmt::format(
        "[axis.{0}]\nsteps_per_mm = 100\ntravel_mm = [-4, 4]\nmax_velocity_mm_s = 60\nmax_acceleration_mm_s2 = 900\n"
        "[axis.{0}.home]\ndirection = \"{1}\"\nswitch_at_mm = {2}\nseek_mm_s = 40\nlatch_mm_s = 4\npull_off_mm = 0.5\n",
        axis, axis == 'Z' ? "high" : "low", axis == 'Z' ? 4.5 : -4.5);
  }
  const std::string machine = write("small.toml", text);
  const std::string part = "G21 G90 G61 F150\nG1 X3\nY2\nX0 Z-1\nG0 Z3\nM2\n";
  const std::vector<std::string> options = {"--data", path("data"), "-m", machine};
  const auto key = [&] { return "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n"; };
  serve(options);
  json("POST", "/programs?name=part.ngc", part);
  json("POST", "/programs/1/run", "", key());
  EXPECT_TRUE(until([&] { return json("GET", "/status")["place"]["y"] > 0.5; }));
  EXPECT_EQ(end(SIGKILL), -SIGKILL);
  serve(options);
  EXPECT_EQ(json("GET", "/status")["trust"], "unknown") << json("GET", "/status");
  EXPECT_EQ(json("GET", "/interrupted")["interrupted"]["code"], "resume.board-reset");
  json("POST", "/home", "", key());
  EXPECT_TRUE(until([&] { return json("GET", "/status")["trust"] == "homed"; })) << json("GET", "/status");
  const auto way = json("GET", "/interrupted")["interrupted"]["reentry"];
  EXPECT_EQ(way["code"], "") << "homing has found the machine where the job was: " << way;
  EXPECT_EQ(way["line"], 3) << way;
  EXPECT_EQ(json("POST", "/interrupted/reenter", "", key())["state"], "checking");
  EXPECT_TRUE(until([&] { return json("GET", "/status")["job"]["state"] == "done"; })) << json("GET", "/status");
  EXPECT_EQ(json("GET", "/status")["place"], (nlohmann::json{{"x", 0.0}, {"y", 2.0}, {"z", 3.0}}));
  EXPECT_EQ(json("GET", "/interrupted")["interrupted"], nullptr);
}

// What senders set is there after a restart: their offsets, which programs have too, and what grbl keeps.
TEST_F(ServeHttp, keeps_what_senders_have_set) {
  // Sends lines, and hears until each has its answer.
  const auto say = [&](const std::string& lines) {
    serve({"--data", path("data"), "--grbl-pty", path("grbl")});
    const int terminal = open(path("grbl").c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
    EXPECT_EQ(::write(terminal, lines.data(), lines.size()), static_cast<ssize_t>(lines.size()));
    std::string heard;
    char bytes[4096];
    const auto is_answered = [&] {
      const ssize_t got = ::read(terminal, bytes, sizeof bytes);
      if (got > 0) heard.append(bytes, static_cast<std::size_t>(got));
      std::ptrdiff_t answers = 0;
      for (std::size_t at = 0; (at = heard.find("\nok\r", at)) != std::string::npos; ++at) ++answers;
      return answers == std::count(lines.begin(), lines.end(), '\n');
    };
    EXPECT_TRUE(until(is_answered)) << heard;
    close(terminal);
    return heard;
  };
  say("$I=SHOP 2\n$N0=G17\n$10=1\nG10 L2 P2 X5\n");
  EXPECT_TRUE(until([&] { return std::filesystem::exists(path("data/work.var")); }));
  end();
  const std::string again = say("$I\n$N\n$#\n$10=1\n");
  EXPECT_THAT(again, HasSubstr("[VER:1.1h.20190830:SHOP2]"));
  EXPECT_THAT(again, HasSubstr(">G17:ok"));
  EXPECT_THAT(again, HasSubstr("$N0=G17\r\n$N1=\r\n"));
  EXPECT_THAT(again, HasSubstr("[G55:5.000,0.000,0.000]"));
  end();
}

TEST_F(ServeHttp, asks_for_the_token_and_for_its_own_name) {
  const std::string token = write("token", "0123456789abcdef\n");
  serve({"--http-token", token});
  EXPECT_THAT(ask("GET", "/api/v1/status"), HasSubstr("401 Unauthorized"));
  EXPECT_THAT(ask("GET", "/api/v1/status", "", "Authorization: Bearer 0123456789abcdef\r\n"), HasSubstr("200 OK"));
  EXPECT_THAT(ask("GET", "/api/v1/status?token=0123456789abcdef"), HasSubstr("200 OK"));
  EXPECT_THAT(ask("GET", "/api/v1/status?token=0123456789abcdef", "", "Origin: http://evil.example\r\n"),
              HasSubstr("403 Forbidden"));
}

// A browser loads the page before it knows a token; what the page asks of the API needs one.
TEST_F(ServeHttp, gives_the_page_without_the_token) {
  std::filesystem::create_directory(path("page"));
  write("page/index.html", "the page");
  serve({"--http-token", write("token", "0123456789abcdef\n"), "--page", path("page")});
  EXPECT_THAT(ask("GET", "/"), HasSubstr("the page"));
  EXPECT_THAT(ask("GET", "/", "", "Origin: http://evil.example\r\n"), HasSubstr("403 Forbidden"));
  EXPECT_THAT(ask("GET", "/api/v1/status"), HasSubstr("401 Unauthorized"));
  EXPECT_THAT(ask("POST", "/"), HasSubstr("401 Unauthorized"));
}

TEST_F(ServeHttp, gives_files_compressed_and_only_when_they_are_new) {
  std::filesystem::create_directories(path("page/assets"));
  write("page/index.html", "the page");
  write("page/index.html.br", "in brotli");
  write("page/index.html.gz", "in gzip");
  write("page/assets/a.js", "the script");
  serve({"--page", path("page")});
  const std::string plain = ask("GET", "/");
  EXPECT_THAT(plain, HasSubstr("the page"));
  EXPECT_THAT(plain, HasSubstr("Cache-Control: no-cache\r\n"));
  EXPECT_THAT(plain, HasSubstr("Content-Security-Policy: default-src 'none'; script-src 'self'"));
  const std::string brotli = ask("GET", "/", "", "Accept-Encoding: gzip, deflate, br;q=0.9\r\n");
  EXPECT_THAT(brotli, HasSubstr("in brotli"));
  EXPECT_THAT(brotli, HasSubstr("Content-Encoding: br\r\n"));
  EXPECT_THAT(brotli, HasSubstr("Content-Type: text/html"));
  EXPECT_THAT(ask("GET", "/", "", "Accept-Encoding: gzip, br;q=0\r\n"), HasSubstr("in gzip"));
  EXPECT_THAT(ask("GET", "/assets/a.js"), HasSubstr("immutable"));
  const std::size_t at = plain.find("ETag: ") + 6;
  const std::string known = "If-None-Match: " + plain.substr(at, plain.find('\r', at) - at) + "\r\n";
  EXPECT_THAT(ask("GET", "/", "", known), HasSubstr("304 Not Modified"));
  EXPECT_THAT(ask("GET", "/", "", known), Not(HasSubstr("the page")));
  EXPECT_THAT(ask("GET", "/", "", "Accept-Encoding: br\r\n" + known), HasSubstr("200 OK")) << "other bytes";
}

TEST_F(ServeHttp, tells_the_path_and_the_text_of_a_program_from_the_works_zero) {
  serve();
  const std::string key = "X-Passo-Key: " + json("POST", "/owner", "{}").value("key", "") + "\r\n";
  // The tool stands at X -5 of the work, so that the work's zero is at X 5 of the machine.
  EXPECT_EQ(json("POST", "/work", R"({"place": {"x": -5}})", key)["work_offset"]["x"], 5.0);
  EXPECT_EQ(json("GET", "/status")["work_offset"]["x"], 5.0);
  EXPECT_EQ(json("GET", "/status")["work_offset"]["y"], 0.0);
  const auto program = json("POST", "/programs?name=p.ngc", "G21 G90\nG0 X10\nG1 Y20 F3000\nM2\n");
  const std::string id = "/programs/" + std::to_string(program.value("id", 0));
  EXPECT_EQ(json("GET", id + "/path")["complete"], false);
  json("POST", id + "/check");
  EXPECT_TRUE(until([&] { return json("GET", id)["state"] == "good"; })) << json("GET", id);
  const auto path = json("GET", id + "/path");
  EXPECT_EQ(path["points"], 3);
  EXPECT_EQ(path["chunks"], 1);
  EXPECT_EQ(path["all"]["high"], (std::vector<double>{15, 20, 0}));
  EXPECT_EQ(path["work"]["low"], (std::vector<double>{10, 0, 0}));
  const std::string chunk = ask("GET", "/api/v1" + id + "/path?chunk=0");
  EXPECT_THAT(chunk, HasSubstr("Content-Length: 76\r\n"));
  EXPECT_THAT(chunk, HasSubstr("\r\n\r\nPASP"));
  EXPECT_THAT(ask("GET", "/api/v1" + id + "/path?chunk=1"), HasSubstr("400 Bad Request"));
  EXPECT_THAT(ask("GET", "/api/v1" + id + "/path?chunk=0&level=3"), HasSubstr("400 Bad Request"));
  EXPECT_THAT(ask("GET", "/api/v1" + id + "/text?from=2&lines=2"), testing::EndsWith("\r\n\r\nG0 X10\nG1 Y20 F3000\n"));
  // Another zero: the check counts no longer.
  json("POST", "/work", R"({"place": {"x": 0}})", key);
  EXPECT_EQ(json("GET", id)["state"], "unchecked");
}

TEST_F(ServeHttp, refuses_to_listen_for_all_without_a_token) {
  const auto open = passo("serve --http 0.0.0.0:0");
  EXPECT_EQ(open.code, 2);
  EXPECT_THAT(open.err, HasSubstr("serve.open-http"));
  const auto weak = passo("serve --http 0.0.0.0:0 --http-token " + write("token", "short\n"));
  EXPECT_EQ(weak.code, 2);
  EXPECT_THAT(weak.err, HasSubstr("serve.bad-token"));
  EXPECT_EQ(passo("serve --http nowhere").code, 2);
  EXPECT_EQ(passo("serve --http 127.0.0.1:0 --http-token /nonexistent").code, 2);
}

TEST_F(ServeHttp, shows_a_page_and_nothing_beside_it) {
  const std::string folder = path("page");
  std::filesystem::create_directory(folder);
  std::filesystem::create_directory(folder + "/sub");
  write("page/index.html", "the page");
  write("page/sub/a.js", "the script");
  write("page/.hidden", "hidden");
  write("secret", "secret");
  std::filesystem::create_symlink(path("secret"), folder + "/link");
  serve({"--page", folder});
  EXPECT_THAT(ask("GET", "/"), HasSubstr("the page"));
  EXPECT_THAT(ask("GET", "/sub/a.js"), HasSubstr("Content-Type: text/javascript"));
  for (const char* bad : {"/../secret", "/sub/../../secret", "/%2e%2e/secret", "/.hidden", "/link", "//secret", "/sub",
                          "/./index.html", "/sub/..", "/index.html/x", "secret", "/\\..\\secret"}) {
    const std::string answer = ask("GET", bad);
    EXPECT_THAT(answer, Not(HasSubstr("200 OK"))) << bad;
    EXPECT_THAT(answer, Not(HasSubstr("secret"))) << bad;
  }
}

TEST_F(ServeHttp, changes_the_machine_file_and_keeps_its_comments) {
  const std::string file = path("mill.toml");
  write("mill.toml", read(PASSO_SOURCE_DIR "/examples/machines/router.toml"));
  serve({"--machine", file});
  auto told = json("GET", "/machine/file");
  ASSERT_TRUE(told["good"].get<bool>()) << told;
  EXPECT_EQ(told["values"]["axis.X.microsteps"], 16);
  EXPECT_TRUE(told["in_force"].get<bool>());
  const auto draft = [&](const nlohmann::json& changes) {
    return json("POST", "/machine/file/draft", nlohmann::json({{"text", told["text"]}, {"set", changes}}).dump());
  };
  const auto refused = draft({{"axis.X.home.switch_at_mm", 500}});
  EXPECT_FALSE(refused["good"].get<bool>());
  EXPECT_THAT(refused["findings"].dump(), HasSubstr("machine."));
  // Two axes cannot have one motor.
  const auto conflict = draft({{"axis.X.motor", 0}, {"axis.Y.motor", 0}, {"axis.Z.motor", 1}});
  EXPECT_FALSE(conflict["good"].get<bool>()) << conflict;
  EXPECT_FALSE(conflict["findings"].empty());
  const auto good = draft({{"axis.X.microsteps", 8}, {"axis.X.max_velocity_mm_s", 90}});
  ASSERT_TRUE(good["good"].get<bool>()) << good["findings"];
  EXPECT_EQ(good["axes"][0]["steps_per_unit"], 320);
  EXPECT_THAT(good["text"].get<std::string>(), HasSubstr("microsteps = 8              # as set on"));
  // A look changes nothing, and writing needs the ownership and the file as it was.
  EXPECT_EQ(read(file), told["text"].get<std::string>());
  const std::string body = nlohmann::json({{"text", good["text"]}, {"stamp", told["stamp"]}}).dump();
  EXPECT_EQ(json("POST", "/machine/file", body)["error"]["code"], "owner.not-you");
  const std::string key = "X-Passo-Key: " + json("POST", "/owner")["key"].get<std::string>() + "\r\n";
  const std::string bad = nlohmann::json({{"text", refused["text"]}, {"stamp", told["stamp"]}}).dump();
  EXPECT_EQ(json("POST", "/machine/file", bad, key)["error"]["code"], "machine-file.unsound");
  const auto written = json("POST", "/machine/file", body, key);
  EXPECT_FALSE(written["in_force"].get<bool>()) << written;
  EXPECT_EQ(read(file), good["text"].get<std::string>());
  EXPECT_EQ(json("POST", "/machine/file", body, key)["error"]["code"], "machine-file.changed");
}

TEST_F(ServeHttp, makes_a_program_of_a_drill_file) {
  serve();
  const auto send = [&](const std::string& name, const std::string& text) {
    return json("POST", "/cam/files?name=" + name, text);
  };
  send("holes.drl", "M48\nMETRIC\nT1C0.800\n%\nT1\nX10.0Y10.0\nX20.0Y10.0\nM30\n");
  EXPECT_EQ(send("wrong.drl", "this is no drill file\n")["files"], nlohmann::json({"holes.drl", "wrong.drl"}));
  const auto make = [&](const std::string& order) {
    json("POST", "/cam", order);
    until([&] { return json("GET", "/cam")["state"] != "running"; });
    return json("GET", "/cam");
  };
  const auto made = make(R"({"job": "drill", "files": ["holes.drl"], "options": {"depth": -1.5, "plain": true}})");
  ASSERT_EQ(made["state"], "done") << made;
  ASSERT_TRUE(made["program"].is_number()) << made;
  const std::string id = std::to_string(made["program"].get<int>());
  EXPECT_EQ(json("GET", "/programs/" + id)["name"], "holes-drill.ngc");
  EXPECT_THAT(ask("GET", "/api/v1/programs/" + id + "/text"), HasSubstr("Z-1.5"));
  EXPECT_THAT(ask("GET", "/api/v1/cam/picture"), HasSubstr("<svg"));
  EXPECT_THAT(ask("GET", "/api/v1/programs/" + id + "/text"), HasSubstr("(holes-drill.ngc"));
  const auto failed = make(R"({"job": "drill", "files": ["wrong.drl"]})");
  EXPECT_EQ(failed["state"], "failed");
  EXPECT_THAT(failed["words"].get<std::string>(), HasSubstr("wrong.drl"));
  // Nothing of this computer is read or written, but what was sent.
  for (const char* const order :
       {R"({"job": "show", "files": ["holes.drl"]})", R"({"job": "drill", "files": ["holes.drl"], "profile": {}})",
        R"({"job": "board", "files": ["holes.drl"], "options": {"machine": "/etc/passwd"}})",
        R"({"job": "board", "files": ["holes.drl"], "profile": {"board": {}}})",
        R"({"job": "board", "files": ["holes.drl"], "profile": {"isolate": {"edge": "../x"}}})",
        R"({"job": "board", "files": ["holes.drl"], "profile": {"drill": {"tools": ["1", "2"]}}})",
        R"({"job": "drill", "files": ["/etc/passwd"]})",
        R"({"job": "drill", "files": ["holes.drl"], "options": {"output": "x"}})",
        R"({"job": "isolate", "files": ["holes.drl"], "options": {"edge": "/etc/passwd"}})",
        R"({"job": "isolate", "files": ["holes.drl"], "options": {"edge": "../x"}})"}) {
    EXPECT_EQ(json("POST", "/cam", order)["error"]["code"], "http.bad-body") << order;
  }
  EXPECT_EQ(send("../x", "a")["files"].dump().find('/'), std::string::npos);
  EXPECT_TRUE(json("DELETE", "/cam/files")["files"].empty());
}

// The process that makes the program reports over its pipe.
TEST_F(ServeHttp, shows_how_much_of_a_job_is_done) {
  serve();
  std::string holes = "M48\nMETRIC\nT1C0.800\n%\nT1\n";
  for (int i = 0; i < 1500; ++i) holes += fmt::format("X{}.0Y{}.0\n", i * 37 % 1009, i * 53 % 997);
  json("POST", "/cam/files?name=many.drl", holes + "M30\n");
  EXPECT_EQ(json("POST", "/cam", R"({"job": "drill", "files": ["many.drl"]})")["state"], "running");
  std::vector<double> shares = {0};
  until([&] {
    const auto now = json("GET", "/cam");
    const double share = now["progress"].get<double>();
    EXPECT_GE(share, shares.back());
    if (share > shares.back()) shares.push_back(share);
    return now["state"] != "running";
  });
  EXPECT_EQ(json("GET", "/cam")["state"], "done");
  EXPECT_EQ(shares.back(), 1);
  EXPECT_GE(shares.size(), 3U) << "it has grown on the way";
  EXPECT_EQ(json("DELETE", "/cam/files")["progress"], 0);
}

TEST_F(ServeHttp, makes_all_programs_of_a_board_and_says_what_to_do_when) {
  serve();
  const std::string head = "%FSLAX46Y46*%\n%MOMM*%\n%LPD*%\n%ADD10C,1*%\nD10*\n";
  json("POST", "/cam/files?name=odd.gbr", head + "X5000000Y5000000D02*\nX9000000Y5000000D01*\nM02*\n");
  json("POST", "/cam/files?name=board.gko",
       head + "X0Y0D02*\nX20000000Y0D01*\nX20000000Y15000000D01*\nX0Y15000000D01*\nX0Y0D01*\nM02*\n");
  json("POST", "/cam/files?name=holes.drl", "M48\nMETRIC\nT1C0.800\n%\nT1\nX5.0Y5.0\nM30\n");
  const auto make = [&](const std::string& options) {
    json("POST", "/cam", R"({"job": "board", "files": ["odd.gbr", "board.gko", "holes.drl"], )" + options + "}");
    until([&] { return json("GET", "/cam")["state"] != "running"; });
    return json("GET", "/cam");
  };
  const auto unknown = make(R"("options": {})");
  EXPECT_EQ(unknown["programs"].size(), 2U) << unknown;
  EXPECT_EQ(unknown["report"]["files"][2]["layer"], "unknown");
  const auto made = make(R"("options": {"as": ["odd.gbr=top copper"], "margin": 12},
                            "profile": {"outline": {"depth": "-1.6", "tabs": 2}, "drill": {"plain": true}})");
  ASSERT_EQ(made["state"], "done") << made;
  ASSERT_EQ(made["programs"].size(), 3U);
  EXPECT_EQ(json("GET", "/programs")["programs"].size(), 3U) << "programs that are made again take their places";
  const auto text = [&](std::size_t at) {
    return ask("GET", "/api/v1/programs/" + std::to_string(made["programs"][at].get<int>()) + "/text");
  };
  EXPECT_THAT(text(0), Not(HasSubstr("G81")));
  EXPECT_THAT(text(2), HasSubstr("Z-1.6"));
  EXPECT_EQ(json("GET", "/programs/" + std::to_string(made["programs"][1].get<int>()))["name"],
            "odd-2-isolate-front.ngc");
  EXPECT_EQ(made["report"]["margin_mm"], 12);
  EXPECT_GT(made["report"]["steps"][1]["time_s"].get<double>(), 1);
  EXPECT_THAT(ask("GET", "/api/v1/cam/picture"), HasSubstr("<svg"));
  EXPECT_NE(ask("GET", "/api/v1/cam/picture?number=2"), ask("GET", "/api/v1/cam/picture?number=0"));
  EXPECT_THAT(ask("GET", "/api/v1/cam/picture?number=9"), HasSubstr("there is no picture"));
  EXPECT_THAT(ask("GET", "/api/v1/cam/page"), HasSubstr("Mill the front"));
}

TEST_F(ServeHttp, tells_systemd_that_it_is_ready_lives_and_ends) {
  const Manager manager(path("notify"));
  setenv("NOTIFY_SOCKET", path("notify").c_str(), 1);
  setenv("WATCHDOG_USEC", "20000", 1);
  serve();
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  std::string told;
  EXPECT_TRUE(until([&] { return (told += manager.told()).find("WATCHDOG=1\nWATCHDOG=1") != std::string::npos; }))
      << told;
  EXPECT_THAT(told, HasSubstr("READY=1\nSTATUS="));
  EXPECT_EQ(end(), 0);
  EXPECT_THAT(manager.told(), HasSubstr("STOPPING=1"));
}

TEST_F(ServeHttp, can_be_checked_without_opening_anything) {
  const auto outcome = passo("serve --check --http 127.0.0.1:7080 --grbl-tcp 127.0.0.1:7071 --board serial:/dev/none");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("are valid"));
  write("m.toml", "nothing = 1\n");
  const std::string token = write("token", "short\n");
  EXPECT_EQ(passo("serve --check -m " + path("m.toml")).code, 3);
  EXPECT_THAT(passo("serve --check --http 0.0.0.0:80").err, HasSubstr("[serve.open-http]"));
  EXPECT_THAT(passo("serve --check --http :80 --http-token " + token).err, HasSubstr("[serve.bad-token]"));
  EXPECT_THAT(passo("serve --check --grbl-tcp 0.0.0.0:80").err, HasSubstr("[serve.open-port]"));
  EXPECT_THAT(passo("serve --check --board nowhere").err, HasSubstr("is not a board"));
  EXPECT_EQ(passo("serve --check --board grbl:/dev/ttyUSB0").code, 0);
  EXPECT_THAT(passo("serve --check --grbl-serial tcp:a:1").err, HasSubstr("--grbl-serial: expected DEVICE"));
  EXPECT_THAT(passo("serve --check --http :80 --data /dev/null").err, HasSubstr("[serve.data]"));
  EXPECT_THAT(passo("serve --check --data " + path("data")).err, HasSubstr("[serve.data]"));
  EXPECT_FALSE(std::filesystem::exists(path("data")));
}

}  // namespace
