#include "path_ahead.hpp"

namespace passo {

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
