#include "follower/host_follower.hpp"

#include <map>
#include <optional>
#include <stdexcept>

#include "passo/firmware/follower.hpp"
#include "passo/firmware/winding_table.hpp"

namespace passo {
namespace {

DriveMode drive_named(const std::string& name) {
  if (name == "two_on") return DriveMode::two_on;
  if (name == "wave") return DriveMode::wave;
  if (name == "half_step") return DriveMode::half_step;
  throw std::runtime_error("no such drive: " + name);
}

class HostHardware {
 public:
  static constexpr bool has_keypad = true;

  explicit HostHardware(const std::string& drive) : table_(winding_table(drive_named(drive))) {}

  void set(const LineChange& change) {
    if (change.line.starts_with("key.")) {
      const KeyPlace place = key_place(change.line);
      connected_[place.row][place.column] = change.high;
    } else {
      levels_[change.line] = change.high;
    }
  }
  void advance_to(Nanoseconds now) { now_ = now; }
  // All pins float: a transistor without a drive is off. The LEDs that are lit when low are lit again at once.
  void reset() {
    for (auto& [output, value] : values_) {
      if (output.starts_with("led.") && output != "led.0") continue;
      put(output, output.starts_with("windings.") ? "0000" : "0");
    }
  }
  const std::vector<OutputChange>& seen() const { return seen_; }

  uint8_t lines() {
    uint8_t byte = 0xc0;  // two pins that are something else
    const char* const names[] = {"clock.x", "clock.y", "clock.z", "direction.x", "direction.y", "direction.z"};
    for (unsigned bit = 0; bit < 6; ++bit) byte = static_cast<uint8_t>(byte | (levels_[names[bit]] ? 1U << bit : 0U));
    return byte;
  }
  bool relay_line() { return levels_["relay"]; }
  bool tool_button() { return levels_["button"]; }
  void windings(uint8_t axis, uint8_t place) {
    put(std::string("windings.") + "xyz"[axis], winding_text(table_.at(place)));
  }
  void relay(bool on) {
    put("relay", on ? "1" : "0");
    put("indicator.relay", on ? "1" : "0");
  }
  void indicators(bool automatic, bool manual) {
    put("indicator.automatic", automatic ? "1" : "0");
    put("indicator.manual", manual ? "1" : "0");
  }
  void light_relay_indicator() { put("indicator.relay", "1"); }
  void leds(bool automatic, bool manual, bool raising) {
    put("led.0", automatic ? "1" : "0");
    put("led.1", !manual || raising ? "1" : "0");
    put("led.2", manual ? "0" : "1");
    put("led.3", manual ? "0" : "1");
  }
  bool millisecond() {
    if (now_ < next_millisecond_) return false;
    next_millisecond_ += 1'000'000;
    return true;
  }
  uint8_t rows() const {
    uint8_t down = 0;
    for (unsigned row = 0; row < 4; ++row)
      down = static_cast<uint8_t>(down | (connected_[row][column_] ? 1U << row : 0U));
    return down;
  }
  void draw_column(uint8_t column) { column_ = column; }

 private:
  void put(const std::string& output, const std::string& value) {
    const std::string nothing = output.starts_with("windings.") ? "0000" : "0";
    std::string& now = values_.try_emplace(output, nothing).first->second;
    if (now == value) return;
    now = value;
    seen_.push_back({now_, output, value});
  }

  WindingTable table_;
  Nanoseconds now_ = 0;
  Nanoseconds next_millisecond_ = 1'000'000;
  std::map<std::string, bool> levels_;
  bool connected_[4][3] = {};
  uint8_t column_ = 0;
  std::map<std::string, std::string> values_;
  std::vector<OutputChange> seen_;
};

template <class Customs>
std::vector<OutputChange> run(const FollowerVector& vector, Nanoseconds turn) {
  HostHardware hardware(vector.drive);
  std::optional<Follower<HostHardware, Customs>> follower;
  auto next = vector.lines.begin();
  for (Nanoseconds now = 0; now < vector.end; now += turn) {
    hardware.advance_to(now);
    for (; next != vector.lines.end() && next->at <= now; ++next) {
      if (next->line == "reset") {
        hardware.reset();
        follower.reset();
      } else {
        hardware.set(*next);
      }
    }
    if (!follower) follower.emplace(hardware).begin();
    follower->poll();
  }
  return hardware.seen();
}

}  // namespace

std::vector<OutputChange> run_on_host(const FollowerVector& vector, Nanoseconds turn) {
  return run<UsualCustoms>(vector, turn);
}

std::vector<OutputChange> run_first_board_on_host(const FollowerVector& vector, Nanoseconds turn) {
  return run<FirstBoardCustoms>(vector, turn);
}

}  // namespace passo
