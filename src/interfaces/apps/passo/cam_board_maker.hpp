// BoardMaker: writes the programs of a board into a folder, with a picture each, and fills in the page with the
// instructions.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cam_board_page.hpp"
#include "cam_board_plan.hpp"
#include "cam_commands.hpp"
#include "cam_solder_command.hpp"
#include <fmt/format.h>

#include "passo/machine_file/machine_description.hpp"
#include "passo/probing/probing_cycle.hpp"

namespace passo {

// "12.345678mm"
inline std::string exact_mm(Nanometres length) {
  return fmt::format("{:.6f}mm", to_mm(length).value());
}

class BoardMaker {
 public:
  // Writes into `folder`.
  BoardMaker(const CamBoardArguments& arguments, std::filesystem::path folder, const BoardPlan& plan,
             const MachineDescription* machine)
      : arguments_(arguments), folder_(std::move(folder)), plan_(plan), machine_(machine) {}

  int make(CamDrillArguments drill, CamIsolateArguments isolate, CamOutlineArguments outline,
           const WorkProgress& progress);
  const std::filesystem::path& folder() const { return folder_; }
  bool accepts_joined() const { return arguments_.accept_joined; }
  void tell_files() const;
  BoardPage page;
  std::size_t joined_nets = 0;

 private:
  bool is_x() const { return arguments_.turn == "x"; }
  Nanometres middle() const {
    const DrawnBox& box = plan_.box;
    return {is_x() ? (box.least.x.count + box.most.x.count) / 2 : (box.least.y.count + box.most.y.count) / 2};
  }
  // Both sides have the same zero: the board is flipped about its middle.
  template <class Arguments>
  void place(Arguments& arguments, bool is_turned) const {
    const DrawnPoint corner = plan_.box.least;
    arguments.zero = exact_mm(corner.x - margin_) + "," + exact_mm(corner.y - margin_);
    arguments.mirror = is_turned ? arguments_.turn : "";
    arguments.mirror_at = is_turned ? exact_mm(middle()) : "";
  }
  // The names of the step's files.
  template <class Arguments>
  void name(Arguments& arguments, const char* what) {
    const std::string stem = fmt::format("{}-{}", ++programs_, what);
    arguments.output = (folder_ / (stem + ".ngc")).string();
    arguments.picture = (folder_ / (stem + ".svg")).string();
  }
  template <class Arguments>
  int add(Arguments arguments, int (*command)(const Arguments&, const WorkProgress&, const CamSources*, CamMade*),
          const CamSources& sources, BoardStep step);
  WorkProgress next_step();
  // With --park last: how the next program continues the route. `is_last`: someone works on the board after it.
  RouteLink link(bool is_last) const;
  void tell(const BoardStep& step) const;
  std::array<DrawnPoint, 2> pins(Nanometres distance) const;
  // In the coordinates of the programs of both sides.
  std::pair<double, double> in_program(DrawnPoint at) const {
    const DrawnPoint corner = plan_.box.least;
    return {to_mm(at.x - corner.x + margin_).value(), to_mm(at.y - corner.y + margin_).value()};
  }
  DrawnPoint to_program(DrawnPoint at) const {
    return {at.x - plan_.box.least.x + margin_, at.y - plan_.box.least.y + margin_};
  }
  std::string copy_words() const;
  void name_holes(const std::array<DrawnPoint, 2>& holes);
  std::vector<std::string> registration_words() const;
  int draw_turn(const CamDrillArguments& drill, const std::array<DrawnPoint, 2>& holes, BoardStep& step);
  int mill_mask(const CamIsolateArguments& isolate, bool is_back, CamSources sources);
  int cut_stencils(const CamIsolateArguments& isolate, CamSources sources);
  int turn_over(const CamDrillArguments& drill, std::optional<std::array<DrawnPoint, 2>> holes);
  int find_heights(const char* side);
  int add_probing(const ProbingCycle& cycle, const char* what, BoardStep step);

  const CamBoardArguments& arguments_;
  std::filesystem::path folder_;
  const BoardPlan& plan_;
  const MachineDescription* machine_;
  Nanometres margin_;
  std::optional<DrawnPoint> last_;  // where the last program ended, with --park last; empty: at the park position
  int programs_ = 0;
  WorkProgress steps_progress_;
  std::size_t steps_begun_ = 0;
};

}  // namespace passo
