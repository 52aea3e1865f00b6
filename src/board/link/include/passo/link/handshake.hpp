// Handshake: how a host and its board begin. The host says what is connected to the board's pins, then hello, then the
// session's number, and goes on when the board has answered each of them and suits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/link/link.hpp"
#include "passo/link/twin_motors.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// How a host begins with a board.
struct Greeting {
  std::uint8_t motors = 0;
  std::uint16_t session = 0;          // identifies the session to the board; 0: none, for a line that loses nothing
  std::uint8_t number = 0;            // the hello's number: where the counting of items begins
  Silence silence = {};               // goes with the session: after what silence the board switches its outputs off
  std::vector<MotorPair> pairs = {};  // motors that turn an axis together; the host plans those before them only
  PinSetup setup = {};                // what is connected to the board's pins; the board must be able to do all of it
};

class Handshake {
 public:
  enum class Phase : std::uint8_t { before_hello, greeting, naming, ready };

  void begin(const Greeting& greeting);
  // Back to the state before the hello.
  void hang_up();
  // The board is to hear another number.
  void rename(std::uint16_t session);

  Phase phase() const { return phase_; }
  bool before_hello() const { return phase_ == Phase::before_hello; }
  // True: the board has to answer the setup, the hello or the number.
  bool is_under_way() const { return phase_ == Phase::greeting || phase_ == Phase::naming; }
  const Greeting& wanted() const { return wanted_; }
  std::uint8_t motors() const { return wanted_.motors; }
  std::uint16_t session() const { return wanted_.session; }
  // How many motors' positions the board is asked for: all that there may be, before it knows how many there are.
  std::uint8_t positions() const { return before_hello() ? std::uint8_t{max_motors} : motors(); }

  // When the setup, the hello or the number was said last.
  void record_hello(Seconds now) { said_ = now; }
  Seconds said() const { return said_; }

  // The board's answer to the setup. Error: the board cannot do all of it, or cannot make the times.
  std::optional<LinkError> handle(const PinSetup& setup);
  // True: the board has the setup that was asked for, or none was.
  bool is_set_up() const;
  const PinSetup& set_up() const { return set_up_; }
  PinSetup undone_setup() const;

  // The board's answer to the hello.
  void handle(const HelloReply& reply);
  const std::optional<HelloReply>& reply() const { return reply_; }
  // Goes on if the answer to the hello has come. Error: the board does not suit.
  std::optional<LinkError> go_on();
  // Goes on if the board knows the session's number.
  void handle(const BoardStatus& status);

 private:
  Greeting wanted_;
  PinSetup set_up_;  // as the board has answered
  Phase phase_ = Phase::before_hello;
  std::optional<HelloReply> reply_;
  Seconds said_{0};
};

// Whether all times are as long as needed, and events as close.
bool suffices(const StepTiming& given, const StepTiming& needed);
// What a board makes that does not suffice, as the object of a sentence. `clock`: its ticks a second.
std::string words_of_timing(const StepTiming& given, const StepTiming& needed, double clock);
// The pins of a setup, as words: "door, limit 4". Limits are counted from 1.
std::string words_of_setup(const PinSetup& setup);

}  // namespace passo
