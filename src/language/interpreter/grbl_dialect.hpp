// The dialect of grbl 1.1: the part of the language that grbl accepts, and grbl's number for each error.
//
// A block is checked against the rows of the codes (code_table.hpp) before anything else. Words that grbl accepts
// without effect (comments, M1, G40, G61, G91.1) are taken out of the block. The rest means the same as in LinuxCNC's
// dialect, and the same code executes it. Source: grbl's documentation (doc/markdown/interface.md,
// doc/csv/error_codes_en_US.csv) and its behaviour, version 1.1 as it is built by default: without M7.
#pragma once

#include <string>
#include <string_view>

#include "code_table.hpp"
#include "program_state.hpp"
#include "reporter.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

// True: grbl accepts the block, with `more_axes` beside its X, Y and Z, and words without effect are taken out. False:
// the reason was reported.
[[nodiscard]] bool accept_as_grbl(Block& block, const ProgramState& state, Reporter& reporter, LetterSet more_axes);

// For a line that cannot be parsed: whether grbl, which reads word by word, finds another error before, which is then
// reported.
[[nodiscard]] bool refuse_as_grbl(const Block& block, const ProgramState& state, Reporter& reporter,
                                  LetterSet more_axes);

// "grbl error:20, unsupported or invalid command"; empty where grbl has no number for it.
std::string grbl_error(std::string_view code);

}  // namespace passo
