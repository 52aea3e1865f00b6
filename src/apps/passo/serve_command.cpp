// passo serve: a machine that senders of G-code drive, as they drive a Grbl controller.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "example_machine_text.hpp"
#include "opened_machine.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <poll.h>

#include "passo/grbl/grbl_controller.hpp"
#include "passo/transport/sender_line.hpp"

namespace passo {
namespace {

// How long the loop waits for senders: while the machine is busy, and while nothing goes on.
constexpr Seconds busy_look{0.002};
constexpr Seconds idle_look{0.02};
// A virtual machine that is later than this, because the computer was busy or asleep, does not catch up.
constexpr Seconds most_late{0.2};
constexpr Seconds hardly_late{1e-4};
constexpr int most_turns = 5000;  // of one look

struct HostAndPort {
  std::string host;
  unsigned port = 0;
};

// "HOST:PORT", "[::1]:PORT" or ":PORT". Empty: it is none of them.
std::optional<HostAndPort> read_address(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return {};
  std::string_view host = text.substr(0, colon);
  const std::string_view digits = text.substr(colon + 1);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  unsigned port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc() || end != digits.data() + digits.size() || port > 65535) return {};
  return HostAndPort{.host = host.empty() ? "127.0.0.1" : std::string(host), .port = port};
}

bool is_this_computer(const std::string& host) {
  return host.starts_with("127.") || host == "::1" || host == "localhost";
}

// The time of a virtual machine follows the clock of this computer.
class WallClock {
 public:
  // How far the clock is ahead of `time`.
  Seconds ahead_of(Seconds time) {
    const auto now = std::chrono::steady_clock::now();
    const Seconds ahead = Seconds(std::chrono::duration<double>(now - start_).count()) - (time - from_);
    if (ahead <= most_late) return ahead;
    start_ = now;
    from_ = time;
    return Seconds(0);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Seconds from_{0};
};

class Daemon {
 public:
  using Lines = std::vector<std::unique_ptr<SenderLine>>;

  Daemon(OpenedMachine& machine, GrblController& grbl, Lines lines)
      : machine_(machine), session_(machine.session()), grbl_(grbl), lines_(std::move(lines)) {}

  // Until a signal comes.
  void serve() {
    while (interrupted_by() == 0) {
      wait();
      for (const auto& line : lines_) attend(*line);
      turn();
      reply();
    }
  }

  // Brakes what moves, and waits until it rests.
  void stop() {
    if (session_.busy()) try_request(session_, request::Stop{});
    while (session_.busy()) {
      if (machine_.has_board()) {
        session_.turn(busy_look);
      } else {
        session_.turn(Seconds(1));
      }
    }
  }

 private:
  void wait() {
    std::vector<pollfd> all;
    for (const auto& line : lines_) line->add_to(all, may_read(*line));
    const bool busy = session_.busy() || session_.state() == MachineState::offline;
    const Seconds most = busy ? busy_look : idle_look;
    const auto milliseconds = static_cast<int>(machine_.has_board() && busy ? 0 : most.value() * 1e3);
    static_cast<void>(poll(all.data(), all.size(), milliseconds));
  }

  // One sender drives; others are told that they have to wait.
  bool may_read(const SenderLine& line) const { return grbl_.wants_more() && (driver_ == nullptr || driver_ == &line); }

  void attend(SenderLine& line) {
    const SenderLine::News news = line.look(may_read(line));
    if (news.came && driver_ == nullptr) {
      driver_ = &line;
      grbl_.connect();
    }
    if (driver_ != &line) return;
    if (!news.bytes.empty()) grbl_.receive(news.bytes);
    if (!news.went) return;
    driver_ = nullptr;
    grbl_.disconnect();
  }

  void turn() {
    if (machine_.has_board()) {
      session_.turn(session_.busy() ? busy_look : Seconds(0));
      return grbl_.turn(session_.take_changes());
    }
    for (int turns = 0; turns < most_turns; ++turns) {
      const Seconds ahead = clock_.ahead_of(session_.now());
      if (ahead < hardly_late) break;
      session_.turn(ahead);
      grbl_.turn(session_.take_changes());
    }
    grbl_.turn(session_.take_changes());
  }

  void reply() {
    for (const std::string& text : grbl_.take_replies()) {
      if (driver_ != nullptr) driver_->send(text);
    }
  }

  OpenedMachine& machine_;
  MachineSession& session_;
  GrblController& grbl_;
  Lines lines_;
  SenderLine* driver_ = nullptr;  // where the sender is that drives
  WallClock clock_;
};

// Opens all lines that the arguments ask for. False, with a message and `code`: one of them cannot be.
bool open_lines(const ServeArguments& arguments, Daemon::Lines& lines, int& code) {
  const bool any = !arguments.grbl_tcp.empty() || !arguments.grbl_pty.empty();
  const std::string wanted = any ? arguments.grbl_tcp : "127.0.0.1:7071";
  if (!wanted.empty()) {
    const auto address = read_address(wanted);
    if (!address) {
      code = fail(exit_bad_program, "--grbl-tcp: expected HOST:PORT, as 127.0.0.1:7071, not " + wanted);
      return false;
    }
    if (!is_this_computer(address->host) && !arguments.anybody_may_drive) {
      code = fail(exit_bad_program,
                  fmt::format("--grbl-tcp {}: whoever reaches this port can drive the machine, because the protocol "
                              "has no password. If that is meant, add --anybody-may-drive [serve.open-port]",
                              wanted));
      return false;
    }
    auto line = SenderLine::listen(address->host, address->port);
    if (!line) {
      code = fail(exit_failed, line.error());
      return false;
    }
    lines.push_back(std::move(*line));
  }
  if (!arguments.grbl_pty.empty()) {
    auto line = SenderLine::open_terminal(arguments.grbl_pty);
    if (!line) {
      code = fail(exit_failed, line.error());
      return false;
    }
    lines.push_back(std::move(*line));
  }
  return true;
}

std::optional<MachineDescription> load_machine(const std::string& file) {
  Diagnostics diagnostics;
  const auto machine = file.empty() ? parse_machine(example_machine_text, "the example machine", diagnostics)
                                    : load_machine_file(file, diagnostics);
  show(diagnostics);
  return machine;
}

}  // namespace

int serve(const ServeArguments& arguments) {
  const std::optional<MachineDescription> machine = load_machine(arguments.machine);
  if (!machine) return exit_bad_machine;
  int code = exit_done;
  Daemon::Lines lines;
  if (!open_lines(arguments, lines, code)) return code;
  outlive_readers();
  const auto opened = OpenedMachine::open(*machine, {.board = arguments.board, .tells_place = true}, code);
  if (!opened) return code;
  brake_on_signals();
  if (!opened->greet(opened->any_greeting(), code)) return code;
  const KnownPosition position = opened->session().status().position;
  InterpreterOptions dialect;
  dialect.dialect = Dialect::grbl;
  OpenProgram program(*machine, dialect, position.place);
  GrblController grbl(*machine, opened->session(), program);
  fmt::print("{} on {}, for senders of Grbl 1.1:\n", machine->name,
             opened->has_board() ? arguments.board : "a virtual board");
  for (const auto& line : lines) fmt::print("  {}\n", line->name());
  fmt::print("Ctrl-C stops the machine, and ends.\n");
  std::fflush(stdout);
  Daemon daemon(*opened, grbl, std::move(lines));
  daemon.serve();
  daemon.stop();
  return interrupted_by() == 2 || interrupted_by() == 15 ? exit_done : 128 + interrupted_by();
}

}  // namespace passo
