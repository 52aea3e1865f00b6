// PathAhead: the segments that were pulled and not played yet, up to the next action or the path's end. Private to
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

  // The segment number i from the first, which is 0; pulls it if needed. nullptr if an action or the end comes before
  // it.
  const Segment* at(std::size_t i) {
    while (segments_.size() <= i && !ended_) pull();
    return i < segments_.size() ? &segments_[i] : nullptr;
  }
  // Removes the first segment after it was played.
  void pop() { segments_.pop_front(); }

  // The action that ends the segments, as far as pulled. nullptr at the end of the path.
  const Action* action() const { return action_ ? &*action_ : nullptr; }
  // Takes the action after the last segment, when all segments are played. Nothing at the end of the path.
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
