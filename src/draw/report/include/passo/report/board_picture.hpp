// A picture of a board from its files: from above, and flipped, from below.
#pragma once

#include "passo/cam/board_job.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

// Draws into `file`; the caller commits it. Copper is shiny where the solder mask leaves it bare.
Status<OutputError> draw_board(const BoardJob& job, const PictureOptions& options, OutputFile& file);

}  // namespace passo
