#include "jerk_planner.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace passo {
namespace {

// Seconds between two places from which braking is tried.
constexpr double between_trials = 0.003;

// A share of the longest time of a move. A smaller part is not cut off.
constexpr double smallest_part = 0.02;

// A share of the time to rest. Another change must be sooner by this factor to be worth it.
constexpr double worth = 0.98;

// Shares of the wanted speed. From each of them a plan that goes on is tried.
constexpr std::array<double, 6> tried_speeds = {1, 0.9, 0.75, 0.55, 0.35, 0.15};

// A plan that goes on must see this many times the braking way.
constexpr double sight = 1.5;

}  // namespace

JerkPlanner::JerkPlanner(Source<PathItem>& path, const MotionLimits& limits, std::size_t most_queued)
    : axes_(axes_with_limits(limits)),
      path_(path),
      most_queued_(most_queued),
      window_(std::make_unique<JerkWindow>(axes_, path_, most_queued)) {
  window_->begin_at({}, wishes_.feeds);
}

void JerkPlanner::wish(const MidRunWishes& wishes) {
  unsuited_ = unsuited_ || wishes.feeds != wishes_.feeds;
  wishes_ = wishes;
  fastest_ = {.override = std::max(fastest_.override, wishes.feeds.override),
              .adaptive = std::max(fastest_.adaptive, wishes.feeds.adaptive),
              .spindle = std::max(fastest_.spindle, wishes.feeds.spindle),
              .top = std::max(fastest_.top, wishes.feeds.top)};
  window_->set_feeds(wishes.feeds);
}

void JerkPlanner::drop_to_action() {
  while (path_.at(0) != nullptr) path_.pop();
  rest_.reset();
  change_.reset();
  now_ = {};
  window_->begin_at({}, wishes_.feeds);
}

// Whether the wishes keep the motion from going on from its present place.
bool JerkPlanner::stands() {
  const Segment* segment = path_.at(0);
  return segment == nullptr ? wishes_.stands_before(path_.action()) : wishes_.stands_on(*segment);
}

bool JerkPlanner::next(MotionItem& item) {
  const bool stands = wishes_.any() && this->stands();
  if (stands || unsuited_) adapt(stands);
  if (stands && now_.speed == 0) {
    item = Action{.kind = Action::Kind::feed_hold, .outputs = outputs_};
    return true;
  }
  auto* move = std::get_if<PlannedMove>(&item);
  if (move == nullptr) move = &item.emplace<PlannedMove>();
  if (produce(*move)) {
    if (!rest_) rest_ = shorten(*move, longest_move_);
    take_note(*move);
    return true;
  }
  const std::optional<Action> action = path_.take_action();
  if (!action) return false;
  outputs_ = action->outputs;
  item = *action;
  window_->begin_at({}, wishes_.feeds);
  return true;
}

bool JerkPlanner::produce(PlannedMove& move) {
  if (rest_) {
    move = *std::exchange(rest_, std::nullopt);
    return true;
  }
  if (change_ && given_pieces_ == change_->pieces().size()) {
    change_.reset();
    if (!unsuited_) fastest_ = wishes_.feeds;
  }
  if (!change_) return window_->next(move);
  move.segment = *path_.at(0);
  take_pieces(*change_, given_pieces_, move);
  return true;
}

// Takes as many pieces on one segment as a move has room for. Returns whether the segment ends there.
bool JerkPlanner::take_pieces(const SpeedChange& change, std::size_t& given, PlannedMove& move) {
  const std::vector<SpeedChange::Piece>& pieces = change.pieces();
  const std::size_t segment = pieces[given].segment;
  bool ends = false;
  move.phase_count = 0;
  for (; given < pieces.size() && pieces[given].segment == segment; ++given) {
    if (move.phase_count == PlannedMove::most_phases) break;
    const SpeedChange::Piece& piece = pieces[given];
    move.add(piece.phase);
    ends = piece.ends_segment;
    move.to = ends ? move.segment.curve.length() : piece.phase.position_at(piece.phase.duration);
  }
  return ends;
}

// The motion that comes if nothing changes: how far it was looked at.
struct JerkPlanner::Outlook {
  bool behind_rest = false;  // the rest of a move that was too long is passed
  std::size_t pieces = 0;    // pieces of the change, given or looked at
  std::size_t cells = 0;     // cells of the window, looked at
  std::size_t segment = 0;   // segment of the path where that place lies
};

bool JerkPlanner::look_ahead(Outlook& outlook, PlannedMove& move) {
  if (rest_ && !std::exchange(outlook.behind_rest, true)) {
    move = *rest_;
    if (move.to >= move.segment.curve.length()) ++outlook.segment;
    return true;
  }
  if (change_ && outlook.pieces < change_->pieces().size()) {
    move.segment = *path_.at(outlook.segment);
    if (take_pieces(*change_, outlook.pieces, move)) ++outlook.segment;
    return true;
  }
  return window_->look_at(outlook.cells, outlook.segment, move);
}

// The shortest way to rest is a SpeedChange. If none is possible, the motion goes on as planned to a place where one
// is, or to rest.
void JerkPlanner::braking_plan(std::vector<PlannedMove>& plan) {
  plan.clear();
  Outlook outlook{.pieces = given_pieces_};
  PathState state = now_;
  double since_trial = between_trials;
  while (state.speed > 0) {
    std::optional<SpeedChange> stop;
    if (since_trial >= between_trials) {
      stop = SpeedChange::plan(path_, state, {.axes = axes_, .feeds = fastest_, .exit = 0});
      since_trial = 0;
    }
    PlannedMove move;
    if (stop) {
      for (std::size_t given = 0; given < stop->pieces().size();) {
        move.segment = *path_.at(stop->pieces()[given].segment);
        take_pieces(*stop, given, move);
        append(move, plan);
      }
      return;
    }
    if (!look_ahead(outlook, move)) return;
    append(move, plan);
    if (move.ends_at_rest()) return;
    since_trial += move.duration().value();
    state = behind(move);
    state.segment = outlook.segment;
  }
}

// Appends the move in parts no longer than other moves.
void JerkPlanner::append(const PlannedMove& move, std::vector<PlannedMove>& plan) const {
  std::optional<PlannedMove> rest = move;
  while (rest) {
    plan.push_back(*rest);
    rest = shorten(plan.back(), longest_move_);
  }
}

// Shortens the move to the longest time allowed. Returns the rest, if any.
std::optional<PlannedMove> JerkPlanner::shorten(PlannedMove& move, Seconds longest) {
  if (move.duration() <= longest * (1 + smallest_part)) return {};
  const Seconds small = longest * smallest_part;
  Seconds left = longest;
  for (std::size_t i = 0; i < move.phase_count; ++i) {
    Phase& phase = move.phases[i];
    if (phase.duration <= left + small && (i == 0 || left > small)) {
      left = std::max(left - phase.duration, Seconds(0));
      continue;
    }
    PlannedMove rest = move;
    rest.phase_count = 0;
    if (left <= small) {  // between two phases
      for (std::size_t k = i; k < move.phase_count; ++k) rest.add(move.phases[k]);
      move.phase_count = i;
    } else {
      rest.add({.duration = phase.duration - left,
                .start = phase.position_at(left),
                .velocity = phase.velocity_at(left),
                .acceleration = phase.acceleration + phase.jerk * left,
                .jerk = phase.jerk});
      for (std::size_t k = i + 1; k < move.phase_count; ++k) rest.add(move.phases[k]);
      phase.duration = left;
      move.phase_count = i + 1;
    }
    move.to = rest.from();
    return rest;
  }
  return {};
}

PathState JerkPlanner::behind(const PlannedMove& move) {
  const Phase& last = move.phases[move.phase_count - 1];
  return {.s = move.to < move.segment.curve.length() ? move.to.value() : 0,
          .speed = move.exit_velocity().value(),
          .acceleration = (last.acceleration + last.jerk * last.duration).value()};
}

void JerkPlanner::take_note(const PlannedMove& move) {
  now_ = behind(move);
  if (!rest_ && move.ends_at_rest()) now_.speed = now_.acceleration = 0;
  if (move.to < move.segment.curve.length()) return;
  path_.pop();
  window_->segment_passed();
  ++passed_segments_;
}

// Adapts to the wishes. At rest the plan begins anew. In motion a change leads to the wanted speed, as soon as one is
// possible.
void JerkPlanner::adapt(bool stands) {
  if (stands) {
    unsuited_ = true;
    if (now_.speed > 0) stop_sooner();
  } else if (now_.speed > 0) {
    unsuited_ = !go_over();
  } else {
    rest_.reset();
    change_.reset();
    window_->begin_at({.s = now_.s}, wishes_.feeds);
    fastest_ = wishes_.feeds;
    unsuited_ = false;
  }
}

void JerkPlanner::stop_sooner() {
  const bool stopping = change_ && change_->exit() == 0;
  std::optional<SpeedChange> stop = SpeedChange::plan(path_, now_, {.axes = axes_, .feeds = fastest_, .exit = 0});
  if (!stop) return;
  if (stopping) {
    double left = rest_ ? rest_->duration().value() : 0;
    for (std::size_t i = given_pieces_; i < change_->pieces().size(); ++i) {
      left += change_->pieces()[i].phase.duration.value();
    }
    if (stop->duration() > worth * left) return;
  }
  rest_.reset();
  change_ = std::move(stop);
  given_pieces_ = passed_segments_ = 0;
}

// Goes over to a plan with the present feeds. Returns false if none was found: then the old plan goes on.
bool JerkPlanner::go_over() {
  const Segment& segment = *path_.at(0);
  const double feed = wishes_.feeds.speed_on(segment);
  auto window = std::make_unique<JerkWindow>(axes_, path_, most_queued_);
  for (const double part : tried_speeds) {
    std::optional<SpeedChange> change =
        SpeedChange::plan(path_, now_, {.axes = axes_, .feeds = fastest_, .exit = part * std::min(feed, now_.speed)});
    if (!change) continue;
    window->begin_at({.segment = change->segment(), .s = change->s(), .speed = change->exit()}, wishes_.feeds);
    if (!window->can_go_on(sight * change->braking_way())) continue;
    rest_.reset();
    change_ = std::move(change);
    given_pieces_ = passed_segments_ = 0;
    window_ = std::move(window);
    return true;
  }
  return false;
}

}  // namespace passo
