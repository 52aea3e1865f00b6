// Announcement: builds the message `Replace` (a queue update) from the frames that follow it. For the host. Portable.
#pragma once

#include <stdint.h>

#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class Announcement {
 public:
  // The frame numbered `number` replaces everything after item `after`.
  Announcement(uint16_t number, uint16_t after, uint8_t motors) : number_(number), motors_(motors) {
    replace_.after = after;
    reader_.set_motors(motors);
  }

  // Adds an item's frame, as the board will receive it.
  void add(const uint8_t* frame, uint8_t size) {
    for (uint8_t i = 0; i < size; ++i) static_cast<void>(reader_.feed(frame[i]));
    sums_.add(reader_.frame(), motors_);
    words_ += ItemSums::describe(static_cast<uint8_t>(reader_.frame().type), motors_);
    ++replace_.count;
  }
  Replace replace() const {
    Replace replace = replace_;
    // The announcement comes first, so its words are added before those of the items.
    ItemSums sums;
    sums.add_announcement(number_, replace.after, replace.count);
    sums.second = static_cast<uint16_t>(sums.second + words_ * sums.first + sums_.second);
    sums.first = static_cast<uint16_t>(sums.first + sums_.first);
    replace.sums = sums.to_leave_nothing(words_ + ItemSums::words_of_announcement);
    return replace;
  }

 private:
  uint16_t number_;
  uint8_t motors_;
  Decoder reader_;
  ItemSums sums_;  // the sums of the items only
  unsigned words_ = 0;
  Replace replace_;
};

}  // namespace passo
