// The recorded signals that `passo follower sim --input` plays, and what the motors made of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"

#include "passo/base/result.hpp"
#include "passo/emulator/emulated_follower.hpp"

namespace passo {

struct FollowerRecording {
  std::vector<LineChange> lines = {};  // in order of time, from the end of the reset
  Nanoseconds end = 0;                 // the last time in the file
  bool has_keys = false;
};

// Reads arguments.input, which is played from arguments.from on, at most until arguments.time if that is given. The
// error is a sentence with the reason.
Result<FollowerRecording, std::string> read_follower_recording(const FollowerArguments& arguments,
                                                               std::size_t most_changes);

// Compares the pulses on the clock lines with the steps of the motors: a row for each motor with pulses, then, if some
// were lost, what to do.
std::string compared_steps(std::string_view follower, const std::vector<LineChange>& lines, const FollowerRun& run);

}  // namespace passo
