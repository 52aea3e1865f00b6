// ProbeWatch: what a host watches its board's probe for. ProbeReport: what the host has heard of the probe.
//
// The board tells every change of the probe with the motors' positions at that very event. The board also keeps the
// positions of the first change since the watch began. So the place of a contact is known to the step, however late the
// host hears of it, and whatever was lost on the way. A limit switch may take the probe's place, to home an axis by it.
#pragma once

#include <array>
#include <cstdint>

#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo {

enum class ProbeUntil : std::uint8_t {
  off,       // not watched
  touched,   // until the free probe gets touched
  released,  // until the touched probe gets free
};

struct ProbeReport {
  bool touched = false;   // the probe is touched, as far as the host has heard
  bool happened = false;  // the event that is watched for
  // Steps of each motor from the beginning of the watch to that event. Known after the contact was recalled.
  std::array<std::int32_t, max_motors> steps{};
};

class ProbeWatch {
 public:
  // What a message means for the watch.
  enum class News : std::uint8_t { none, happened, begin_again };

  // `limit`: the bit of a limit switch that takes the probe's place, or 0. True: the board must confirm the wish. That
  // includes the end of a watch on a limit switch, because the switch must be known to stop the motors again.
  [[nodiscard]] bool wish(ProbeUntil until, std::uint8_t limit);
  // True: the status shows that the board rests with `executed` done, and watches what was wished for.
  bool is_confirmed_by(const BoardStatus& status, std::uint16_t executed) const;
  void confirm(const BoardStatus& status);

  std::uint8_t limit() const { return limit_; }
  bool watches_several() const { return (limit_ & (limit_ - 1)) != 0; }
  // The bit of BoardInput that is watched.
  std::uint16_t input() const { return limit_ != 0 ? std::uint16_t{limit_} : std::uint16_t{input_probe}; }
  const ProbeReport& report() const { return report_; }

  // Takes note of a status, or of a change that the board tells by itself.
  News handle(const BoardStatus& status);
  News handle(const Captured& captured);
  // Takes the board's answer to what it has kept.
  void recall(const Captured& kept, std::uint8_t motors);

 private:
  ProbeUntil wished_ = ProbeUntil::off;  // not yet confirmed
  ProbeUntil until_ = ProbeUntil::off;
  std::uint8_t limit_ = 0;
  ProbeReport report_;
  bool began_as_wanted_ = false;                 // the probe was already as it is to become
  std::array<std::int32_t, max_motors> from_{};  // positions when the watch began
};

}  // namespace passo
