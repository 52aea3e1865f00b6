// TimedVfd: a drive with a motor, in virtual time. Its owner has the clock.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passo/spindle/vfd.hpp"
#include "passo/units/units.hpp"

namespace passo::test {

// The motor changes its speed by `rpm_a_second`.
class TimedVfd final : public Vfd {
 public:
  // `pass`: lets time pass during an exchange; empty: an exchange takes none.
  explicit TimedVfd(std::function<Seconds()> clock, std::function<void(Seconds)> pass = nullptr)
      : clock_(std::move(clock)), pass_(std::move(pass)), turned_until_(clock_()) {}

  bool can(VfdTask task) const override { return task != VfdTask::run_reverse || has_reverse; }
  std::string fault_text(int number) const override { return number == 3 ? "overcurrent" : ""; }

  Result<double, VfdTrouble> exchange(VfdTask task, double rpm) override {
    if (pass_) pass_(Seconds(is_silent ? 0.3 : 0.02));
    turn();
    if (is_silent) return Failure{VfdTrouble{.kind = VfdTrouble::Kind::silent}};
    if (is_damaged) return Failure{VfdTrouble{.kind = VfdTrouble::Kind::bad_reply, .words = "its checksum is wrong"}};
    if (refuses == task) return Failure{VfdTrouble{.kind = VfdTrouble::Kind::refused, .exception = 2}};
    switch (task) {
      case VfdTask::set_speed: set_rpm = rpm; break;
      case VfdTask::run_forward: direction = 1; break;
      case VfdTask::run_reverse: direction = -1; break;
      case VfdTask::stop: direction = 0; break;
      case VfdTask::reset_fault: fault = 0; break;
      case VfdTask::read_speed: return std::abs(speed);
      case VfdTask::read_current: return 4.5;
      case VfdTask::read_load: return 0.25;
      case VfdTask::read_fault: return fault;
    }
    if (task < VfdTask::read_speed) commands.push_back(task);
    return 0.0;
  }

  // Brings the motor to the present.
  void turn() {
    const Seconds now = clock_();
    const double goal = fault != 0 ? 0 : direction * std::min(set_rpm, top_rpm);
    const double most = rpm_a_second * (now - std::exchange(turned_until_, now)).value();
    speed += std::clamp(goal - speed, -most, most);
    // A drive that is told to run the other way while it turns would brake hard.
    turned_against = turned_against || direction * speed < 0;
  }

  double rpm_a_second = 9000;
  double top_rpm = 24000;
  double set_rpm = 0;
  double speed = 0;
  int direction = 0;
  int fault = 0;
  bool is_silent = false;
  bool is_damaged = false;
  bool has_reverse = true;
  bool turned_against = false;
  std::optional<VfdTask> refuses;
  std::vector<VfdTask> commands;

 private:
  std::function<Seconds()> clock_;
  std::function<void(Seconds)> pass_;
  Seconds turned_until_;
};

}  // namespace passo::test
