// WebServer: serves HTTP and WebSocket on one TCP port, within the caller's event loop.
//
// Position in the pipeline: outside it, the entry point for programs and browsers. It is independent of machines: a
// WebHandler produces the responses. Boost.Beast is used only behind this header.
//
// Nothing blocks, and there is no thread: poll() executes a limited number of steps that are ready, so only the owner's
// thread calls the handler. A client that does not read or send in time loses its connection: connections, bodies,
// messages and times are limited (WebLimits). A stream client that reads slowly skips messages, and gets the newest one
// when it has read the last.
//
// A new connection is always accepted: if the maximum is reached, an idle connection is closed, preferably one that has
// not sent a request. Clients that keep connections open can therefore not delay a request to hold the machine.
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
  // Headers; empty: the defaults of a response that is never cached.
  std::string encoding = {};  // Content-Encoding
  std::string version = {};   // ETag
  std::string cache = {};     // Cache-Control
  std::string policy = {};    // Content-Security-Policy
  std::string allow = {};     // Allow; empty: none
  // Not empty: the response is not known yet. The server calls this function often, until it has filled in the response
  // and returns true. It must do so within a limited time.
  std::function<bool(WebAnswer& answer)> later = {};
};

// What a handler does with a request. Found once, when the header is known.
struct WebService {
  std::size_t longest_body = 0;                                     // bytes; a longer body is refused, and not read
  bool is_stream = false;                                           // the stream for WebSocket clients is here
  bool is_pictures = false;                                         // the stream of pictures is here
  std::function<WebAnswer(const WebRequest& request)> answer = {};  // called once the body is read
};

class WebHandler {
 public:
  virtual ~WebHandler() = default;
  // Finds the service for a request. `head`: the request without its body.
  virtual WebService find(const WebRequest& head) = 0;
  // Formats an error response of the server itself like those of the handler.
  virtual WebAnswer refusal(unsigned status) = 0;
  // Returns true if the request does not need the token. Host and Origin are checked nevertheless.
  virtual bool is_public(const WebRequest&) { return false; }
  // Processes a message from a stream client. Returns the response; empty: none.
  virtual std::string hear(std::string_view message, std::uint64_t client) = 0;
  // A stream client has disconnected, or has not responded for `stream_dead_after`. Its number is never reused.
  virtual void gone(std::uint64_t) {}
};

struct WebLimits {
  std::size_t connections = 700;
  std::size_t watchers = 600;                     // maximum number of stream clients; the other connections are
                                                  // reserved for requests
  std::size_t viewers = 8;                        // maximum number of clients of the picture stream
  std::size_t large_bodies = 4;                   // maximum number of large bodies at the same time
  std::size_t small_body = std::size_t{1} << 16;  // bytes; a longer body is a large body
  std::size_t message = std::size_t{1} << 14;     // maximum message length of a stream client, bytes
  std::chrono::seconds header_within{10};
  std::chrono::seconds body_within{120};
  std::chrono::seconds answer_read_within{30};
  std::chrono::seconds stream_dead_after{10};  // time without a response to a ping
};

class WebServer {
 public:
  // Listens at an address; port 0: any free port. The error is a sentence with the reason. `handler` must outlive the
  // server.
  static Result<std::unique_ptr<WebServer>, std::string> listen(const std::string& host, unsigned port,
                                                                WebAccess access, WebHandler& handler,
                                                                const WebLimits& limits = {});
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  unsigned port() const;
  // Adds the server's file descriptors, so that the event loop can sleep until there is something to do.
  void add_to(std::vector<pollfd>& all) const;
  // Processes what is ready, but at most `steps` steps.
  void poll(int steps = 256);
  // Sends a new message to all stream clients, each at most as often as it has requested (?hz=1 to 60, default 10).
  void publish(std::string message);
  // Sends a JPEG to all clients of the picture stream (multipart/x-mixed-replace). A client that has not read the
  // previous one yet skips pictures, and gets the newest one then.
  void show(std::shared_ptr<const std::string> jpeg);

  std::size_t connections() const;
  std::size_t watchers() const;  // number of stream connections
  std::size_t viewers() const;   // number of connections of the picture stream
  std::uint64_t requests() const;
  std::uint64_t refused() const;  // number of refused requests and connections
  std::uint64_t skipped() const;  // number of messages skipped for slow clients

 private:
  class Implementation;
  explicit WebServer(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
