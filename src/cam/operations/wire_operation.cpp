// The options of the operation wire: foam cut with a hot wire.
#include "cam_rows.hpp"

namespace passo {

std::vector<CamOption> cam_options_of(CamWireArguments& a) {
  using enum CamKind;
  std::vector<CamOption> rows{
      {"PROFILE",
       &a.files,
       drawings,
       "profile of the left side, then of the right: SVG, DXF, HPGL or airfoil (.dat)",
       {.is_required = true, .most_files = 2}},
      output_row(a.output),
      picture_row(a.picture, "picture of block, profiles and wire (FILE.svg or FILE.png)"),
      {"json", &a.json, flag, "print a summary as JSON", {.matters_to = cli}},
      {"axes",
       &a.axes,
       choice,
       "axes of the program: XY or XYUV (default: XYUV if the two sides differ)",
       {.choices = {"XY", "XYUV"}}},
      {"keep",
       &a.keep,
       choice,
       "part that is kept: inside or outside of the profile; line: the wire follows it, without kerf compensation",
       {.choices = {"inside", "outside", "line"}}},
      {"kerf", &a.kerf, length, "width that the wire melts at the feed rate, or WIDTH@SPEED,... as measured"},
      {"feed", &a.feed, feed, "feed rate of the slower end at its profile, per minute"},
      {"most-feed", &a.most_feed, feed,
       "highest feed rate of the faster end, per minute (default: three times --feed)"},
      {"span", &a.span, length, "distance between the towers"},
      {"width", &a.width, length, "width of the block, from profile to profile"},
      {"block-at", &a.block_at, length, "distance from the left tower to the left profile (default: block centred)",
       experts_only},
      {"chord", &a.chord, length, "chord of an airfoil: one length, or LEFT,RIGHT"},
      {"skin", &a.skin, length, "thickness of the skin that is glued onto the core: the foam is smaller by it"},
      {"spar", &a.spars, text,
       "AT,WIDTH,DEPTH[,below]: slot for a spar; AT: X of its middle, or % of the chord, or LEFT:RIGHT; can be "
       "repeated"},
      {"straight", &a.straight, flag, "straight lines between the points of an airfoil, instead of a smooth curve",
       experts_only},
      {"right-at", &a.right_at, length, "X,Y: offset of the right profile"},
      {"right-turn",
       &a.right_turn,
       degrees,
       "rotation of the right profile about its origin, degrees counterclockwise",
       {.range = CamRange{-360, 360}}},
      {"block", &a.block, length,
       "X,Y,X,Y: corners of the block's face in program coordinates; the wire starts outside it"},
      {"lead", &a.lead, length, "length of the lead-in and lead-out next to the profile"},
      {"tolerance", &a.tolerance, length, "chord tolerance on curves", experts_only},
      {"heat", &a.heat, number,
       "S value of the M3 that heats the wire (default: the program does not switch the wire)"},
      join_row(a.join),
      units_row(a.units),
      input_row(a.input, "unit of the numbers in a DXF file: mm, cm or inch (default: as the file declares)"),
      {"scale", &a.scale, number, "scale factor of the drawings", experts_only},
      layer_row(a.layers, "layer to read; can be repeated (default: all visible layers)"),
      zero_row(a.zero, "position of X0 Y0: file (the file's origin), lower-left (of the left profile), or X,Y"),
  };
  return all_of({rows, controller_rows(a)});
}

}  // namespace passo
