// The follower's images for the PIC16F877A, in gpsim, on a FollowerVector.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "follower/vector.hpp"

namespace passo {

// gpsim's script and what it said are left in `work`.
inline FollowerRun run_image_on_pic(PicFollower board, const std::filesystem::path& image, const FollowerVector& vector,
                                    const std::filesystem::path& work, Turns turns = Turns::unwatched) {
  const auto run = run_pic_follower(board, image, vector.lines, vector.end, work, turns);
  if (!run) throw std::runtime_error(run.error());
  return *run;
}

// `images`: the folder with the images of the build.
inline FollowerRun run_on_pic(PicFollower board, const std::string& images, const FollowerVector& vector,
                              const std::filesystem::path& work, Turns turns = Turns::unwatched) {
  const std::string name = board == PicFollower::first_board ? "/first_board" : "/follower_pic_" + vector.drive;
  return run_image_on_pic(board, images + name + ".cod", vector, work, turns);
}

}  // namespace passo
