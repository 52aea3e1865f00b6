// GrblInput: splits the bytes that a sender sends to a Grbl controller into lines and real-time commands.
//
// Position in the pipeline: outside it, the entry point for senders. Real-time commands are single bytes. They take
// effect immediately, even within a line, and are not part of the line. All other bytes stay in the receive buffer
// until the controller processes their line. The buffer never drops a byte: free() is the number of bytes that fit, and
// wants_more() tells the server when to stop reading, so that a sender that sends more is blocked.
//
// Senders send real-time bytes of 0x80 and above as single bytes, or in UTF-8 (C2 85 for 0x85). UTF-8 text contains the
// same bytes: "Ä" is C3 84. A byte that belongs to a character of UTF-8 text is therefore not a command.
//
// A line ends with LF, CR or CR LF. Like grbl, the input removes blanks, comments and '/', and converts letters to
// upper case. The text of a comment (MSG,…) is stored with the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace passo {

class GrblInput {
 public:
  static constexpr std::size_t told_size = 128;      // size of the receive buffer as reported to senders
  static constexpr std::size_t most_waiting = 8192;  // for senders that do not count bytes
  static constexpr std::size_t longest_stripped = 255;

  struct Line {
    std::string text;        // without blanks and comments, in upper case
    std::string message;     // text of the last comment (MSG,…), as written
    bool too_long = false;   // the end is missing
    bool cancelled = false;  // followed by a jog cancel: has no effect if it is a jog
  };

  // Adds received bytes. Passes each real-time command to `act` at its position among the bytes.
  void receive(std::string_view bytes, const std::function<void(std::uint8_t)>& act);
  // Returns the next complete line, if there is one.
  std::optional<Line> pop_line();
  bool has_line() const { return ends_ > 0; }
  // Cancels all jogs among the waiting lines, including an incomplete one.
  void cancel_jogs();
  // Drops all waiting lines.
  void clear();

  std::size_t free() const { return waiting_.size() >= told_size ? 0 : told_size - waiting_.size(); }
  bool wants_more() const { return waiting_.size() < most_waiting; }

 private:
  // Returns the command if the byte is one in the current context.
  std::optional<std::uint8_t> command(std::uint8_t byte);

  std::string waiting_;
  std::size_t ends_ = 0;       // number of line ends in waiting_
  std::size_t cancelled_ = 0;  // number of cancelled lines, from the first one on
  int text_bytes_ = 0;         // remaining bytes of a UTF-8 character
  bool command_next_ = false;  // after C2
  bool after_return_ = false;
};

}  // namespace passo
