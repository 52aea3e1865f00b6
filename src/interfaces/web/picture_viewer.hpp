// PictureViewer: a client of the picture stream of WebServer. A part of web_server.cpp, the only source that sees
// Boost.Beast.
//
// The stream is multipart/x-mixed-replace (RFC 2046 section 5.1.1). The delimiter follows each picture at once, because
// browsers show a picture when the delimiter behind it has come. At most one picture per viewer waits to be sent.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <unordered_set>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <poll.h>

namespace passo {

class PictureViewer;

// The viewers of a server, and what they see. Must outlive the server's context.
struct PictureViewers {
  std::unordered_set<PictureViewer*> all = {};
  std::shared_ptr<const std::string> newest = {};  // null: none has come since the first viewer
  std::chrono::seconds read_within{30};
};

class PictureViewer : public std::enable_shared_from_this<PictureViewer> {
 public:
  PictureViewer(PictureViewers& others, boost::beast::tcp_stream stream) : others_(others), stream_(std::move(stream)) {
    if (others_.all.empty()) others_.newest.reset();
    others_.all.insert(this);
  }
  PictureViewer(const PictureViewer&) = delete;
  PictureViewer& operator=(const PictureViewer&) = delete;
  ~PictureViewer() { others_.all.erase(this); }

  void start() {
    before_ =
        "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\nCache-Control: no-store\r\n"
        "X-Content-Type-Options: nosniff\r\nContent-Security-Policy: frame-ancestors 'none'\r\n"
        "Cross-Origin-Resource-Policy: same-origin\r\nConnection: close\r\n\r\n--picture\r\n";
    write({boost::asio::buffer(before_), {}, {}});
    watch_end();
  }
  void close() { stream_.close(); }
  // There is a new picture.
  void offer() {
    if (!writing_) send();
  }
  pollfd awaited() {
    const auto events = static_cast<short>(writing_ ? POLLIN | POLLOUT : POLLIN);
    return {.fd = stream_.socket().native_handle(), .events = events, .revents = 0};
  }

 private:
  using Buffers = std::array<boost::asio::const_buffer, 3>;

  // A viewer says nothing more. It is read to notice when it goes, also while the camera is silent.
  void watch_end() {
    stream_.expires_never();
    stream_.async_read_some(boost::asio::buffer(ignored_),
                            [self = shared_from_this()](boost::beast::error_code error, std::size_t) {
                              if (error) return self->close();
                              self->watch_end();
                            });
  }

  void send() {
    if (!others_.newest || others_.newest == sending_) return;
    sending_ = others_.newest;
    before_ = "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(sending_->size()) + "\r\n\r\n";
    static constexpr std::string_view behind = "\r\n--picture\r\n";
    write({boost::asio::buffer(before_), boost::asio::buffer(*sending_), boost::asio::buffer(behind)});
  }

  void write(const Buffers& bytes) {
    writing_ = true;
    stream_.expires_after(others_.read_within);
    boost::asio::async_write(stream_, bytes, [self = shared_from_this()](boost::beast::error_code error, std::size_t) {
      self->writing_ = false;
      if (error) return self->close();
      self->send();
    });
  }

  PictureViewers& others_;
  boost::beast::tcp_stream stream_;
  std::string before_;
  std::shared_ptr<const std::string> sending_;  // the last one
  std::array<char, 256> ignored_{};
  bool writing_ = false;
};

}  // namespace passo
