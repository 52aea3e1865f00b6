// Camera: the pictures of the machine's camera.
//
// Position in the pipeline: the API's interface to a service that the program provides. No call blocks. The camera
// sends pictures only while someone wants them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "passo/base/sentence.hpp"
#include "passo/machine_file/camera_description.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct CameraPicture {
  std::uint64_t number = 0;                      // of the picture, from 1; 0: there is none yet
  std::shared_ptr<const std::string> jpeg = {};  // null: there is none yet
};

struct CameraStatus {
  enum class State : std::uint8_t {
    off,         // no picture is wanted
    connecting,  // connected or connecting, and no picture has come yet
    live,        // pictures come
    waiting,     // the last attempt failed; the next one comes soon
  };
  State state = State::off;
  std::optional<Seconds> age = {};  // since the newest picture has come
  Sentence problem = {};            // of the last attempt; empty: it succeeded

  friend bool operator==(const CameraStatus&, const CameraStatus&) = default;
};

class Camera {
 public:
  virtual ~Camera() = default;
  // Sets whether the stream is wanted.
  virtual void watch(bool is_watched) = 0;
  // Wants one picture. Returns the number of the newest one: the picture with a higher number comes after this call.
  virtual std::uint64_t want_picture() = 0;
  virtual CameraPicture newest() = 0;
  virtual CameraStatus status() = 0;
};

// The camera of a machine.
struct MachineCamera {
  CameraDescription description;
  Camera* pictures = nullptr;
};

}  // namespace passo
