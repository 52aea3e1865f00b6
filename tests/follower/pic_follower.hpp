// The follower's image for the PIC16F877A, in gpsim: its pins as lines and outputs of a FollowerVector.
#pragma once

#include <filesystem>
#include <vector>

#include "follower/vector.hpp"

namespace passo {

bool gpsim_is_here();

// `images`: where they lie, less "_two_on.cod". gpsim's script and what it said are left in `work`. It watches
// turns only where asked: that makes it twenty times slower.
enum class Turns { unwatched, watched };
ChipRun run_on_pic(const std::string& images, const FollowerVector& vector, const std::filesystem::path& work,
                   Turns turns);

}  // namespace passo
