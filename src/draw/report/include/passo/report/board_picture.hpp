// A picture of a board as its files draw it: from above, and turned over from below.
#pragma once

#include "passo/cam/board_job.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

// Draws into `file`, which the caller commits. Where a mask leaves copper bare, the copper shines.
Status<OutputError> draw_board(const BoardJob& job, const PictureOptions& options, OutputFile& file);

}  // namespace passo
