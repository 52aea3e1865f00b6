// An image of the firmware `follower` in its chip's emulator: levels on the board's lines go in, and what the board's
// outputs change to comes out. docs/follower.md has the lines and the outputs of each board.
//
// A line is "clock.x", "direction.x" (also y and z), "relay", "button", "key.5" (also "key.*" and "key.#") or "reset".
// An output is "windings.x" (also y and z), "relay", "indicator.relay" and, as the board has them,
// "indicator.automatic", "indicator.manual" or "led.0" to "led.3". A winding's value is F1 to F4, as "0110"; of the
// others "1" is on, whatever level that takes on the pin.
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

// From `at` on, the line has this level. Before the first change of a line its level is low, and no key is down. A
// "reset" is over at once.
struct LineChange {
  Nanoseconds at = 0;
  std::string line;
  bool high = false;
};

// From `at` on, the output has this value. Before its first change an output is "0" or "0000".
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

// A row and column of a 4x3 keypad, from 0, for "key.5". Row -1: the line is no key.
struct KeyPlace {
  int row = 0;
  int column = 0;
};
KeyPlace key_place(std::string_view line);

// The text for a pattern of windings, bit 0 is F1.
std::string winding_text(unsigned pattern);

// All followers by name: "first_board", and board and drive as "pic_two_on" or "uno_half_step".
std::vector<std::string> emulated_followers();
// The name of the file that the build makes for it.
std::filesystem::path follower_image(std::string_view follower);
// The outputs that the follower's board has.
std::vector<std::string> outputs_of_follower(std::string_view follower);
// Whether the follower's board has a keypad and a tool button.
bool has_keypad(std::string_view follower);
// Runs `image` on the follower's board until `end`, in the emulator of its chip, a program of its own. The image may be
// the one with the names of the program (.elf or .cod) or the one that is flashed (.hex). `lines`: in order of time.
// What the board has not (keys on an Uno) does nothing. The error is a sentence with the reason.
Result<FollowerRun, std::string> run_follower(std::string_view follower, const std::filesystem::path& image,
                                              std::span<const LineChange> lines, Nanoseconds end);

// Whether gpsim, which emulates PICs, is installed.
bool gpsim_is_here();

// What differs between the boards with a PIC16F877A.
enum class PicFollower { at_20_mhz, first_board };
// gpsim watches turns only if asked: then it is twenty times slower.
enum class Turns { unwatched, watched };

// Runs `image`, a .cod or .hex file, in gpsim until `end`. `lines`: in order of time. gpsim runs as a program of its
// own. `work`: a folder for its files. The error is a sentence with the reason.
Result<FollowerRun, std::string> run_pic_follower(PicFollower board, const std::filesystem::path& image,
                                                  std::span<const LineChange> lines, Nanoseconds end,
                                                  const std::filesystem::path& work, Turns turns = Turns::unwatched);

}  // namespace passo
