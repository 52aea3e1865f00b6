// PathAhead: the segments that were pulled and not executed yet, up to the next action or the path's end. Private to
// trajectory/.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "passo/base/source.hpp"
#include "passo/base/window.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// Segments have numbers, counted from the beginning of the program.
class PathAhead {
 public:
  explicit PathAhead(Source<PathItem>& path) : path_(path) {}

  // The number of the first segment.
  std::uint64_t first() const { return segments_.first(); }
  // Returns the segment, and pulls it if needed. It keeps its address until it is popped. nullptr if an action or the
  // end comes before it.
  const Segment* at(std::uint64_t number) {
    while (segments_.end() <= number && !ended_) pull();
    return number < segments_.end() ? std::get_if<Segment>(segments_[number].get()) : nullptr;
  }
  const Segment* front() { return at(first()); }
  // Returns the segment after that one. nullptr if the path stops before it.
  const Segment* after(std::uint64_t number);
  // Removes the first segment after its execution.
  void pop() { segments_.drop_front(); }

  // The action after the segments, as far as pulled. nullptr at the end of the path.
  const Action* action() const { return action_ ? &*action_ : nullptr; }
  // Removes and returns the action after the last segment, when all segments are executed. Nothing at the end of the
  // path.
  std::optional<Action> take_action() {
    if (action_) ended_ = false;
    return std::exchange(action_, std::nullopt);
  }

  // Drops an await_line after the last segment, which then ends in its mode `last`. Returns false if there is none, or
  // no segment is left before it.
  bool go_on(PathMode last) {
    if (!action_ || action_->kind != Action::Kind::await_line || segments_.first() == segments_.end()) return false;
    std::get<Segment>(*segments_[segments_.end() - 1]).mode = last;
    action_.reset();
    ended_ = false;
    return true;
  }

  void drop_to_action() {
    while (front() != nullptr) pop();
  }
  // Drops everything that was pulled.
  void restart() {
    segments_.clear();
    action_.reset();
    ended_ = false;
  }

 private:
  void pull();

  Source<PathItem>& path_;
  Window<std::unique_ptr<PathItem>> segments_;  // each item is a segment
  std::optional<Action> action_;
  bool ended_ = false;
};

}  // namespace passo
