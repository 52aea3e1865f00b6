// What the commands that carve reliefs share: their arguments, the surface, and the words about what was made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cam_commands.hpp"
#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

#include "passo/carve/relief_program.hpp"
#include "passo/carve/relief_surface.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/operations/length_text.hpp"

namespace passo {

// Reads arguments. Keeps the first message of what is wrong.
class ReliefReading {
 public:
  explicit ReliefReading(double unit_mm) : unit_mm_(unit_mm) {}

  Mm length(const char* option, const std::string& text, Mm least, Mm most) {
    const Result<Mm, std::string> read = parse_length(option, text, unit_mm_);
    if (!read) {
      refuse(read.error());
    } else if (*read < least || *read > most) {
      refuse(fmt::format("{}: expected {:g} to {:g} mm, found '{}'", option, least.value(), most.value(), text));
    } else {
      return *read;
    }
    return least;
  }
  std::optional<Mm> perhaps(const char* option, const std::string& text, Mm least, Mm most) {
    if (text.empty()) return std::nullopt;
    return length(option, text, least, most);
  }
  // A Z, below the top at Z0.
  std::optional<Mm> depth(const char* option, const std::string& text) {
    if (text.empty()) return std::nullopt;
    const Result<Mm, std::string> read = parse_length(option, text, unit_mm_);
    if (read && *read >= Mm(0.001) && *read <= deepest_relief) {
      refuse(fmt::format("{1}: expected a Z below the top at Z0, found '{0}'; write {1} -{0}", text, option));
      return std::nullopt;
    }
    return length(option, text, -deepest_relief, Mm(-0.001)) * -1;
  }
  Cutter cutter(const char* option, const std::string& text) {
    const Result<Cutter, std::string> read = parse_cutter(text);
    constexpr Mm widest{200};  // what the table below the cutter is made for
    if (read && read->radius * 2 <= widest) return *read;
    refuse(read ? fmt::format("{}: '{}': expected a diameter of at most 200 mm", option, text)
                : fmt::format("{}: {}", option, read.error()));
    return {};
  }
  void refuse(const std::string& message) {
    if (message_.empty()) message_ = message;
  }
  ReliefPoint place(const char* option, const std::string& text) {
    const Result<std::vector<Mm>, std::string> both = parse_lengths(option, text, unit_mm_);
    if (both && both->size() == 2) return {(*both)[0], (*both)[1]};
    refuse(fmt::format("{}: expected X,Y, found '{}'", option, text));
    return {};
  }
  double unit_mm() const { return unit_mm_; }
  const std::string& message() const { return message_; }

 private:
  double unit_mm_;
  std::string message_;
};

struct ReliefJob {
  ReliefShape shape;
  ReliefProgramOptions program;
};
// Reads all options but --within and --origin. `reading` has the message of what is wrong.
ReliefJob relief_job_of(const CamReliefArguments& arguments, ReliefReading& reading);

// Reads the closed curves of a drawing, in program coordinates. Shows findings, and returns false if there are errors.
bool read_curves(const std::string& path, std::vector<std::vector<ReliefPoint>>& curves);

struct ReliefGrid {
  HeightGrid grid;
  std::string words;  // what was read
  bool is_body = false;
  Mm high{};  // of a body, as carved
};
// How a model is turned before it is seen from above, after --up: not, or for the other side of flipped stock.
enum class ModelSide : std::uint8_t { as_told, left_to_right, front_to_back };
// Reads the file. Empty: errors are in `findings`.
std::optional<ReliefGrid> read_relief(const CamReliefArguments& arguments, const ReliefJob& job, ModelSide side,
                                      Diagnostics& findings);

// Checks the memory for the nodes that the cutters' centres reach.
bool fits_memory(const ReliefProgramOptions& program, const HeightGrid& grid, const std::string& name,
                 Diagnostics& findings);
// Sets the position of node (0, 0) of the grid, from --origin.
void place_relief(const CamReliefArguments& arguments, const HeightGrid& grid, ReliefReading& reading,
                  ReliefProgramOptions& program);
// Checks that the curves lie over the relief, which has been placed.
bool meet(const std::vector<std::vector<ReliefPoint>>& curves, const HeightGrid& grid,
          const ReliefProgramOptions& program, const std::string& name, Diagnostics& findings);

std::string grid_words(const HeightGrid& grid);
// One line for each cutter.
std::string summary_of(const ReliefReport& report);
// An object for each cutter.
nlohmann::ordered_json json_of(const ReliefReport& report);

// The programs of both sides, for --two-sided.
int cam_relief_sides(const CamReliefArguments& arguments, const WorkProgress& progress);

}  // namespace passo
