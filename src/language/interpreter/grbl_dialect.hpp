// The Grbl 1.1 dialect: the subset of the language that grbl accepts, and grbl's number for each error.
//
// A block is checked against the rows of the codes (code_table.hpp) before anything else. Words that grbl accepts
// without effect (comments, M1, G40, G61, G91.1) are removed from the block. Everything else has the same meaning as in
// the LinuxCNC dialect, and the same code executes it. Source: grbl's documentation (doc/markdown/interface.md,
// doc/csv/error_codes_en_US.csv) and its behaviour, version 1.1 in its default build: without M7.
#pragma once

#include <string>
#include <string_view>

#include "code_table.hpp"
#include "program_state.hpp"
#include "reporter.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

// Returns true if grbl accepts the block, with `more_axes` in addition to X, Y and Z, and removes words without effect.
// Otherwise reports the reason and returns false.
[[nodiscard]] bool accept_as_grbl(Block& block, const ProgramState& state, Reporter& reporter, LetterSet more_axes);

// For an unparsable line: since grbl reads word by word, it may find another error first. Reports that error and
// returns true if there is one.
[[nodiscard]] bool refuse_as_grbl(const Block& block, const ProgramState& state, Reporter& reporter,
                                  LetterSet more_axes);

// Returns e.g. "grbl error:20, unsupported or invalid command"; empty if grbl has no number for it.
std::string grbl_error(std::string_view code);

}  // namespace passo
