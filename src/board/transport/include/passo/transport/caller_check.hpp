// CallerCheck: whether a caller at a port for senders of G-code is a sender. The first line decides.
//
// A browser lets any web page send a request to a port of this computer, with a body that the page has chosen. Read as
// G-code, the lines of that body would move the machine. So a caller whose first line begins as one of HTTP, TLS, SSH,
// RTSP, SIP or another protocol is a stranger, and no byte of a stranger passes.
//
// Senders need answers to `?`, Ctrl-X and other real-time bytes before they have sent a line. No request begins with
// such a byte, so these pass at once. Only what may begin a request is held back, which is letters: G could be that of
// GET. In G-code a digit follows soon; in a request a blank follows a word of three letters or more.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

class CallerCheck {
 public:
  enum class Caller : std::uint8_t { unknown, sender, stranger };
  // On a serial port, bytes that mean nothing may be noise.
  enum class Noise : std::uint8_t { none, possible };

  explicit CallerCheck(Noise noise = Noise::none) : noise_(noise) {}

  // The caller's next bytes. Returns those that may take effect now.
  [[nodiscard]] std::string pass(std::string_view bytes);
  Caller caller() const { return caller_; }
  // Another may call now, unless the line at hand is not judged yet.
  void begin_anew();
  // The caller has gone.
  void reset();

 private:
  void judge(char c);
  void judge_start(char c);

  Noise noise_;
  Caller caller_ = Caller::unknown;
  std::string held_;    // the letters that the first line begins with
  std::string passed_;  // of this call
};

}  // namespace passo
