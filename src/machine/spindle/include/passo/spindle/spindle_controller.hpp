// SpindleController: brings a spindle to the ordered speed through its drive, watches it, and stops it after a fault.
//
// Position: between a HostSpindle, which runs it in a thread, and a Vfd. It has no clock: it is given one, so tests run
// in virtual time.
//
// Invariants: before the first run, and after each fault, the drive is told to stop until it confirms. A spindle that
// turns the other way is stopped first, and runs only when it stands. A speed counts as reached after two readings
// within the tolerance.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "passo/drive/host_spindle.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"
#include "passo/spindle/vfd.hpp"
#include "passo/units/units.hpp"

namespace passo {

class SpindleController {
 public:
  using Clock = std::function<Seconds()>;

  // A drive that is silent for three exchanges, or for this time, is lost.
  static constexpr Seconds longest_silence{1};
  static constexpr int most_silent_exchanges = 3;

  // `vfd` must outlive the controller.
  SpindleController(Vfd& vfd, const SpindleBusDescription& bus, Clock clock);

  void order(const SpindleOrder& wanted);
  // Makes at most one exchange. Returns the time until the next one is due.
  Seconds step();
  // True: clear_fault() would succeed.
  bool can_be_cleared() const;
  // Ends a fault whose cause is gone; the order applies again. Of a drive that still reports a fault, it is reset.
  bool clear_fault();
  // The drive has confirmed that it is stopped.
  bool is_stopped() const { return told_direction_ == SpindleDirection::off; }

  HostSpindleStatus status() const;

 private:
  SpindleOrder wanted() const;
  std::optional<VfdTask> next_task();
  std::optional<VfdTask> next_reading();
  void hear(VfdTask task, double value);
  void hear_speed(double rpm);
  void miss(VfdTask task, const VfdTrouble& trouble);
  void check_speed();
  void fail(Sentence why);
  void begin_order();
  bool reads(VfdTask task) const;

  // What the readings of the spindle's speed say about the order.
  struct Approach {
    Seconds since{0};  // the order was given
    int good = 0;      // successive readings within the tolerance
    bool reached = false;
    std::optional<Seconds> slow_since = {};  // slower than half of the order, after it was reached
  };
  struct Readings {
    double rpm = 0;
    std::optional<double> current = {};
    std::optional<double> load = {};
    int fault_number = 0;
    bool was_reset = false;  // the fault, since it was read
  };
  struct Connection {
    bool answers = false;
    bool may_turn = false;  // it was told to run, and has not confirmed that it is stopped
    int silent = 0;         // successive exchanges without a good reply
    int refused = 0;        // successive commands
    Seconds heard{0};
  };

  Vfd& vfd_;
  SpindleBusDescription bus_;
  Clock clock_;
  SpindleOrder order_;
  std::optional<SpindleDirection> told_direction_;  // confirmed by the drive; empty: unknown
  std::optional<double> told_rpm_;
  SpindleDirection last_direction_ = SpindleDirection::off;  // in which it may still turn
  Approach approach_;
  Readings readings_;
  Connection connection_;
  Sentence fault_;
  bool resets_ = false;
  std::array<bool, vfd_task_count> refuses_{};  // readings that this drive does not have after all
  std::uint32_t turn_ = 0;                      // of the readings
  Seconds next_reading_{0};
};

}  // namespace passo
