#include "jog_keys.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>

#include "commands.hpp"
#include "machine_connection.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "passo/link/await.hpp"

namespace passo {
namespace {

constexpr Seconds lease{0.12};
constexpr Seconds a_turn{0.01};
constexpr double step_of_speed = 1.25;
constexpr double fastest = 1e4;  // mm/s; the axes' own limits still hold
constexpr double slowest = 0.01;

// What a key asks for.
struct Key {
  enum class Kind : std::uint8_t { none, jog, faster, slower, quit };
  Kind kind = Kind::none;
  Point direction;
};

Point toward(Axis axis, double way) {
  Point direction;
  direction[axis] = way;
  return direction;
}
Point toward(double x, double y) {
  Point direction;
  direction[Axis::x] = x;
  direction[Axis::y] = y;
  return direction;
}

// Finds the key for the bytes that a terminal sends: arrows, page keys, and the numeric keypad with its diagonals.
Key key_of(std::string_view bytes) {
  struct Known {
    std::string_view bytes;
    Point direction;
  };
  static const std::array known = {
      Known{"\033[C", toward(Axis::x, 1)},
      Known{"\033[D", toward(Axis::x, -1)},
      Known{"\033[A", toward(Axis::y, 1)},
      Known{"\033[B", toward(Axis::y, -1)},
      Known{"\033OC", toward(Axis::x, 1)},
      Known{"\033OD", toward(Axis::x, -1)},
      Known{"\033OA", toward(Axis::y, 1)},
      Known{"\033OB", toward(Axis::y, -1)},
      Known{"\033[5~", toward(Axis::z, 1)},
      Known{"\033[6~", toward(Axis::z, -1)},
      Known{"6", toward(1, 0)},
      Known{"4", toward(-1, 0)},
      Known{"8", toward(0, 1)},
      Known{"2", toward(0, -1)},
      Known{"9", toward(1, 1)},
      Known{"7", toward(-1, 1)},
      Known{"3", toward(1, -1)},
      Known{"1", toward(-1, -1)},
  };
  // If several keys come at once, the last one counts. But a key that quits counts always.
  Key key;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto rest = bytes.substr(at);
    const auto* const found =
        std::find_if(known.begin(), known.end(), [&](const Known& one) { return rest.starts_with(one.bytes); });
    if (found != known.end()) {
      key = {.kind = Key::Kind::jog, .direction = found->direction};
      at += found->bytes.size();
      continue;
    }
    if (rest[0] == '+') key.kind = Key::Kind::faster;
    if (rest[0] == '-') key.kind = Key::Kind::slower;
    if (rest[0] == 'q' || rest[0] == 'Q' || rest[0] == 4) return {.kind = Key::Kind::quit, .direction = {}};
    ++at;
  }
  return key;
}

// Sets the terminal so that keys come one by one and are not shown. The destructor restores the old settings.
class RawTerminal {
 public:
  RawTerminal() {
    tcgetattr(STDIN_FILENO, &before_);
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~RawTerminal() { tcsetattr(STDIN_FILENO, TCSANOW, &before_); }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  Key read_key(Seconds within) const {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    char typed[64];
    if (poll(&input, 1, static_cast<int>(within.value() * 1e3)) <= 0) return {};
    const ssize_t size = ::read(STDIN_FILENO, typed, sizeof typed);
    return size > 0 ? key_of({typed, static_cast<std::size_t>(size)}) : Key{.kind = Key::Kind::quit, .direction = {}};
  }

 private:
  termios before_{};
};

class KeyJog {
 public:
  KeyJog(MachineSession& session, bool is_real, const MachineDescription& description, MmPerSecond speed)
      : session_(session), real_time_(is_real), description_(description), speed_(speed) {}

  int run() {
    fmt::print(
        "Arrows move X and Y, Page Up and Page Down move Z, the numeric keypad X and Y with diagonals.\n"
        "The machine moves while a key is held. + and - change the speed, q ends.\n");
    const RawTerminal terminal;
    while (interrupted_by() == 0) {
      // A virtual machine's time passes only in turns. So each turn follows a wait of the same length.
      const Key key = terminal.read_key(real_time_ ? Seconds(0) : a_turn);
      if (key.kind == Key::Kind::quit) break;
      act(key);
      for (const Seconds end = session_.now() + a_turn; end - session_.now() > hardly_any;) {
        session_.poll(end - session_.now());
      }
      show();
      if (!session_.status().trouble_sentence.text.empty()) break;
    }
    try_request(session_, request::Stop{});
    while (session_.busy()) session_.poll(a_turn);
    show();
    fmt::print("\n");
    if (const std::string words = session_.status().trouble_sentence.text; !words.empty()) {
      return fail(exit_failed, "the board: " + words);
    }
    return interrupted_by() != 0 ? 128 + interrupted_by() : exit_done;
  }

 private:
  void act(const Key& key) {
    if (key.kind == Key::Kind::faster) speed_ = std::min(speed_ * step_of_speed, MmPerSecond(fastest));
    if (key.kind == Key::Kind::slower) speed_ = std::max(speed_ * (1 / step_of_speed), MmPerSecond(slowest));
    if (key.kind != Key::Kind::jog || !has_axes(key.direction)) return;
    if (!session_.busy()) {
      direction_ = key.direction;
      const JogWay way{.direction = direction_, .speed = speed_};
      const auto taken = session_.request(request::Jog{.way = way, .lease = lease});
      refusal_ = taken ? "" : "  " + taken.error().message();
    } else if (key.direction == direction_) {
      try_request(session_, request::RenewKeepAlive{});
    } else {
      try_request(session_, request::Stop{});
    }
  }
  bool has_axes(const Point& direction) const {
    return std::ranges::all_of(all_axes, [&](Axis axis) {
      return direction[axis] == 0 ||
             std::ranges::any_of(description_.axes, [&](const AxisDescription& one) { return one.axis == axis; });
    });
  }
  void show() {
    const MachineStatus status = session_.status();
    std::string line;
    for (const AxisDescription& axis : description_.axes) {
      line += fmt::format(" {}{:.3f}", letter_of(axis.axis), status.ahead[axis.axis]);
    }
    line = fmt::format("\r{:<6}{}  {:.0f} mm/min{}\033[K", name_of(status.state), line,
                       speed_.value() * seconds_per_minute, refusal_);
    if (line == shown_) return;
    shown_ = line;
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
  }

  MachineSession& session_;
  bool real_time_;
  const MachineDescription& description_;
  MmPerSecond speed_;
  Point direction_;
  std::string refusal_;  // why the last key moved nothing
  std::string shown_;
};

}  // namespace

int jog_by_keys(MachineSession& session, bool is_real, const MachineDescription& description, MmPerSecond speed) {
  return KeyJog(session, is_real, description, speed).run();
}

}  // namespace passo
