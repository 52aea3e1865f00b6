// LaserProgram: writes the moves of a laser head as G-code, for Passo and for Grbl 1.1 in its laser mode ($32=1).
//
// The planners of laser/ call travel(), run(), burn() and lower(); nothing else writes moves. So one class ensures that
// the beam is off in every rapid, in every move of Z, before the first cut and after the last: those lines carry S0.
// The S word stands in lines that move in X or Y only. Grbl changes it there without a stop, and Passo on the path.
//
// Power is a share of `most_s`, rounded to a whole S word; see s_of(). The estimated time assumes that each rapid and
// each sequence of cuts begins and ends at rest, with a constant acceleration.
//
// Source: Grbl v1.1 Laser Mode (github.com/gnea/grbl, doc/markdown/laser_mode.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/program_text.hpp"
#include "passo/cam/region.hpp"

namespace passo {

// M4: the power follows the speed, so a corner gets no more than a straight line. M3: the power is constant.
enum class BeamMode : std::uint8_t { dynamic, constant };

struct LaserProgramOptions {
  std::string name = {};                  // program name, for the first comment
  std::vector<std::string> files = {};    // names of the drawings or pictures
  std::vector<std::string> remarks = {};  // comments at the head of the program
  ProgramUnits units = ProgramUnits::mm;
  BeamMode beam = BeamMode::dynamic;
  std::uint32_t most_s = 1000;  // S word of full power: Grbl's $30
  MmPerSecond2 acceleration{1000};
  Nanometres rapid{6'000'000'000};       // speed of rapids, nm/min; only for the estimated time
  std::string air = {};                  // M7 or M8, which switch the air assist on; empty: none
  std::optional<Nanometres> focus = {};  // Z of the head; empty: the program has no Z
  DrawnPoint park = {};
};

// The S word of a power in percent.
std::uint32_t s_of(double percent, std::uint32_t most_s);

// The beam of a cut.
struct BeamSetting {
  std::uint32_t s = 0;
  Nanometres feed{1'000'000'000};  // nm/min
};

struct LaserTotals {
  std::optional<DrawnBox> burned = {};  // bounding box of the cuts
  std::optional<DrawnBox> moved = {};   // of all moves; begins with the first rapid
  double burned_nm = 0;                 // length of the cuts
  double seconds = 0;                   // estimated
  std::uint32_t least_s = 0;            // of the cuts
  std::uint32_t most_s = 0;
  std::size_t lines = 0;  // lines with moves
};

class LaserProgram {
 public:
  explicit LaserProgram(LaserProgramOptions options);

  const LaserProgramOptions& options() const { return options_; }
  DrawnPoint at() const { return at_; }

  // Omits words that are as in the line before: for the many short lines of a picture.
  void write_tersely(bool terse) { is_terse_ = terse; }

  // Moves with the beam off: by a rapid, or at this feed.
  void travel(DrawnPoint to);
  void run(DrawnPoint to, Nanometres feed);
  // Moves along a line or an arc, see PathPoint, with the beam on. With S0 it is like run().
  void burn(DrawnPoint to, double bulge, const BeamSetting& beam);
  // Moves the head to this Z with the beam off.
  void lower(Nanometres z);

  const LaserTotals& totals() const { return totals_; }
  // Ends the program and returns its text. Nothing may be added afterwards.
  std::string finish();

 private:
  void feed_move(DrawnPoint to, double bulge, const BeamSetting& beam);
  std::string words_to(DrawnPoint to) const;
  void add(int motion, std::string words, std::uint32_t s);
  void count(DrawnPoint to, double bulge, bool is_burned);
  void end_sequence();
  std::string head() const;

  LaserProgramOptions options_;
  ProgramText text_;
  LaserTotals totals_;
  DrawnPoint at_;
  bool is_placed_ = false;  // whether the program has moved to at_
  bool is_terse_ = false;
  int motion_ = -1;  // the last G word
  std::uint32_t s_ = 0;
  Nanometres feed_{};
  double sequence_seconds_ = 0;  // of the cuts since the last rest, without ramps
};

}  // namespace passo
