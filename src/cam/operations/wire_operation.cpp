// What is cut of foam with a hot wire.
#include "cam_rows.hpp"

namespace passo {

std::vector<CamOption> cam_options_of(CamWireArguments& a) {
  using enum CamKind;
  return {
      {"PROFILE",
       &a.files,
       drawings,
       "of the left side, and of the right: SVG, DXF, HPGL, airfoil (.dat)",
       {.is_required = true, .most_files = 2}},
      output_row(a.output),
      picture_row(a.picture, "draw block, profiles and wire (FILE.svg or FILE.png)"),
      {"json", &a.json, flag, "print what was done as JSON", {.matters_to = cli}},
      {"axes", &a.axes, choice, "XY or XYUV; without it XYUV where the two sides differ", {.choices = {"XY", "XYUV"}}},
      {"keep",
       &a.keep,
       choice,
       "what stays: inside of the profile, outside, or line: no kerf",
       {.choices = {"inside", "outside", "line"}}},
      {"kerf", &a.kerf, length, "width that the wire melts at the feed; or WIDTH@SPEED,... as measured"},
      {"feed", &a.feed, feed, "a minute, of the slower end at its profile"},
      {"most-feed", &a.most_feed, feed, "a minute, of the faster end; without it three times the feed"},
      {"span", &a.span, length, "from tower to tower, along the wire"},
      {"width", &a.width, length, "of the block, from profile to profile"},
      {"block-at", &a.block_at, length, "from the left tower to the left profile; without it in the middle",
       experts_only},
      {"chord", &a.chord, length, "of airfoils: one length, or LEFT,RIGHT"},
      {"right-at", &a.right_at, length, "X,Y: the right profile lies so far from where it is drawn"},
      {"right-turn",
       &a.right_turn,
       degrees,
       "the right profile is turned about its zero, degrees",
       {.range = CamRange{-360, 360}}},
      {"block", &a.block, length, "X,Y,X,Y of the program: corners of the block's face: the wire begins beyond it"},
      {"lead", &a.lead, length, "the cut begins and ends so far beside the profile"},
      {"tolerance", &a.tolerance, length, "of chords on curves", experts_only},
      {"heat", &a.heat, number, "S of M3, which heats the wire; without it the program leaves it alone"},
      join_row(a.join),
      units_row(a.units),
      input_row(a.input, "unit of a DXF file's numbers: mm, cm or inch; without it as it says"),
      {"scale", &a.scale, number, "drawings: the numbers times this", experts_only},
      layer_row(a.layers, "read this layer; may be given again. Without it all that are on"),
      zero_row(a.zero, "where X0 Y0 is: file, lower-left of the left profile, or X,Y"),
  };
}

}  // namespace passo
