// WebServer by Boost.Beast 1.74, with handlers: coroutines of Asio 1.74 and clang 14 do not go together.
#include "passo/web/web_server.hpp"

#include <algorithm>
#include <charconv>
#include <deque>
#include <optional>
#include <unordered_set>
#include <utility>

#include "picture_viewer.hpp"
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

namespace passo {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Error = beast::error_code;
using Text = std::shared_ptr<const std::string>;

constexpr std::uint32_t longest_header = 8192;
constexpr std::uint64_t any_length = std::uint64_t{1} << 40;
constexpr std::size_t read_buffer = 16'384;
// So little of the stream waits in the operating system that a slow watcher sees what is, and not what was.
constexpr int send_buffer = 65'536;
constexpr std::size_t most_answers = 16;
constexpr int usual_rate = 10;
constexpr int highest_rate = 60;
constexpr auto before_next_look = std::chrono::milliseconds(10);
constexpr auto before_next_accept = std::chrono::milliseconds(20);
// Where no file is left, newcomers would push one another out before they are heard.
constexpr auto time_to_ask = std::chrono::milliseconds(50);

std::string_view view(beast::string_view text) {
  return {text.data(), text.size()};
}

std::chrono::steady_clock::duration pace_of(std::string_view query) {
  const std::string_view digits = query_value(query, "hz");
  int rate = usual_rate;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rate);
  if (error != std::errc()) rate = usual_rate;
  // A little less, so that a message that comes a moment early is not skipped.
  return std::chrono::microseconds(900'000 / std::clamp(rate, 1, highest_rate));
}

}  // namespace

class WebServer::Implementation {
 public:
  class Connection;
  class Watcher;

  Implementation(WebAccess who_may, WebHandler& answers, const WebLimits& bounds)
      : access(std::move(who_may)), handler(answers), limits(bounds), acceptor(context), pause(context) {
    viewers.read_within = limits.answer_read_within;
  }
  ~Implementation();

  void accept();
  void make_room(std::chrono::steady_clock::duration after = {});

  // All of them, for the end: a connection keeps itself alive by what it waits for in the context. So these outlive the
  // context.
  std::unordered_set<Connection*> open;
  std::unordered_set<Watcher*> watching;
  PictureViewers viewers;
  std::size_t large_bodies = 0;
  asio::io_context context{1};
  WebAccess access;
  WebHandler& handler;
  WebLimits limits;
  tcp::acceptor acceptor;
  asio::steady_timer pause;
  Text newest;
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;
  std::uint64_t skipped = 0;
  std::uint64_t watchers_ever = 0;
  bool accepts = false;  // false: it waits until a newcomer can be let in again
};

// A client of the stream.
class WebServer::Implementation::Watcher : public std::enable_shared_from_this<Watcher> {
 public:
  Watcher(Implementation& server, beast::tcp_stream stream, std::chrono::steady_clock::duration pace)
      : server_(server), stream_(std::move(stream)), pace_(pace) {
    server_.watching.insert(this);
  }
  ~Watcher() {
    server_.watching.erase(this);
    server_.handler.gone(number_);
  }

  void start(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(stream_).expires_never();
    websocket::stream_base::timeout timeout{};
    timeout.handshake_timeout = server_.limits.header_within;
    timeout.idle_timeout = server_.limits.stream_dead_after;
    timeout.keep_alive_pings = true;
    stream_.set_option(timeout);
    stream_.read_message_max(server_.limits.message);
    stream_.async_accept(request, [self = shared_from_this()](Error error) {
      if (error) return;
      self->accepted_ = true;
      self->read();
      self->send();
    });
  }
  void close() { beast::get_lowest_layer(stream_).close(); }
  // It always hears; what it says may wait for room.
  pollfd awaited() {
    const auto events = static_cast<short>(writing_ || !accepted_ ? POLLIN | POLLOUT : POLLIN);
    return {.fd = beast::get_lowest_layer(stream_).socket().native_handle(), .events = events, .revents = 0};
  }

  // There is a new message.
  void offer() {
    if (!accepted_) return;
    if (writing_) {
      ++server_.skipped;
      return;
    }
    send();
  }

 private:
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
      if (!error) self->hear();
    });
  }

  void hear() {
    std::string answer = server_.handler.hear(beast::buffers_to_string(buffer_.data()), number_);
    buffer_.consume(buffer_.size());
    if (!answer.empty()) answers_.push_back(std::make_shared<const std::string>(std::move(answer)));
    if (answers_.size() > most_answers) return close();  // it asks, and does not read
    send();
    read();
  }

  void send() {
    if (writing_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!answers_.empty()) {
      sending_ = std::move(answers_.front());
      answers_.pop_front();
    } else if (server_.newest && server_.newest != seen_ && now - sent_at_ >= pace_) {
      sending_ = seen_ = server_.newest;
      sent_at_ = now;
    } else {
      return;
    }
    writing_ = true;
    stream_.text(true);
    stream_.async_write(asio::buffer(*sending_), [self = shared_from_this()](Error error, std::size_t) {
      self->writing_ = false;
      if (!error) self->send();
    });
  }

  Implementation& server_;
  std::uint64_t number_ = ++server_.watchers_ever;
  websocket::stream<beast::tcp_stream> stream_;
  std::chrono::steady_clock::duration pace_;
  std::chrono::steady_clock::time_point sent_at_;
  beast::flat_buffer buffer_;
  std::deque<Text> answers_;
  Text sending_;
  Text seen_;
  bool accepted_ = false;
  bool writing_ = false;
};

// A client that asks, one request after the other.
class WebServer::Implementation::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Implementation& server, tcp::socket socket)
      : server_(server), stream_(std::move(socket)), later_(server.context), buffer_(read_buffer) {
    server_.open.insert(this);
  }
  ~Connection() {
    server_.open.erase(this);
    give_back_body();
  }

  void start() { read_header(); }
  void close() {
    later_.cancel();
    stream_.close();
  }
  // Who goes first where there is no room: those who have not asked yet, then those who have waited longest.
  std::pair<bool, std::chrono::steady_clock::time_point> standing() const { return {asks_, since_}; }
  // Without an event that it waits for, one that has gone would wake the loop again and again.
  pollfd awaited() {
    return {.fd = awaits_ != 0 ? stream_.socket().native_handle() : -1, .events = awaits_, .revents = 0};
  }

 private:
  using Parser = http::request_parser<http::string_body>;

  void read_header() {
    awaits_ = POLLIN;
    asks_ = false;
    since_ = std::chrono::steady_clock::now();
    parser_.emplace();
    parser_->header_limit(longest_header);
    parser_->body_limit(any_length);  // the limit is known once the path is
    stream_.expires_after(server_.limits.header_within);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (error == http::error::end_of_stream || error == beast::error::timeout) return self->close();
      if (error == http::error::header_limit) return self->refuse(431);
      if (error == http::error::body_limit) return self->refuse(413);
      if (error.category() == http::make_error_code(http::error::bad_method).category()) return self->refuse(400);
      if (!error) self->take_header();
    });
  }

  // Nothing of a body is read for a caller who may not ask, or that is too long.
  void take_header() {
    asks_ = true;
    const auto& header = parser_->get();
    const std::string_view target = view(header.target());
    const std::size_t mark = std::min(target.find('?'), target.size());
    request_ = WebRequest{.method = std::string(view(header.method_string())),
                          .path = std::string(target.substr(0, mark)),
                          .query = std::string(target.substr(std::min(mark + 1, target.size()))),
                          .key = std::string(view(header["X-Passo-Key"])),
                          .encodings = std::string(view(header[http::field::accept_encoding])),
                          .known = std::string(view(header[http::field::if_none_match])),
                          .type = std::string(view(header[http::field::content_type])),
                          .body = {}};
    const WebCaller caller{.host = view(header[http::field::host]),
                           .origin = view(header[http::field::origin]),
                           .authorization = view(header[http::field::authorization]),
                           .query = request_.query};
    const auto status = server_.access.refuse(caller);
    if (status && !(*status == 401 && server_.handler.is_public(request_))) return refuse(*status);
    service_ = server_.handler.find(request_);
    if (websocket::is_upgrade(header)) return upgrade();
    if (service_.is_pictures) return view_pictures();
    const std::size_t longest = service_.longest_body;
    const auto length = parser_->content_length();
    if (length && *length > longest) return refuse(413);
    if (length.value_or(longest) > server_.limits.small_body) {
      if (server_.large_bodies >= server_.limits.large_bodies) return refuse(503);
      ++server_.large_bodies;
      large_body_ = true;
    }
    parser_->body_limit(longest);
    if (view(header[http::field::expect]) == "100-continue") return invite_body();
    read_body();
  }

  // The client waits for these words before it sends its body.
  void invite_body() {
    static constexpr std::string_view words = "HTTP/1.1 100 Continue\r\n\r\n";
    awaits_ = POLLOUT;
    asio::async_write(stream_, asio::buffer(words), [self = shared_from_this()](Error error, std::size_t) {
      if (!error) self->read_body();
    });
  }

  void read_body() {
    awaits_ = POLLIN;
    stream_.expires_after(large_body_ ? server_.limits.body_within : server_.limits.header_within);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (error == http::error::body_limit) return self->refuse(413);
      if (!error) self->answer();
    });
  }

  void answer() {
    ++server_.requests;
    request_.body = std::move(parser_->get().body());
    WebAnswer answer = service_.answer(request_);
    request_.body = std::string();
    give_back_body();
    if (answer.later) return send_later(std::move(answer));
    send(std::move(answer), parser_->get().keep_alive());
  }

  // Nothing is awaited of the client meanwhile.
  void send_later(WebAnswer answer) {
    awaits_ = 0;
    stream_.expires_never();
    later_.expires_after(before_next_look);
    later_.async_wait([self = shared_from_this(), answer = std::move(answer)](Error cancelled) mutable {
      if (cancelled || !self->stream_.socket().is_open()) return;
      WebAnswer known;
      if (!answer.later(known)) return self->send_later(std::move(answer));
      self->send(std::move(known), self->parser_->get().keep_alive());
    });
  }

  void view_pictures() {
    if (server_.viewers.all.size() >= server_.limits.viewers) return refuse(503);
    ++server_.requests;
    std::make_shared<PictureViewer>(server_.viewers, std::move(stream_))->start();
  }

  void upgrade() {
    if (!service_.is_stream) return refuse(404);
    if (server_.watching.size() >= server_.limits.watchers) return refuse(503);
    ++server_.requests;
    stream_.expires_never();
    std::make_shared<Watcher>(server_, std::move(stream_), pace_of(request_.query))->start(parser_->get());
  }

  // What is left of the request is not read, so the connection ends.
  void refuse(unsigned status) {
    ++server_.refused;
    send(server_.handler.refusal(status), false);
  }

  void send(WebAnswer answer, bool keeps_alive) {
    awaits_ = POLLOUT;
    response_ = {};
    response_.version(11);
    response_.result(answer.status);
    response_.set(http::field::content_type, answer.type);
    response_.set(http::field::cache_control, answer.cache.empty() ? "no-store" : answer.cache);
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Content-Security-Policy", answer.policy.empty() ? "frame-ancestors 'none'" : answer.policy);
    if (!answer.version.empty()) response_.set(http::field::etag, answer.version);
    if (!answer.cache.empty()) response_.set(http::field::vary, "Accept-Encoding");
    if (!answer.encoding.empty()) response_.set(http::field::content_encoding, answer.encoding);
    if (!answer.allow.empty()) response_.set(http::field::allow, answer.allow);
    if (answer.status == 401) response_.set(http::field::www_authenticate, "Bearer");
    response_.body() = std::move(answer.body);
    response_.keep_alive(keeps_alive);
    response_.prepare_payload();
    stream_.expires_after(server_.limits.answer_read_within);
    http::async_write(stream_, response_, [self = shared_from_this(), keeps_alive](Error error, std::size_t) {
      if (error) return;
      if (keeps_alive) return self->read_header();
      Error ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  void give_back_body() {
    if (std::exchange(large_body_, false)) --server_.large_bodies;
  }

  Implementation& server_;
  beast::tcp_stream stream_;
  asio::steady_timer later_;
  beast::flat_buffer buffer_;
  std::optional<Parser> parser_;
  http::response<http::string_body> response_;
  WebRequest request_;
  WebService service_;
  short awaits_ = POLLIN;
  bool large_body_ = false;
  bool asks_ = false;  // a whole header has come
  std::chrono::steady_clock::time_point since_;
};

// Closing ends all that is waited for. The handlers then run once more, and let the connections go.
WebServer::Implementation::~Implementation() {
  Error ignored;
  acceptor.close(ignored);
  pause.cancel();
  for (Connection* const one : open) one->close();
  for (Watcher* const one : watching) one->close();
  for (PictureViewer* const one : viewers.all) one->close();
  context.restart();
  context.poll();
}

// Whoever comes may want to hold the machine. So a newcomer never waits for those who keep connections open: watchers
// have a limit of their own, and of the others one goes, if it has waited for `after`.
void WebServer::Implementation::make_room(std::chrono::steady_clock::duration after) {
  if (open.empty()) return;
  Connection* const first = *std::ranges::min_element(open, {}, [](const Connection* one) { return one->standing(); });
  if (std::chrono::steady_clock::now() - first->standing().second < after) return;
  ++refused;
  open.erase(first);  // it lives until what it waits for has ended
  first->close();
}

void WebServer::Implementation::accept() {
  accepts = true;
  acceptor.async_accept([this](Error error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) {  // for instance too many open files: that may pass
      accepts = false;
      if (error == asio::error::no_descriptors) make_room(time_to_ask);
      pause.expires_after(before_next_accept);
      pause.async_wait([this](Error cancelled) {
        if (!cancelled) accept();
      });
      return;
    }
    if (open.size() + watching.size() + viewers.all.size() >= limits.connections) make_room();
    Error ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(send_buffer), ignored);
    std::make_shared<Connection>(*this, std::move(socket))->start();
    accept();
  });
}

Result<std::unique_ptr<WebServer>, std::string> WebServer::listen(const std::string& host, unsigned port,
                                                                  WebAccess access, WebHandler& handler,
                                                                  const WebLimits& limits) {
  auto implementation = std::make_unique<Implementation>(std::move(access), handler, limits);
  Error error;
  tcp::resolver resolver(implementation->context);
  const auto found = resolver.resolve(host, std::to_string(port), tcp::resolver::passive, error);
  const auto failed = [&] { return Failure{host + ":" + std::to_string(port) + ": " + error.message()}; };
  if (error) return failed();
  tcp::acceptor& acceptor = implementation->acceptor;
  const tcp::endpoint place = found.begin()->endpoint();
  acceptor.open(place.protocol(), error);
  if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(place, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) return failed();
  implementation->accept();
  return std::unique_ptr<WebServer>(new WebServer(std::move(implementation)));
}

WebServer::WebServer(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
WebServer::~WebServer() = default;

unsigned WebServer::port() const {
  Error ignored;
  return implementation_->acceptor.local_endpoint(ignored).port();
}

void WebServer::poll(int steps) {
  for (int done = 0; done < steps && implementation_->context.poll_one() > 0; ++done) {
  }
}

void WebServer::add_to(std::vector<pollfd>& all) const {
  const auto add = [&all](pollfd one) {
    if (one.fd >= 0) all.push_back(one);
  };
  // A newcomer who cannot be let in yet would let nobody sleep.
  if (implementation_->accepts) add({.fd = implementation_->acceptor.native_handle(), .events = POLLIN, .revents = 0});
  for (Implementation::Connection* const one : implementation_->open) add(one->awaited());
  for (Implementation::Watcher* const one : implementation_->watching) add(one->awaited());
  for (PictureViewer* const one : implementation_->viewers.all) add(one->awaited());
}

void WebServer::publish(std::string message) {
  implementation_->newest = std::make_shared<const std::string>(std::move(message));
  // A watcher that is sent away meanwhile takes itself out of the set.
  const std::vector<Implementation::Watcher*> all(implementation_->watching.begin(), implementation_->watching.end());
  for (Implementation::Watcher* const one : all) one->offer();
}

void WebServer::show(std::shared_ptr<const std::string> jpeg) {
  implementation_->viewers.newest = std::move(jpeg);
  const std::vector<PictureViewer*> all(implementation_->viewers.all.begin(), implementation_->viewers.all.end());
  for (PictureViewer* const one : all) one->offer();
}

std::size_t WebServer::connections() const {
  return implementation_->open.size() + implementation_->watching.size() + viewers();
}
std::size_t WebServer::viewers() const {
  return implementation_->viewers.all.size();
}
std::size_t WebServer::watchers() const {
  return implementation_->watching.size();
}
std::uint64_t WebServer::requests() const {
  return implementation_->requests;
}
std::uint64_t WebServer::refused() const {
  return implementation_->refused;
}
std::uint64_t WebServer::skipped() const {
  return implementation_->skipped;
}

}  // namespace passo
