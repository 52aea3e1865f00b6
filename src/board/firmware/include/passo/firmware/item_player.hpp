// ItemPlayer: the part of a Board that plays the items of its list, in order, and counts the motors' steps.
//
// The player has the first `begun_` items of the list. It plays each part of an item as a segment, one after the other;
// finished items are counted and removed from the list. Portable: no heap, no virtual call.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/firmware/board_hardware.hpp"
#include "passo/firmware/board_identity.hpp"
#include "passo/firmware/message_sender.hpp"
#include "passo/firmware/play_list.hpp"
#include "passo/firmware/segment_splitter.hpp"
#include "passo/wire/segment_parts.hpp"

namespace passo {

template <class Hardware, size_t queue_capacity, class SegmentPlayer, uint8_t most_motors>
class ItemPlayer : protected MessageSender<Hardware> {
 public:
  using Segment = SegmentFor<most_motors>;
  using Breath = BreathOf<Hardware>;
  static void breathe() { Breath{}(); }
  static void slice() { SliceOf<Hardware>{}(); }

  // For the timer. True if there is nothing to play: no event will come.
  bool idle() const { return player_.done(); }
  // Returns the ticks from the last event to the next. Call once for each event, only when not idle.
  uint32_t ticks_to_next_event() { return player_.wait(); }
  void on_event() {
    const uint8_t stepped = player_.play();
    if (stepped != 0) hardware_.step(stepped, player_.directions());
    if (player_.done()) settle();
  }

  // Removes items that the player has finished, and passes it those that it can accept. On a chip the main loop calls
  // it.
  void settle() {
    for (;; load()) {
      breathe();
      while (player_.finished()) {
        retire_one();
        slice();
      }
      if (!player_.ready() || !has_more()) return;
    }
  }
  // Passes one item to the player, and removes at most one finished item before, because making short events is more
  // urgent.
  void feed() {
    breathe();
    if (!player_.ready() && player_.finished()) retire_one();
    if (player_.ready() && has_more()) load();
  }
  // Whether there is an item, or a part of one, that the player has not begun.
  bool has_more() const { return !parts_.are_done() || begun_ != list_.size(); }
  SegmentPlayer& player() { return player_; }

 protected:
  using MessageSender<Hardware>::hardware_;

  ItemPlayer(Hardware& hardware, const BoardIdentity& identity)
      : MessageSender<Hardware>(hardware), identity_(identity) {}

  // Returns the number of events played of the present item.
  uint16_t played() const {
    return begun_ == 0 ? uint16_t{0} : static_cast<uint16_t>(done_of_front_ + player_.played());
  }
  void drop_all() {
    list_.clear(places());
    begun_ = 0;
    parts_.drop();
    done_of_front_ = 0;
  }
  uint8_t places() const { return identity_.places < queue_capacity ? identity_.places : uint8_t{queue_capacity}; }

  [[gnu::noinline]] int32_t position(uint8_t motor) const {
    if (motor >= most_motors) return 0;
    return positions_[motor] + (begun_ == 0 || motor >= motors_ ? int16_t{0} : player_.steps(motor));
  }

  BoardIdentity identity_;
  SegmentPlayer player_{0};
  PlayList<queue_capacity, most_motors, Breath> list_;  // the player plays its first item
  uint8_t begun_ = 0;                    // items at the front that the player has; the last one perhaps only in part
  uint8_t motors_ = 0;                   // as agreed with the host
  uint16_t executed_ = 0;                // number of the last item done
  uint8_t owed_ = 0;                     // items executed and other news since the last report
  uint8_t from_rest_ = 0;                // low byte of the number of the newest item that follows a standstill
  int32_t positions_[most_motors] = {};  // at the end of the last segment

 private:
  // Loads the next part of the newest begun item, or the first part of the item after it. The player plays a part as a
  // segment.
  [[gnu::noinline]] void load() {
    const bool begins = parts_.are_done();
    if (begins) ++begun_;
    breathe();
    auto& item = list_.at(static_cast<uint8_t>(begun_ - 1));
    const uint16_t events = item.segment.events;
    if (begins && static_cast<uint8_t>(item.number) == from_rest_) begin_from_rest(events);
    if (events == 0) return player_.pass(item.outputs());
    if (item.segment.form == 0 && item.segment.bend == 0 && events <= longest_part) return player_.load(item.segment);
    load_part(item.segment, begins);
  }
  // Records that the motors are stopped before the newest begun item. Outputs take no time, so the motors are also
  // stopped before the item after them.
  void begin_from_rest(uint16_t events) {
    if (events == 0) {
      ++from_rest_;
    } else if constexpr (requires { player_.begin_from_rest(); }) {
      player_.begin_from_rest();
    }
  }
  [[gnu::noinline]] void load_part(Segment& segment, bool begins) {
    parts_.take(segment, begins);
    if (is_root(segment.form)) identity_.template keep_playable<Breath>(parts_.part(), motors_);
    player_.load(parts_.part());
  }

  void retire_one() {
    retire();
    player_.forget();
    breathe();
  }
  // Finishes the oldest item, or a part of it. Outputs are switched here, at the event before them.
  [[gnu::noinline]] void retire() {
    const auto& item = list_.front();
    if (item.is_segment()) {
      player_.add_steps(positions_);
      const uint16_t left = static_cast<uint16_t>(item.segment.events - done_of_front_);
      const uint8_t length = part_length(item.segment.form);
      done_of_front_ = static_cast<uint16_t>(done_of_front_ + length);
      if (left > length) return;
    } else {
      hardware_.outputs(item.outputs());
    }
    done_of_front_ = 0;
    executed_ = item.number;
    list_.pop();
    --begun_;
    ++owed_;
  }

  uint16_t done_of_front_ = 0;                  // events of the front item in finished parts
  SegmentSplitter<most_motors, Breath> parts_;  // parts of the newest begun item
};

}  // namespace passo
