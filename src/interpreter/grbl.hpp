// The dialect of grbl 1.1: which of the language it accepts, and its number for each error.
//
// A block is checked against the table of grbl.cpp before anything is made of it, and what grbl accepts without effect
// (comments, M1, G40, G61, G91.1) is taken out of it. What is left means the same as in LinuxCNC's dialect, and is
// executed by the same code. Source: grbl's documentation (doc/markdown/interface.md, doc/csv/error_codes_en_US.csv)
// and its behaviour, version 1.1 as it is built by default: without M7.
#pragma once

#include <string>
#include <string_view>

#include "program_state.hpp"
#include "reporter.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

// Whether grbl takes the block; if not, it was said why. What has no effect is gone from it.
[[nodiscard]] bool accept_as_grbl(Block& block, const ProgramState& state, Reporter& reporter);

// "grbl error:20, unsupported or invalid command"; empty where grbl has no number for it.
std::string grbl_error(std::string_view code);

}  // namespace passo
