// The options of the operation relief: a surface carved from a picture or a model.
#include "cam_rows.hpp"

namespace passo {
namespace {

constexpr CamRange any_removal{0, 1e7};

std::vector<CamOption> shape_rows(CamReliefArguments& a) {
  using enum CamKind;
  return {
      {"width",
       &a.width,
       length,
       "size in X; the aspect ratio is kept (default: 100 mm, or the model's size)",
       {.usual = "100mm"}},
      {"length", &a.length, length, "size in Y; the aspect ratio is kept", experts_only},
      {"depth",
       &a.depth,
       length,
       "Z of black, or of the lowest point, a negative Z (default: -3 mm, or the model's height)",
       {.usual = "-3mm"}},
      {"up",
       &a.up,
       choice,
       "axis of the model that points up",
       {.choices = {"z", "-z", "x", "-x", "y", "-y"}, .matters_to = experts, .is_of_job = true}},
      {"input-units",
       &a.input_units,
       choice,
       "unit of the model",
       {.choices = {"mm", "cm", "m", "inch"}, .matters_to = experts, .is_of_job = true}},
      {"area",
       &a.area,
       choice,
       "area that is cut: all, or model (only where the model stands)",
       {.choices = {"all", "model"}, .matters_to = experts, .is_of_job = true}},
      {"gamma",
       &a.gamma,
       number,
       "exponent of the brightness: height = brightness^gamma",
       {.range = CamRange{0.05, 20}, .matters_to = experts}},
      {"invert", &a.invert, flag, "invert the picture: black is high, white is low"},
      {"mirror", &a.mirror, flag, "mirror left to right, e.g. for stamps and moulds"},
      {"channel",
       &a.channel,
       choice,
       "channel that gives the height: luminance or alpha",
       {.choices = {"luminance", "alpha"}, .matters_to = experts}},
      {"margin", &a.margin, length, "width of a flat rim around the relief", experts_only},
      {"margin-level",
       &a.margin_level,
       choice,
       "level of the rim: bottom or top",
       {.choices = {"bottom", "top"}, .matters_to = experts}},
      {"pitch", &a.pitch, length, "largest spacing of the grid points (default: as fine as the cutters need)",
       experts_only},
      {"origin",
       &a.origin,
       place,
       "position of X0 Y0: lower-left, lower-right, upper-left, upper-right, center; or X,Y of the lower left corner",
       {.choices = {"lower-left", "lower-right", "upper-left", "upper-right", "center"}, .matters_to = experts}},
  };
}

std::vector<CamOption> finishing_rows(CamReliefArguments& a) {
  using enum CamKind;
  return {
      {"cutter", &a.cutter, text, "finishing cutter"},
      {"way",
       &a.way,
       choice,
       "strategy: rows (along X), columns (along Y), both, spiral or contours",
       {.choices = {"rows", "columns", "both", "spiral", "contours"}}},
      {"steep",
       &a.steep,
       degrees,
       "slope above which contours are used, degrees; flatter areas get rows",
       {.range = CamRange{10, 80}, .matters_to = experts}},
      {"moves",
       &a.moves,
       choice,
       "moves of the program: arcs (lines and arcs, whichever are fewer) or lines",
       {.choices = {"arcs", "lines"}, .matters_to = experts}},
      {"step", &a.step, length, "stepover (default: from --scallop)", experts_only},
      {"scallop", &a.scallop, length, "scallop height between passes, on a flat area"},
      {"tolerance", &a.tolerance, length, "largest height of a move above the exact toolpath", experts_only},
      clearance_row(a.clearance, "clearance height: rapids run this far above the stock"),
      {"overrun", &a.overrun, length,
       "distance that cutters move beyond the edge (default: their radius; 0 with a rim at the top)", experts_only},
      {"entry",
       &a.entry,
       choice,
       "entry into the stock: ramp or plunge",
       {.choices = {"ramp", "plunge"}, .matters_to = experts}},
      {"ramp-angle",
       &a.ramp_angle,
       degrees,
       "angle of the entry ramp, degrees",
       {.range = CamRange{0.5, 45}, .matters_to = experts}},
      {"feed", &a.feed, feed, "feed rate, per minute"},
      {"plunge", &a.plunge, feed, "largest downward feed rate of the cutter, per minute"},
      {"removal",
       &a.removal,
       removal,
       "target removal rate, mm3/min: the feed rate drops where more would be cut; see --feed-most",
       {.range = any_removal, .matters_to = experts}},
      {"feed-most", &a.feed_most, feed, "highest feed rate where less than the target removal rate is cut, per minute",
       experts_only},
      spindle_row(a.spindle),
  };
}

std::vector<CamOption> roughing_rows(CamReliefArguments& a) {
  using enum CamKind;
  return {
      {"rough", &a.rough, text, "roughing cutter, which works level by level"},
      {"rough-way",
       &a.rough_strategy,
       choice,
       "roughing strategy: rows, or offsets of each level's outline",
       {.choices = {"rows", "offsets"}, .matters_to = experts}},
      {"rough-step", &a.rough_step, length, "stepover of roughing (default: 0.4 of the cutter's diameter)",
       experts_only},
      {"rough-down", &a.rough_down, length, "depth of a roughing level", experts_only},
      {"rough-stock", &a.rough_stock, length, "finishing allowance that roughing leaves in all directions",
       experts_only},
      {"rough-feed", &a.rough_feed, feed, "feed rate of roughing, per minute (default: --feed)", experts_only},
      {"rough-removal",
       &a.rough_removal,
       removal,
       "target removal rate of this cutter, mm3/min",
       {.range = any_removal, .matters_to = experts}},
      {"rest", &a.rest, text, "rest-machining cutter, for areas that the finishing cutter is too large for"},
      {"rest-step", &a.rest_step, length, "stepover of rest machining (default: from --scallop)", experts_only},
      {"rest-least", &a.rest_least, length,
       "material that the finishing cutter may leave; areas with more get rest machining", experts_only},
      {"rest-feed", &a.rest_feed, feed, "feed rate of rest machining, per minute (default: --feed)", experts_only},
      {"rest-removal",
       &a.rest_removal,
       removal,
       "target removal rate of this cutter, mm3/min",
       {.range = any_removal, .matters_to = experts}},
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamReliefArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE",
        &a.file,
        drawings,
        "PNG or TIFF picture (bright is high), STL model, or height map x,y,z",
        {.is_required = true, .most_files = 1}},
       output_row(a.output),
       picture_row(a.picture, "picture of the finished surface (FILE.png)")},
      shape_rows(a),
      finishing_rows(a),
      roughing_rows(a),
  });
}

}  // namespace passo
