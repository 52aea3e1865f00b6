// ServedCamera: the camera of `passo serve`: its pictures go to the viewers of the web server, while there are any.
#pragma once

#include <cstdint>

#include "passo/camera/camera_feed.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

class ServedCamera {
 public:
  explicit ServedCamera(const CameraDescription& camera)
      : description_(camera), feed_(camera.stream, camera.snapshot) {}

  MachineCamera machine_camera() { return {.description = description_, .pictures = &feed_}; }
  // Sends the newest picture. Must be called once per iteration of the main loop.
  void poll(WebServer& server) {
    feed_.watch(server.viewers() > 0);
    const CameraPicture newest = feed_.newest();
    if (newest.number == shown_) return;
    shown_ = newest.number;
    server.show(newest.jpeg);
  }

 private:
  CameraDescription description_;
  CameraFeed feed_;
  std::uint64_t shown_ = 0;  // the last picture
};

}  // namespace passo
