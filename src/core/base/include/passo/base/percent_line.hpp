// PercentSender and PercentReceiver: the progress of a process, for the process that started it.
//
// The message is one byte: how many per cent are done, 0 to 100. Each is sent once, and they only grow. So there are at
// most 101 messages, a pipe never fills, and neither side waits. The receiver trusts nothing: it ignores every byte
// that is no such message.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace passo {

class PercentSender {
 public:
  // The message to send when this share, 0 to 1, is done. Empty: nothing new. Rounds down: 100 means that all is done.
  std::optional<std::uint8_t> next(double share) {
    if (!(share > 0)) share = 0;
    const int percent = static_cast<int>(std::floor(100 * std::min(1.0, share)));
    if (percent <= sent_) return std::nullopt;
    sent_ = percent;
    return static_cast<std::uint8_t>(percent);
  }

 private:
  int sent_ = -1;
};

class PercentReceiver {
 public:
  void take(std::span<const std::uint8_t> messages) {
    for (const std::uint8_t percent : messages) {
      if (percent <= 100) percent_ = std::max<int>(percent_, percent);
    }
  }
  int percent() const { return percent_; }

 private:
  int percent_ = 0;
};

}  // namespace passo
