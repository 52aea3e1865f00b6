// The sentences of a camera's problems. The page has the same codes (page/src/lang/LANGUAGE/findings.ts).
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::camera_says {

inline constexpr SentenceRow unreachable{"camera.unreachable", "the camera cannot be reached"};
inline constexpr SentenceRow status{"camera.status", "the camera answers with HTTP status {status}"};
inline constexpr SentenceRow no_pictures{"camera.no-pictures", "the camera sends no JPEG pictures"};
inline constexpr SentenceRow bad_response{"camera.bad-response",
                                          "the camera's response is not valid HTTP, or not a valid picture stream"};
inline constexpr SentenceRow wrong_length{"camera.wrong-length", "the camera states a wrong length of a picture"};
inline constexpr SentenceRow too_large{"camera.too-large", "a picture of the camera is too large"};
inline constexpr SentenceRow silent{"camera.silent", "the camera sends no pictures"};
inline constexpr SentenceRow ended{"camera.ended", "the camera has closed the connection"};

}  // namespace passo::camera_says
