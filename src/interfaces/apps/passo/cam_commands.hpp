// The commands of `passo cam`, a function each.
//
// `progress`: gets the share of the work that is done; it is 1 before the command prints its summary. `given`: what was
// read already, instead of the files. `made`: what is printed otherwise. Null: nothing.
#pragma once

#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/base/counted.hpp"
#include "passo/base/work_progress.hpp"
#include "passo/cam/board_layer.hpp"
#include "passo/operations/cam_arguments.hpp"

namespace passo {

// What a command would read from its files, if it was read already.
struct CamSources {
  std::vector<Drawing> drills = {};
  BoardLayer layer = {};  // of the copper, or of the edge
  Region board = {};      // inside the edge; empty: there is none
};

// What a command has made.
struct CamMade {
  std::vector<std::string> tools = {};  // for the operator, in the order in which they are used
  std::string summary = {};
};

struct CamShowArguments {
  std::vector<std::string> files;  // Gerber and drill files, folders, zip archives
  std::string picture;             // .svg or .png; empty: none
  bool json = false;
};

int cam_drill(const CamDrillArguments& arguments, const WorkProgress& progress, const CamSources* given = nullptr,
              CamMade* made = nullptr);
int cam_isolate(const CamIsolateArguments& arguments, const WorkProgress& progress, const CamSources* given = nullptr,
                CamMade* made = nullptr);
int cam_outline(const CamOutlineArguments& arguments, const WorkProgress& progress, const CamSources* given = nullptr,
                CamMade* made = nullptr);
int cam_profile(const CamProfileArguments& arguments, const WorkProgress& progress);
int cam_pocket(const CamPocketArguments& arguments, const WorkProgress& progress);
int cam_engrave(const CamEngraveArguments& arguments, const WorkProgress& progress);
int cam_wire(const CamWireArguments& arguments, const WorkProgress& progress);
int cam_relief(const CamReliefArguments& arguments, const WorkProgress& progress);
// The first three at once, on all files of a board.
int cam_board(const CamBoardArguments& arguments, const WorkProgress& progress, CamDrillArguments drill,
              CamIsolateArguments isolate, CamOutlineArguments outline);
int cam_show(const CamShowArguments& arguments);

}  // namespace passo
