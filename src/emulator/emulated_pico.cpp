#include "passo/emulator/emulated_pico.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo {
namespace {

constexpr const char* script = PASSO_EMULATED_PICO "/emulated_pico.js";
constexpr const char* packages = PASSO_EMULATED_PICO "/node_modules/rp2040js";
constexpr std::size_t request_head = 41;
constexpr std::uint8_t stop_at_byte = 1;
constexpr std::uint8_t to_uart = 2;
constexpr std::size_t change_size = 12;
constexpr std::size_t answer_head = 12;
constexpr std::size_t answer_tail = 12;

// Both sides of the pipe are programs on one machine. Its numbers are little-endian, as the emulator's are.
static_assert(std::endian::native == std::endian::little);
template <class Number>
void put(std::vector<std::uint8_t>& to, Number number) {
  const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(number);
  to.insert(to.end(), bytes.begin(), bytes.end());
}
template <class Number>
Number get(const std::vector<std::uint8_t>& from, std::size_t at) {
  Number number;
  std::memcpy(&number, from.data() + at, sizeof(number));
  return number;
}

bool write_all(int to, const std::vector<std::uint8_t>& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    // A socket instead of a pipe, because only that can be told not to raise a signal when the other side is gone.
    const ssize_t wrote = ::send(to, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    sent += static_cast<std::size_t>(wrote);
  }
  return true;
}
bool read_all(int from, std::vector<std::uint8_t>& bytes) {
  for (std::size_t have = 0; have < bytes.size();) {
    const ssize_t got = ::read(from, bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    have += static_cast<std::size_t>(got);
  }
  return true;
}

[[noreturn]] void become_node(int in, int out, const std::string& program, const PicoPins& pins, PicoSocket socket) {
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  // Ctrl-C in the terminal is for Passo, which brakes; the board must go on meanwhile.
  std::signal(SIGINT, SIG_IGN);
  const char* const line = socket == PicoSocket::usb ? "usb" : "uart";
  const std::string spindle = std::to_string(pins.spindle_pwm);
  const std::string pulses = std::to_string(pins.encoder_pulses);
  const std::string index = std::to_string(pins.encoder_index);
  ::execlp("node", "node", script, program.c_str(), line, spindle.c_str(), pulses.c_str(), index.c_str(),
           static_cast<char*>(nullptr));
  ::_exit(127);
}

}  // namespace

Result<std::unique_ptr<EmulatedPico>, std::string> EmulatedPico::start(const std::string& program, const PicoPins& pins,
                                                                       PicoSocket socket) {
  if (!std::filesystem::exists(packages)) {
    return Failure<std::string>{
        std::string("the Pico's emulator is not installed: scripts/install.sh, or `npm ci` in ") + PASSO_EMULATED_PICO};
  }
  int to[2];
  int from[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, to) != 0) return Failure<std::string>{std::strerror(errno)};
  if (::pipe2(from, O_CLOEXEC) != 0) {
    const std::string reason = std::strerror(errno);
    ::close(to[0]);
    ::close(to[1]);
    return Failure<std::string>{reason};
  }
  const pid_t child = ::fork();
  if (child == 0) become_node(to[1], from[1], program, pins, socket);
  ::close(to[1]);
  ::close(from[1]);
  std::unique_ptr<EmulatedPico> pico(new EmulatedPico(child, to[0], from[0]));
  // The first answer shows that the program is there and boots.
  if (child < 0 || !pico->run(1, {})) return Failure<std::string>{pico->error()};
  return pico;
}

EmulatedPico::~EmulatedPico() {
  ::close(to_);
  ::close(from_);
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
}

bool EmulatedPico::fail() {
  error_ = "the Pico's emulator has ended: is node installed, version 18 or later, and the file a UF2 of Passo's?";
  return false;
}

bool EmulatedPico::run(std::uint64_t cycle, const Stops& stops) {
  const std::vector<std::uint8_t> bytes = std::exchange(to_send_, {});
  return request(cycle, stops, stops.at_byte ? stop_at_byte : std::uint8_t{0}, bytes);
}

bool EmulatedPico::send_by_uart(std::span<const std::uint8_t> bytes) {
  return request(cycle_, {}, to_uart, bytes);
}

bool EmulatedPico::request(std::uint64_t cycle, const Stops& stops, std::uint8_t flags,
                           std::span<const std::uint8_t> bytes) {
  std::vector<std::uint8_t> request;
  put(request, static_cast<std::uint32_t>(request_head + bytes.size()));
  put(request, static_cast<double>(cycle));
  put(request, drawn_low_);
  put(request, stops.watched);
  put(request, stops.rises);
  request.push_back(flags);
  put(request, encoder_.from);
  put(request, encoder_.to);
  put(request, encoder_.pulses_per_turn);
  request.insert(request.end(), bytes.begin(), bytes.end());
  return (write_all(to_, request) && read_answer()) || fail();
}

bool EmulatedPico::read_answer() {
  std::vector<std::uint8_t> answer(4);
  if (!read_all(from_, answer)) return false;
  answer.resize(get<std::uint32_t>(answer, 0));
  if (answer.size() < answer_head + answer_tail || !read_all(from_, answer)) return false;
  const std::size_t changes = get<std::uint32_t>(answer, 8);
  const std::size_t tail = answer_head + changes * change_size;
  if (tail + answer_tail > answer.size()) return false;
  cycle_ = static_cast<std::uint64_t>(get<double>(answer, 0));
  changes_.clear();
  for (std::size_t at = answer_head; at < tail; at += change_size) {
    changes_.push_back(
        {.cycle = static_cast<std::uint64_t>(get<double>(answer, at)), .levels = get<std::uint32_t>(answer, at + 8)});
  }
  if (!changes_.empty()) levels_ = changes_.back().levels;
  duty_ = get<double>(answer, tail);
  lost_bytes_ = get<std::uint32_t>(answer, tail + 8);
  said_.assign(answer.begin() + static_cast<std::ptrdiff_t>(tail + answer_tail), answer.end());
  return true;
}

void EmulatedPico::send(std::span<const std::uint8_t> bytes) {
  to_send_.insert(to_send_.end(), bytes.begin(), bytes.end());
}

}  // namespace passo
