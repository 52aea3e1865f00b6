// PhaseCurrents: the currents of the phases of all motors of a winding record, over time. Private to report/.
//
// Where the motor and its stage are known, the currents rise and fall (WindingCurrent, one for each output); else they
// are at once what the pattern says. They begin at position 0, at rest.
#pragma once

#include <vector>

#include "passo/motor/winding_current.hpp"
#include "passo/report/winding_record.hpp"

namespace passo {

class PhaseCurrents {
 public:
  struct Phases {
    double a = 0;  // fraction of the rated current, −1 … 1
    double b = 0;
    friend bool operator==(const Phases&, const Phases&) = default;
  };

  explicit PhaseCurrents(const WindingMotors& motors);

  Phases of(std::size_t motor) const;
  // The motor is at another position; its transistors switch.
  void move_to(std::size_t motor, std::int64_t place);
  // Lets time pass from now() to `until`. As long as currents change, it calls `show` some times before the end.
  template <class Show>
  void play(Seconds until, const Show& show) {
    while (!are_settled() && now_ + apart_ < until) {
      run(apart_);
      show();
    }
    run(until - now_);
  }
  // Lets time pass until the currents have settled.
  template <class Show>
  void play_out(const Show& show) {
    while (!are_settled()) {
      run(apart_);
      show();
    }
  }
  Seconds now() const { return now_; }

 private:
  struct Motor {
    std::int64_t place = 0;
    std::vector<WindingCurrent> windings = {};  // F1 to F4
  };

  bool are_settled() const;
  void run(Seconds time);
  void switch_windings(Motor& motor) const;

  Excitation excitation_;
  double rated_ = 1;
  Seconds now_{0};
  Seconds apart_{1};
  std::vector<Motor> motors_;
};

}  // namespace passo
