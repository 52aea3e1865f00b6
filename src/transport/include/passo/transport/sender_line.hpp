// SenderLine: where a sender of G-code comes in and goes: a TCP port, or a pseudo-terminal that looks like a serial
// port. One sender at a time.
//
// Nothing here waits, so one loop can serve a machine and any number of lines. What cannot be sent at once is kept; a
// sender that reads nothing for so long that `most_unsent` bytes wait is sent away. What is not read stays with the
// operating system, and so the sender is held up.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

#include "passo/base/result.hpp"

namespace passo {

class SenderLine {
 public:
  static constexpr std::size_t most_unsent = std::size_t{256} * 1024;

  // Listens at a TCP address; port 0: any that is free. The errors are sentences with the reason.
  static Result<std::unique_ptr<SenderLine>, std::string> listen(const std::string& host, unsigned port);
  // Makes a pseudo-terminal, and a link to it at `link`. A sender opens the link like a serial port.
  static Result<std::unique_ptr<SenderLine>, std::string> open_terminal(const std::string& link);
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
  News look(bool reads);
  // Sends whole lines, in one write where the other side takes it.
  void send(std::string_view text);
  bool is_connected() const { return connected_; }

 private:
  SenderLine() = default;
  void take_caller(News& news);
  void read_bytes(News& news);
  void send_unsent();
  void close_sender();
  bool has_reader() const;

  std::string name_;
  std::string link_;  // to be removed
  unsigned port_ = 0;
  int listening_ = -1;
  int sender_ = -1;  // the connection; of a pseudo-terminal, the end that is ours
  bool is_terminal_ = false;
  bool connected_ = false;
  bool broken_ = false;
  std::string unsent_;
};

}  // namespace passo
