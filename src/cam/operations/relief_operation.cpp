// What is carved of pictures and bodies.
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
       "in X; the other side follows. Without it 100 mm, or as the body is",
       {.usual = "100mm"}},
      {"length", &a.length, length, "in Y; the other side follows", experts_only},
      {"depth", &a.depth, length, "of black below white. Without it 3 mm, or as the body is", {.usual = "3mm"}},
      {"gamma", &a.gamma, number, "height = brightness^gamma", {.range = CamRange{0.05, 20}, .matters_to = experts}},
      {"invert", &a.invert, flag, "black is high, white is deep"},
      {"mirror", &a.mirror, flag, "left becomes right, as for stamps and moulds"},
      {"channel",
       &a.channel,
       choice,
       "what of a pixel is its brightness: luminance or alpha",
       {.choices = {"luminance", "alpha"}, .matters_to = experts}},
      {"margin", &a.margin, length, "width of a flat rim around the relief", experts_only},
      {"margin-level",
       &a.margin_level,
       choice,
       "where the rim lies: bottom or top",
       {.choices = {"bottom", "top"}, .matters_to = experts}},
      {"pitch", &a.pitch, length, "the distance of nodes at most; without it as the cutters need", experts_only},
      {"origin",
       &a.origin,
       place,
       "where X0 Y0 is: lower-left, lower-right, upper-left, upper-right, center; or X,Y of the lower left",
       {.choices = {"lower-left", "lower-right", "upper-left", "upper-right", "center"}, .matters_to = experts}},
  };
}

std::vector<CamOption> finishing_rows(CamReliefArguments& a) {
  using enum CamKind;
  return {
      {"cutter", &a.cutter, text, "the cutter that finishes"},
      {"way",
       &a.way,
       choice,
       "rows (along X), columns (along Y), both, spiral or contours",
       {.choices = {"rows", "columns", "both", "spiral", "contours"}}},
      {"steep",
       &a.steep,
       degrees,
       "contours: where it is steeper, degrees; rows on the rest",
       {.range = CamRange{10, 80}, .matters_to = experts}},
      {"moves",
       &a.moves,
       choice,
       "arcs: lines and arcs, whichever are fewer; or lines only",
       {.choices = {"arcs", "lines"}, .matters_to = experts}},
      {"step", &a.step, length, "between rows; without it as --scallop says", experts_only},
      {"scallop", &a.scallop, length, "height of the ridges between rows, on a flat"},
      {"tolerance", &a.tolerance, length, "how far lines may be above the exact path", experts_only},
      clearance_row(a.clearance, "height of the rapids above the stock"),
      {"overrun", &a.overrun, length,
       "how far cutters go beyond the edge; without it their radius, 0 with a rim at the top", experts_only},
      {"entry",
       &a.entry,
       choice,
       "how cutters go into the stock: ramp or plunge",
       {.choices = {"ramp", "plunge"}, .matters_to = experts}},
      {"ramp-angle", &a.ramp_angle, degrees, "of a ramp, degrees", {.range = CamRange{0.5, 45}, .matters_to = experts}},
      {"feed", &a.feed, feed, "a minute"},
      {"plunge", &a.plunge, feed, "the most that a tip goes down, a minute"},
      {"removal",
       &a.removal,
       removal,
       "hold what is cut, mm3 a minute: slower where it would be more, and see --feed-most",
       {.range = any_removal, .matters_to = experts}},
      {"feed-most", &a.feed_most, feed, "up to this feed where less than the removal is cut", experts_only},
      spindle_row(a.spindle),
  };
}

std::vector<CamOption> roughing_rows(CamReliefArguments& a) {
  using enum CamKind;
  return {
      {"rough", &a.rough, text, "this cutter roughs first, level by level"},
      {"rough-way",
       &a.rough_way,
       choice,
       "rows, or offsets of what a level takes off",
       {.choices = {"rows", "offsets"}, .matters_to = experts}},
      {"rough-step", &a.rough_step, length, "between its rows; without it 0.4 of its diameter", experts_only},
      {"rough-down", &a.rough_down, length, "the height of a level", experts_only},
      {"rough-stock", &a.rough_stock, length, "what it leaves, each way", experts_only},
      {"rough-feed", &a.rough_feed, feed, "a minute; without it --feed", experts_only},
      {"rough-removal",
       &a.rough_removal,
       removal,
       "hold what it cuts, mm3 a minute",
       {.range = any_removal, .matters_to = experts}},
      {"rest", &a.rest, text, "this cutter finishes where the other one is too large"},
      {"rest-step", &a.rest_step, length, "between its rows; without it as --scallop says", experts_only},
      {"rest-least", &a.rest_least, length, "what the other cutter may leave", experts_only},
      {"rest-feed", &a.rest_feed, feed, "a minute; without it --feed", experts_only},
      {"rest-removal",
       &a.rest_removal,
       removal,
       "hold what it cuts, mm3 a minute",
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
        "a PNG or TIFF picture (bright is high), an STL file or a height map x,y,z",
        {.is_required = true, .most_files = 1}},
       output_row(a.output),
       picture_row(a.picture, "draw the finished surface (FILE.png)")},
      shape_rows(a),
      finishing_rows(a),
      roughing_rows(a),
  });
}

}  // namespace passo
