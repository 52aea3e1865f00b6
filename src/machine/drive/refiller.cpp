#include "passo/drive/refiller.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "host_actions.hpp"

#include "passo/wire/segment_parts.hpp"

namespace passo {
namespace {

// At least this much motion, or this many items, lie between two places where a refill may end, because finding a tail
// takes time.
constexpr Seconds between_tails{0.0025};
constexpr std::size_t items_between_tails = 3;
// While there is time, a refill has at least this many items, and leaves as many places for the next refill.
constexpr std::size_t worth_sending = 4;

// Waiting for answers between refills. `behind_a_refill`: an answer takes this many times longer when a refill goes
// before the question. `patience`: the rate at which slow answers are forgotten. `made_ahead`: how far ahead a chip
// makes its events.
constexpr double behind_a_refill = 3;
constexpr double patience = 0.9;
constexpr double late_answer = 2;
constexpr double slower_answer = 1.5;
constexpr double moves_an_answer = 3;
constexpr Seconds shortest_answer{0.003};
// After motion that followed the spindle, refills become longer bit by bit. Little motion is ahead there, so a long
// refill would come too late.
constexpr double longer = 1.5;
constexpr Seconds longest_following{0.01};
constexpr double answers_ahead = 2.5;
constexpr Seconds spare{0.003};  // a tail may have many more items than the tail before
constexpr double patience_following = 0.95;
constexpr Seconds made_ahead{0.003};
// The next refill may be slower than the last ones by this factor.
constexpr double spare_of_frames = 1.25;

// Hands out the planner's braking plan as motion.
class Braking final : public Source<MotionItem> {
 public:
  explicit Braking(const std::vector<PlannedMove>& plan) : plan_(plan) {}
  [[nodiscard]] bool next(MotionItem& item) override {
    if (given_ == plan_.size()) return false;
    item = plan_[given_++];
    return true;
  }

 private:
  const std::vector<PlannedMove>& plan_;
  std::size_t given_ = 0;
};

}  // namespace

Refiller::Refiller(const Stages& stages, const StepOptions& steps, const TailOptions& options, bool waits_for_operator)
    : stages_(stages),
      steps_(steps),
      options_(options),
      behind_(stages.link.executed()),
      places_(static_cast<std::size_t>(std::max(stages.link.places(), 0))),
      given_(stages.path.place()),
      done_(given_),
      speed_(stages.planner, places_, worth_sending),
      waits_for_operator_(waits_for_operator) {
  stages.path.keep();
  commit();
}

void Refiller::watch(const MotionItem& motion) {
  motion_played_.note_given(motion);
  given_ = stages_.path.behind(given_, motion);
  const auto* move = std::get_if<PlannedMove>(&motion);
  const Seconds time = move != nullptr ? move->duration() : std::get<Action>(motion).dwell;
  given_time_ += time;
  given_in_all_ += time;
  if (move == nullptr || move->phase_count == 0) return;
  speed_.note_given(*move);
}

Refiller::Turn Refiller::advance() {
  if (stages_.link.error()) return Turn::ended;
  const int recoveries = recoveries_;
  before_action_.reset();
  note_executed();
  if (recoveries_ != recoveries && guards_threads_ && stages_.path.is_in_thread()) return Turn::lost_thread;
  if (refills_under_way_.empty()) {
    brakes_ = false;
    if (pulled_.empty()) {
      rested_ = tail_of_nothing().rest;
      motion_played_.show(motion_played_.given());
      passed_ += sent_time_;
      given_time_ = sent_time_ = Seconds(0);
      began_.reset();
      told_ahead_.reset();
    }
  }
  if (stages_.link.outputs_timed_out() && refills_under_way_.empty() && !(ended_ && pulled_.empty())) {
    take_up();
    return Turn::outputs_off;
  }
  if (!on_tail_ && !brakes_) {
    if (may_plan()) pull();
    if (const std::size_t items = size_of_refill(); items > 0) {
      send(items);
      return Turn::goes_on;
    }
  }
  if (refills_under_way_.empty()) {
    if (pulled_.empty() && ended_) return Turn::ended;
    if (pulled_.empty() && action_) return Turn::at_action;
    if (pulled_.empty() && std::exchange(holds_, false)) return Turn::rests_in_hold;
    if (!pulled_.empty() && free_places() + 1 == places_ && !waits_for_answer()) {
      if (begin_more_slowly()) return Turn::goes_on;
      stages_.link.fail(LinkError::too_few_places);
      return Turn::ended;
    }
  }
  return Turn::waits;
}

// Motion that follows the spindle is planned only when it is due, from the newest answer.
bool Refiller::may_plan() {
  if (attention_ != Attention::follows) return true;
  if (waits_for_answer()) return false;
  if (known_ahead() < refill_at()) return true;
  // A later answer is more accurate.
  stages_.link.ask();
  return false;
}

// How much motion is sent and not executed: as the board told with the spindle's place, or counted in whole items.
Seconds Refiller::known_ahead() const {
  return attention_ == Attention::follows ? told_ahead_.value_or(ahead_) : ahead_;
}

void Refiller::attend(Attention attention) {
  if (attention == attention_) return;
  if (attention_ == Attention::follows) reach_ = horizon();
  told_ahead_.reset();
  attention_ = attention;
  stages_.link.ask_for_spindle(attention == Attention::follows);
  if (in_haste()) {
    // Before a thread, the question was sent after as many bytes as a refill has.
    const double times = attention == Attention::follows ? 1 : behind_a_refill;
    answer_ = std::max(slowest_answer_, std::min(times * stages_.link.answer_time(), options_.refill_at));
  }
  commit();
}

// Sets how long moves may be, by the time that a question and its answer take.
void Refiller::commit() {
  answer_ = std::max(answer_, shortest_answer);
  const Seconds longest = attention_ == Attention::follows ? longest_following : options_.longest_move;
  longest_move_ = in_haste() ? std::min(longest, answer_ / moves_an_answer) : options_.longest_move;
  stages_.generator.be_exact_to(counts_items() ? options_.motion_in_few_places : options_.motion);
  stages_.planner.limit_moves_to(longest_move_);
  stages_.generator.limit_waiting_to(longest_move_);
}

// True: fewer items are better than more exact ones.
bool Refiller::counts_items() const {
  return in_haste() || places_ < options_.few_places;
}

// The board has enough motion while one refill is sent and answered and the next one has not arrived yet.
Seconds Refiller::horizon() const {
  if (attention_ == Attention::follows) return answers_ahead * answer_ + longest_move_ + made_ahead + spare;
  return in_haste() ? 2 * answer_ + longest_move_ + made_ahead : std::min(options_.horizon, reach_);
}
Seconds Refiller::refill_at() const {
  return in_haste() ? horizon() - longest_move_ : std::min(options_.refill_at, reach_ - longest_move_);
}

// An answer that took too long tells of a time too long ago. Then the board is asked again, and slower answers are
// expected.
bool Refiller::waits_for_answer() {
  if (!in_haste()) return false;
  if (!stages_.link.answered()) return true;
  if (!std::exchange(asked_, false)) return false;
  const Seconds time = stages_.link.answer_time();
  if (time > late_answer * answer_) {
    answer_ = slower_answer * answer_;
    ask();
    return true;
  }
  const double kept = attention_ == Attention::follows ? patience_following : patience;
  slowest_answer_ = std::max(time, slowest_answer_ * kept);
  answer_ = std::max(time, answer_ * kept);
  commit();
  return false;
}

std::optional<Point> Refiller::drop() {
  const PathPlace rest = std::exchange(given_, stages_.path.last());
  return stages_.path.point_at(rest);
}

void Refiller::read_again() {
  stages_.path.rewind(given_);
  stages_.planner.restart();
}

// The answer tells the event at which the board is in the current item. All answers of one motion together give a
// better time.
Seconds Refiller::ahead_of(const Turned& turned, Seconds time) {
  Seconds played = sent_time_;
  Seconds next{0};
  for (const Motion& motion : motion_) {
    if (later_by(motion.number, turned.progress.executed) <= 0) continue;
    const Seconds begins = motion.end - motion.time;
    played = begins + time_of(motion.item, turned.event);
    next = begins + time_of(motion.item, turned.event + 1) - played;
    break;
  }
  const Seconds latest = time - played;
  began_ = std::clamp(began_.value_or(latest), latest - next, latest);
  told_ahead_ = sent_time_ - (time - *began_);
  return given_time_ - (time - *began_);
}

Seconds Refiller::executed_time() const {
  const Seconds whole_items = passed_ + sent_time_ - ahead_;
  if (motion_.empty()) return whole_items;
  return whole_items + std::min(motion_.front().time, stages_.link.now() - item_begins_);
}

// Takes note of how far the board has told that it is.
void Refiller::note_executed() {
  const ItemNumber executed = stages_.link.executed();
  played_.show_executed(executed);
  for (; !motion_.empty() && later_by(motion_.front().number, executed) <= 0; motion_.pop_front()) {
    ahead_ -= motion_.front().time;
    item_begins_ = stages_.link.now();
  }
  auto& under_way = refills_under_way_;
  for (; under_way.size() > 1 && later_by(executed, under_way[1].first) >= 0; under_way.pop_front()) {
    motion_played_.show(under_way.front().tail.from);
    done_ = under_way.front().from;
  }
  if (under_way.empty()) return;
  if (later_by(executed, under_way.front().first) < 0) {
    // From the rest on, the board has begun nothing of the refill. If the board dropped the refill, it never will.
    if (!stages_.link.rests()) return;
    behind_ = executed;
    take_up();
    ++recoveries_;
    return;
  }
  stages_.path.forget_before(under_way.front().from.item);
  on_tail_ = later_by(executed, under_way.front().last_of_motion) > 0;
  if (executed != under_way.front().last) return;
  rested_ = std::move(under_way.front().rest);
  done_ = rested_.place;
  motion_played_.show(under_way.front().tail.from);
  if (on_tail_) motion_played_.show_tail(under_way.front().tail.moves);
  under_way.pop_front();
  if (!on_tail_) return;
  behind_ = executed;
  take_up();
  if (!brakes_) ++recoveries_;
}

// The board rests. All that was sent after the rest came too late, and all that was pulled is pulled again.
void Refiller::take_up() {
  refills_under_way_.clear();
  played_.forget();
  motion_played_.forget();
  motion_.clear();
  pulled_.clear();
  given_time_ = sent_time_ = sent_time_ - ahead_;
  given_in_all_ = passed_ + sent_time_;
  ahead_ = pulled_time_ = Seconds(0);
  on_tail_ = holds_ = ended_ = false;
  speed_.rest();
  action_.reset();
  given_ = rested_.place;
  stages_.path.rewind(given_);
  stages_.planner.restart();
  stages_.generator.assume(*rested_.generator);
  stages_.outputs = rested_.outputs;
}

// The machine rests, and no refill fits into the board. False: the path cannot begin more slowly.
bool Refiller::begin_more_slowly() {
  SpeedForTails::Speed highest;
  for (const Pulled& pulled : pulled_) {
    highest.on_path = std::max(highest.on_path, pulled.speed.on_path);
    highest.of_axis = std::max(highest.of_axis, pulled.speed.of_axis);
  }
  if (!speed_.begin_more_slowly(highest)) return false;
  take_up();
  return !(guards_threads_ && stages_.path.is_in_thread());
}

// Pulls motion up to the horizon, and further to a place where a refill may end.
void Refiller::pull() {
  const auto wanted = [&] {
    if (!pulled_.empty() && !pulled_.back().tail) return true;
    return known_ahead() + pulled_time_ < horizon() && pulled_.size() < places_;
  };
  const auto goes_on = [&] { return !holds_ && !ended_ && !action_; };
  while (goes_on() && wanted()) {
    if (std::exchange(outputs_changed_, false)) {
      add(stages_.outputs.tell());
    } else if (!stages_.items.next(item_)) {
      ended_ = true;
    } else if (const auto* segment = std::get_if<BoardSegment>(&item_)) {
      add(*segment);
    } else if (const auto& action = std::get<Action>(item_); action.kind == Action::Kind::feed_hold) {
      holds_ = true;
    } else if (is_for_outputs(action, waits_for_operator_)) {
      stages_.outputs.take_over(action);
      add(stages_.outputs.tell());
    } else {
      action_ = action;
    }
  }
  if (!goes_on() && !pulled_.empty() && !pulled_.back().tail) pulled_.back().tail = tail_of_nothing();
}

void Refiller::add(const LinkItem& item) {
  pulled_.push_back({.item = item, .time = time_of(item), .speed = speed_.speed()});
  pulled_time_ += pulled_.back().time;
  speed_.note_motion(pulled_.back().time);
  const StepGenerator& generator = stages_.generator;
  // A long dwell has more items than a board has places. So a refill may end within a dwell, and the next refill goes
  // on with it.
  if (generator.at_rest() || generator.waits_at_rest()) {
    pulled_.back().tail = tail_of_nothing();
  } else if (generator.ends_at_rest()) {
    return;  // the motion comes to rest by itself soon
  } else if (is_far_from_last_tail()) {
    pulled_.back().tail = find_tail();
    speed_.note_tail(pulled_.back().tail->items.size());
  }
}

bool Refiller::is_far_from_last_tail() const {
  Seconds time{0};
  std::size_t items = 0;
  for (auto at = pulled_.rbegin(); at != pulled_.rend() && !at->tail; ++at, ++items) time += at->time;
  return items >= items_between_tails || time >= between_tails;
}

// Finds how the machine would come to rest after the pulled items.
Refiller::Tail Refiller::find_tail() {
  const bool is_gentle = places_ >= options_.places_for_gentle_tails;
  stages_.planner.braking_plan(plan_, is_gentle ? Planner::Braking::gentle : Planner::Braking::hard);
  Tail tail{.from = given_, .rest = {.place = given_, .outputs = stages_.outputs}};
  for (const PlannedMove& move : plan_) tail.rest.place = stages_.path.behind(tail.rest.place, move);
  tail.motion.from = motion_played_.given();
  if (motion_played_.is_watched()) tail.motion.moves = plan_;
  Braking braking(plan_);
  StepGenerator& rested = *(tail.rest.generator = std::make_unique<StepGenerator>(braking, steps_));
  rested.assume(stages_.generator);
  rested.be_exact_to(counts_items() ? options_.tail_in_few_places : options_.tail);
  while (rested.next(item_)) tail.items.emplace_back(std::get<BoardSegment>(item_));
  return tail;
}

Refiller::Tail Refiller::tail_of_nothing() {
  return {.from = given_,
          .rest = {.place = given_, .generator = fork(), .outputs = stages_.outputs},
          .items = {},
          .motion = {.from = motion_played_.given()}};
}

// A copy of the generator's state. The copy has no motion to read.
std::unique_ptr<StepGenerator> Refiller::fork() {
  plan_.clear();
  Braking nothing(plan_);
  auto fork = std::make_unique<StepGenerator>(nothing, steps_);
  fork->assume(stages_.generator);
  return fork;
}

// One place is for the frame that replaces.
std::size_t Refiller::free_places() const {
  return static_cast<std::size_t>(std::max(stages_.link.places() - 1, 0));
}

// How many of the pulled items to send now. More is better, but the next refill needs places before the tail of this
// one begins.
std::size_t Refiller::size_of_refill() {
  if (pulled_.empty() || known_ahead() >= refill_at()) return 0;
  if (waits_for_answer()) return 0;
  const bool at_once = in_haste();
  const std::size_t places = free_places();
  const std::size_t room = static_cast<std::size_t>(std::max(stages_.link.room() - 1, 0));
  const Seconds time_an_item = std::max(options_.time_an_item, stages_.link.time_a_frame() * spare_of_frames);
  std::size_t fits = 0;
  std::size_t fits_well = 0;
  Seconds line_time{0};
  for (std::size_t i = 1; i <= pulled_.size() && i <= room; ++i) {
    if (!pulled_[i - 1].tail) continue;
    const std::size_t tail = pulled_[i - 1].tail->items.size();
    if (i + tail > room) continue;
    fits = i;
    line_time = made_ahead + time_an_item * static_cast<double>(i + tail + worth_sending);
    if (i + 2 * tail + (tail > 0 ? worth_sending : 0) <= places) fits_well = i;
  }
  if (refills_under_way_.empty() || at_once) return fits_well > 0 ? fits_well : fits;
  if (fits_well >= std::min(worth_sending, pulled_.size())) return fits_well;
  const Seconds present = motion_.empty() ? Seconds(0) : motion_.front().time;  // the board may be at its end
  if (ahead_ - present >= std::max(refill_at() / 2, line_time)) return 0;
  return fits;
}

void Refiller::send(std::size_t items) {
  const Tail& tail = *pulled_[items - 1].tail;
  items_.clear();
  for (std::size_t i = 0; i < items; ++i) items_.push_back(pulled_[i].item);
  items_.insert(items_.end(), tail.items.begin(), tail.items.end());
  Refill refill;
  if (rest_watcher_) {
    // The items come after the frame that replaces.
    const auto last = static_cast<ItemNumber>(stages_.link.sent() + 1 + items_.size());
    rest_watcher_({.executed = last, .place = tail.rest.place, .done = done_});
  }
  refill.first = stages_.link.replace(behind_, items_);
  if (motion_.empty()) item_begins_ = stages_.link.now();
  for (std::size_t i = 0; i < items; ++i) {
    sent_time_ += pulled_[i].time;
    motion_.push_back({.number = static_cast<ItemNumber>(refill.first + i),
                       .time = pulled_[i].time,
                       .end = sent_time_,
                       .item = pulled_[i].item});
    ahead_ += pulled_[i].time;
    if (told_ahead_) *told_ahead_ += pulled_[i].time;
    pulled_time_ -= pulled_[i].time;
  }
  refill.last_of_motion = behind_ = static_cast<ItemNumber>(refill.first + items - 1);
  refill.last = static_cast<ItemNumber>(refill.first + items_.size() - 1);
  assert(refill.last == stages_.link.sent());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    played_.note_sent(static_cast<ItemNumber>(refill.first + i), items_[i],
                      i < items ? std::nullopt : std::optional(refill.last));
  }
  reach_ = reach_ * longer;
  tail_items_ += tail.items.size();
  ++refills_;
  refill.from = tail.from;
  refill.rest = std::move(pulled_[items - 1].tail->rest);
  refill.tail = std::move(pulled_[items - 1].tail->motion);
  refills_under_way_.push_back(std::move(refill));
  pulled_.erase(pulled_.begin(), pulled_.begin() + static_cast<std::ptrdiff_t>(items));
  if (attention_ != Attention::none) ask();
}

void Refiller::ask() {
  if (in_haste()) longest_ahead_ = std::max(longest_ahead_, ahead_);
  asked_ = true;
  stages_.link.ask();
}

Action Refiller::take_action() {
  before_action_ = PathPlace{.item = given_.item - 1};
  return *std::exchange(action_, std::nullopt);
}

// An action that the drive has taken and not carried out must come again when a new host goes on. So the rest is before
// the action.
void Refiller::switch_outputs(const BoardOutputs& outputs) {
  assert(refills_under_way_.empty() && pulled_.empty());
  if (rest_watcher_)
    rest_watcher_({.executed = static_cast<ItemNumber>(stages_.link.sent() + 1),
                   .place = before_action_.value_or(given_),
                   .done = done_});
  switched_ = outputs;
  stages_.link.send(outputs);
}

bool Refiller::settled() {
  if (stages_.link.error()) return true;
  if (stages_.link.busy()) return false;
  behind_ = stages_.link.executed();
  if (switched_) played_.show(*switched_);
  switched_.reset();
  return true;
}

Seconds Refiller::time_of(const LinkItem& item, int of_events) const {
  const auto* segment = std::get_if<BoardSegment>(&item);
  if (segment == nullptr) return Seconds(0);
  return Seconds(static_cast<double>(duration(*segment, of_events)) / whole_tick / steps_.clock.tick_rate.value());
}

}  // namespace passo
