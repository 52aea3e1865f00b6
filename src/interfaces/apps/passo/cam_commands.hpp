// The commands of `passo cam`, one function each.
//
// `progress`: receives the completed fraction of the work; it is 1 before the command prints its summary. `given`:
// input that was already read, instead of the files. `made`: receives what is otherwise printed. Null: not used.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/base/counted.hpp"
#include "passo/base/work_progress.hpp"
#include "passo/cam/board_layer.hpp"
#include "passo/cam/route_link.hpp"
#include "passo/operations/cam_arguments.hpp"

namespace passo {

// The input of a command, if it was already read.
struct CamSources {
  std::vector<Drawing> drills = {};
  BoardLayer layer = {};   // the copper, or the edge
  Region board = {};       // the inside of the edge; empty: none
  std::size_t copies = 1;  // how often the board is there
  RouteLink link = {};     // to the program before
};

// The results of a command.
struct CamMade {
  std::vector<std::string> tools = {};  // tool names for the operator, in order of use
  std::string summary = {};
  std::size_t joined_nets = 0;          // nets that the program leaves joined
  std::optional<DrawnPoint> last = {};  // where the last cut ended
};

struct CamShowArguments {
  std::vector<std::string> files;  // Gerber and drill files, folders, zip archives
  std::string picture;             // .svg or .png; empty: none
  bool json = false;
  bool shapes = false;  // prints the shapes of a drawing as JSON
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
int cam_thread(const CamThreadArguments& arguments, const WorkProgress& progress);
int cam_plot(const CamPlotArguments& arguments, const WorkProgress& progress);
int cam_laser(const CamLaserArguments& arguments, const WorkProgress& progress);
int cam_wire(const CamWireArguments& arguments, const WorkProgress& progress);
int cam_relief(const CamReliefArguments& arguments, const WorkProgress& progress);
// Runs the operations of a job file.
int cam_job_file(const CamJobArguments& arguments, const WorkProgress& progress);
// Runs the first three commands on all files of a board.
int cam_board(const CamBoardArguments& arguments, const WorkProgress& progress, CamDrillArguments drill,
              CamIsolateArguments isolate, CamOutlineArguments outline);
int cam_show(const CamShowArguments& arguments);

}  // namespace passo
