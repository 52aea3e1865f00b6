// Any bytes of a camera, in pieces of any length: memory stays bounded, each picture is a JPEG, and reading the same
// bytes in other pieces ends in the same way.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "passo/camera/camera_response.hpp"

namespace passo {
namespace {

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

std::string last_picture(std::string_view bytes, std::size_t piece, std::string& problem) {
  CameraResponse response;
  std::string last;
  bool reads_on = true;
  while (reads_on && !bytes.empty()) {
    reads_on = response.read(bytes.substr(0, piece));
    bytes.remove_prefix(std::min(bytes.size(), piece));
    if (auto picture = response.take_picture()) last = std::move(*picture);
    require(last.size() <= CameraResponse::most_picture, "a picture above the limit");
    require(last.empty() || last.starts_with("\xFF\xD8\xFF"), "a picture that is no JPEG");
  }
  response.end();
  if (auto picture = response.take_picture()) last = std::move(*picture);
  problem = response.problem().code;
  return last;
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::string whole_problem;
  std::string cut_problem;
  const std::string whole = passo::last_picture(bytes, size + 1, whole_problem);
  const std::string cut = passo::last_picture(bytes, 1, cut_problem);
  passo::require(whole == cut, "another picture");
  passo::require(whole_problem == cut_problem, "another end");
  return 0;
}
