// VirtualMachine: the board's own program, with counters in the place of motors and virtual time in the place of a
// timer.
//
// Place on the street: the end. Time is counted in ticks and passes only while the board plays; at rest it stands
// still. It counts what it commands, and drives a plant: pulses and the spindle's command go there, and its input pins
// are what the plant says. A limit switch stops it as it stops a board. The same bytes give the same counts at any
// speed. Who wants to see each step adds an observer. Cost: about 6 ns an event of a three-axis machine; observers and
// an ideal plant whose inputs do not change cost an event nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "passo/firmware/board.hpp"
#include "passo/link/board_port.hpp"
#include "passo/machine/machine_counts.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/plant/plant.hpp"
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

  // At the start. The plant outlives the machine's last run(). Until then the machine has an ideal one of its own, with
  // nothing but motors and a spindle.
  void connect(Plant& plant);
  // Closes switches of the plant, or opens them, and heeds that at once: bits of BoardInput, not the probe's. What
  // somebody else does to the plant the machine sees in its next run().
  void set_switch(std::uint16_t which, bool closed);
  // As its reset button: the board forgets all, the motors stop where they are, and the outputs are off.
  void reset_board();

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

  // At the start: its counters go on from these positions, which moves nothing. The board's own begin at 0, as after a
  // reset.
  void stand_at(const MotorSteps& positions);

  Ticks now() const { return Ticks{hardware_.now}; }
  MachineCounts counts() const;

 private:
  // What hangs on the board: counters, observers, the plant, and the line to the host.
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
    void make_safe();
    void send(std::uint8_t byte) { to_host.push_back(byte); }
    bool has_encoder() const { return plant->spindle().has_encoder(); }
    SpindleCount spindle() const;
    // What it has not been told yet.
    void pulse_plant();
    Seconds time() const { return Seconds(static_cast<double>(now) * seconds_a_tick); }

    std::int64_t now = 0;
    std::array<Motor, max_motors> motors;
    std::uint8_t last_directions = 0;  // of each motor's last step
    BoardOutputs outputs_now;
    std::int64_t output_changes = 0;
    double seconds_a_tick = 0;
    std::vector<MachineObserver*> observers;
    Plant* plant = nullptr;
    MotorSteps pulsed{};  // the positions up to which the plant has been told
    std::vector<std::uint8_t> to_host;
  };

  void look_at_plant();
  void look_at_inputs();
  void heed(unsigned inputs);
  void stop_at_once(FaultReason reason);

  IdealPlant own_plant_;
  Hardware hardware_;
  BoardIdentity identity_;
  Board<Hardware, items_held> board_;
  Hertz clock_;
  std::uint8_t motor_count_;
  std::int64_t look_in_ = Plant::never;  // events
  std::uint16_t told_ = 0;               // to the board
  std::int64_t next_event_ = 0;
  bool waits_ = false;  // for the next event, which is due then
  std::int64_t events_ = 0;
  std::int64_t shortest_event_interval_ = INT64_MAX;
  std::vector<std::uint8_t> taken_;  // what replies() gave away
};

}  // namespace passo
