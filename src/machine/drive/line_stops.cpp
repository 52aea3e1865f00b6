#include "passo/drive/line_stops.hpp"

#include <utility>

namespace passo {

bool LineStops::next(PathItem& item) {
  if (std::exchange(rewinds_, path_.rewinds()) != path_.rewinds()) {
    waiting_.reset();
    line_.reset();
  }
  if (waiting_) {
    item = *std::exchange(waiting_, std::nullopt);
  } else if (!path_.next(item)) {
    return false;
  } else if (stops_ && ends_before(item)) {
    waiting_ = std::exchange(item, Action{.kind = Action::Kind::feed_hold});
    line_.reset();
    return true;
  }
  record(item);
  return true;
}

// Amid a thread nothing rests, and the program says where it heeds no hold (M53).
bool LineStops::ends_before(const PathItem& item) const {
  const auto line_of = [](const auto& one) { return one.source.line; };
  return line_ && may_rest_ && std::visit(line_of, item) != *line_;
}

void LineStops::record(const PathItem& item) {
  if (const auto* segment = std::get_if<Segment>(&item)) {
    line_ = segment->source.line;
    may_rest_ = segment->heeds.feed_hold && segment->lock != SpindleLock::place;
    return;
  }
  // The program waits there anyway.
  const Action::Kind kind = std::get<Action>(item).kind;
  if (kind == Action::Kind::program_stop || kind == Action::Kind::tool_change) line_.reset();
}

}  // namespace passo
