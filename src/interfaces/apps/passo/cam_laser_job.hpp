// Converts the options of `passo cam laser`.
#pragma once

#include <optional>
#include <string>

#include "cam_job.hpp"

#include "passo/laser/laser_grid.hpp"
#include "passo/laser/laser_lines.hpp"
#include "passo/laser/laser_raster.hpp"

namespace passo {

struct LaserJob {
  MillJob drawing = {};  // how drawings are read, their place, and the head of the program
  LaserProgramOptions program = {};
  LaserLinesOptions lines = {};
  LaserPasses cut = {};
  BeamSetting score = {};
  ToneOptions tones = {};
  RasterMoves raster = {};
  Mm width{100};  // of a picture
  Nanometres join{};
  std::optional<LaserGrid> grid = {};
};

// Shows nothing; what is wrong is in `lengths`.
LaserJob laser_job_of(const CamLaserArguments& arguments, LengthArguments& lengths);

}  // namespace passo
