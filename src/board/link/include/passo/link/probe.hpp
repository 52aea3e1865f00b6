// ProbeWatch: the event of the probe that a host waits for. ProbeReport: the reported state of the probe.
//
// The board reports every change of the probe with the motors' positions at that event. It also stores the positions of
// the first change since the watch began. The position of a contact is thus known to the step, even if the message
// arrives late or is lost. For homing, a limit switch can act as the probe.
#pragma once

#include <array>
#include <cstdint>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo {

enum class ProbeUntil : std::uint8_t {
  off,       // not watched
  touched,   // until the open probe is triggered
  released,  // until the triggered probe opens
};

struct ProbeReport {
  bool touched = false;   // the probe is triggered, as last reported
  bool happened = false;  // the expected event has happened
  // Steps of each motor from the start of the watch to that event. Valid after recall_contact().
  std::array<std::int32_t, max_motors> steps{};
};

class ProbeWatch {
 public:
  // The meaning of a message for the watch.
  enum class News : std::uint8_t { none, happened, begin_again };

  // `limit`: the bit of a limit switch that acts as the probe, or 0. Returns true if the board must confirm the watch.
  // This includes the end of a watch on a limit switch, which must stop the motors again.
  [[nodiscard]] bool wish(ProbeUntil until, std::uint8_t limit);
  // Returns true if the status shows that the board is stopped with `executed` done, and watches as requested.
  bool is_confirmed_by(const BoardStatus& status, std::uint16_t executed) const;
  void confirm(const BoardStatus& status);

  std::uint8_t limit() const { return limit_; }
  bool watches_several() const { return (limit_ & (limit_ - 1)) != 0; }
  // The bit of BoardInput that is watched.
  std::uint16_t input() const { return limit_ != 0 ? std::uint16_t{limit_} : std::uint16_t{input_probe}; }
  const ProbeReport& report() const { return report_; }

  // Processes a status, or a change that the board reports by itself.
  News handle(const BoardStatus& status);
  News handle(const Captured& captured);
  // Stores the captured positions that the board has sent.
  void recall(const Captured& kept, std::uint8_t motors);

 private:
  ProbeUntil wished_ = ProbeUntil::off;  // not yet confirmed
  ProbeUntil until_ = ProbeUntil::off;
  std::uint8_t limit_ = 0;
  ProbeReport report_;
  bool began_as_wanted_ = false;                 // the probe was already in the final state
  std::array<std::int32_t, max_motors> from_{};  // positions when the watch began
};

}  // namespace passo
