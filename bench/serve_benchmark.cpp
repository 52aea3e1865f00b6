// What `passo serve` costs and how soon it obeys: the daemon itself, over sockets, with a virtual board behind TCP that
// this program plays in real time and looks at step by step.
//
//   serve_benchmark [SECONDS]      500 clients of the stream at 10 Hz beside a running job, for so long (20)
//                                  a hold by HTTP and by `!`: the time until the first slower step
//                                  a program of a million lines: from the upload and from the start to the first step
//
// Run it on a quiet computer. It prints; it decides nothing.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/transport/board_server.hpp"

namespace {

using namespace passo;
using Clock = std::chrono::steady_clock;

constexpr std::size_t clients = 500;
constexpr int rate = 10;
constexpr int holds = 25;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Sees the steps of X. The board's time is the time since its start.
class StepWatch final : public MachineObserver {
 public:
  explicit StepWatch(Hertz clock) : tick_(1 / clock.value()) {}
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t) override {
    if ((stepped & 1U) == 0) return;
    const std::int64_t interval = time.count - last_;
    last_ = time.count;
    steps_.fetch_add(1);
    // A step of the same speed comes within a few ticks.
    if (armed_.load() && interval > interval_ + interval_ / 50 && interval_ > 0) {
      slower_at_.store(static_cast<double>(time.count) * tick_);
      armed_.store(false);
    }
    if (!armed_.load()) interval_ = interval;
  }
  void arm() {
    slower_at_.store(0);
    armed_.store(true);
  }
  bool is_armed() const { return armed_.load(); }
  double slower_at() const { return slower_at_.load(); }
  std::uint64_t steps() const { return steps_.load(); }

 private:
  double tick_;
  std::int64_t last_ = 0;
  std::int64_t interval_ = 0;
  std::atomic<bool> armed_{false};
  std::atomic<double> slower_at_{0};
  std::atomic<std::uint64_t> steps_{0};
};

// The board, in real time, in a thread of its own.
class RealBoard {
 public:
  explicit RealBoard(const MachineDescription& machine)
      : watch(machine.board.clock),
        plant_(plant_of(machine)),
        board_(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock, machine.board.highest_event_rate,
               static_cast<std::size_t>(machine.board.held_items)),
        server_(std::move(*BoardServer::listen(0))) {
    board_.connect(plant_);
    board_.add_observer(watch);
    thread_ = std::thread([this] { play(); });
  }
  ~RealBoard() {
    ends_ = true;
    thread_.join();
  }
  unsigned port() const { return server_->port(); }
  double now() const { return seconds_since(start_); }

  StepWatch watch;

 private:
  void play() {
    while (!ends_) {
      server_->wait(Seconds(0.0005));
      for (const Seconds until(now()); board_.elapsed() < until;) {
        const bool said = board_.run(until - board_.elapsed());
        server_->send_to_host(board_.replies());
        if (!said) break;
      }
      server_->attend(board_);
    }
  }

  IdealPlant plant_;
  VirtualMachine board_;
  std::unique_ptr<BoardServer> server_;
  Clock::time_point start_ = Clock::now();
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

int connect_to(unsigned port) {
  const int made = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(made, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    close(made);
    return -1;
  }
  const int on = 1;
  setsockopt(made, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return made;
}

void write_all(int to, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(to, text.data(), text.size());
    if (written <= 0) std::exit(1);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

// The daemon, and what is asked of it.
class Daemon {
 public:
  explicit Daemon(unsigned board) {
    folder_ = std::filesystem::temp_directory_path() / ("passo-serve-benchmark-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    const std::string said = (folder_ / "said").string();
    process_ = fork();
    if (process_ == 0) {
      if (std::freopen(said.c_str(), "w", stdout) == nullptr) _exit(1);
      setenv("XDG_STATE_HOME", folder_.c_str(), 1);
      execl(PASSO_PROGRAM, "passo", "serve", "-m", PASSO_SOURCE_DIR "/examples/machines/router.toml", "--board",
            ("tcp:127.0.0.1:" + std::to_string(board)).c_str(), "--http", "127.0.0.1:0", "--grbl-tcp", "127.0.0.1:0",
            "--data", (folder_ / "data").c_str(), nullptr);
      _exit(1);
    }
    for (int i = 0; i < 1000 && (http == 0 || grbl == 0); ++i) {
      usleep(10'000);
      std::ifstream file(said);
      for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.rfind(':');
        if (colon == std::string::npos || line.find("127.0.0.1:") == std::string::npos) continue;
        (line.find("http://") != std::string::npos ? http : grbl) = std::strtoul(line.c_str() + colon + 1, nullptr, 10);
      }
    }
  }
  ~Daemon() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    std::filesystem::remove_all(folder_);
  }

  std::string ask(const std::string& method, const std::string& path, const std::string& body = "") {
    const int to = connect_to(static_cast<unsigned>(http));
    write_all(to, request(method, path, body));
    std::string answer;
    std::array<char, 65536> piece;
    for (ssize_t got = 0; (got = read(to, piece.data(), piece.size())) > 0;)
      answer.append(piece.data(), std::size_t(got));
    close(to);
    const std::size_t begins = answer.find("\r\n\r\n");
    return begins == std::string::npos ? "" : answer.substr(begins + 4);
  }
  std::string request(const std::string& method, const std::string& path, const std::string& body) const {
    std::string text = method + " /api/v1" + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(http) +
                       "\r\nConnection: close\r\n";
    if (!key.empty()) text += "X-Passo-Key: " + key + "\r\n";
    return text + "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }
  void own() { key = member(ask("POST", "/owner", "{\"name\":\"benchmark\"}"), "key"); }
  // A member of a JSON text, as it is written there.
  static std::string member(const std::string& json, const std::string& name) {
    const std::size_t at = json.find("\"" + name + "\":");
    if (at == std::string::npos) return {};
    std::size_t begins = at + name.size() + 3;
    if (json[begins] == '"') ++begins;
    return json.substr(begins, json.find_first_of("\",}\n", begins) - begins);
  }
  std::string state() { return member(ask("GET", "/status"), "state"); }
  void await(const std::string& wanted) {
    for (int i = 0; i < 3000 && state() != wanted; ++i) usleep(20'000);
  }
  double metric(const std::string& name) {
    const std::string all = ask("GET", "/metrics");
    const std::size_t at = all.find("\npasso_" + name + " ");
    return at == std::string::npos ? -1 : std::strtod(all.c_str() + at + name.size() + 8, nullptr);
  }
  // Seconds of a processor so far.
  double processor() const { return seconds_in("/stat"); }
  // The same of the loop alone. Beside it the time left of a job is planned once, with what others leave of a
  // processor.
  double loop() const { return seconds_in("/task/" + std::to_string(process_) + "/stat"); }
  double megabytes(const std::string& which) const {
    std::ifstream file("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with(which)) return std::strtod(line.c_str() + which.size() + 1, nullptr) / 1024;
    }
    return 0;
  }
  std::string run(const std::string& program) {
    const std::string id = member(ask("POST", "/programs?name=benchmark.ngc", program), "id");
    ask("POST", "/programs/" + id + "/run");
    return id;
  }

  unsigned long http = 0;
  unsigned long grbl = 0;
  std::string key;

 private:
  double seconds_in(const std::string& file_of_times) const {
    std::ifstream file("/proc/" + std::to_string(process_) + file_of_times);
    std::string word;
    double ticks = 0;
    for (int i = 1; i <= 15 && file >> word; ++i) ticks += i >= 14 ? std::strtod(word.c_str(), nullptr) : 0;
    return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  pid_t process_ = 0;
  std::filesystem::path folder_;
};

// Small moves in three axes, as of a relief, for some minutes.
std::string relief(int lines) {
  std::string text = "G21 G90 G64 P0.02 F2400\n";
  for (int i = 0; i < lines; ++i) {
    text += "G1 X" + std::to_string(0.2 * (i % 500)) + " Y" + std::to_string(0.5 * (i / 500 % 400)) + " Z" +
            std::to_string(-0.05 * (i % 7)) + "\n";
  }
  return text + "M2\n";
}

// Reads what comes from all clients for so long. Returns the messages.
std::uint64_t listen(std::vector<pollfd>& all, double seconds) {
  std::uint64_t messages = 0;
  std::array<char, 65536> piece;
  for (const auto start = Clock::now(); seconds_since(start) < seconds;) {
    poll(all.data(), all.size(), 20);
    for (const pollfd& one : all) {
      if ((one.revents & POLLIN) == 0) continue;
      const ssize_t got = read(one.fd, piece.data(), piece.size());
      for (ssize_t i = 0; i < got; ++i) messages += piece[static_cast<std::size_t>(i)] == '\n' ? 1 : 0;
    }
  }
  return messages;
}

void measure_watchers(Daemon& daemon, double seconds) {
  daemon.run(relief(200'000));
  daemon.await("Run");
  const double alone = daemon.loop();
  sleep(4);
  std::printf("a job alone: %.1f %% of a processor, %.0f MB\n", 25 * (daemon.loop() - alone),
              daemon.megabytes("VmRSS:"));
  std::vector<pollfd> all;
  for (std::size_t i = 0; i < clients; ++i) {
    const int made = connect_to(static_cast<unsigned>(daemon.http));
    write_all(made, "GET /api/v1/stream?hz=" + std::to_string(rate) +
                        " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(daemon.http) +
                        "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    all.push_back({.fd = made, .events = POLLIN, .revents = 0});
  }
  listen(all, 2);
  const double watchers = daemon.metric("http_watchers");
  const double before = daemon.processor();
  const double loop_before = daemon.loop();
  const double late = daemon.metric("late_refills_total");
  const std::uint64_t messages = listen(all, seconds);
  const double loop = daemon.loop() - loop_before;
  const double planner = daemon.processor() - before - loop;
  std::printf(
      "%.0f clients of the stream at %d Hz: %.0f messages a second, %.0f late refills in %.0f s, %.0f %% of a "
      "processor and %.0f %% for the time left, %.0f MB, %.0f messages skipped\n",
      watchers, rate, static_cast<double>(messages) / seconds, daemon.metric("late_refills_total") - late, seconds,
      100 * loop / seconds, 100 * planner / seconds, daemon.megabytes("VmRSS:"), daemon.metric("stream_skipped_total"));
  for (const pollfd& one : all) close(one.fd);
  daemon.ask("POST", "/stop");
  daemon.await("Idle");
}

void print(const char* what, std::vector<double> times) {
  std::sort(times.begin(), times.end());
  if (times.empty()) return;
  std::printf("%s: first slower step after %.1f ms (median of %zu), at most %.1f ms\n", what,
              1000 * times[times.size() / 2], times.size(), 1000 * times.back());
}

// The time from `ask` to the first slower step, at full speed along X.
template <class Ask, class GoOn>
std::vector<double> measure_holds(RealBoard& board, Ask ask, GoOn go_on) {
  std::vector<double> times;
  for (int i = 0; i < holds; ++i) {
    usleep(700'000 + 13'000 * static_cast<unsigned>(i));
    board.watch.arm();
    usleep(20'000);
    const double asked = board.now();
    if (!board.watch.is_armed()) continue;  // a corner came
    ask();
    for (int wait = 0; wait < 1000 && board.watch.is_armed(); ++wait) usleep(1000);
    if (!board.watch.is_armed()) times.push_back(board.watch.slower_at() - asked);
    usleep(500'000);
    go_on();
  }
  return times;
}

std::string long_lines() {
  std::string text = "G21 G90 G61.1 F1500\n";
  for (int i = 0; i < 40; ++i) text += i % 2 == 0 ? "G1 X200\n" : "G1 X0\n";
  return text + "M2\n";
}

void measure_http_hold(Daemon& daemon, RealBoard& board) {
  daemon.run(long_lines());
  daemon.await("Run");
  print("a hold by HTTP", measure_holds(
                              board, [&] { daemon.ask("POST", "/hold"); }, [&] { daemon.ask("POST", "/resume"); }));
  daemon.ask("POST", "/stop");
  daemon.await("Idle");
}

void measure_sender_hold(Daemon& daemon, RealBoard& board) {
  daemon.ask("DELETE", "/owner");
  daemon.key.clear();
  const int sender = connect_to(static_cast<unsigned>(daemon.grbl));
  usleep(200'000);
  write_all(sender, "$X\n" + long_lines().substr(14));  // grbl has no G61.1 with a blank
  print("a hold by !", measure_holds(
                           board, [&] { write_all(sender, "!"); }, [&] { write_all(sender, "~"); }));
  write_all(sender, "\x18");
  daemon.await("Idle");
  close(sender);
  usleep(200'000);
}

void measure_long_program(Daemon& daemon, RealBoard& board) {
  daemon.own();
  const std::string text = relief(1'000'000);
  const auto sent = Clock::now();
  const std::string id = Daemon::member(daemon.ask("POST", "/programs?name=long.ngc", text), "id");
  const double uploaded = seconds_since(sent);
  while (Daemon::member(daemon.ask("GET", "/programs/" + id), "state") == "checking") usleep(10'000);
  const double checked = seconds_since(sent);
  const std::uint64_t steps = board.watch.steps();
  const auto asked = Clock::now();
  const double used = daemon.processor();
  daemon.ask("POST", "/programs/" + id + "/run");
  for (int wait = 0; wait < 60'000 && board.watch.steps() == steps; ++wait) usleep(1000);
  std::printf(
      "a program of 1,000,000 lines (%.0f MB): uploaded in %.2f s, checked in %.2f s; first step %.2f s after the "
      "start, %.2f s of a processor\n",
      static_cast<double>(text.size()) / 1e6, uploaded, checked - uploaded, seconds_since(asked),
      daemon.processor() - used);
  std::printf("memory: %.0f MB, at most %.0f MB\n", daemon.megabytes("VmRSS:"), daemon.megabytes("VmHWM:"));
  daemon.ask("POST", "/stop");
  daemon.await("Idle");
}

}  // namespace

int main(int count, char** words) {
  const double seconds = count > 1 ? std::strtod(words[1], nullptr) : 20;
  if (!(seconds >= 1 && seconds <= 3600)) {
    std::fprintf(stderr, "serve_benchmark [SECONDS]: 1 to 3600\n");
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);
  Diagnostics diagnostics;
  const auto machine = load_machine_file(PASSO_SOURCE_DIR "/examples/machines/router.toml", diagnostics);
  if (!machine) return 1;
  RealBoard board(*machine);
  Daemon daemon(board.port());
  if (daemon.http == 0 || daemon.grbl == 0) return 1;
  daemon.own();
  measure_watchers(daemon, seconds);
  measure_http_hold(daemon, board);
  measure_sender_hold(daemon, board);
  measure_long_program(daemon, board);
  return 0;
}
