// The portable Follower on the host, in virtual time: its lines and outputs as in a FollowerVector.
#pragma once

#include <vector>

#include "follower/vector.hpp"

namespace passo {

// A turn of the loop every `turn`.
std::vector<OutputChange> run_on_host(const FollowerVector& vector, Nanoseconds turn = 10'000);
// The same with the customs and the LEDs of the first board.
std::vector<OutputChange> run_first_board_on_host(const FollowerVector& vector, Nanoseconds turn = 10'000);

}  // namespace passo
