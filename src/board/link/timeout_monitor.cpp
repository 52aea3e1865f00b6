#include "passo/link/timeout_monitor.hpp"

#include <algorithm>

#include "passo/link/board_port.hpp"

namespace passo {
namespace {

// A peer that talks, and neither answers nor takes nor executes anything, is given up after this many times the
// patience. No item has so long between two of its events.
constexpr double most_patiences = 2;

}  // namespace

Seconds TimeoutMonitor::until_question(Seconds now) const {
  return std::max(quiet_since_ + care_.answer_within - now, Seconds(0));
}

std::optional<LinkError> TimeoutMonitor::verdict(Seconds now, bool in_vain) const {
  if (!may_lose()) return in_vain ? std::optional(LinkError::no_answer) : std::nullopt;
  if (now - heard_ > care_.patience) return LinkError::no_answer;
  if (now - progressed_ > most_patiences * care_.patience) return LinkError::no_progress;
  return {};
}

bool TimeoutMonitor::is_to_ask_again(Seconds now, bool heard, bool endless) const {
  return !heard && (endless || care_.answer_within - (now - quiet_since_) <= hardly_any);
}

}  // namespace passo
