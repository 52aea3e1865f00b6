// JerkLaw: where an axis has a limit of jerk. The acceleration changes continuously, also through joints of segments.
//
// A change in mid-run leads off the plan (JerkWindow) by a SpeedChange. To stop, the change leads to rest, else to a
// speed from which a new plan goes on. The old plan stays until both are found. At rest everything may change.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "emergency_brake.hpp"
#include "jerk_window.hpp"
#include "rest.hpp"
#include "shorten.hpp"
#include "soonest_stop.hpp"
#include "speed_change.hpp"
#include "speed_law.hpp"

namespace passo {
namespace {

// In seconds of motion: the least time between two trials of a change. It bounds the work, because a trial takes up to
// a few milliseconds, and moves may be much shorter. It is also the greatest delay of a change.
constexpr double between_trials = 0.003;

// Times the shortest stop. A later one is compared with the soonest that can be planned.
constexpr double late = 1.1;
constexpr double very_late = 1.5;

// A share of the time to rest. Another stop must be sooner by this factor, or stops of rounding would replace each
// other at every move.
constexpr double worth = 0.98;
// In seconds. Another stop must also be sooner by this. The last part of a stop takes up to twice as long as the
// shortest one (JerkProfile, next to a stop), on any scale. Without this minimum, each move would be replaced by one of
// half the length, down to the spacing of doubles.
constexpr double least_gain_of_stop = 0.001;

// Shares of the wanted speed. From each of them a plan that goes on is tried: the first is the best one, and the others
// help where the path ahead is slower than the feed.
constexpr std::array<double, 6> tried_speeds = {1, 0.9, 0.75, 0.55, 0.35, 0.15};

// A plan that goes on must see this many times the braking way: above 1, or its end would act on its start. Up to 3 the
// times of 24 random programs with 570 holds and overrides differ by less than 1 %.
constexpr double sight = 1.5;

class JerkLaw final : public SpeedLaw {
 public:
  explicit JerkLaw(const LawInputs& inputs)
      : axes_(axes_with_limits(inputs.limits)),
        path_(inputs.path),
        stops_(inputs.limits),
        wishes_(inputs.wishes),
        most_queued_(inputs.most_queued),
        emergency_brake_(inputs.limits),
        window_(new_window()) {}

  void begin() override { begin_at({.segment = path_.first()}); }

  void feeds_changed() override {
    unsuited_ = true;
    fastest_ = FeedFactors::fastest_of(fastest_, wishes_.feeds);
  }

  // Where no plan leads on, the old one leads to rest, and a new one from there.
  void path_grew() override { unsuited_ = true; }

  bool go_on(PlannedMove& move) override {
    if (unsuited_ && (now_.speed == 0 || may_try(Seconds(between_trials)))) adapt();
    return produce(move);
  }

  bool brake(PlannedMove& move) override {
    unsuited_ = true;
    if (now_.speed == 0) return false;
    if (is_stop_late() && may_try(pause_in_stop())) stop_sooner();
    return now_.speed > 0 && produce(move);
  }

  // The shortest gentle way to rest is a SpeedChange. If none is possible, the motion goes on as planned to a place
  // where one is, or to rest. A late stop would take too long to find, because each refill of a board asks for a plan.
  void braking_plan(Planner::Braking how, std::vector<PlannedMove>& plan) override {
    if (how == Planner::Braking::hard && emergency_brake_.plan(path_, now_, fastest_, plan)) return;
    Outlook outlook{.pieces = given_pieces_};
    PathState state = now_;
    double since_trial = between_trials;
    PlannedMove move;
    while (state.speed > 0) {
      std::optional<SpeedChange> stop;
      if (since_trial >= between_trials) {
        stop = plan_stop(state, to_speed_0());
        since_trial = 0;
      }
      if (stop) {
        for (std::size_t given = 0; given < stop->pieces().size();) {
          take_pieces(*stop, given, move);
          append(move, plan);
        }
        return;
      }
      if (!look_ahead(outlook, state.segment, move)) return;
      append(move, plan);
      if (ends_at_stop(move, state.segment)) return;
      since_trial += move.duration().value();
      state = PathState::behind(move, state.segment);
    }
  }

 private:
  std::unique_ptr<JerkWindow> new_window() const {
    return std::make_unique<JerkWindow>(JerkWindow::Inputs{.axes = axes_,
                                                           .path = path_,
                                                           .feeds = wishes_.feeds,
                                                           .stops = stops_.any() ? &stops_ : nullptr,
                                                           .most_queued = most_queued_});
  }

  // Begins anew, at rest.
  void begin_at(const PathState& state) {
    now_ = state;
    rest_.reset();
    change_.reset();
    window_->begin_at(state, stopped_);
    fastest_ = wishes_.feeds;
    unsuited_ = false;
  }

  bool produce(PlannedMove& move) {
    if (!pull(move)) return false;
    rest_ = shorten(move, wishes_.longest_move);
    now_ = PathState::behind(move, path_.first());
    since_trial_ += move.duration();
    if (rest_ || !(has_stopped() || ends_at_stop(move, path_.first()))) return true;
    move.stops_at_once = has_stopped();
    if (stops_.any()) stopped_ = move.segment.curve.tangent(move.to) * now_.speed;
    now_.speed = now_.acceleration = 0;
    return true;
  }

  // At a stop of the path the motors may stop at once.
  bool ends_at_stop(const PlannedMove& move, std::uint64_t segment) {
    if (move.ends_at_rest()) return true;
    return stops_.any() && move.to >= move.segment.curve.length() && path_.after(segment) == nullptr;
  }

  // At the end of a stop the motion rests, whatever speed rounding has left: the window is that of the plan before.
  bool has_stopped() const { return change_ && given_pieces_ == change_->pieces().size() && change_->end().speed == 0; }

  bool pull(PlannedMove& move) {
    if (rest_) {
      move = *rest_;
      return true;
    }
    if (change_ && given_pieces_ == change_->pieces().size()) {
      change_.reset();
      if (!unsuited_) fastest_ = wishes_.feeds;
    }
    if (!change_) return window_->next(move);
    take_pieces(*change_, given_pieces_, move);
    return true;
  }

  // Takes as many pieces on one segment as a move has room for.
  void take_pieces(const SpeedChange& change, std::size_t& given, PlannedMove& move) {
    const std::vector<SpeedChange::Piece>& pieces = change.pieces();
    const std::uint64_t segment = pieces[given].segment;
    move.begin_on(*path_.at(segment));
    for (; given < pieces.size() && pieces[given].segment == segment; ++given) {
      if (move.phase_count == PlannedMove::most_phases) break;
      const SpeedChange::Piece& piece = pieces[given];
      move.add(piece.phase);
      move.to = piece.ends_segment ? move.segment.curve.length() : piece.phase.position_at(piece.phase.duration);
    }
  }

  // The motion that comes if nothing changes: how far it was looked at.
  struct Outlook {
    bool behind_rest = false;  // the rest of a move that was too long is passed
    std::size_t pieces = 0;    // pieces of the change, given or looked at
    std::size_t cells = 0;     // cells of the window, looked at
  };
  // The next move, which lies on that segment.
  bool look_ahead(Outlook& outlook, std::uint64_t segment, PlannedMove& move) {
    if (rest_ && !std::exchange(outlook.behind_rest, true)) {
      move = *rest_;
      return true;
    }
    if (change_ && outlook.pieces < change_->pieces().size()) {
      take_pieces(*change_, outlook.pieces, move);
      return true;
    }
    if (change_ && change_->end().speed == 0) return false;
    return window_->peek(outlook.cells++, segment, move);
  }

  // Appends the move in parts no longer than other moves.
  void append(const PlannedMove& move, std::vector<PlannedMove>& plan) const {
    std::optional<PlannedMove> rest = move;
    while (rest) {
      plan.push_back(*rest);
      rest = shorten(plan.back(), wishes_.longest_move);
    }
  }

  // Adapts to the wishes. At rest the plan begins anew. In motion a change leads to the wanted speed, as soon as one is
  // possible.
  void adapt() {
    if (now_.speed > 0) {
      unsuited_ = !go_over();
    } else {
      begin_at(now_);
    }
  }

  // A hold may use the start-stop velocities. The stop ramp of a board ends with speed 0.
  SpeedChange::Request to_rest() const {
    return {.axes = axes_, .feeds = fastest_, .exit = 0, .stops = stops_.any() ? &stops_ : nullptr};
  }
  SpeedChange::Request to_speed_0() const { return {.axes = axes_, .feeds = fastest_, .exit = 0}; }

  // The soonest stop that is found: the simplest one that is not late, or the best of all.
  std::optional<SpeedChange> plan_stop(const PathState& state, const SpeedChange::Request& request) {
    const Seconds soon = late * SpeedChange::shortest_stop(path_, state, request);
    std::optional<SpeedChange> best;
    const auto is_soon = [&](std::optional<SpeedChange> stop) {
      if (stop && !(best && best->duration_from(0) <= stop->duration_from(0))) best = std::move(stop);
      return best && best->duration_from(0) <= soon;
    };
    const auto of_way = [&](SpeedChange::Way way) { return SpeedChange::plan(path_, state, request, way); };
    static_cast<void>(is_soon(of_way(SpeedChange::Way::of_one_strength)) ||
                      is_soon(soonest_stop(path_, state, request)) || is_soon(of_way(SpeedChange::Way::in_steps)));
    return best;
  }

  // Whether this time of motion has passed since the last trial.
  bool may_try(Seconds pause) {
    if (since_trial_ < pause) return false;
    since_trial_ = Seconds(0);
    return true;
  }

  // A stop that is hardly late is tried again only when half of it is over, so there are few trials.
  Seconds pause_in_stop() const {
    const Seconds left = time_to_rest();
    return left < very_late * SpeedChange::shortest_stop(path_, now_, to_rest())
               ? std::max(left, Seconds(between_trials))
               : Seconds(between_trials);
  }

  // The remaining time of the current stop. Infinite if there is none.
  Seconds time_to_rest() const {
    const bool stops = change_ && change_->end().speed == 0;
    if (!stops) return Seconds(std::numeric_limits<double>::infinity());
    return (rest_ ? rest_->duration() : Seconds(0)) + change_->duration_from(given_pieces_);
  }

  bool is_stop_late() const {
    const Seconds shortest = SpeedChange::shortest_stop(path_, now_, to_rest());
    return time_to_rest() > std::max(late * shortest, shortest + Seconds(least_gain_of_stop));
  }

  void stop_sooner() {
    std::optional<SpeedChange> stop = plan_stop(now_, to_rest());
    const Seconds left = time_to_rest();
    const Seconds most = std::min(left * worth, left - Seconds(least_gain_of_stop));
    if (!stop || stop->duration_from(0) > most) return;
    if (stop->pieces().empty()) return stand_at_once();
    lead_off(std::move(stop));
  }

  // The start-stop velocities allow a stop without a ramp.
  void stand_at_once() {
    rest_.reset();
    stopped_ = path_.at(now_.segment)->curve.tangent(Mm(now_.s)) * now_.speed;
    now_.speed = now_.acceleration = 0;
  }

  void lead_off(std::optional<SpeedChange> change) {
    rest_.reset();
    change_ = std::move(change);
    given_pieces_ = 0;
  }

  // Goes over to a plan with the present feeds. Returns false if none was found: then the old plan goes on.
  bool go_over() {
    const double wanted = std::min(wishes_.feeds.speed_on(*path_.front()), now_.speed);
    std::unique_ptr<JerkWindow> window = new_window();
    for (const double part : tried_speeds) {
      std::optional<SpeedChange> change =
          SpeedChange::plan(path_, now_, {.axes = axes_, .feeds = fastest_, .exit = part * wanted});
      if (!change) continue;
      window->begin_at(change->end());
      if (!window->can_go_on(sight * change->braking_way())) continue;
      lead_off(std::move(change));
      window_ = std::move(window);
      return true;
    }
    return false;
  }

  std::vector<LimitedAxis> axes_;
  PathAhead& path_;
  StopSpeeds stops_;
  const MidRunWishes& wishes_;
  std::size_t most_queued_;
  EmergencyBrake emergency_brake_;
  std::unique_ptr<JerkWindow> window_;

  PathState now_;                        // at the end of the last move given
  Point stopped_;                        // how fast the axes were when the machine last came to a stop
  std::optional<PlannedMove> rest_;      // the rest of a move that was too long
  std::optional<SpeedChange> change_;    // leads to the window's start
  std::size_t given_pieces_ = 0;         // pieces of the change
  FeedFactors fastest_;                  // the fastest feeds with which any of the present plan was made
  bool unsuited_ = false;                // the plan does not suit the wishes
  Seconds since_trial_{between_trials};  // motion since a change was last tried
};

}  // namespace

std::unique_ptr<SpeedLaw> jerk_law(const LawInputs& inputs) {
  return std::make_unique<JerkLaw>(inputs);
}

}  // namespace passo
