#include "camera_api.hpp"

#include <algorithm>
#include <utility>

#include "api_answers.hpp"

namespace passo {
namespace {

constexpr Seconds picture_within{5};

WebAnswer jpeg_answer(std::string jpeg) {
  return {.type = "image/jpeg", .body = std::move(jpeg)};
}

WebAnswer no_picture(Sentence why) {
  if (why.code.empty()) why = {.code = "camera.no-picture", .text = "no picture has come from the camera in time"};
  return error_answer(503, "camera.no-picture", why);
}

}  // namespace

WebAnswer CameraApi::still(const ApiCall&) {
  Camera& camera = *shared_.camera->pictures;
  const std::uint64_t before = camera.want_picture();
  const Seconds until = shared_.session.now() + picture_within;
  return {.later = [&camera, &session = shared_.session, before, until](WebAnswer& answer) {
    const CameraPicture newest = camera.newest();
    const bool has_come = newest.number > before;
    if (!has_come && session.now() < until) return false;
    answer = has_come ? jpeg_answer(*newest.jpeg) : no_picture(camera.status().problem);
    return true;
  }};
}

WebAnswer CameraApi::stream(const ApiCall&) {
  return refusal_answer(400);
}

WebAnswer CameraApi::job_still(const ApiCall& call) {
  auto jpeg = shared_.options.history->still(static_cast<std::int64_t>(std::min<std::uint64_t>(call.id, INT64_MAX)));
  return jpeg ? jpeg_answer(std::move(*jpeg)) : refusal_answer(404);
}

}  // namespace passo
