#include <algorithm>
#include <utility>

#include "passo/link/probe.hpp"

namespace passo {
namespace {

constexpr ProbeUntil until_is(bool touched) {
  return touched ? ProbeUntil::touched : ProbeUntil::released;
}

}  // namespace

bool ProbeWatch::wish(ProbeUntil until, std::uint8_t limit) {
  const bool homed = std::exchange(limit_, limit) != 0;
  wished_ = until;
  until_ = ProbeUntil::off;
  report_ = {};
  return until != ProbeUntil::off || homed;
}

bool ProbeWatch::is_confirmed_by(const BoardStatus& status, std::uint16_t executed) const {
  return status.executed == executed && (status.state & (board_moves | board_kept)) == 0 &&
         ((status.state & board_homes) != 0) == (limit_ != 0);
}

void ProbeWatch::confirm(const BoardStatus& status) {
  report_ = {};
  if (wished_ == ProbeUntil::off) return;
  until_ = wished_;
  report_.touched = (status.inputs & input()) != 0;
  began_as_wanted_ = until_ == until_is(report_.touched);
  std::copy_n(status.positions, from_.size(), from_.begin());
}

// A Captured message may be lost, but every status shows the same. If the probe was at the beginning already as it is
// to become, its first change is away from that. Then the watch begins again.
ProbeWatch::News ProbeWatch::handle(const BoardStatus& status) {
  const bool touched = (status.inputs & input()) != 0;
  const bool came = std::exchange(report_.touched, touched) != touched;
  if (until_ == ProbeUntil::off) return News::none;
  const bool as_wanted = until_ == until_is(touched);
  const bool kept = (status.state & board_kept) != 0;
  if (as_wanted ? came || kept : kept && !began_as_wanted_) {
    report_.happened = true;
    return News::happened;
  }
  if (as_wanted || !began_as_wanted_) return News::none;
  began_as_wanted_ = kept;
  return kept ? News::begin_again : News::none;
}

ProbeWatch::News ProbeWatch::handle(const Captured& captured) {
  if ((captured.input & input()) == 0) return News::none;
  report_.touched = (captured.input & captured_released) == 0;
  if (until_ != until_is(report_.touched)) return News::none;
  report_.happened = true;
  return News::happened;
}

void ProbeWatch::recall(const Captured& kept, std::uint8_t motors) {
  const bool touched = (kept.input & captured_released) == 0;
  report_.happened = (kept.input & input()) != 0 && until_ == until_is(touched);
  if (!report_.happened) return;
  for (std::size_t m = 0; m < motors; ++m) report_.steps[m] = kept.positions[m] - from_[m];
}

}  // namespace passo
