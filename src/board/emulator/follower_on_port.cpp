#include "passo/emulator/follower_on_port.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

constexpr Nanoseconds longest_piece = 4'000'000'000;
constexpr std::int64_t most_steps_in_piece = 20'000;
constexpr Nanoseconds after_the_end = 2'000'000;

// The key that the board waits for.
constexpr Nanoseconds pressed = 50'000'000;
constexpr Nanoseconds released = 150'000'000;
const std::string automatic_key = "key.*";

// From a rising clock to the change of the windings: the loop reads the lines, and then steps the motors.
constexpr Nanoseconds shortest_answer = 8'000;
constexpr Nanoseconds longest_answer = 2 * first_board_level;

// Two windings on at a time, F1 to F4, upwards.
const std::array<std::string, 4> windings_upwards{"1100", "0110", "0011", "1001"};

struct Signal {
  std::string line;
  int pin = 0;
};
std::array<Signal, 2 * port_axes + 1> signals_of(const PortPins& pins) {
  return {{{"clock.x", pins.clock[0]},
           {"clock.y", pins.clock[1]},
           {"clock.z", pins.clock[2]},
           {"direction.x", pins.direction[0]},
           {"direction.y", pins.direction[1]},
           {"direction.z", pins.direction[2]},
           {"relay", pins.tool}}};
}

}  // namespace

FollowerOnPort::FollowerOnPort(std::unique_ptr<RunningPic> pic, Nanoseconds pulse, Plant& plant)
    : pic_(std::move(pic)), pulse_(pulse), plant_(plant), driver_(pulse) {
  const std::array presses{LineChange{pressed, automatic_key, true}, LineChange{released, automatic_key, false}};
  pic_->add(presses);
}

Result<std::unique_ptr<FollowerOnPort>, std::string> FollowerOnPort::start(const std::filesystem::path& image,
                                                                           const std::filesystem::path& work,
                                                                           Nanoseconds pulse, Plant& plant) {
  auto pic = RunningPic::start(PicFollower::first_board, image, work, std::array{automatic_key});
  if (!pic) return Failure{pic.error()};
  return std::unique_ptr<FollowerOnPort>(new FollowerOnPort(std::move(*pic), pulse, plant));
}

void FollowerOnPort::step(Nanoseconds at, unsigned stepped, unsigned down) {
  driver_.step(at, stepped, down);
  for (std::size_t m = 0; m < port_axes; ++m) {
    if ((stepped >> m & 1) == 0) continue;
    const bool goes_down = (down >> m & 1) != 0;
    ++counts_[m].commanded;
    counts_[m].commanded_net += goes_down ? -1 : 1;
    pulses_[m].push_back({at, goes_down});
  }
  ++steps_in_piece_;
}

void FollowerOnPort::switch_tool(Nanoseconds at, bool on) {
  driver_.switch_tool(at, on);
}

bool FollowerOnPort::pass_to(Nanoseconds now) {
  if (!error_.empty()) return false;
  if (now - played() < longest_piece && steps_in_piece_ < most_steps_in_piece) return true;
  return play(now, false);
}

bool FollowerOnPort::finish(Nanoseconds now) {
  if (!error_.empty() || !play(now + 2 * pulse_ + after_the_end, true)) return false;
  for (std::size_t m = 0; m < port_axes; ++m) {
    for (const Pulse& pulse : std::exchange(pulses_[m], {})) record_lost(m, pulse);
  }
  std::ranges::stable_sort(lost_, {}, &LostPulse::at);
  return true;
}

bool FollowerOnPort::play(Nanoseconds end, bool is_last) {
  steps_in_piece_ = 0;
  pic_->add(lines_of(driver_.take(end)));
  const auto run = is_last ? pic_->run_to(end + lead) : pic_->run_before(end + lead);
  if (!run) {
    error_ = run.error();
    return false;
  }
  return std::ranges::all_of(run->changes, [&](const OutputChange& change) { return take(change); });
}

// What the writes change on the pins.
std::vector<LineChange> FollowerOnPort::lines_of(const std::vector<PortWrite>& writes) {
  static const auto signals = signals_of({});
  std::vector<LineChange> lines;
  writes_ += std::ssize(writes);
  for (const PortWrite& write : writes) {
    port_.write(write.to, write.value);
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const bool high = port_.level(signals[i].pin);
      if (std::exchange(levels_[i], high) != high) lines.push_back({write.at + lead, signals[i].line, high});
    }
  }
  return lines;
}

bool FollowerOnPort::take(const OutputChange& change) {
  const Nanoseconds at = change.at - lead;
  if (change.output == "relay") {
    relay_is_closed_ = change.value == "1";
    relay_closings_ += relay_is_closed_ ? 1 : 0;
  }
  if (!change.output.starts_with("windings.")) return true;
  return turn(static_cast<std::size_t>(change.output.back() - 'x'), at, change.value);
}

bool FollowerOnPort::turn(std::size_t motor, Nanoseconds at, const std::string& windings) {
  const auto place = std::ranges::find(windings_upwards, windings);
  const auto index = static_cast<unsigned>(place - windings_upwards.begin());
  const unsigned steps = (index - std::exchange(places_[motor], index)) % 4;
  if (place == windings_upwards.end() || (steps != 1 && steps != 3)) {
    error_ = "the board switched the windings of " + std::string(1, "XYZ"[motor]) + " to " + windings +
             ", which is not the next pattern";
    return false;
  }
  const bool down = steps == 3;
  ++counts_[motor].sampled;
  counts_[motor].sampled_net += down ? -1 : 1;
  find_pulse_of(motor, at, down);
  MotorSteps turned{};
  turned[motor] = down ? -1 : 1;
  const Seconds now(static_cast<double>(at) * 1e-9);
  if (watch_) watch_(now);
  plant_.pulse(now, turned);
  return true;
}

// The first pulse that can have caused a step now. Those before it were lost.
void FollowerOnPort::find_pulse_of(std::size_t motor, Nanoseconds at, bool down) {
  std::deque<Pulse>& pulses = pulses_[motor];
  const Nanoseconds rise = at - pulse_;
  for (; !pulses.empty() && pulses.front().at <= rise - shortest_answer; pulses.pop_front()) {
    const Pulse& pulse = pulses.front();
    if (pulse.at >= rise - longest_answer && pulse.down == down) {
      pulses.pop_front();
      return;
    }
    record_lost(motor, pulse);
  }
}

void FollowerOnPort::record_lost(std::size_t motor, const Pulse& pulse) {
  if (lost_.size() < most_losses) lost_.push_back({pulse.at, motor});
}

}  // namespace passo
