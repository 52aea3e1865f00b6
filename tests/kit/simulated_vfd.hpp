// SimulatedVfd: a drive with a motor behind a pseudo-terminal, to the byte: a Huanyang, an H-100, or the drive of the
// example table. It may be slow, silent or damaged, refuse, fail, and be switched off and on.
//
// It is written from the protocols' documents and shares no code with the program.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace passo::test {

class SimulatedVfd {
 public:
  enum class Kind { huanyang, h100, table };

  explicit SimulatedVfd(Kind kind, double hertz_a_second = 2000)
      : kind_(kind), hertz_a_second_(hertz_a_second), master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) throw std::runtime_error("no pseudo-terminal");
    device_ = ptsname(master_);
    // The other end stays open, so that the terminal outlives each program that uses it.
    slave_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY);
    termios raw{};
    tcgetattr(slave_, &raw);
    cfmakeraw(&raw);
    tcsetattr(slave_, TCSANOW, &raw);
    thread_ = std::thread([this] { run(); });
  }
  ~SimulatedVfd() {
    ends_ = true;
    thread_.join();
    ::close(slave_);
    ::close(master_);
  }
  SimulatedVfd(const SimulatedVfd&) = delete;
  SimulatedVfd& operator=(const SimulatedVfd&) = delete;

  const std::string& device() const { return device_; }
  double rpm() const { return std::abs(hertz()) * 60; }
  double hertz() const {
    const std::lock_guard lock(mutex_);
    return hertz_;
  }
  bool is_told_to_run() const { return direction_ != 0; }
  // The highest output frequency since the last call.
  double take_highest_hertz() {
    const std::lock_guard lock(mutex_);
    return std::exchange(highest_, hertz_);
  }
  int requests() const { return requests_; }

  // As if its mains switch was thrown: it forgets its orders, and coasts.
  void restart() {
    direction_ = 0;
    set_hertz_ = 0;
  }

  std::atomic<int> delay_ms{5};
  std::atomic<bool> is_silent{false};
  std::atomic<int> wrong_checksums{0};  // in the next replies
  std::atomic<int> silent_replies{0};
  std::atomic<int> exceptions{0};
  std::atomic<int> fault{0};
  std::atomic<double> load_share{0.5};  // current: 10 A at 1

 private:
  using Bytes = std::vector<std::uint8_t>;

  static unsigned checksum(const Bytes& bytes, std::size_t size) {
    unsigned sum = 0xFFFF;
    for (std::size_t i = 0; i < size; ++i) {
      sum ^= bytes[i];
      for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? (sum >> 1U) ^ 0xA001U : sum >> 1U;
    }
    return sum;
  }

  void run() {
    Bytes request;
    auto before = std::chrono::steady_clock::now();
    while (!ends_) {
      pollfd ready{.fd = master_, .events = POLLIN, .revents = 0};
      const bool any = ::poll(&ready, 1, 2) > 0;
      const auto now = std::chrono::steady_clock::now();
      turn(std::chrono::duration<double>(now - before).count());
      before = now;
      if (!any) continue;
      std::uint8_t bytes[64];
      const ssize_t got = ::read(master_, bytes, sizeof bytes);
      if (got <= 0) {
        usleep(2000);
        continue;
      }
      request.insert(request.end(), bytes, bytes + got);
      if (request.size() < 3 || request.size() < length_of(request)) continue;
      answer(request);
      request.clear();
    }
  }

  void turn(double time) {
    const std::lock_guard lock(mutex_);
    if (fault != 0) direction_ = 0;
    const double goal = direction_ * set_hertz_;
    const double most = hertz_a_second_ * time;
    hertz_ += std::clamp(goal - hertz_, -most, most);
    highest_ = std::max(highest_, std::abs(hertz_));
  }

  std::size_t length_of(const Bytes& request) const {
    if (kind_ == Kind::huanyang) return 5U + request[2];
    if (request[1] != 16) return 8;
    return request.size() < 7 ? 9 : 9U + request[6];
  }

  void answer(const Bytes& request) {
    const std::size_t end = request.size() - 2;
    const unsigned sum = checksum(request, end);
    if (request[end] != (sum & 0xFFU) || request[end + 1] != sum >> 8U || request[0] != 1) return;
    ++requests_;
    if (is_silent || take(silent_replies)) return;
    Bytes reply = kind_ == Kind::huanyang ? huanyang_reply(request) : modbus_reply(request);
    if (take(exceptions)) reply = {request[0], static_cast<std::uint8_t>(request[1] | 0x80U), 4};
    unsigned reply_sum = checksum(reply, reply.size());
    if (take(wrong_checksums)) reply_sum ^= 0x5555U;
    reply.push_back(static_cast<std::uint8_t>(reply_sum & 0xFFU));
    reply.push_back(static_cast<std::uint8_t>(reply_sum >> 8U));
    usleep(static_cast<useconds_t>(delay_ms * 1000));
    // In two parts, as a USB adapter passes them on.
    static_cast<void>(!::write(master_, reply.data(), 2));
    usleep(1000);
    static_cast<void>(!::write(master_, reply.data() + 2, reply.size() - 2));
  }

  static bool take(std::atomic<int>& number) { return number > 0 && number-- > 0; }

  Bytes huanyang_reply(const Bytes& request) {
    switch (request[1]) {
      case 3:
        direction_ = request[3] == 0x01 ? 1 : request[3] == 0x11 ? -1 : 0;
        return {1, 3, 1, static_cast<std::uint8_t>(direction_ == 0 ? 0 : 0x09)};
      case 4: {
        const unsigned value =
            request[3] == 1 ? counts(std::abs(hertz()) * 100) : counts(direction_ == 0 ? 0 : load_share * 10 * 10);
        return {1, 4, 3, request[3], static_cast<std::uint8_t>(value >> 8U), static_cast<std::uint8_t>(value & 0xFFU)};
      }
      case 5: set_hertz_ = (request[3] * 256 + request[4]) / 100.0; return {1, 5, 2, request[3], request[4]};
      default: return {1, static_cast<std::uint8_t>(request[1] | 0x80U), 1};
    }
  }

  Bytes modbus_reply(const Bytes& request) {
    const unsigned address = request[2] * 256U + request[3];
    const unsigned value = request[4] * 256U + request[5];
    const bool is_h100 = kind_ == Kind::h100;
    const double scale = is_h100 ? 10 : 100;
    if (request[1] == 3 || request[1] == 4) {
      const std::map<unsigned, unsigned> registers = {
          {is_h100 ? 0U : 0x2103U, counts(std::abs(hertz()) * scale)},
          {is_h100 ? 2U : 0x2104U, counts(direction_ == 0 ? 0 : load_share * 10 * scale)},
          {is_h100 ? 10U : 0x2100U, static_cast<unsigned>(fault.load()) | (is_h100 ? 0U : 0x0300U)}};  // and a warning
      const auto found = registers.find(address);
      if (found == registers.end() || value != 1 || (request[1] == 4) != is_h100) {
        return {1, static_cast<std::uint8_t>(request[1] | 0x80U), 2};
      }
      return {1, request[1], 2, static_cast<std::uint8_t>(found->second >> 8U),
              static_cast<std::uint8_t>(found->second & 0xFFU)};
    }
    if (is_h100 && request[1] == 5 && value == 0xFF00) {
      direction_ = address == 0x49 ? 1 : address == 0x4A ? -1 : 0;
    } else if (request[1] == 6 && address == (is_h100 ? 0x0201U : 0x2001U)) {
      set_hertz_ = value / scale;
    } else if (!is_h100 && request[1] == 6 && address == 0x2000) {
      direction_ = value == 0x12 ? 1 : value == 0x22 ? -1 : 0;
    } else if (!is_h100 && request[1] == 6 && address == 0x2002 && value == 2) {
      fault = 0;
    } else {
      return {1, static_cast<std::uint8_t>(request[1] | 0x80U), 2};
    }
    return Bytes(request.begin(), request.begin() + 6);
  }

  static unsigned counts(double value) { return static_cast<unsigned>(std::lround(value)); }

  Kind kind_;
  double hertz_a_second_;
  int master_;
  int slave_ = -1;
  std::string device_;
  mutable std::mutex mutex_;
  double hertz_ = 0;
  double highest_ = 0;
  std::atomic<double> set_hertz_{0};
  std::atomic<int> direction_{0};
  std::atomic<int> requests_{0};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace passo::test
