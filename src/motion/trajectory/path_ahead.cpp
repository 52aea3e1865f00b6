#include "path_ahead.hpp"

#include "rest.hpp"

namespace passo {

const Segment* PathAhead::after(std::uint64_t number) {
  const Segment* const before = at(number);
  const Segment* const next = at(number + 1);
  return next != nullptr && !rests_between(*before, *next) ? next : nullptr;
}

// Writes the item where a segment is to stay, so that no segment is copied.
void PathAhead::pull() {
  std::unique_ptr<PathItem>& place = segments_.append();
  if (place == nullptr) place = std::make_unique<PathItem>();
  ended_ = !path_.next(*place);
  if (const auto* action = std::get_if<Action>(place.get()); action != nullptr && !ended_) {
    action_ = *action;
    ended_ = true;
  }
  if (ended_ || !std::get<Segment>(*place).curve.has_length()) segments_.drop_back();
}

}  // namespace passo
