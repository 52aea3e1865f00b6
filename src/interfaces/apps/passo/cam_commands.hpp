// The commands of `passo cam`, a function each.
//
// `given`: what was read already, instead of the files. `made`: what is printed otherwise. Null: nothing.
#pragma once

#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/base/counted.hpp"
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

int cam_drill(const CamDrillArguments& arguments, const CamSources* given = nullptr, CamMade* made = nullptr);
int cam_isolate(const CamIsolateArguments& arguments, const CamSources* given = nullptr, CamMade* made = nullptr);
int cam_outline(const CamOutlineArguments& arguments, const CamSources* given = nullptr, CamMade* made = nullptr);
int cam_profile(const CamProfileArguments& arguments);
int cam_pocket(const CamPocketArguments& arguments);
int cam_engrave(const CamEngraveArguments& arguments);
int cam_wire(const CamWireArguments& arguments);
int cam_relief(const CamReliefArguments& arguments);
// The first three at once, on all files of a board.
int cam_board(const CamBoardArguments& arguments, CamDrillArguments drill, CamIsolateArguments isolate,
              CamOutlineArguments outline);
int cam_show(const CamShowArguments& arguments);

}  // namespace passo
