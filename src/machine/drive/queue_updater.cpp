#include "passo/drive/queue_updater.hpp"

#include <algorithm>
#include <utility>

#include "host_actions.hpp"

#include "passo/base/ensure.hpp"

namespace passo {
namespace {

// While there is time, a refill has at least this many items, and leaves as many places for the next refill.
constexpr std::size_t worth_sending = 4;
// The next refill may be slower than the last ones by this factor.
constexpr double spare_of_frames = 1.25;

}  // namespace

QueueUpdater::QueueUpdater(const Stages& stages, const StepOptions& steps, const StopRampOptions& options,
                           bool waits_for_operator)
    : stages_(stages),
      options_(options),
      behind_(stages.link.executed()),
      places_(static_cast<std::size_t>(std::max(stages.link.places(), 0))),
      ledger_(stages.link, steps.clock.tick_rate, stages.path.place()),
      tails_(stages, steps, options, places_, ledger_.motion_played()),
      pace_(options),
      given_(stages.path.place()),
      speed_(stages.planner, places_, worth_sending),
      waits_for_operator_(waits_for_operator) {
  stages.path.keep();
  commit();
}

void QueueUpdater::watch(const MotionItem& motion) {
  given_ = stages_.path.behind(given_, motion);
  const auto* move = std::get_if<PlannedMove>(&motion);
  ledger_.record_given(motion, move != nullptr ? move->duration() : std::get<Action>(motion).dwell);
  if (move == nullptr || move->phase_count == 0) return;
  speed_.record_given(*move);
}

QueueUpdater::Progress QueueUpdater::advance() {
  if (stages_.link.error()) return Progress::ended;
  const int recoveries = ledger_.recoveries();
  before_action_.reset();
  on_executed();
  if (ledger_.recoveries() != recoveries && guards_threads_ && stages_.path.is_in_thread())
    return Progress::lost_thread;
  if (ledger_.under_way() == nullptr) {
    brakes_ = false;
    if (pulled_.empty()) {
      rested_ = tails_.at_rest(given_).rest;
      ledger_.record_rest();
    }
  }
  if (stages_.link.outputs_timed_out() && ledger_.under_way() == nullptr && !(pulled_.ends() && pulled_.empty())) {
    rewind();
    stages_.outputs.forget_told();
    return Progress::outputs_off;
  }
  if (!on_tail_ && !brakes_) {
    if (may_plan()) pull();
    if (const std::size_t items = size_of_refill(); items > 0) {
      send(items);
      return Progress::goes_on;
    }
  }
  return ledger_.under_way() == nullptr ? advance_at_rest() : Progress::waits;
}

// The board has executed all that was sent.
QueueUpdater::Progress QueueUpdater::advance_at_rest() {
  if (pulled_.empty()) {
    if (pulled_.ends()) return Progress::ended;
    if (pulled_.action()) return Progress::at_action;
    return pulled_.take_hold() ? Progress::rests_in_hold : Progress::waits;
  }
  if (free_places() + 1 != places_ || waits_for_answer()) return Progress::waits;
  if (begin_more_slowly()) return Progress::goes_on;
  stages_.link.fail(LinkError::too_few_places);
  return Progress::ended;
}

// Motion that follows the spindle is planned only when it is due, from the newest answer.
bool QueueUpdater::may_plan() {
  if (!pace_.follows()) return true;
  if (waits_for_answer()) return false;
  if (known_ahead() < pace_.refill_at()) return true;
  // A later answer is more accurate.
  stages_.link.ask();
  return false;
}

// How much motion is sent and not executed: as the board told with the spindle's place, or counted in whole items.
Seconds QueueUpdater::known_ahead() const {
  return pace_.follows() ? ledger_.told_ahead().value_or(ledger_.ahead()) : ledger_.ahead();
}

void QueueUpdater::attend(Attention attention) {
  if (attention == pace_.attention()) return;
  ledger_.forget_told();
  stages_.link.ask_for_spindle(attention == Attention::follows);
  pace_.attend(attention, stages_.link.answer_time());
  commit();
}

// Tells the stages how long moves may be, and how exact.
void QueueUpdater::commit() {
  stages_.generator.be_exact_to(counts_items() ? options_.motion_in_few_places : options_.motion);
  stages_.planner.limit_moves_to(pace_.longest_move());
  stages_.generator.limit_waiting_to(pace_.longest_move());
}

// True: fewer items are better than more exact ones.
bool QueueUpdater::counts_items() const {
  return pace_.in_haste() || places_ < options_.few_places;
}

// An answer that took too long tells of a time too long ago. Then the board is asked again.
bool QueueUpdater::waits_for_answer() {
  if (!pace_.in_haste()) return false;
  if (!stages_.link.answered()) return true;
  if (!pace_.take_question()) return false;
  if (!pace_.judge(stages_.link.answer_time())) {
    ask();
    return true;
  }
  commit();
  return false;
}

std::optional<Point> QueueUpdater::drop() {
  const PathPosition rest = std::exchange(given_, stages_.path.last());
  return stages_.path.point_at(rest);
}

void QueueUpdater::read_again() {
  stages_.path.rewind(given_);
  stages_.planner.restart();
}

// Takes note of how far the board has told that it is.
void QueueUpdater::on_executed() {
  const ItemNumber executed = stages_.link.executed();
  ledger_.on_executed(executed);
  const QueueUpdateLedger::Refill* const refill = ledger_.under_way();
  if (refill == nullptr) return;
  if (later_by(executed, refill->first) < 0) {
    // From the rest on, the board has begun nothing of the refill. If the board dropped the refill, it never will.
    if (!stages_.link.rests()) return;
    behind_ = executed;
    rewind();
    ledger_.on_recovery();
    return;
  }
  stages_.path.forget_before(refill->tail.from.item);
  on_tail_ = later_by(executed, refill->last_of_motion) > 0;
  if (executed != refill->last) return;
  rested_ = ledger_.end_refill(on_tail_);
  if (!on_tail_) return;
  behind_ = executed;
  rewind();
  if (!brakes_) ledger_.on_recovery();
}

// The board rests. All that was sent after the rest came too late, and all that was pulled is pulled again.
void QueueUpdater::rewind() {
  ledger_.forget_unexecuted();
  pulled_.clear();
  on_tail_ = false;
  speed_.rest();
  given_ = rested_.place;
  stages_.path.rewind(given_);
  stages_.planner.restart();
  stages_.generator.assume(*rested_.generator);
  stages_.outputs = rested_.outputs;
}

// The machine rests, and no refill fits into the board. False: the path cannot begin more slowly.
bool QueueUpdater::begin_more_slowly() {
  const bool is_slower = speed_.begin_more_slowly(pulled_.highest_speed());
  ledger_.set_slowdowns(speed_.slowdowns());
  if (!is_slower) return false;
  rewind();
  return !(guards_threads_ && stages_.path.is_in_thread());
}

// Pulls motion up to the horizon, and further to a place where a refill may end.
void QueueUpdater::pull() {
  const auto wanted = [&] {
    if (!pulled_.may_end()) return true;
    return known_ahead() + pulled_.time() < pace_.horizon() && pulled_.size() < places_;
  };
  while (pulled_.goes_on() && wanted()) {
    if (std::exchange(outputs_changed_, false)) {
      add(stages_.outputs.tell());
    } else if (!stages_.items.next(item_)) {
      pulled_.record_end();
    } else if (const auto* segment = std::get_if<BoardSegment>(&item_)) {
      if (stages_.outputs.go_on()) add(stages_.outputs.tell());
      add(*segment);
    } else if (const auto* outputs = std::get_if<PathOutputs>(&item_)) {
      stages_.outputs.apply(*outputs);
      add(stages_.outputs.tell());
    } else if (const auto& action = std::get<Action>(item_); action.kind == Action::Kind::feed_hold) {
      if (stages_.outputs.halt()) add(stages_.outputs.tell());
      pulled_.record_hold();
    } else if (is_for_outputs(action, waits_for_operator_)) {
      stages_.outputs.apply(action);
      add(stages_.outputs.tell());
    } else {
      pulled_.record_action(action);
    }
  }
  if (!pulled_.goes_on() && !pulled_.may_end()) pulled_.last().tail = tails_.at_rest(given_);
}

void QueueUpdater::add(const LinkItem& item) {
  const Seconds time = ledger_.time_of(item);
  pulled_.add(item, time, speed_.speed());
  speed_.record_motion(time);
  const StepGenerator& generator = stages_.generator;
  // A long dwell has more items than a board has places. So a refill may end within a dwell, and the next refill goes
  // on with it.
  if (generator.at_rest() || generator.waits_at_rest()) {
    pulled_.last().tail = tails_.at_rest(given_);
  } else if (generator.ends_at_rest()) {
    return;  // the motion comes to rest by itself soon
  } else if (pulled_.is_far_from_last_tail()) {
    pulled_.last().tail = tails_.brake(given_, counts_items());
    speed_.record_tail(pulled_.last().tail->items.size());
    ledger_.set_slowdowns(speed_.slowdowns());
  }
}

// One place is for the frame that replaces.
std::size_t QueueUpdater::free_places() const {
  return static_cast<std::size_t>(std::max(stages_.link.places() - 1, 0));
}

// How many of the pulled items to send now. More is better, but the next refill needs places before the tail of this
// one begins.
std::size_t QueueUpdater::size_of_refill() {
  if (pulled_.empty() || known_ahead() >= pace_.refill_at()) return 0;
  if (waits_for_answer()) return 0;
  const bool at_once = pace_.in_haste();
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
  if (ledger_.under_way() == nullptr || at_once) return fits_well > 0 ? fits_well : fits;
  if (fits_well >= std::min(worth_sending, pulled_.size())) return fits_well;
  if (ledger_.surely_ahead() >= std::max(pace_.refill_at() / 2, line_time)) return 0;
  return fits;
}

void QueueUpdater::send(std::size_t items) {
  StopRamp tail = std::move(*pulled_[items - 1].tail);
  items_.clear();
  for (std::size_t i = 0; i < items; ++i) items_.push_back(pulled_[i].item);
  items_.insert(items_.end(), tail.items.begin(), tail.items.end());
  // The items come after the frame that replaces.
  ledger_.report_rest(static_cast<ItemNumber>(stages_.link.sent() + 1 + items_.size()), tail.rest.place);
  const ItemNumber first = stages_.link.replace(behind_, items_);
  for (std::size_t i = 0; i < items; ++i) {
    ledger_.record_motion(pulled_[i].item, static_cast<ItemNumber>(first + i), pulled_[i].time);
  }
  behind_ = static_cast<ItemNumber>(first + items - 1);
  ledger_.record_refill({.first = first,
                         .last_of_motion = behind_,
                         .last = static_cast<ItemNumber>(first + items_.size() - 1),
                         .tail = std::move(tail)});
  pulled_.drop_first(items);
  pace_.record_refill();
  if (pace_.attention() != Attention::none) ask();
}

void QueueUpdater::ask() {
  if (pace_.in_haste()) ledger_.on_question();
  pace_.on_question();
  stages_.link.ask();
}

Action QueueUpdater::take_action() {
  before_action_ = PathPosition{.item = given_.item - 1};
  return pulled_.take_action();
}

// An action that the drive has taken and not carried out must come again when a new host goes on. So the rest is before
// the action.
void QueueUpdater::switch_outputs(const BoardOutputs& outputs) {
  ensure(ledger_.under_way() == nullptr && pulled_.empty());
  ledger_.report_rest(static_cast<ItemNumber>(stages_.link.sent() + 1), before_action_.value_or(given_));
  switched_ = outputs;
  stages_.link.send(outputs);
}

bool QueueUpdater::settled() {
  if (stages_.link.error()) return true;
  if (stages_.link.busy()) return false;
  behind_ = stages_.link.executed();
  if (switched_) ledger_.show(*switched_);
  switched_.reset();
  return true;
}

}  // namespace passo
