// LineWindow: the lines for a machine that answers each of them by one line. The bytes of all lines that were sent and
// not answered never exceed the machine's receive buffer, and each answer belongs to the oldest of them. Answered lines
// are remembered as long as the machine may be executing them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>

#include "passo/units/units.hpp"

namespace passo {

class LineWindow {
 public:
  struct Line {
    std::string text;        // with its end
    std::uint32_t line = 0;  // of the program; 0: of none
    Seconds silence{0};      // how long the machine may be silent because of it
    Seconds sent{0};
  };

  void add(Line line) { waiting_.push_back(std::move(line)); }
  // Sends all lines that fit into the machine's buffer, which has `size` bytes as the machine tells.
  std::string send(Seconds now, std::size_t size);
  // The oldest line is answered. Empty: the answer belongs to no line of ours.
  std::optional<Line> take_answered();
  void drop_waiting() { waiting_.clear(); }
  void drop_sent() {
    sent_.clear();
    sent_bytes_ = 0;
  }

  // The machine tells how many bytes are free. Without a line of ours in its buffer, no more than that fit, whatever
  // size it tells.
  void hear_free_bytes(std::size_t bytes);
  std::size_t usable(std::size_t size) const { return std::min(size, empty_buffer_); }

  std::size_t waiting() const { return waiting_.size(); }
  bool all_answered() const { return waiting_.empty() && sent_.empty(); }
  // The oldest line without an answer; null: none.
  const Line* oldest() const { return sent_.empty() ? nullptr : &sent_.front(); }
  std::size_t sent_bytes() const { return sent_bytes_; }
  std::uint64_t lines_sent() const { return lines_sent_; }

  // Lines of a program. The last that was sent; 0: none was.
  std::uint32_t last_line() const { return last_line_; }
  // An answered line, which the machine may still hold with some lines before it: at most `most` in all.
  void note_held(std::uint32_t line, std::size_t most);
  // The first of the `count` lines that were answered last; if there are none, the last that was sent.
  std::uint32_t first_held(std::size_t count) const;

 private:
  std::deque<Line> waiting_;
  std::deque<Line> sent_;
  std::size_t sent_bytes_ = 0;
  std::uint64_t lines_sent_ = 0;
  std::size_t empty_buffer_ = std::numeric_limits<std::size_t>::max();
  std::uint32_t last_line_ = 0;
  std::deque<std::uint32_t> held_;
};

}  // namespace passo
