// StreamedRun: sends board segments over the serial line to the real firmware on the emulated chip, and compares every
// edge of its step pins with the host's Player.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "passo/chip/pin_map.hpp"
#include "passo/emulator/emulated_chip.hpp"
#include "passo/emulator/emulated_ports.hpp"
#include "passo/emulator/emulated_timer.hpp"
#include "passo/emulator/emulated_uart.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

struct BoardUnderTest {
  std::string program;
  std::string mcu = "atmega328p";
  std::vector<MotorPins> motors;
  std::string ports = "BCD";
  std::uint32_t baud = 500'000;
};

BoardUnderTest uno_under_test(const std::string& program);
// With a host that drives that many motors.
BoardUnderTest mega_under_test(const std::string& program, std::uint8_t motors);
// With its motors driven so.
BoardUnderTest uno_windings_under_test(const std::string& program, const std::vector<DriveMode>& drives);
BoardUnderTest mega_windings_under_test(const std::string& program, const std::vector<DriveMode>& drives);

struct EdgeCheck {
  std::uint64_t steps = 0;            // edges seen
  std::uint64_t expected = 0;         // of the model
  std::uint64_t wrong_count = 0;      // motors with another number of edges
  std::uint64_t wrong_direction = 0;  // edges; of windings, patterns out of order, and changes of other pins
  std::int64_t error = 0;             // the worst motor's edges against the model, peak to peak, in cycles
  std::int64_t apart = 0;             // the first motor's edge of an event, and the last one's: always in this order
  std::int64_t apart_in_motor = 0;    // the windings of one motor that lie on two ports
  std::uint64_t shortest_pulse = 0;
  std::uint64_t longest_pulse = 0;
  std::uint64_t shortest_setup = 0;  // from a direction's change to that motor's next step
  std::uint64_t shortest_hold = 0;   // from a motor's step to its direction's change
  std::uint64_t overruns = 0;        // bytes lost in the UART
  std::uint64_t unwatched = 0;       // the longest time between two looks at it, since the board started
  std::uint64_t complaints = 0;      // frames that the board did not take
  bool finished = false;
  double seconds = 0;  // of the chip's time, playing
  std::uint64_t events = 0;

  bool exact() const { return finished && wrong_count == 0 && wrong_direction == 0 && steps == expected; }
};

struct SeenStep {
  std::int64_t time = 0;
  bool down = false;
};
using SeenSteps = std::vector<SeenStep>;  // of one motor

// What the host's Player makes of the segments, for each motor, in ticks from the start. Adds the events to `events`.
std::vector<SeenSteps> edges_of_model(const std::vector<BoardSegment>& segments, std::uint8_t motors,
                                      std::uint64_t& events);

class BoardBench {
 public:
  explicit BoardBench(const BoardUnderTest& board);

  // The next host drives the first `count` motors only.
  void drive_motors(std::size_t count) { board_.motors.resize(count); }

  // The function is called before each item that play() sends, with the item's frame. Then the board's complaints about
  // bytes that are no frame do not count.
  std::function<void(std::span<const std::uint8_t>)> before_item;

  // Plays the items from rest to rest.
  EdgeCheck play(const std::vector<BoardSegment>& segments);

  // Says hello and sends all items, which begin when all have come: one less than the board takes at once.
  using Item = std::variant<BoardSegment, BoardOutputs>;
  void start_items(const std::vector<Item>& items);
  // Says hello and sends as many items as the board takes at once. `limit`: the bit of a limit switch that is to
  // capture.
  void start(const std::vector<BoardSegment>& segments, std::uint8_t limit = 0);
  // The steps that came out of the pins since the changes were forgotten, of each motor.
  std::vector<SeenSteps> seen();
  // Finds where the motors stand in their winding tables after motion that play() did not play.
  void follow_windings();
  void name_session(const Session& session);
  void set_up(const PinSetup& setup);
  // Lets time pass, whatever the board says.
  void run(std::uint64_t cycles);
  // Asks the board for its status or something else. The answer comes while the board runs.
  void ask(const Ask& question = {});
  // The function is called when the board has told where its spindle is.
  std::function<void(const Turned&)> on_turned;
  // Of the last frame that went to the board.
  std::uint8_t last_byte() const { return last_byte_; }
  const std::optional<BoardStatus>& status() const { return status_; }
  const std::optional<PinSetup>& pin_setup() const { return pin_setup_; }
  const std::optional<ErrorReport>& error() const { return error_; }
  const std::optional<Fault>& fault() const { return fault_; }
  const std::optional<Captured>& captured() const { return captured_; }

  EmulatedChip& chip() { return *chip_; }
  EmulatedPorts& ports() { return *ports_; }
  const EmulatedPorts& ports() const { return *ports_; }
  EmulatedUart& uart() { return *uart_; }
  const EmulatedTimer& timer() const { return *timer_; }
  std::uint64_t cycles() const { return chip_->cycles(); }

 private:
  void hear(std::uint8_t byte);
  bool send_hello();
  void put_on_line(std::span<const std::uint8_t> frame);
  // After all that was executed, or just after a hello.
  void send_replace(std::span<const Item> items);
  void send_item(const BoardSegment& segment);
  void send_item(const BoardOutputs& outputs);
  void see_steps(std::vector<SeenSteps>& seen, EdgeCheck& result) const;
  void see_windings(std::vector<SeenSteps>& seen, EdgeCheck& result);
  EdgeCheck check(const std::vector<BoardSegment>& segments);

  BoardUnderTest board_;
  std::unique_ptr<EmulatedChip> chip_;
  std::unique_ptr<EmulatedTimer> timer_;
  std::unique_ptr<EmulatedUart> uart_;
  std::unique_ptr<EmulatedPorts> ports_;
  Decoder decoder_;
  bool greeted_ = false;
  std::uint8_t capacity_ = 0;
  std::uint8_t last_byte_ = 0;
  std::uint8_t last_sent_ = 0;
  std::uint8_t last_executed_ = 0;
  std::uint64_t complaints_ = 0;
  std::vector<int> places_;  // of motors whose windings the board switches, in their tables
  std::optional<Fault> fault_;
  std::optional<Captured> captured_;
  std::optional<BoardStatus> status_;
  std::optional<ErrorReport> error_;
  std::optional<PinSetup> pin_setup_;
};

// What a random stream of segments is made of.
struct StreamKind {
  std::uint32_t shortest_interval = 100;  // ticks
  std::uint32_t longest_interval = 100;
  std::uint8_t shortest_segment = 20;  // events
  std::uint8_t longest_segment = 255;
  int segments = 100;
  std::uint8_t part = 0;  // segments have parts of 2^part events, with bends and roots. 0: one part
  int ramp = 0;           // the first ones speed up from a fifth of the rate: nothing moves at its highest rate at once
  bool all_at_every_event = false;  // else one motor steps at every event, the others as it comes
  bool reversing = true;            // directions change from segment to segment
};
std::vector<BoardSegment> random_stream(std::mt19937_64& random, std::uint8_t motors, const StreamKind& kind);

}  // namespace passo
