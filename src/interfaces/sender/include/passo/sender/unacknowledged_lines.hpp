// UnacknowledgedLines: flow control for a machine that acknowledges each line by one response. The bytes of all
// unacknowledged lines never exceed the machine's receive buffer, and each response belongs to the oldest of them.
// Acknowledged lines are remembered as long as the machine may be executing them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/units/units.hpp"

namespace passo {

// What the machine says to a line, other than reports and ok.
struct GrblAnswer {
  std::string line;
  std::vector<std::string> said = {};
  std::string error = {};  // "error:3, the '$' command is unknown"; empty: ok
};

class UnacknowledgedLines {
 public:
  // Returns the text of a line without its line end.
  static std::string without_end(std::string_view text) { return std::string(text.substr(0, text.find('\n'))); }

  struct Line {
    std::string text;        // including its line end
    std::uint32_t line = 0;  // line of the program; 0: none
    Seconds silence{0};      // how long the machine may not respond because of it
    Seconds sent{0};
    bool goes_on = false;  // a piece of a line, not its last one
    bool marks = false;    // a question of the sender itself, which counts as no line
    bool asks = false;     // its answer is wanted; a rejection is no fault
    std::vector<std::string> said = {};
  };

  void add(Line line) { waiting_.push_back(std::move(line)); }
  // Returns the lines that fit into the machine's receive buffer, and marks them as sent. `size`: as reported by the
  // machine.
  std::string send(Seconds now, std::size_t size);
  // Returns the next line if it fits; null otherwise. Nothing follows a line that writes the EEPROM before it is
  // acknowledged.
  const Line* next_fitting(std::size_t size) const;
  // Marks the next line as sent, and returns it.
  std::string send_next(Seconds now);
  // Sends a mark before all waiting lines. Returns whether it fits.
  bool send_mark(const std::string& text, Seconds now, std::size_t size);
  // Removes and returns the oldest line, which was acknowledged. Empty: the response belongs to none of our lines.
  std::optional<Line> take_answered();
  // Notes what the machine says, if the oldest line asks.
  void note_said(std::string_view text);
  void keep_reply(Line line, std::string error);
  std::optional<GrblAnswer> take_reply();
  void drop_waiting() { waiting_.clear(); }
  void drop_sent() {
    sent_.clear();
    lines_answered_ = lines_sent_;
    sent_bytes_ = 0;
  }

  // Notes the number of free bytes reported by the machine. If none of our lines is in its buffer, this is its actual
  // size, whatever size was reported.
  void hear_free_bytes(std::size_t bytes);
  std::size_t usable(std::size_t size) const { return std::min(size, empty_buffer_); }

  std::size_t waiting() const { return waiting_.size(); }
  bool all_answered() const { return waiting_.empty() && sent_.empty(); }
  // Returns the oldest unacknowledged line; null if there is none.
  const Line* oldest() const { return sent_.empty() ? nullptr : &sent_.front(); }
  std::size_t sent_bytes() const { return sent_bytes_; }
  std::uint64_t lines_sent() const { return lines_sent_; }
  std::uint64_t lines_answered() const { return lines_answered_; }

  // Program lines. Returns the last one sent; 0 if there was none.
  std::uint32_t last_line() const { return last_line_; }
  // Notes an acknowledged line, which may still be in the machine together with some lines before it: at most `most` in
  // all.
  void note_held(std::uint32_t line, std::size_t most);
  // Returns the first of the last `count` acknowledged lines; if there are none, the last line sent.
  std::uint32_t first_held(std::size_t count) const;

 private:
  std::deque<Line> waiting_;
  std::deque<Line> sent_;
  std::size_t sent_bytes_ = 0;
  std::uint64_t lines_sent_ = 0;
  std::uint64_t lines_answered_ = 0;
  std::size_t empty_buffer_ = std::numeric_limits<std::size_t>::max();
  std::uint32_t last_line_ = 0;
  std::deque<std::uint32_t> held_;
  std::deque<GrblAnswer> replies_;
};

}  // namespace passo
