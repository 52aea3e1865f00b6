// CameraFeed: fetches the pictures of an MJPEG camera by HTTP, while someone wants them.
//
// Position in the pipeline: outside it. Programs and browsers get the pictures from the web server; this is the only
// connection to the camera, and only the addresses that it is created with are fetched.
//
// Resolving a name, connecting and reading happen in a thread of their own, so that a camera never delays the machine.
// Only the newest picture is kept. A camera that is silent for too long, or sends something else, is disconnected and
// tried again, first soon, then at growing intervals.
#pragma once

#include <memory>
#include <optional>

#include "passo/api/camera.hpp"
#include "passo/base/http_url.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct CameraPace {
  Seconds connect_within{3};
  Seconds picture_within{5};  // from the connection or from the last picture
  Seconds first_retry{0.5};   // the interval doubles with each failure
  Seconds last_retry{10};
  Seconds between_snapshots{0.2};  // of a camera that has no stream
  Seconds wants_within{5};         // how long a single picture is wanted
  Seconds lingers{2};              // how long the stream stays open when no picture is wanted any more
};

class CameraFeed final : public Camera {
 public:
  CameraFeed(HttpUrl stream, std::optional<HttpUrl> snapshot, const CameraPace& pace = {});
  ~CameraFeed() override;
  CameraFeed(const CameraFeed&) = delete;
  CameraFeed& operator=(const CameraFeed&) = delete;

  void watch(bool is_watched) override;
  std::uint64_t want_picture() override;
  CameraPicture newest() override;
  CameraStatus status() override;

 private:
  class Fetcher;
  std::shared_ptr<Fetcher> fetcher_;
};

}  // namespace passo
