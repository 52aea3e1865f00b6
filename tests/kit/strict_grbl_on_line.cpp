// strict_grbl_on_line: a StrictGrbl in real time behind a pseudo-terminal, as a sender meets a board on a serial port,
// for tests that need processes of their own, such as the stories of the web interface:
//   strict_grbl_on_line LINK [--card grblhal|fluidnc] [--probe-at Z:MM]
// LINK becomes a symbolic link to the terminal, and vanishes at the end. --card: a board with a card for files.
// --probe-at closes the probe where Z is at or below MM.
// Commands on standard input, one a line:
//   limit X|Y|Z 0|1    a limit switch opens or closes
//   probe 0|1          the probe
//   door 0|1           the safety door
//   hold 0|1           the hold input
//   unplug SECONDS     the cable is out: no byte comes through, in either direction
//   power [SECONDS]    the power is cut for so long; the position is lost, the settings stay
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "kit/strict_card_board.hpp"
#include "kit/strict_grbl.hpp"
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

namespace passo::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double of_115200_baud = 11520;  // bytes per second
constexpr int look = 2;                   // ms

volatile std::sig_atomic_t ends = 0;

struct Arguments {
  std::string link;
  std::string card;
  std::optional<double> probe_at;  // mm
};

std::optional<Arguments> read_arguments(int count, char** words) {
  if (count < 2) return {};
  Arguments arguments{.link = words[1], .card = {}, .probe_at = {}};
  for (int i = 2; i + 1 < count; i += 2) {
    const std::string_view option = words[i];
    const std::string_view value = words[i + 1];
    if (option == "--card" && (value == "grblhal" || value == "fluidnc")) {
      arguments.card = value;
    } else if (option == "--probe-at" && value.starts_with("Z:")) {
      arguments.probe_at = std::atof(words[i + 1] + 2);
    } else {
      return {};
    }
  }
  return count % 2 == 0 ? std::optional(arguments) : std::nullopt;
}

// The end of the terminal that belongs to the board. The other end stays open here, so that a sender may come and go.
int open_terminal(const std::string& link) {
  termios raw{};
  cfmakeraw(&raw);
  int board = -1;
  int sender = -1;
  std::array<char, 64> name{};
  if (openpty(&board, &sender, name.data(), &raw, nullptr) != 0) return -1;
  fcntl(board, F_SETFL, O_NONBLOCK);
  fcntl(STDIN_FILENO, F_SETFL, O_NONBLOCK);
  unlink(link.c_str());
  return symlink(name.data(), link.c_str()) == 0 ? board : -1;
}

std::string read_some(int from) {
  std::array<char, 4096> bytes{};
  const ssize_t count = read(from, bytes.data(), bytes.size());
  return count > 0 ? std::string(bytes.data(), static_cast<std::size_t>(count)) : std::string();
}

StrictGrbl& strict_of(StrictGrbl& board) {
  return board;
}
StrictGrbl& strict_of(StrictCardBoard& board) {
  return board.inner();
}

template <class Board>
class BoardOnLine {
 public:
  BoardOnLine(Board board, int terminal, std::optional<double> probe_at)
      : board_(std::move(board)), terminal_(terminal) {
    StrictGrbl& grbl = strict_of(board_);
    grbl.bytes_per_second = of_115200_baud;
    grbl.probe = [this, probe_at](const Point& at) { return touches_ || (probe_at && at[Axis::z] <= *probe_at); };
    board_.restart();
  }

  void serve() {
    while (ends == 0) {
      std::array<pollfd, 2> all{
          {{.fd = terminal_, .events = POLLIN, .revents = 0}, {.fd = STDIN_FILENO, .events = POLLIN, .revents = 0}}};
      poll(all.data(), has_input_ ? 2 : 1, look);
      if (has_input_ && all[1].revents != 0) read_commands();
      turn();
    }
  }

 private:
  void turn() {
    const Clock::time_point now = Clock::now();
    const std::string came = read_some(terminal_);
    if (now >= dark_until_ && is_dark_) {
      is_dark_ = false;
      board_.restart();
    }
    if (now >= cut_until_ && !is_dark_ && !came.empty()) board_.receive(came);
    const double passed = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    if (is_dark_) return;
    board_.run(passed);
    const std::string said = board_.take_output();
    if (now < cut_until_ || said.empty()) return;
    // Nobody may be listening: a terminal that is full loses what it cannot hold, as a serial line does.
    static_cast<void>(!write(terminal_, said.data(), said.size()));
  }
  void read_commands() {
    const std::string came = read_some(STDIN_FILENO);
    has_input_ = !came.empty();
    input_ += came;
    for (std::size_t end = 0; (end = input_.find('\n')) != std::string::npos; input_.erase(0, end + 1)) {
      take_command(input_.substr(0, end));
    }
  }
  void take_command(const std::string& line) {
    std::istringstream words(line);
    std::string what;
    words >> what;
    StrictGrbl& grbl = strict_of(board_);
    char axis = 0;
    if (what == "limit") words >> axis;
    double value = 0;
    words >> value;
    const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
    if (what == "limit") {
      grbl.set_limit(axis, value != 0);
    } else if (what == "probe") {
      touches_ = value != 0;
    } else if (what == "door") {
      grbl.open_door(value != 0);
    } else if (what == "hold") {
      grbl.held_input = value != 0;
      if (value != 0) board_.receive("!");
    } else if (what == "unplug") {
      cut_until_ = until;
    } else if (what == "power") {
      is_dark_ = true;
      dark_until_ = until;
    } else {
      std::fprintf(stderr, "no command: %s\n", line.c_str());
    }
  }

  Board board_;
  int terminal_;
  bool touches_ = false;
  bool has_input_ = true;
  std::string input_;
  bool is_dark_ = false;
  Clock::time_point last_ = Clock::now();
  Clock::time_point cut_until_{};
  Clock::time_point dark_until_{};
};

int serve(const Arguments& arguments) {
  const int terminal = open_terminal(arguments.link);
  if (terminal < 0) {
    std::perror(arguments.link.c_str());
    return 1;
  }
  if (arguments.card.empty()) {
    BoardOnLine<StrictGrbl>(StrictGrbl(), terminal, arguments.probe_at).serve();
  } else {
    const bool is_grblhal = arguments.card == "grblhal";
    StrictCardBoard board = is_grblhal ? strict_grblhal_with_card() : strict_fluidnc_with_card();
    board.files()[is_grblhal ? "/old.nc" : "/sd/old.nc"] = "G21 G90\nG1 X1 F600\nM2\n";  // somebody has put it there
    BoardOnLine<StrictCardBoard>(std::move(board), terminal, arguments.probe_at).serve();
  }
  unlink(arguments.link.c_str());
  return 0;
}

}  // namespace
}  // namespace passo::test

int main(int count, char** words) {
  const auto arguments = passo::test::read_arguments(count, words);
  if (!arguments) {
    std::fprintf(stderr, "usage: strict_grbl_on_line LINK [--card grblhal|fluidnc] [--probe-at Z:MM]\n");
    return 2;
  }
  for (const int one : {SIGTERM, SIGINT}) std::signal(one, [](int) { passo::test::ends = 1; });
  return passo::test::serve(*arguments);
}
