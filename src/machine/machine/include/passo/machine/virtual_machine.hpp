// VirtualMachine: the simulated machine: the board's own program, with counters instead of motors and simulated time
// instead of a timer.
//
// Position in the pipeline: the end. Time is counted in ticks, and passes only while the board executes motion. The
// machine counts the steps that it commands, and drives a plant: pulses and the spindle's command go to the plant, and
// the plant sets the input pins. A limit switch stops the simulated machine like a real board. The same bytes give the
// same counts at any simulation speed. An observer gets each step. Cost: about 6 ns per event with three axes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "passo/firmware/board.hpp"
#include "passo/link/board_port.hpp"
#include "passo/machine/machine_counts.hpp"
#include "passo/machine/machine_observer.hpp"
#include "passo/plant/ideal_plant.hpp"
#include "passo/plant/plant.hpp"
#include "passo/units/units.hpp"
#include "passo/wire/handwheel_count.hpp"

namespace passo {

class VirtualMachine final : public BoardPort {
 public:
  // The queue length of a board with a few kilobytes of memory.
  static constexpr std::size_t items_held = 240;

  // `clock`: the board's timer frequency, a whole number of hertz below 2^32. The board rejects segments faster than
  // `highest_event_rate`; 0: no limit. `places`: the length of the queue, at most items_held.
  VirtualMachine(std::uint8_t motors, Hertz clock, Hertz highest_event_rate = Hertz(0),
                 std::size_t places = items_held);
  VirtualMachine(const VirtualMachine&) = delete;
  VirtualMachine& operator=(const VirtualMachine&) = delete;

  // The observer must live until the last run().
  void add_observer(MachineObserver& observer) { hardware_.observers.push_back(&observer); }

  // Connects a plant, at the start. The plant must live until the last run(). Before connect(), the machine has an
  // ideal plant with only motors and a spindle.
  void connect(Plant& plant);
  // Closes or opens switches of the plant immediately. `which`: bits of BoardInput, except the probe's. Other changes
  // of the plant take effect in the next run().
  void set_switch(std::uint16_t which, bool closed);
  // Sets how the plant's switches and drivers are connected to the board's pins, at the start. The pin set-up of the
  // host must match it.
  void wire(const PinSetup& wiring);
  // Connects a handwheel to the board's pins, at the start. Who changes its count turns it.
  HandwheelCount& fit_handwheel() { return hardware_.wheel.emplace(); }
  // Simulates a board that cannot make its events in time: delays the next event and all later ones. Call it during
  // motion.
  void stand_still(Ticks time);
  // Simulates the reset button: the board loses its state, the motors stop instantly, and the outputs are switched off.
  void reset_board();

  void receive(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool run(Seconds most) override;
  // Like run(), but until `time`. The largest time means infinity.
  [[nodiscard]] bool run_to(Ticks time);
  std::span<const std::uint8_t> replies() override;
  Seconds elapsed() const override { return Seconds(static_cast<double>(hardware_.now) / clock_.value()); }

  // Lets time pass. Call it only while the board's queue is empty.
  void wait(Ticks time);
  // The board's program, for tests.
  auto& board() { return board_; }

  // Sets the initial positions of the machine's counters, at the start. Nothing moves. The board's own counters start
  // at 0, as after a reset.
  void stand_at(const MotorSteps& positions);

  // Returns false if the motors have no holding torque.
  bool drivers_on() const { return hardware_.drivers_on == hardware_.drivers_obey(); }

  Ticks now() const { return Ticks{hardware_.now}; }
  MachineCounts counts() const;

 private:
  // The connections of the board: counters, observers, the plant, and the link to the host.
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
    // Step pulses have the requested length, and do not limit the event rate.
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
    bool has_handwheel() const { return wheel.has_value(); }
    HandwheelCount handwheel() const { return *wheel; }
    // Passes the pending pulses to the plant.
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
    std::optional<HandwheelCount> wheel;
    PinSetup setup;   // the pin set-up of the host
    PinSetup wiring;  // the actual connections
    bool drivers_on = true;
    bool is_new_setup = false;
    // Whether the active level of the enable output is the same in both.
    bool drivers_obey() const { return ((setup.outputs ^ wiring.outputs) & inverted_enable) == 0; }
    MotorSteps pulsed{};  // the positions passed to the plant so far
    std::vector<std::uint8_t> to_host;
  };

  // Updates the board's measurement of the host's silence.
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
  std::int64_t look_in_ = Plant::never;  // the number of events until the plant's inputs must be read
  std::uint16_t told_ = 0;               // the inputs last passed to the board
  std::int64_t tenth_;                   // ticks in a tenth of a second
  std::int64_t next_tenth_;
  std::int64_t next_event_ = 0;
  bool waits_ = false;  // for the next event, due at next_event_
  std::int64_t events_ = 0;
  std::int64_t shortest_event_interval_ = INT64_MAX;
  std::vector<std::uint8_t> taken_;  // bytes returned by replies()
};

}  // namespace passo
