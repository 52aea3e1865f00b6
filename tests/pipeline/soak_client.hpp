// SoakClient: somebody who asks a machine for random things at random instants: often what makes sense in the state
// that the machine is in, at times anything.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "kit/stage_test.hpp"
#include <fmt/format.h>

#include "passo/session/machine_session.hpp"

namespace passo::test {

class SoakClient {
 public:
  SoakClient(const MachineDescription& machine, Random random) : machine_(machine), random_(std::move(random)) {}

  // What it asks for now, if anything.
  std::optional<Request> act(const MachineStatus& status) {
    if (status.state != MachineState::jog) renews_until_ = Seconds(0);
    if (status.time < renews_until_ && status.time >= renews_at_) {
      renews_at_ = status.time + Seconds(0.1);
      return request::RenewKeepAlive{};
    }
    if (status.time < next_) return {};
    next_ = status.time + Seconds(std::exp(random_.between(-3, 2)));
    return random_.chance(0.15) ? anything(status) : sensible(status);
  }

 private:
  std::optional<Request> sensible(const MachineStatus& status) {
    switch (status.state) {
      case MachineState::offline: return {};
      case MachineState::idle: return begin(status);
      case MachineState::door: return random_.chance(0.5) ? Request(request::Resume{}) : Request(request::Stop{});
      case MachineState::alarm:
      case MachineState::fault: return request::ResetMachine{};
      case MachineState::sleep: return request::Wake{};
      case MachineState::check: return {};
      case MachineState::home:
      case MachineState::probe: return random_.chance(0.95) ? std::nullopt : amid(status);
      default: return amid(status);
    }
  }
  Request begin(const MachineStatus& status) {
    if (status.position.trust == Trust::unknown && random_.chance(0.5)) return home_or_place(status);
    const double kind = random_.between(0, 1);
    if (kind < 0.55) return start(status);
    if (kind < 0.80) return jog(status);
    if (kind < 0.88) return probe(status);
    if (kind < 0.92) return check(status);
    if (kind < 0.95) return home_or_place(status);
    if (kind < 0.97) return request::Sleep{};
    return request::ResetMachine{};
  }
  std::optional<Request> amid(const MachineStatus& status) {
    const double kind = random_.between(0, 1);
    if (status.waits_for && kind < 0.6) return request::OperatorDone{};
    if (status.state == MachineState::hold && kind < 0.5) return request::Resume{};
    if (kind < 0.65) return {};
    if (kind < 0.77) return request::Hold{};
    if (kind < 0.83) return request::Resume{};
    if (kind < 0.96) return change();
    return request::Stop{};
  }
  Request anything(const MachineStatus& status) {
    switch (static_cast<int>(random_.between(0, 16.999))) {
      case 0: return start(status);
      case 1: return jog(status);
      case 2: return request::RenewKeepAlive{};
      case 3: return request::Home{};
      case 4: return probe(status);
      case 5: return check(status);
      case 6: return request::Hold{};
      case 7: return request::Resume{};
      case 8: return request::Stop{};
      case 9: return change();
      case 10: return request::OperatorDone{};
      case 11: return home_or_place(status);
      case 12: return request::ResetMachine{};
      case 13: return request::Sleep{};
      case 14: return request::Wake{};
      case 15: return request::ChooseStops{.single_block = random_.chance(0.3), .optional_stop = random_.chance(0.5)};
      default: return nonsense();
    }
  }
  Request nonsense() {
    const double kind = random_.between(0, 1);
    if (kind < 0.3) return request::Jog{};
    if (kind < 0.5) return request::Override{.feed = -1};
    if (kind < 0.8) return request::Probe{.target = xyz(0, 0, std::nan("")), .speed = MmPerSecond(1)};
    return request::SetPosition{.position = {.place = xyz(HUGE_VAL, 0), .trust = Trust::commanded}};
  }

  // Somebody has measured where the machine stands, not always well.
  Request home_or_place(const MachineStatus& status) {
    if (random_.chance(0.6)) return request::Home{};
    Point place = status.position.place;
    if (random_.chance(0.3)) place[Axis::x] += random_.between(-30, 30);
    for (const AxisDescription& axis : machine_.axes) {
      place[axis.axis] = std::clamp(place[axis.axis], axis.travel_low, axis.travel_high);
    }
    return request::SetPosition{.position = {.place = place, .trust = Trust::commanded}};
  }
  Request jog(const MachineStatus& status) {
    renews_at_ = status.time + Seconds(0.1);
    renews_until_ = status.time + Seconds(std::exp(random_.between(-2, 2)));
    JogWay way{.direction = xyz(one(), one(), random_.chance(0.3) ? one() : 0),
               .speed = MmPerSecond(random_.between(1, 120))};
    if (random_.chance(0.3)) way.distance = Mm(random_.between(0.01, 30));
    return request::Jog{.way = way, .lease = Seconds(random_.between(0.15, 0.6))};
  }
  Request probe(const MachineStatus& status) {
    Point target = status.position.place;
    target[Axis::x] += random_.between(-5, 5);
    target[Axis::z] += random_.between(-50, 10);
    return request::Probe{
        .target = target, .speed = MmPerSecond(random_.between(2, 40)), .toward = random_.chance(0.8)};
  }
  Request check(const MachineStatus& status) {
    return request::Check{.program = ProgramReader::from_text("check", program(status)), .options = {}};
  }
  Request start(const MachineStatus& status) {
    return request::Start{.program = ProgramReader::from_text("soak", program(status)),
                          .options = {},
                          .waits_for_operator = random_.chance(0.9),
                          .live = random_.chance(0.8)};
  }
  Request change() {
    const auto factor = [&](double highest) -> std::optional<double> {
      if (random_.chance(0.5)) return {};
      return random_.chance(0.1) ? 0 : random_.chance(0.4) ? 1 : random_.between(0.1, highest);
    };
    return request::Override{.feed = factor(2), .adaptive_feed = factor(1), .spindle = factor(2)};
  }

  // A small program from where the machine stands.
  std::string program(const MachineStatus& status) {
    place_ = status.position.place;
    std::string text = fmt::format("G21 G90 G94 F{:.0f}\n", random_.between(500, 6000));
    const int lines = static_cast<int>(random_.between(1, 12));
    for (int i = 0; i < lines; ++i) text += line() + "\n";
    return text + "M2\n";
  }
  std::string line() {
    const double kind = random_.between(0, 1);
    if (kind < 0.5) return move(random_.chance(0.3) ? "G0" : "G1");
    if (kind < 0.6) return arc();
    if (kind < 0.65) return fmt::format("G4 P{:.2f}", random_.between(0, 2));
    if (kind < 0.73) return fmt::format("{} S{:.0f}", random_.chance(0.7) ? "M3" : "M4", random_.between(100, 20'000));
    if (kind < 0.77) return "M5";
    if (kind < 0.81) return random_.chance(0.5) ? "M8" : "M7";
    if (kind < 0.83) return "M9";
    if (kind < 0.86) return "M0";
    if (kind < 0.88) return "M1";
    if (kind < 0.91) return fmt::format("M6 T{:.0f}", random_.between(1, 9));
    if (kind < 0.93) return random_.chance(0.5) ? "M49" : "M48";
    if (kind < 0.98) return probe_line();
    return "G1 X200";  // out of the travel
  }
  std::string move(const char* word) {
    const double size = random_.chance(0.1) ? 60 : 15;
    std::string words = word;
    for (const AxisDescription& axis : machine_.axes) {
      if (!random_.chance(0.6)) continue;
      const double wanted = place_[axis.axis] + size * one();
      place_[axis.axis] = std::clamp(wanted, axis.travel_low, axis.travel_high);
      words += fmt::format(" {}{:.4f}", letter_of(axis.axis), place_[axis.axis]);
    }
    return words == word ? "G4 P0.1" : words;
  }
  std::string arc() {
    return fmt::format("{} X{:.4f} Y{:.4f} I{:.4f} J0", random_.chance(0.5) ? "G2" : "G3", place_[Axis::x],
                       place_[Axis::y], random_.between(0.5, 8));
  }
  // Nobody knows where it ends: what follows begins at a place that is known.
  std::string probe_line() {
    const double bottom = std::max(-49.0, place_[Axis::z] - random_.between(5, 60));
    return fmt::format("G38.{} Z{:.4f}\nG1 Z{:.4f}", random_.chance(0.3) ? 2 : 3, bottom, place_[Axis::z]);
  }
  double one() { return random_.between(-1, 1); }

  const MachineDescription& machine_;
  Random random_;
  Point place_;
  Seconds next_{0};
  Seconds renews_at_{0};
  Seconds renews_until_{0};
};

}  // namespace passo::test
