// FollowerVector: what goes into a follower and what has to come out of it. vectors/README.md has the text form.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "passo/emulator/emulated_follower.hpp"
#include "passo/grading/board_case.hpp"

namespace passo {

using ExpectedChange = DueChange;

struct FollowerVector {
  std::string name;
  std::string drive = "two_on";
  std::vector<LineChange> lines = {};
  std::vector<ExpectedChange> expected = {};
  Nanoseconds end = 0;

  // A person presses something; or lines and windings alone.
  bool needs_keypad() const;
};

// Throws std::runtime_error with name and line where the text is wrong.
FollowerVector read_follower_vector(const std::filesystem::path& file);
// The hand-made ones, by name.
std::vector<FollowerVector> follower_vectors(const std::filesystem::path& directory);

// Motors at random: each line is high and low for `shortest` or up to eight times that, and directions turn
// between edges; each motor for itself, or all edges at one time. What has to come out is computed from a motor's
// position.
enum class Edges { apart, together };
FollowerVector random_steps(std::uint64_t seed, int steps_an_axis, Nanoseconds shortest, Edges edges,
                            std::string_view axes = "xyz");

// Motors that all step at one time, upwards, by a square wave with this period.
FollowerVector square_wave(std::string_view axes, int pulses, Nanoseconds period);

// Three square waves, a third of a period apart, without an end: the least time that a loop can have for anything else.
// In the midst of it somebody wants manual mode; only that is looked at.
FollowerVector manual_mode_at_full_rate(Nanoseconds level);

// A person plays with the keypad meanwhile, but does not press `#`.
void add_fidgeting(FollowerVector& vector, std::uint64_t seed);

// The same on a board that waits for a mode key after its reset and runs at a slower clock: all times are `factor`
// times as long, and before them a person presses `*`.
FollowerVector after_automatic_key(const FollowerVector& vector, int factor);

// All there are; those that a board without a keypad has, and that random steps are about.
std::vector<std::string> follower_outputs();
std::vector<std::string> moved_outputs();
std::vector<std::string> winding_outputs();
std::vector<std::string> first_board_outputs();

// What differs, in words; empty where nothing does. Only the outputs that the board `has` are asked for.
std::string difference(const FollowerVector& vector, const std::vector<OutputChange>& seen,
                       const std::vector<std::string>& has);

std::string text_of_file(const std::filesystem::path& file);

}  // namespace passo
