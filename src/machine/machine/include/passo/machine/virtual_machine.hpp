// VirtualMachine: the board's own program, with counters instead of motors and virtual time instead of a timer.
//
// Place on the street: the end. Time is counted in ticks, passes only while the board plays, and stands still at rest.
// The machine counts the steps that it commands, and drives a plant: pulses and the spindle's command go to the plant,
// and the plant sets the input pins. A limit switch stops the machine as it stops a board. The same bytes give the same
// counts at any speed. An observer sees each step. Cost: about 6 ns an event on a machine with three axes. Without
// observers, and with an ideal plant whose inputs do not change, an event costs nothing more.
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
  // As many as on a board with some kilobytes of memory.
  static constexpr std::size_t items_held = 240;

  // `clock`: the rate of the board's timer, a whole number of hertz below 2^32. The board refuses segments faster than
  // `highest_event_rate`; 0: it refuses none. `places`: places for items, at most items_held.
  VirtualMachine(std::uint8_t motors, Hertz clock, Hertz highest_event_rate = Hertz(0),
                 std::size_t places = items_held);
  VirtualMachine(const VirtualMachine&) = delete;
  VirtualMachine& operator=(const VirtualMachine&) = delete;

  // The observer outlives the machine's last run().
  void add_observer(MachineObserver& observer) { hardware_.observers.push_back(&observer); }

  // Connects a plant, at the start. The plant outlives the machine's last run(). Before connect() the machine has its
  // own ideal plant, with nothing but motors and a spindle.
  void connect(Plant& plant);
  // Closes or opens switches of the plant, and heeds the change at once. `which`: bits of BoardInput, except the
  // probe's. If somebody else changes the plant, the machine sees the change in its next run().
  void set_switch(std::uint16_t which, bool closed);
  // Says how the plant's switches and drivers are connected to the board's pins, at the start. A host that says nothing
  // of it then finds closed switches open.
  void wire(const PinSetup& wiring);
  // As a board that cannot make its events in time: the next event, and all after it, come so much later. In motion.
  void stand_still(Ticks time);
  // As its reset button: the board forgets all, the motors stop where they are, and the outputs are off.
  void reset_board();

  void receive(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool run(Seconds most) override;
  // The same as run(), but until `time`. The greatest time stands for infinity.
  [[nodiscard]] bool run_to(Ticks time);
  std::span<const std::uint8_t> replies() override;
  Seconds elapsed() const override { return Seconds(static_cast<double>(hardware_.now) / clock_.value()); }

  // Lets time pass at rest. Call only while the board has nothing to play.
  void wait(Ticks time);
  // The board's program, for tests that set its pins or make things happen to it.
  auto& board() { return board_; }

  // Sets, at the start, the positions from which the machine's counters go on. Nothing moves. The board's own counters
  // begin at 0, as after a reset.
  void stand_at(const MotorSteps& positions);

  // False: the motors hold nothing.
  bool drivers_on() const { return hardware_.drivers_on == hardware_.drivers_obey(); }

  Ticks now() const { return Ticks{hardware_.now}; }
  MachineCounts counts() const;

 private:
  // What is connected to the board: counters, observers, the plant, and the line to the host.
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
    void switch_off();
    bool switch_off(std::uint8_t switches);
    void send(std::uint8_t byte) { to_host.push_back(byte); }
    void enable() { drivers_on = true; }
    void release() { drivers_on = false; }
    // Its pulses are as long as wanted, and cost no events.
    PinSetup set_up(const PinSetup& wanted) {
      is_new_setup = true;
      setup = wanted;
      setup.timing.event_ticks = 0;
      return setup;
    }
    std::uint8_t drivers_rest() const { return setup.drivers_rest; }
    std::uint16_t alarms() const { return setup.alarms; }
    static bool can_watch(std::uint8_t /*limits*/) { return true; }
    bool has_encoder() const { return plant->spindle().has_encoder(); }
    SpindleCount spindle() const;
    // Gives the plant the pulses that it has not been told yet.
    void pulse_plant();
    Seconds time() const { return Seconds(static_cast<double>(now) * seconds_a_tick); }

    std::int64_t now = 0;
    std::array<Motor, max_motors> motors;
    std::uint8_t last_directions = 0;  // the direction of each motor's last step
    BoardOutputs outputs_now;
    std::int64_t output_changes = 0;
    double seconds_a_tick = 0;
    std::vector<MachineObserver*> observers;
    Plant* plant = nullptr;
    PinSetup setup;   // what the host has said of the pins
    PinSetup wiring;  // what is true of them
    bool drivers_on = true;
    bool is_new_setup = false;
    // Whether the drivers take the board's enable for what it is meant.
    bool drivers_obey() const { return ((setup.outputs ^ wiring.outputs) & inverted_enable) == 0; }
    MotorSteps pulsed{};  // the positions up to which the plant has been told
    std::vector<std::uint8_t> to_host;
  };

  // Lets the board count its host's silence up to now.
  void count_silence();
  void update_inputs();
  void check_inputs();
  void on_inputs(unsigned inputs);

  IdealPlant own_plant_;
  Hardware hardware_;
  BoardIdentity identity_;
  Board<Hardware, items_held> board_;
  Hertz clock_;
  std::uint8_t motor_count_;
  std::int64_t look_in_ = Plant::never;  // the number of events until the plant must be asked for its inputs
  std::uint16_t told_ = 0;               // the inputs last told to the board
  std::int64_t tenth_;                   // ticks in a tenth of a second
  std::int64_t next_tenth_;
  std::int64_t next_event_ = 0;
  bool waits_ = false;  // for the next event, due at next_event_
  std::int64_t events_ = 0;
  std::int64_t shortest_event_interval_ = INT64_MAX;
  std::vector<std::uint8_t> taken_;  // what replies() has returned
};

}  // namespace passo
