// GrblInput: the bytes that a sender sends to a Grbl controller, cut into lines and real-time commands.
//
// Place on the street: beside the street, at the door for senders. Real-time commands are single bytes. They act as
// soon as they come, also in the middle of a line, and are not part of the line. All other bytes wait in the receive
// buffer until the controller takes their line. The buffer never drops a byte: free() tells the sender how much fits,
// and wants_more() tells the server when to stop reading, so that a sender that sends more is held up.
//
// Senders send real-time bytes of 0x80 and above as single bytes, or in UTF-8 (C2 85 for 0x85). Text in UTF-8 has the
// same bytes inside: "Ä" is C3 84. So a byte that belongs to a character of UTF-8 text is no command.
//
// A line ends with LF, CR or CR LF. Like grbl, the input takes blanks, comments and '/' out, and makes letters
// capital. The text of a comment (MSG,…) is kept beside the line.
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
  static constexpr std::size_t told_size = 128;      // of the receive buffer, as senders are told
  static constexpr std::size_t most_waiting = 8192;  // for senders that do not count
  static constexpr std::size_t longest_stripped = 255;

  struct Line {
    std::string text;        // without blanks and comments, in capital letters
    std::string message;     // of its last comment (MSG,…), as written
    bool too_long = false;   // the rest is missing
    bool cancelled = false;  // a jog cancel came after it: as a jog it has no effect
  };

  // Takes bytes as they came. Each real-time command goes to `act` at its place among the bytes.
  void receive(std::string_view bytes, const std::function<void(std::uint8_t)>& act);
  // Takes the next whole line, if there is one.
  std::optional<Line> pop_line();
  bool has_line() const { return ends_ > 0; }
  // Jogs among the lines that wait, also in a line that has only begun, are not to move.
  void cancel_jogs();
  // Drops all that waits.
  void clear();

  std::size_t free() const { return waiting_.size() >= told_size ? 0 : told_size - waiting_.size(); }
  bool wants_more() const { return waiting_.size() < most_waiting; }

 private:
  // Whether a byte is a command now, and what it is.
  std::optional<std::uint8_t> command(std::uint8_t byte);

  std::string waiting_;
  std::size_t ends_ = 0;       // line ends in waiting_
  std::size_t cancelled_ = 0;  // lines from the first one on
  int text_bytes_ = 0;         // how many bytes of a UTF-8 character are still to come
  bool command_next_ = false;  // after C2
  bool after_return_ = false;
};

}  // namespace passo
