// CameraConnection: a TCP connection to a camera, with a request that has been sent. For CameraFeed's thread: each call
// waits a limited time. Private to camera/.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "passo/base/http_url.hpp"
#include "passo/units/units.hpp"

namespace passo {

class CameraConnection {
 public:
  // Connects, and sends a GET request. `gives_up`: asked often while it waits. Empty: the camera cannot be reached.
  static std::optional<CameraConnection> open(const HttpUrl& url, Seconds within,
                                              const std::function<bool()>& gives_up);
  ~CameraConnection();
  CameraConnection(CameraConnection&& other) noexcept;
  CameraConnection& operator=(CameraConnection&&) = delete;

  enum class Read : std::uint8_t { nothing, bytes, closed };
  // Waits for bytes, at most for a moment.
  Read read(std::string& bytes) const;

 private:
  explicit CameraConnection(int socket) : socket_(socket) {}
  int socket_;
};

}  // namespace passo
