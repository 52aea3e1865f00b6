// The options of the operation plot: a pen or a drag knife that follows the lines of drawings.
#include "cam_rows.hpp"

namespace passo {
namespace {

std::vector<CamOption> pen_rows(CamPlotArguments& a) {
  using enum CamKind;
  return {
      {"pen-up", &a.pen_up, length, "Z at which the pen travels", {.is_of_machine = true}},
      {"pen-down", &a.pen_down, length, "Z at which the pen draws", {.is_of_machine = true}},
      {"servo", &a.servo, text,
       "a servo moves the pen: DOWN or DOWN,UP, S words of M3; without UP, M5 raises it (default: Z moves the pen)"},
      {"servo-delay",
       &a.servo_delay,
       number,
       "pause after each motion of the servo, seconds",
       {.range = CamRange{0, 10}, .matters_to = experts}},
      {"dot",
       &a.dot,
       number,
       "pause with the pen down at a dot, seconds",
       {.range = CamRange{0, 60}, .matters_to = experts}},
      {"knife", &a.knife, length, "drag knife: offset of the blade's tip from the axis on which it swivels"},
      {"swivel",
       &a.swivel,
       degrees,
       "drag knife: the blade swivels on an arc at corners that turn by more than this, degrees",
       {.range = CamRange{0, 180}, .matters_to = experts}},
      {"overcut", &a.overcut, length, "drag knife: how far closed contours are cut beyond their start"},
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamPlotArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, "drawings: SVG, DXF or HPGL", are_needed}},
      pen_rows(a),
      {output_row(a.output),
       picture_row(a.picture, "picture of the lines and the travels (FILE.svg or FILE.png)"),
       {"json", &a.json, flag, "print a summary as JSON; needs --output", {.matters_to = cli, .is_of_job = true}},
       units_row(a.units),
       input_row(a.input, "DXF: unit of the numbers in the file (default: as the file declares)"),
       scale_row(a.scale),
       layer_row(a.layers, "layer or pen to read; can be repeated (default: all visible layers)"),
       zero_row(a.zero, "position of X0 Y0: file (the file's origin), lower-left (of the drawing), or X,Y"),
       mirror_row(a.mirror),
       mirror_at_row(a.mirror_at),
       {"feed", &a.feed, feed, "feed rate along the lines, per minute"},
       {"plunge-feed", &a.plunge_feed, feed, "feed rate of the pen's descent, per minute"},
       park_row(a.park),
       join_row(a.join),
       {"sheet", &a.sheet, length,
        "W,H: size of the material, whose lower left corner is X0 Y0; a drawing that extends beyond it is refused",
        experts_only}},
      controller_rows(a),
  });
}

}  // namespace passo
