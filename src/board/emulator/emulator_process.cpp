#include "passo/emulator/emulator_process.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <unistd.h>

namespace passo {
namespace {

constexpr std::size_t request_head = 41;
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

bool read_all(int from, std::vector<std::uint8_t>& bytes) {
  for (std::size_t have = 0; have < bytes.size();) {
    const ssize_t got = ::read(from, bytes.data() + have, bytes.size() - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    have += static_cast<std::size_t>(got);
  }
  return true;
}

[[noreturn]] void become(const std::vector<std::string>& words, int in, int out) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  // Ctrl-C in the terminal is for Passo, which brakes; the board must go on meanwhile.
  std::signal(SIGINT, SIG_IGN);
  ::execvp(pointers.front(), pointers.data());
  ::_exit(127);
}

}  // namespace

EmulatorProcess::EmulatorProcess(const std::vector<std::string>& words, std::string died)
    : child_([&](int in, int out) { become(words, in, out); }), died_(std::move(died)) {}

bool EmulatorProcess::run(std::uint64_t cycle, const Stops& stops) {
  const std::vector<std::uint8_t> bytes = std::exchange(to_send_, {});
  return request(cycle, stops, stops.at_byte ? 1 : 0, bytes);
}
bool EmulatorProcess::send_by_other_line(std::span<const std::uint8_t> bytes) {
  return request(cycle_, {}, 2, bytes);
}

bool EmulatorProcess::request(std::uint64_t cycle, const Stops& stops, std::uint8_t flags,
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
  if (child_.send({reinterpret_cast<const char*>(request.data()), request.size()}) && read_answer()) return true;
  error_ = died_;
  return false;
}

bool EmulatorProcess::read_answer() {
  std::vector<std::uint8_t> answer(4);
  if (!read_all(child_.output(), answer)) return false;
  answer.resize(get<std::uint32_t>(answer, 0));
  if (answer.size() < answer_head + answer_tail || !read_all(child_.output(), answer)) return false;
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

void EmulatorProcess::send(std::span<const std::uint8_t> bytes) {
  to_send_.insert(to_send_.end(), bytes.begin(), bytes.end());
}

}  // namespace passo
