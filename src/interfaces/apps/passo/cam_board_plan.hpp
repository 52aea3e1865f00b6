// BoardPlan: what `passo cam board` mills, in the coordinates of the files: one board, or a panel of copies.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/cam/board_job.hpp"
#include "passo/cam/board_panel.hpp"
#include "passo/operations/cam_arguments.hpp"

namespace passo {

struct BoardPlan {
  std::vector<Drawing> drills;
  std::optional<BoardLayer> front;
  std::optional<BoardLayer> back;
  std::optional<BoardLayer> edge;
  std::array<Region, 2> mask = {};   // openings of the solder mask, front and back
  std::array<Region, 2> paste = {};  // openings of the stencil
  Region face;                       // the board within its outline; empty: unknown
  DrawnBox box;                      // of all copies
  DrawnBox one;                      // of the first copy
  PanelGrid grid;
};

// Parses --copies and --gap. `outline`: its cutter must fit into the gap between two boards, twice if there are tabs.
Result<PanelGrid, std::string> panel_of(const CamBoardArguments& arguments, const CamOutlineArguments& outline);

// Shows notes, and reports errors in `findings`.
BoardPlan board_plan_of(const BoardJob& job, Nanometres join, const PanelGrid& grid, Diagnostics& findings);

}  // namespace passo
