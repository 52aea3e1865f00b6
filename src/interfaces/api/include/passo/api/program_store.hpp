// ProgramStore: the programs that clients have uploaded, and the results of their checks.
//
// The store also keeps data that is not part of a program: the work offsets, and the tool lengths.
//
// Bounded in the number of programs and in total bytes. A program is checked piece by piece, so that a long one does
// not delay the machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/activity/cut_forecast.hpp"
#include "passo/activity/job_outline.hpp"
#include "passo/activity/program.hpp"
#include "passo/api/program_path.hpp"
#include "passo/base/result.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/journal/path_fingerprint.hpp"
#include "passo/levelling/height_map.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

enum class UploadState : std::uint8_t { unchecked, checking, good, bad };
std::string_view name_of(UploadState state);

struct StoredProgram {
  std::uint64_t id = 0;
  std::string name;
  Dialect dialect = Dialect::linuxcnc;
  std::string text;
  std::uint64_t lines = 0;
  std::uint64_t deleted_lines = 0;  // number of lines that begin with /
  bool block_delete = false;        // whether these lines are skipped
  UploadState state = UploadState::unchecked;
  std::uint64_t checks = 0;  // number of checks started
  Point checked_from = {};   // machine position at the last check
  ProgramCheck check;
  bool changes_tools_by_moves = false;  // at the last check: M6, on a machine with [tool_change]
  std::optional<Seconds> planned_time;  // duration of its motion, including ramps, at overrides of 100 %
  std::uint64_t path = 0;               // fingerprint of its path, after a successful check
  Diagnostics findings;
  ProgramPath path_points;                 // path of the last check, for viewers
  JobOutline outline{};                    // outline of the last check, for framing
  bool is_small = false;                   // made on request, e.g. to frame a job; not for lists
  std::optional<HeightMap> height_map{};   // height map of the surface to which the program is to be levelled
  std::vector<std::size_t> line_starts{};  // offsets in the text, one for each fixed number of lines

  // Returns `count` lines of the text, beginning with line `from` (the first is 1); fewer at the end.
  std::string_view lines_from(std::uint64_t from, std::uint64_t count) const;
  // Returns the text to keep in the history and in a journal: an equivalent text that does not depend on the block
  // delete setting.
  std::string text_to_keep() const;
};

// Judges the path items of one program, in order. The error is a clause that says what the board cannot do.
using PathJudge = std::function<Status<std::string>(const PathItem&)>;

class ProgramStore {
 public:
  static constexpr std::size_t most_programs = 64;
  static constexpr std::size_t longest_program = std::size_t{64} << 20;  // bytes
  static constexpr std::size_t most_bytes = std::size_t{256} << 20;
  // Limit for all paths together. A check drops the paths of other programs if there is no room.
  static constexpr std::size_t most_path_bytes = std::size_t{512} << 20;

  // Adds a program. Returns null if there is no room.
  const StoredProgram* add(std::string name, Dialect dialect, std::string text);
  // Adds a program that was made on request.
  const StoredProgram* add_small(std::string name, std::string text);
  const StoredProgram* find(std::uint64_t id) const;
  // Returns false if there is no such program.
  bool remove(std::uint64_t id);
  const std::map<std::uint64_t, StoredProgram>& all() const { return programs_; }

  // Begins to check a program from this start position. Only one check runs at a time; a new one replaces it. A program
  // that was already found error-free from this position is not checked again, unless its path was dropped.
  void check(std::uint64_t id, const MachineDescription& machine, const Point& start);
  // Sets the folders with subroutine files for all programs.
  void set_sub_folders(std::vector<std::string> folders) { sub_folders_ = std::move(folders); }
  // Sets a function that returns a judge for each check. Null: the board can execute every path.
  void judge_paths(std::function<PathJudge()> new_judge) { new_judge_ = std::move(new_judge); }
  // Sets a function that returns what is left of the lives of tools, for each check. Null: unknown.
  void set_lives(std::function<LivesLeft()> lives) { lives_ = std::move(lives); }
  // Invalidates all checks.
  void forget_checks();
  bool checks() const { return checker_ != nullptr; }
  // Checks one piece of limited size.
  void poll();
  InterpreterOptions options_of(const StoredProgram& program) const;
  InterpreterOptions options_of(Dialect dialect) const;
  // Sets whether lines that begin with / are skipped. This invalidates the previous check.
  void set_block_delete(std::uint64_t id, bool leaves_out);
  void set_height_map(std::uint64_t id, HeightMap map);
  void set_planned_time(std::uint64_t id, Seconds time);

  // Sets the work zero (G54) in machine coordinates, for all programs.
  void set_work_zero(const Point& zero);
  Point work_zero() const { return work_frame().work_offset(); }
  // Returns the work zero with its rotation about Z, which comes from probing an angle.
  Frame work_frame() const;
  // Sets the offsets and tools for the programs. If they differ, previous checks become invalid.
  void set_offsets(const SavedParameters& parameters, const ToolTable& tools);
  const SavedParameters& parameters() const { return parameters_; }
  const ToolTable& tools() const { return tools_; }

 private:
  void make_room_for_path(std::uint64_t id);
  void judge(const PathItem& item, StoredProgram& program);
  static void forget_check(StoredProgram& program);

  std::map<std::uint64_t, StoredProgram> programs_;
  std::size_t bytes_ = 0;
  std::uint64_t last_id_ = 0;
  SavedParameters parameters_;
  ToolTable tools_;
  std::vector<std::string> sub_folders_;
  std::uint64_t checked_ = 0;  // the program being checked
  std::unique_ptr<ProgramChecker> checker_;
  std::function<PathJudge()> new_judge_;
  std::function<LivesLeft()> lives_;
  std::optional<CutForecast> cuts_;  // of the program being checked
  PathJudge judge_;                  // of the program being checked
  std::vector<std::string> told_;    // its objections so far
  PathFingerprint path_;             // path fingerprint of the program being checked
};

}  // namespace passo
