// Handshake: the start of a session between host and board. The host sends the pin set-up, then the hello, then the
// session's number, and waits for the answer to each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/link/link.hpp"
#include "passo/link/twin_motors.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// The parameters of a handshake.
struct Greeting {
  std::uint8_t motors = 0;
  std::uint16_t session = 0;          // identifies the session; 0: none, for a link that loses nothing
  std::uint8_t number = 0;            // the number from which items are counted
  Silence silence = {};               // the silence after which the board switches its outputs off
  std::vector<MotorPair> pairs = {};  // motors that move one axis together; the host plans only the first of each pair
  PinSetup setup = {};                // the pin set-up, all of which the board must support
};

class Handshake {
 public:
  enum class Phase : std::uint8_t { before_hello, greeting, naming, ready };

  void begin(const Greeting& greeting);
  // Returns to the state before the handshake.
  void hang_up();
  // Changes the session's number.
  void rename(std::uint16_t session);

  Phase phase() const { return phase_; }
  bool before_hello() const { return phase_ == Phase::before_hello; }
  // Returns true if an answer of the board is due.
  bool is_under_way() const { return phase_ == Phase::greeting || phase_ == Phase::naming; }
  const Greeting& wanted() const { return wanted_; }
  std::uint8_t motors() const { return wanted_.motors; }
  std::uint16_t session() const { return wanted_.session; }
  // The number of motor positions to request: before the handshake all that are possible.
  std::uint8_t positions() const { return before_hello() ? std::uint8_t{max_motors} : motors(); }

  // Stores the time of the last message of the handshake.
  void record_hello(Seconds now) { said_ = now; }
  Seconds said() const { return said_; }

  // Processes the answer to the pin set-up. Error: the board does not support it, or cannot make the timing.
  std::optional<LinkError> handle(const PinSetup& setup);
  // Returns true if the board has the requested pin set-up, or none was requested.
  bool is_set_up() const;
  const PinSetup& set_up() const { return set_up_; }
  PinSetup undone_setup() const;

  // Processes the answer to the hello.
  void handle(const HelloReply& reply);
  const std::optional<HelloReply>& reply() const { return reply_; }
  // Continues if the answer to the hello has arrived. Error: the board does not suit the machine.
  std::optional<LinkError> go_on();
  // Continues if the board has the session's number.
  void handle(const BoardStatus& status);

 private:
  Greeting wanted_;
  PinSetup set_up_;  // as confirmed by the board
  Phase phase_ = Phase::before_hello;
  std::optional<HelloReply> reply_;
  Seconds said_{0};
};

// Whether all times are long enough, and the event rate is high enough.
bool suffices(const StepTiming& given, const StepTiming& needed);
// The insufficient timing of a board, as the object of a sentence. `clock`: the board's timer frequency, Hz.
std::string words_of_timing(const StepTiming& given, const StepTiming& needed, double clock);
// The pins of a setup, as words: "door, limit 4". Limits are counted from 1.
std::string words_of_setup(const PinSetup& setup);

}  // namespace passo
