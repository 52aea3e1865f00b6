// SenderConnection: the connection of a G-code sender: a TCP port, a pseudo-terminal that looks like a serial port, or
// a serial port. One sender at a time.
//
// A serial port does not show whether a sender is connected. A sender counts as connected when it sends something. A
// sender that has been silent for `serial_silence` can be replaced by another one: see yields(). A port whose device
// disappears is opened again when the device is back.
//
// A client whose first line belongs to another protocol, such as a browser's, is not a sender (ClientFilter). Its TCP
// connection is closed; input from a terminal or serial port is dropped until the terminal is closed or the port has
// been silent for `serial_pause`.
//
// No function waits, so one loop can serve a machine and any number of connections. Bytes that cannot be sent at once
// are kept; a sender that reads nothing is disconnected when `most_unsent` bytes wait. Unread input stays in the
// operating system's buffer, which throttles the sender.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

#include "passo/base/result.hpp"
#include "passo/transport/client_filter.hpp"

namespace passo {

class SenderConnection {
 public:
  static constexpr std::size_t most_unsent = std::size_t{256} * 1024;
  // An active sender queries the status several times a second.
  static constexpr std::chrono::seconds serial_silence{10};
  // After this silence, another sender may be at the serial port.
  static constexpr std::chrono::seconds serial_pause{1};

  // Listens at a TCP address; port 0: a free port. The errors are sentences with the reason.
  static Result<std::unique_ptr<SenderConnection>, std::string> listen(const std::string& host, unsigned port);
  // Makes a pseudo-terminal, and a link to it at `link`. A sender opens the link like a serial port.
  static Result<std::unique_ptr<SenderConnection>, std::string> open_terminal(const std::string& link);
  // Opens a serial port.
  static Result<std::unique_ptr<SenderConnection>, std::string> open_serial(const std::string& device, unsigned baud);
  ~SenderConnection();
  SenderConnection(const SenderConnection&) = delete;
  SenderConnection& operator=(const SenderConnection&) = delete;

  // The display name: "tcp:127.0.0.1:7071", or the path of the link.
  const std::string& name() const { return name_; }
  unsigned port() const { return port_; }

  // Adds the descriptors and events to wait for. `reads`: also wait for bytes from the sender.
  void add_to(std::vector<pollfd>& all, bool reads) const;
  struct News {
    bool came = false;
    bool went = false;
    std::string bytes;
  };
  // Returns what has happened since the last call.
  News poll(bool reads);
  // Sends whole lines, in one write if the other side accepts it.
  void send(std::string_view text);
  bool is_connected() const { return connected_; }
  // True if the sender may have disconnected unnoticed.
  bool yields() const { return kind_ == Kind::serial && Clock::now() - heard_ > serial_silence; }
  // Treats the sender as disconnected.
  void part() { connected_ = false; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Kind : unsigned char { network, terminal, serial };

  SenderConnection() = default;
  void hear_serial(News& news, bool reads);
  void accept_client(News& news);
  void read_bytes(News& news);
  void send_unsent();
  void close_sender();
  bool has_reader() const;

  std::string name_;
  std::string link_;  // path of the link, to be removed at the end
  unsigned port_ = 0;
  int listening_ = -1;
  int sender_ = -1;  // the connection, our end of the pseudo-terminal, or the serial port
  Kind kind_ = Kind::network;
  unsigned baud_ = 0;
  ClientFilter check_;
  Clock::time_point heard_;
  Clock::time_point tried_;       // time of the last attempt to open the device again
  Clock::time_point accepts_at_;  // the earliest time for the next accept: there was no room for a client
  bool connected_ = false;
  bool broken_ = false;
  std::string unsent_;
};

}  // namespace passo
