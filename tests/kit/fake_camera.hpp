// A camera with a server of its own, for tests: an MJPEG stream, good or with one of the faults of real ones.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo::test {

// Not a picture for eyes, but with the marks at its start and its end.
inline std::string fake_jpeg(int number, std::size_t bytes = 200) {
  std::string picture = "\xFF\xD8\xFF\xE0picture " + std::to_string(number) + " ";
  picture.resize(std::max(bytes, picture.size()), 'x');
  return picture + "\xFF\xD9";
}

class FakeCamera {
 public:
  enum class Habit {
    stream,           // as ustreamer and mjpg-streamer
    chunked,          // as ESP32-CAM: in chunks, and the first part has no delimiter
    without_length,   // parts without Content-Length
    still,            // a single JPEG
    slow,             // a picture each 80 ms, byte by byte at its start
    stalls,           // one picture, and nothing more
    silent,           // accepts, and says nothing
    broken_boundary,  // a delimiter that was not announced
    short_length,     // states less than a picture has
    long_length,      // states more
    huge,             // announces a picture of 100 MiB
    endless,          // a picture without an end
    text,             // a web page
    redirects,        // to another server
    closes,           // one picture, then it closes the connection
  };

  explicit FakeCamera(Habit habit) : habit_(habit) { come_back(); }
  ~FakeCamera() { go(); }
  FakeCamera(const FakeCamera&) = delete;
  FakeCamera& operator=(const FakeCamera&) = delete;

  unsigned port() const { return port_; }
  std::string url(const std::string& path = "/stream") const {
    return "http://127.0.0.1:" + std::to_string(port_) + path;
  }
  void change(Habit habit) { habit_ = habit; }
  int connections() const { return connections_; }  // so far
  int open() const { return open_; }                // now
  std::string last_request() const {
    const std::lock_guard lock(mutex_);
    return last_request_;
  }

  // Switched off: nobody listens at the port.
  void go() {
    ends_ = true;
    if (thread_.joinable()) thread_.join();
  }
  void come_back() {
    ends_ = false;
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int on = 1;
    setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_, 8), 0);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { run(); });
  }

 private:
  void run() {
    while (!ends_) {
      pollfd one{.fd = listener_, .events = POLLIN, .revents = 0};
      if (poll(&one, 1, 10) <= 0) continue;
      const int client = accept(listener_, nullptr, nullptr);
      if (client < 0) continue;
      ++connections_;
      ++open_;
      serve(client);
      close(client);
      --open_;
    }
    close(listener_);
  }
  // Returns false once the client has gone, or the camera is switched off.
  bool wait(int client, int milliseconds) const {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    do {
      pollfd one{.fd = client, .events = POLLIN, .revents = 0};
      if (poll(&one, 1, 2) > 0) return false;  // it says nothing after its request
      if (ends_) return false;
    } while (std::chrono::steady_clock::now() < until);
    return true;
  }
  bool send_all(int client, std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent > 0) bytes.remove_prefix(static_cast<std::size_t>(sent));
      if (sent <= 0 && !wait(client, 1)) return false;
    }
    return true;
  }
  void serve(int client) {
    char bytes[4096];
    const ssize_t got = recv(client, bytes, sizeof bytes, 0);
    const std::string request(bytes, static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    {
      const std::lock_guard lock(mutex_);
      last_request_ = request;
    }
    const Habit habit = habit_;
    if (habit == Habit::silent) return void(wait(client, 600'000));
    if (habit == Habit::redirects) {
      return void(send_all(client, "HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:1/secret\r\n\r\n"));
    }
    if (habit == Habit::text) return void(send_all(client, "HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n\r\nhello"));
    if (habit == Habit::still || request.starts_with("GET /snapshot")) {
      const std::string picture = fake_jpeg(++number_);
      return void(send_all(client, "HTTP/1.1 200 OK\r\nContent-Type: image/jpeg\r\nContent-Length: " +
                                       std::to_string(picture.size()) + "\r\n\r\n" + picture));
    }
    stream(client, habit);
  }
  void stream(int client, Habit habit) {
    const bool is_chunked = habit == Habit::chunked;
    const auto say = [&](const std::string& text) {
      if (!is_chunked) return send_all(client, text);
      char size[20];
      static_cast<void>(std::snprintf(size, sizeof size, "%zx\r\n", text.size()));
      return send_all(client, size + text + "\r\n");
    };
    const std::string delimiter = habit == Habit::broken_boundary ? "--other\r\n" : "--cut\r\n";
    if (!send_all(client, std::string("HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary=cut\r\n") +
                              (is_chunked ? "Transfer-Encoding: chunked\r\n\r\n" : "\r\n")) ||
        (!is_chunked && !say(delimiter))) {
      return;
    }
    for (bool goes_on = true; goes_on;) {
      const std::string picture = fake_jpeg(++number_);
      std::size_t length = picture.size();
      if (habit == Habit::short_length) length -= 50;
      if (habit == Habit::long_length) length += 50;
      if (habit == Habit::huge) length = std::size_t{100} << 20U;
      const bool has_length = habit != Habit::without_length && habit != Habit::endless;
      say("Content-Type: image/jpeg\r\n" +
          (has_length ? "Content-Length: " + std::to_string(length) + "\r\n\r\n" : std::string("\r\n")));
      if (habit == Habit::endless) {
        while (say(std::string(60'000, 'x'))) {
        }
        return;
      }
      for (std::size_t i = 0; habit == Habit::slow && i < 20; ++i) {
        if (!say(picture.substr(i, 1)) || !wait(client, 4)) return;
      }
      goes_on = say(habit == Habit::slow ? picture.substr(20) : picture) && say("\r\n" + delimiter);
      if (habit == Habit::closes) return;
      goes_on = goes_on && wait(client, habit == Habit::stalls ? 600'000 : 5);
    }
  }

  std::atomic<Habit> habit_;
  std::atomic<bool> ends_ = false;
  std::atomic<int> connections_ = 0;
  std::atomic<int> open_ = 0;
  std::atomic<int> number_ = 0;  // of the last picture
  unsigned port_ = 0;
  int listener_ = -1;
  mutable std::mutex mutex_;  // for the next
  std::string last_request_;
  std::thread thread_;
};

}  // namespace passo::test
