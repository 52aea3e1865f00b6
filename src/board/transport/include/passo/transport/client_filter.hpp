// ClientFilter: decides whether a client of a G-code port is a sender, by its first line.
//
// A browser lets any web page send a request to a port of this computer, with a body chosen by the page. Read as
// G-code, the lines of that body would move the machine. So a client whose first line starts like HTTP, TLS, SSH, RTSP,
// SIP or another protocol is rejected, and all of its bytes are dropped.
//
// Senders need answers to `?`, Ctrl-X and other real-time bytes before they have sent a line. No request starts with
// such a byte, so these pass at once. Only letters are held back, because they may start a request: G could be the
// first letter of GET. In G-code a digit follows soon; in a request a blank follows a word of at least three letters.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

class ClientFilter {
 public:
  enum class Caller : std::uint8_t { unknown, sender, stranger };
  // On a serial port, invalid bytes may be noise.
  enum class Noise : std::uint8_t { none, possible };

  explicit ClientFilter(Noise noise = Noise::none) : noise_(noise) {}

  // Checks the client's next bytes. Returns those that may take effect now.
  [[nodiscard]] std::string pass(std::string_view bytes);
  Caller caller() const { return caller_; }
  // Prepares for another client, unless the current line is still being checked.
  void begin_anew();
  // Call when the client has disconnected.
  void reset();

 private:
  void judge(char c);
  void judge_start(char c);

  Noise noise_;
  Caller caller_ = Caller::unknown;
  std::string held_;    // the letters at the start of the first line
  std::string passed_;  // the bytes that pass() returns
};

}  // namespace passo
