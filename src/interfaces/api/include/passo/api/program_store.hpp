// ProgramStore: the programs that clients have uploaded, and what their check has found.
//
// The store also keeps what outlives a program: the offsets of the work systems, and the lengths of tools.
//
// Bounded: so many programs, and so many bytes in all. A program is checked a piece at a time, so that a long one does
// not delay the machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/api/program_path.hpp"
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
  std::uint64_t deleted_lines = 0;  // those that begin with /
  bool block_delete = false;        // these lines are left out
  UploadState state = UploadState::unchecked;
  std::uint64_t checks = 0;  // how many have begun
  Point checked_from = {};   // where the machine stood at the last check
  ProgramCheck check;
  std::optional<Seconds> planned_time;  // of its motion, with all ramps, at overrides of 100 %
  std::uint64_t path = 0;               // the fingerprint of its path, after a good check
  Diagnostics findings;
  ProgramPath path_points;                 // of the last check; for viewers
  std::optional<HeightMap> height_map{};   // of the surface that it is to be levelled on
  std::vector<std::size_t> line_starts{};  // where every so many lines begin in the text

  // A window of the text: `count` lines from line `from` on (1 is the first), fewer at the end.
  std::string_view lines_from(std::uint64_t from, std::uint64_t count) const;
  // What the history and a journal keep of the program: a text that means the same without any choice.
  std::string text_to_keep() const;
};

class ProgramStore {
 public:
  static constexpr std::size_t most_programs = 64;
  static constexpr std::size_t longest_program = std::size_t{64} << 20;  // bytes
  static constexpr std::size_t most_bytes = std::size_t{256} << 20;
  // Of all paths together. A check drops the paths of other programs if there is no room.
  static constexpr std::size_t most_path_bytes = std::size_t{512} << 20;

  // Null: there is no room.
  const StoredProgram* add(std::string name, Dialect dialect, std::string text);
  const StoredProgram* find(std::uint64_t id) const;
  // False: there is none.
  bool remove(std::uint64_t id);
  const std::map<std::uint64_t, StoredProgram>& all() const { return programs_; }

  // Begins the check of a program from this place on. One is checked at a time; the last one counts. A program that was
  // found good from this place is not checked again, unless its path had to make room.
  void check(std::uint64_t id, const MachineDescription& machine, const Point& start);
  bool checks() const { return checker_ != nullptr; }
  // Checks a bounded piece.
  void poll();
  InterpreterOptions options_of(const StoredProgram& program) const;
  InterpreterOptions options_of(Dialect dialect) const;
  // Whether lines that begin with / are left out. The check of before does not count any more.
  void set_block_delete(std::uint64_t id, bool leaves_out);
  void set_height_map(std::uint64_t id, HeightMap map);
  void set_planned_time(std::uint64_t id, Seconds time);

  // Where the work's zero (G54) lies in machine coordinates, for all programs.
  void set_work_zero(const Point& zero);
  Point work_zero() const { return work_frame().work_offset(); }
  // The same with its rotation about Z, which an angle of the work has been probed for.
  Frame work_frame() const;
  // The offsets and tools for the programs from now on. Checks that were made before count no longer, if they differ.
  void set_offsets(const SavedParameters& parameters, const ToolTable& tools);
  const SavedParameters& parameters() const { return parameters_; }
  const ToolTable& tools() const { return tools_; }

 private:
  void make_room_for_path(std::uint64_t id);
  void forget_checks();
  static void forget_check(StoredProgram& program);

  std::map<std::uint64_t, StoredProgram> programs_;
  std::size_t bytes_ = 0;
  std::uint64_t last_id_ = 0;
  SavedParameters parameters_;
  ToolTable tools_;
  std::uint64_t checked_ = 0;  // the program that is checked
  std::unique_ptr<ProgramChecker> checker_;
  PathFingerprint path_;  // of what is checked
};

}  // namespace passo
