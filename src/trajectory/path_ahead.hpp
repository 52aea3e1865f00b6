// PathAhead: the segments that were pulled and are not played yet, up to the next action or the end. Private to
// trajectory/.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class PathAhead {
 public:
  explicit PathAhead(Source<PathItem>& path) : path_(path) {}

  // The segment so many behind the first, pulled where it has to be; nullptr where an action or the end comes before.
  const Segment* at(std::size_t i) {
    while (segments_.size() <= i && !ended_) pull();
    return i < segments_.size() ? &segments_[i] : nullptr;
  }
  // The first is played.
  void pop() { segments_.pop_front(); }

  // What ends the segments, as far as it was pulled; nothing at the end of the path.
  const Action* action() const { return action_ ? &*action_ : nullptr; }
  // What is behind the last segment, when all are played; nothing at the end of the path.
  std::optional<Action> take_action() {
    if (action_) ended_ = false;
    return std::exchange(action_, std::nullopt);
  }

 private:
  void pull() {
    if (!path_.next(pulled_)) {
      ended_ = true;
    } else if (const auto* action = std::get_if<Action>(&pulled_)) {
      action_ = *action;
      ended_ = true;
    } else if (const auto& segment = std::get<Segment>(pulled_); segment.curve.has_length()) {
      segments_.push_back(segment);
    }
  }

  Source<PathItem>& path_;
  std::deque<Segment> segments_;
  std::optional<Action> action_;
  bool ended_ = false;
  PathItem pulled_;
};

}  // namespace passo
