// BoardCase: what goes into a board with a PIC and what has to come out: one of the follower's conformance vectors
// (tests/follower/vectors), which are part of the program.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/emulator/emulated_follower.hpp"

namespace passo {

// An output that must change at `change.at`, or at most `within` later.
struct DueChange {
  OutputChange change;
  Nanoseconds within = 0;
};

struct BoardCase {
  std::string name;
  std::string drive = "two_on";  // the drive mode that it is about
  std::vector<LineChange> lines = {};
  std::vector<DueChange> due = {};
  Nanoseconds end = 0;
  std::vector<std::string> outputs = {};  // that are looked at
  Nanoseconds settling = 0;               // a winding pattern that lasts shorter is not looked at
};

// Reads the text of a vector; its README describes the form. The error names the line.
Result<BoardCase, std::string> read_board_case(const std::string& name, std::string_view text);

// The boards that can be graded: "first_board" and its variants with vectors of their own, "pic_two_on", "pic_wave",
// "pic_half_step".
const std::vector<std::string>& graded_boards();
// Their cases. On the first board somebody first presses `*`, and all times are five times as long, as its clock is
// slower; it also has vectors of its own.
std::vector<BoardCase> board_cases(const std::string& board);

// The change of an output that is the first to be wrong.
struct OutputFault {
  std::string output;      // empty: none is wrong
  std::size_t number = 0;  // of the change of this output, from 1
  Nanoseconds at = 0;      // when it was due, or came
  std::string expected;    // the value; empty: no change
  std::string found;
  std::string words;  // a sentence without a full stop
};
OutputFault find_output_fault(const BoardCase& asked, std::span<const OutputChange> seen);

}  // namespace passo
