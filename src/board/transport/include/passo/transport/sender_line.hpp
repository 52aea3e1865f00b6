// SenderLine: where a sender of G-code comes in and goes: a TCP port, a pseudo-terminal that looks like a serial port,
// or a serial port. One sender at a time.
//
// A serial port does not tell whether anybody is there. A sender has come when it says something. Whoever has said
// nothing for `serial_silence` counts as gone as soon as another sender wants the machine: see yields(). A port
// whose device goes away is opened again when it is back.
//
// A caller whose first line is that of another protocol, such as a browser's, is no sender (CallerCheck). A connection
// is then closed; of a terminal or a serial port, what is said is dropped, until the terminal is closed or the port was
// silent for `serial_pause`.
//
// Nothing here waits, so one loop can serve a machine and any number of lines. What cannot be sent at once is kept; a
// sender that reads nothing for so long that `most_unsent` bytes wait is sent away. What is not read stays with the
// operating system, and so the sender is held up.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

#include "passo/base/result.hpp"
#include "passo/transport/caller_check.hpp"

namespace passo {

class SenderLine {
 public:
  static constexpr std::size_t most_unsent = std::size_t{256} * 1024;
  // A sender that works asks for the status several times a second.
  static constexpr std::chrono::seconds serial_silence{10};
  // After this, somebody else may be at a serial port.
  static constexpr std::chrono::seconds serial_pause{1};

  // Listens at a TCP address; port 0: any that is free. The errors are sentences with the reason.
  static Result<std::unique_ptr<SenderLine>, std::string> listen(const std::string& host, unsigned port);
  // Makes a pseudo-terminal, and a link to it at `link`. A sender opens the link like a serial port.
  static Result<std::unique_ptr<SenderLine>, std::string> open_terminal(const std::string& link);
  // Opens a serial port.
  static Result<std::unique_ptr<SenderLine>, std::string> open_serial(const std::string& device, unsigned baud);
  ~SenderLine();
  SenderLine(const SenderLine&) = delete;
  SenderLine& operator=(const SenderLine&) = delete;

  // What to call it: "tcp:127.0.0.1:7071", or the link.
  const std::string& name() const { return name_; }
  unsigned port() const { return port_; }

  // Adds what to wait for. `reads`: also for bytes of the sender.
  void add_to(std::vector<pollfd>& all, bool reads) const;
  struct News {
    bool came = false;
    bool went = false;
    std::string bytes;
  };
  // What has happened since the last call.
  News poll(bool reads);
  // Sends whole lines, in one write where the other side takes it.
  void send(std::string_view text);
  bool is_connected() const { return connected_; }
  // The sender may have gone without a sign.
  bool yields() const { return kind_ == Kind::serial && Clock::now() - heard_ > serial_silence; }
  // Takes the sender for gone.
  void part() { connected_ = false; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Kind : unsigned char { network, terminal, serial };

  SenderLine() = default;
  void hear_serial(News& news, bool reads);
  void accept_client(News& news);
  void read_bytes(News& news);
  void send_unsent();
  void close_sender();
  bool has_reader() const;

  std::string name_;
  std::string link_;  // to be removed
  unsigned port_ = 0;
  int listening_ = -1;
  int sender_ = -1;  // the connection; of a pseudo-terminal, the end that is ours; the serial port
  Kind kind_ = Kind::network;
  unsigned baud_ = 0;
  CallerCheck check_;
  Clock::time_point heard_;
  Clock::time_point tried_;       // to open the device again
  Clock::time_point accepts_at_;  // not before: there was no room for a caller
  bool connected_ = false;
  bool broken_ = false;
  std::string unsent_;
};

}  // namespace passo
