// Runs an image of the firmware `follower` in an emulator of its chip. The inputs are levels on the board's signal
// lines; the result is every change of the board's outputs. docs/follower.md lists the lines and outputs of each board.
//
// A line is "clock.x", "direction.x" (also y and z), "relay", "button", "key.5" (also "key.*" and "key.#") or "reset".
// An output is "windings.x" (also y and z), "relay", "indicator.relay" and, depending on the board,
// "indicator.automatic", "indicator.manual" or "led.0" to "led.3". The value of windings is F1 to F4, e.g. "0110"; for
// the others "1" is on, independent of the pin's active level.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

using Nanoseconds = std::int64_t;  // from the end of the reset

// The shortest level, high or low, that the first board is sure to detect on a clock line: its longest turn, with three
// motors (docs/follower.md, "How fast").
inline constexpr Nanoseconds first_board_level = 48'000;

// The line has this level from `at` on. Before its first change a line is low, and no key is pressed. A "reset" is a
// short pulse.
struct LineChange {
  Nanoseconds at = 0;
  std::string line;
  bool high = false;
};

// The output has this value from `at` on. Before its first change an output is "0" or "0000".
struct OutputChange {
  Nanoseconds at = 0;
  std::string output;
  std::string value;
};

struct FollowerRun {
  std::vector<OutputChange> changes = {};
  // The longest time from one sample of the clock lines to the next, in cycles: a level that lasts longer is always
  // detected. 0 if it was not measured.
  std::uint64_t longest_turn = 0;
};

// The row and column of a 4x3 keypad for e.g. "key.5", counted from 0. Row -1: the line is not a key.
struct KeyPlace {
  int row = 0;
  int column = 0;
};
KeyPlace key_place(std::string_view line);

// Returns the text for a winding pattern; bit 0 is F1.
std::string winding_text(unsigned pattern);

// Returns the names of all followers: "first_board", and combinations of board and drive mode such as "pic_two_on" or
// "uno_half_step".
std::vector<std::string> emulated_followers();
// Returns the name of the image file that the build creates for the follower.
std::filesystem::path follower_image(std::string_view follower);
// The outputs that the follower's board has.
std::vector<std::string> outputs_of_follower(std::string_view follower);
// Whether the follower's board has a keypad and a tool button.
bool has_keypad(std::string_view follower);
// Runs `image` on the follower's board until `end`, in a separate emulator process. The image may be the program with
// debug symbols (.elf or .cod) or the file to be flashed (.hex). `lines`: in order of time. Changes of lines that the
// board lacks (keys on an Uno) have no effect. The error is a sentence with the reason.
Result<FollowerRun, std::string> run_follower(std::string_view follower, const std::filesystem::path& image,
                                              std::span<const LineChange> lines, Nanoseconds end);

// Whether gpsim, which emulates PICs, is installed.
bool gpsim_is_here();

// The differences between the boards with a PIC16F877A.
enum class PicFollower { at_20_mhz, first_board };
// Watching the loop's passes makes gpsim twenty times slower, so it is optional.
enum class Turns { unwatched, watched };

// Runs `image`, a .cod or .hex file, in gpsim until `end`. `lines`: in order of time. gpsim runs as a separate process.
// `work`: a folder for its files. The error is a sentence with the reason.
Result<FollowerRun, std::string> run_pic_follower(PicFollower board, const std::filesystem::path& image,
                                                  std::span<const LineChange> lines, Nanoseconds end,
                                                  const std::filesystem::path& work, Turns turns = Turns::unwatched);

}  // namespace passo
