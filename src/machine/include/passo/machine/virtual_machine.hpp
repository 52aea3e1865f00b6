// VirtualMachine: the board's own program, with counters in the place of motors and virtual time in the place of a
// timer.
//
// Place on the street: the end. Time is counted in ticks and passes only while the board plays; at rest it stands
// still. Its probe is touched while the motors' counts are in one of the bodies that stand on it; limit switches are
// closed by its axes, and stop it as they stop a board. The same bytes give the same counts at any speed. Who wants to
// see each step adds an observer. Cost: about 6 ns an event of a three-axis machine; without observers there is nothing
// to pay for them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "passo/firmware/board.hpp"
#include "passo/link/board_port.hpp"
#include "passo/machine/machine_counts.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/machine/touch_body.hpp"
#include "passo/machine/travel_switch.hpp"
#include "passo/machine/virtual_spindle.hpp"
#include "passo/units/units.hpp"

namespace passo {

class VirtualMachine final : public BoardPort {
 public:
  // As a board with some kilobytes of memory.
  static constexpr std::size_t items_held = 240;

  // `clock`: the board's timer, a whole number of hertz below 2^32. Segments faster than the highest event rate it
  // refuses; 0: none. `places`: for items, items_held at most.
  VirtualMachine(std::uint8_t motors, Hertz clock, Hertz highest_event_rate = Hertz(0),
                 std::size_t places = items_held);
  VirtualMachine(const VirtualMachine&) = delete;
  VirtualMachine& operator=(const VirtualMachine&) = delete;

  // The observer outlives the machine's last run().
  void add_observer(MachineObserver& observer) { hardware_.observers.push_back(&observer); }

  void add_body(const TouchBody& body);
  void add_switch(const TravelSwitch& added);
  // Closes a switch of the board, or opens it: bits of BoardInput, not the probe's.
  void set_switch(std::uint16_t which, bool closed);

  void receive(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool run(Seconds most) override;
  // The same, until that time; the end of all times is infinity.
  [[nodiscard]] bool run_to(Ticks time);
  std::span<const std::uint8_t> replies() override;
  Seconds elapsed() const override { return Seconds(static_cast<double>(hardware_.now) / clock_.value()); }

  // Lets time pass at rest; only while the board has nothing to play.
  void wait(Ticks time);
  // The board's program; what its pins say, and what happens to it.
  auto& board() { return board_; }

  // At the start. Without it the spindle does as commanded, and has no encoder.
  void fit_spindle(const SpindleModel& model) { hardware_.turning = VirtualSpindle(model); }
  // At the start: its counters go on from these positions. The board's own begin at 0, as after a reset.
  void stand_at(const std::array<std::int64_t, max_motors>& positions);
  // As it turns; what its encoder has counted of that the board tells.
  const VirtualSpindle& spindle() const { return hardware_.turning; }

  Ticks now() const { return Ticks{hardware_.now}; }
  MachineCounts counts() const;

 private:
  // What hangs on the board: counters, observers, and the line to the host.
  struct Hardware {
    struct Motor {
      std::int64_t total = 0;
      std::int64_t position = 0;
      std::int64_t reversals = 0;
      std::int64_t last_step = 0;
      std::int64_t shortest_interval = INT64_MAX;
    };

    void step(std::uint8_t stepped, std::uint8_t directions);
    void outputs(const BoardOutputs& wanted);
    void send(std::uint8_t byte) { to_host.push_back(byte); }
    bool has_encoder() const { return turning.has_encoder(); }
    SpindleCount spindle() const;
    bool is_in_a_body() const;

    std::int64_t now = 0;
    std::array<Motor, max_motors> motors;
    std::uint8_t last_directions = 0;  // of each motor's last step
    BoardOutputs outputs_now;
    std::int64_t output_changes = 0;
    double seconds_a_tick = 0;
    VirtualSpindle turning;
    std::vector<MachineObserver*> observers;
    std::vector<TouchBody> bodies;
    std::vector<TravelSwitch> limits;
    std::vector<std::uint8_t> to_host;
  };

  void look_at_switches();

  Hardware hardware_;
  Board<Hardware, items_held> board_;
  Hertz clock_;
  std::uint8_t motor_count_;
  std::uint16_t switches_ = 0;       // closed by hand
  std::vector<bool> limits_closed_;  // of hardware_.limits
  std::uint16_t told_ = 0;           // to the board
  std::int64_t next_event_ = 0;
  bool waits_ = false;  // for the next event, which is due then
  std::int64_t events_ = 0;
  std::int64_t shortest_event_interval_ = INT64_MAX;
  std::vector<std::uint8_t> taken_;  // what replies() gave away
};

}  // namespace passo
