// The follower's image for a PIC16F877A in gpsim, in one piece.
#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>

#include <unistd.h>

#include "passo/emulator/emulated_follower.hpp"
#include "passo/emulator/running_pic.hpp"

namespace passo {

KeyPlace key_place(std::string_view line) {
  constexpr std::string_view names = "123456789*0#";
  const std::size_t index = line.size() == 5 && line.starts_with("key.") ? names.find(line.back()) : names.npos;
  if (index == names.npos) return {-1, -1};
  return {static_cast<int>(index / 3), static_cast<int>(index % 3)};
}

std::string winding_text(unsigned pattern) {
  std::string text;
  for (unsigned f = 0; f < 4; ++f) text += (pattern >> f & 1) != 0 ? '1' : '0';
  return text;
}

bool gpsim_is_here() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((folder + "/gpsim").c_str(), X_OK) == 0) return true;
  }
  return false;
}

Result<FollowerRun, std::string> run_pic_follower(PicFollower board, const std::filesystem::path& image,
                                                  std::span<const LineChange> lines, Nanoseconds end,
                                                  const std::filesystem::path& work, Turns turns) {
  std::set<std::string> keys;
  for (const LineChange& change : lines) {
    if (change.line.starts_with("key.")) keys.insert(change.line);
  }
  auto pic = RunningPic::start(board, image, work, std::vector(keys.begin(), keys.end()), turns);
  if (!pic) return Failure{pic.error()};
  (*pic)->add(lines);
  auto run = (*pic)->run_to(end);
  if (!run) return Failure{run.error()};
  if (!(*pic)->has_written()) {
    return Failure{image.string() + " is not firmware for a PIC16F877A: it never writes to a port"};
  }
  return *std::move(run);
}

}  // namespace passo
