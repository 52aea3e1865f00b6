// WebServer: HTTP and WebSocket at one TCP port, for the owner of a loop.
//
// Position in the pipeline: outside it, the entry point for programs and browsers. It knows nothing of machines: a
// WebHandler answers. Boost.Beast is behind this header and nowhere else.
//
// Nothing here waits, and there is no thread: poll() does a bounded number of steps that are ready. So the handler is
// called by the owner's thread alone. What a client does not read or send in time costs that client its connection:
// connections, bodies, messages and times are bounded (WebLimits). A watcher of the stream that reads slowly skips
// messages, and gets the newest one when it has read the last.
//
// A newcomer always gets in: where all connections are taken, one of those that wait goes, first of all one that has
// not asked anything. So nobody who keeps connections open delays a request to hold the machine.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <poll.h>

#include "passo/base/result.hpp"
#include "passo/web/web_access.hpp"

namespace passo {

struct WebRequest {
  std::string method = {};  // "GET", "POST" …
  std::string path = {};    // "/api/v1/status": without the query, not decoded
  std::string query = {};
  std::string key = {};        // the header X-Passo-Key
  std::string encodings = {};  // the header Accept-Encoding
  std::string known = {};      // the header If-None-Match
  std::string type = {};       // the header Content-Type
  std::string body = {};
};

struct WebAnswer {
  unsigned status = 200;
  std::string type = "application/json";
  std::string body = {};
  // Headers; empty: the usual ones of an answer that is never kept.
  std::string encoding = {};  // Content-Encoding
  std::string version = {};   // ETag
  std::string cache = {};     // Cache-Control
  std::string policy = {};    // Content-Security-Policy
  std::string allow = {};     // Allow; empty: none
};

// What a handler does with a request. Found once, when the header is known.
struct WebService {
  std::size_t longest_body = 0;                                     // bytes; a longer body is refused, and not read
  bool is_stream = false;                                           // the stream for WebSocket clients is here
  std::function<WebAnswer(const WebRequest& request)> answer = {};  // called once the body is read
};

class WebHandler {
 public:
  virtual ~WebHandler() = default;
  // `head`: the request without its body.
  virtual WebService find(const WebRequest& head) = 0;
  // What a server itself refuses is told in the handler's form too.
  virtual WebAnswer refusal(unsigned status) = 0;
  // True: also those who do not know the token may ask this. Host and Origin are checked all the same.
  virtual bool is_public(const WebRequest&) { return false; }
  // A client of the stream has sent a message. Returns the answer; empty: none.
  virtual std::string hear(std::string_view message, std::uint64_t client) = 0;
  // A client of the stream has left, or has not answered for `stream_dead_after`. Its number is never used again.
  virtual void gone(std::uint64_t) {}
};

struct WebLimits {
  std::size_t connections = 700;
  std::size_t watchers = 600;                     // of them: the rest is for requests
  std::size_t large_bodies = 4;                   // at once
  std::size_t small_body = std::size_t{1} << 16;  // bytes; what is longer is a large body
  std::size_t message = std::size_t{1} << 14;     // of a client of the stream
  std::chrono::seconds header_within{10};
  std::chrono::seconds body_within{120};
  std::chrono::seconds answer_read_within{30};
  std::chrono::seconds stream_dead_after{10};  // without an answer to a ping
};

class WebServer {
 public:
  // Listens at an address; port 0: any that is free. The error is a sentence with the reason. `handler` outlives the
  // server.
  static Result<std::unique_ptr<WebServer>, std::string> listen(const std::string& host, unsigned port,
                                                                WebAccess access, WebHandler& handler,
                                                                const WebLimits& limits = {});
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  unsigned port() const;
  // Adds what the server waits for, so that the owner of the loop may sleep until there is something to do.
  void add_to(std::vector<pollfd>& all) const;
  // Does what is ready, but no more than `steps` steps.
  void poll(int steps = 256);
  // Gives all clients of the stream a new message, each at most as often as it asked (?hz=1 to 60, else 10).
  void publish(std::string message);

  std::size_t connections() const;
  std::size_t watchers() const;  // connections to the stream
  std::uint64_t requests() const;
  std::uint64_t refused() const;  // requests and connections
  std::uint64_t skipped() const;  // messages that slow watchers did not get

 private:
  class Implementation;
  explicit WebServer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
