// The options of the operation laser: cuts along drawings, pictures by lines, and a test grid.
#include "cam_rows.hpp"

namespace passo {
namespace {

constexpr CamRange any_percent{0, 100};

std::vector<CamOption> beam_rows(CamLaserArguments& a) {
  using enum CamKind;
  return {
      {"power", &a.power, percent, "power of cuts, and of black in pictures, % of --max-s", {.range = any_percent}},
      {"feed", &a.feed, feed, "feed rate of cuts and pictures, per minute"},
      {"passes", &a.passes, number, "number of passes along each line", {.range = CamRange{1, 100}}},
      {"max-s", &a.max_s, number, "S word of full power: $30 of Grbl", {.range = CamRange{10, 100'000}}},
      {"beam",
       &a.beam,
       choice,
       "power at the corners: dynamic (M4: it follows the speed) or constant (M3)",
       {.choices = {"dynamic", "constant"}}},
      {"air",
       &a.air,
       choice,
       "output that switches the air assist: off, mist (M7) or flood (M8)",
       {.choices = {"off", "mist", "flood"}}},
      {"focus", &a.focus, length, "Z at which the beam is in focus, set once at the start (default: no Z)"},
      {"step", &a.step, length, "how much lower each pass is; needs --focus (default: all passes at the same Z)",
       experts_only},
      {"acceleration",
       &a.acceleration,
       number,
       "acceleration of the machine, mm/s2, for the overscan and the estimated time",
       {.range = CamRange{1, 100'000}, .matters_to = experts}},
      {"rapid", &a.rapid, feed, "speed of rapids, per minute, for the estimated time", {.matters_to = experts}},
  };
}

std::vector<CamOption> line_rows(CamLaserArguments& a) {
  using enum CamKind;
  return {
      {"side",
       &a.side,
       choice,
       "side of closed lines on which the kerf lies: part (outside parts, inside openings), outside, inside or on",
       {.choices = {"part", "outside", "inside", "on"}}},
      {"kerf", &a.kerf, length, "width of the cut; the beam stays half of it away from the part"},
      {"lead", &a.lead, length, "radius of the lead-in, a quarter circle in the scrap; needs --kerf", experts_only},
      {"score-color", &a.score_colors, text,
       "SVG, DXF: colour of shapes that are scored on their lines; can be repeated", of_one_job},
      {"score-layer", &a.score_layers, text, "layer that is scored on its lines; can be repeated", of_one_job},
      {"score-power",
       &a.score_power,
       percent,
       "power of scored lines, and of the labels of a grid, % of --max-s",
       {.range = any_percent}},
      {"score-feed", &a.score_feed, feed, "feed rate of scored lines, per minute (default: --feed)"},
      join_row(a.join),
  };
}

std::vector<CamOption> raster_rows(CamLaserArguments& a) {
  using enum CamKind;
  return {
      {"width", &a.width, length, "picture: size in X, rounded to whole cells; the aspect ratio is kept"},
      {"line-distance", &a.line_distance, length, "picture, grid: distance of the lines, and size of a cell"},
      {"mode",
       &a.mode,
       choice,
       "picture: grey (power follows the tone), dither (Floyd-Steinberg), ordered (8 x 8 matrix) or threshold",
       {.choices = {"grey", "dither", "ordered", "threshold"}}},
      {"least-power",
       &a.least_power,
       percent,
       "picture, grey: power of the lightest tone that is burned, % of --max-s",
       {.range = any_percent}},
      {"gamma",
       &a.gamma,
       number,
       "picture: exponent of the darkness; below 1, light tones get more power",
       {.range = CamRange{0.05, 20}, .matters_to = experts}},
      {"threshold",
       &a.threshold,
       percent,
       "picture, threshold: brightness below which a cell is burned, % of white",
       {.range = any_percent}},
      {"scan",
       &a.scan,
       choice,
       "picture: direction of the lines, x or y",
       {.choices = {"x", "y"}, .matters_to = experts}},
      {"invert", &a.invert, flag, "picture: burn the bright areas"},
      {"one-way", &a.one_way, flag, "picture: lines in one direction only", experts_only},
      {"overscan", &a.overscan, length,
       "picture: run-up and run-out of each line with the beam off (default: as --feed and --acceleration require)",
       experts_only},
  };
}

std::vector<CamOption> grid_rows(CamLaserArguments& a) {
  using enum CamKind;
  return {
      {"grid", &a.grid, text, "COLUMNSxROWS: a test grid instead of a drawing, e.g. 5x6", of_one_job},
      {"grid-power", &a.grid_power, text, "LEAST,MOST: power of the first and the last column, %", of_one_job},
      {"grid-feed", &a.grid_feed, length, "LEAST,MOST: feed rates of the highest and the lowest row, per minute",
       of_one_job},
      {"cell", &a.cell, length, "grid: size of a square", experts_of_one_job},
      {"grid-outlines", &a.grid_outlines, flag, "grid: squares are cut, not filled with lines", of_one_job},
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamLaserArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, "drawings (SVG, DXF or HPGL), or one picture (PNG, JPEG or TIFF)"}},
      beam_rows(a),
      line_rows(a),
      raster_rows(a),
      grid_rows(a),
      {output_row(a.output),
       picture_row(a.picture, "picture of what the beam burns, drawn from the program (FILE.png)"),
       {"json", &a.json, flag, "print a summary as JSON; needs --output", {.matters_to = cli, .is_of_job = true}},
       units_row(a.units),
       input_row(a.input, "DXF: unit of the numbers in the file (default: as the file declares)"),
       scale_row(a.scale),
       layer_row(a.layers, "layer to read; can be repeated (default: all visible layers)", CamFor::everyone),
       color_row(a.colors),
       name_row(a.names),
       zero_row(a.zero, "position of X0 Y0: file (of a picture, its lower left corner), lower-left, or X,Y"),
       mirror_row(a.mirror),
       mirror_at_row(a.mirror_at),
       park_row(a.park),
       {"sheet", &a.sheet, length,
        "W,H: size of the material, whose lower left corner is X0 Y0; what extends beyond it is refused",
        experts_only}},
      controller_rows(a),
  });
}

}  // namespace passo
