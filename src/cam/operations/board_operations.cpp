// What is made of a circuit board: holes, copper, the edge, and all of it at once.
#include "cam_rows.hpp"

namespace passo {

std::vector<CamOption> cam_options_of(CamDrillArguments& a) {
  using enum CamKind;
  return {
      {"FILE", &a.files, drawings, "DXF drawings, drill files, KiCad boards; the kind is seen from what is in them",
       are_needed},
      output_row(a.output),
      picture_row(a.picture, "draw holes, tools and rapids (FILE.svg or FILE.png)"),
      units_row(a.units),
      input_row(a.input, "unit of the files' numbers: mm, cm or inch; without it as they say"),
      scale_row(a.scale),
      {"zeros",
       &a.zeros,
       choice,
       "drill files: which zeros are left out, leading or trailing",
       {.choices = {"leading", "trailing"}, .matters_to = experts, .is_of_job = true}},
      layer_row(a.layers, "DXF: read this layer; may be given again. Without it all that are on"),
      zero_row(a.zero, "where X0 Y0 is: file, lower-left of all holes, or X,Y"),
      mirror_row(a.mirror),
      mirror_at_row(a.mirror_at),
      {"align", &a.align, length, "X,Y,X,Y: drill two more holes, for pins that hold the board", experts_of_one_job},
      {"align-drill", &a.align_drill, length, "diameter of these holes", experts_only},
      {"tools", &a.tools, length, "the drills at hand, as 0.8,1.0,1.3; without it one for each diameter"},
      {"tolerance", &a.tolerance, length, "how far a drill of --tools may be off", experts_only},
      {"drill", &a.drill, length, "this one drill makes every hole"},
      {"mill", &a.mill, length, "a milling cutter of this diameter makes wider holes, and slots"},
      {"mill-step", &a.mill_step, length, "how deep a turn of the cutter goes", experts_only},
      clearance_row(a.clearance, "height of the rapids above the board"),
      {"depth", &a.depth, length, "of the holes, below 0", {.is_of_machine = true}},
      {"peck", &a.peck, length, "drill in pecks of this depth, and clear the hole after each"},
      {"feed", &a.feed, feed, "a minute, down into a hole"},
      {"mill-feed", &a.mill_feed, feed, "a minute, of the cutter", experts_only},
      spindle_row(a.spindle),
      park_row(a.park),
      {"plain", &a.plain, flag, "plain moves (G0, G1), not canned cycles (G81, G83)"},
      {"route-steps",
       &a.route_steps,
       number,
       "work on the order of each tool's holes",
       {.range = CamRange{0, 1e10}, .matters_to = CamFor::programs}},
  };
}

std::vector<CamOption> cam_options_of(CamIsolateArguments& a) {
  using enum CamKind;
  return all_of({
      {
          {"COPPER", &a.files, drawings,
           "copper layers, which are united: Gerber, a KiCad board, or DXF with filled areas", are_needed},
          {"edge", &a.edge, file, "the board's edge: nothing beyond it is milled (Gerber, KiCad or DXF)", of_one_job},
          {"join",
           &a.join,
           length,
           "ends of the edge's lines that are no farther apart are joined",
           {.matters_to = CamFor::programs}},
          {"tool",
           &a.tools,
           length,
           "widths of the cutters at hand, as 1,0.2: the widest goes first",
           {.usual = usual_isolation_tool}},
          {"v", &a.v, text, "a V-shaped cutter: ANGLE,TIP in degrees and width of the tip"},
          {"depth", &a.depth, length, "into the board, below 0"},
          {"passes", &a.passes, number, "loops around the copper", {.range = CamRange{1, 1000}}},
          {"width", &a.width, length, "free ground around the copper; says how many loops"},
          {"overlap",
           &a.overlap,
           percent,
           "percent of the cutter's width that two loops have in common",
           {.range = CamRange{0, 95}, .matters_to = experts}},
          {"clear", &a.clear, flag, "take all copper off the board that is not wanted"},
          {"voronoi", &a.voronoi, flag, "go midway between islands: each keeps the ground around it", experts_only},
          {"tolerance", &a.tolerance, length, "how much farther from the copper the cutter stays", experts_only},
      },
      mill_rows(a),
  });
}

std::vector<CamOption> cam_options_of(CamOutlineArguments& a) {
  using enum CamKind;
  return all_of({
      {{"EDGE", &a.files, drawings, "drawings of the edge: Gerber, a KiCad board, DXF or SVG", are_needed}},
      edge_rows(a),
      mill_rows(a),
  });
}

std::vector<CamOption> cam_options_of(CamBoardArguments& a) {
  using enum CamKind;
  return {
      {"JOB", &a.paths, drawings, "Gerber and drill files, folders of them, a zip archive, or a KiCad board",
       are_needed},
      {"output", &a.output, file, "folder for programs, pictures and board.html", {.matters_to = cli, .letter = "o"}},
      {"profile",
       &a.profile,
       file,
       "options of drill, isolate and outline (TOML); without it those remembered for\nthe machine of -m",
       {.matters_to = cli}},
      {"machine",
       &a.machine,
       file,
       "machine file (TOML): how long each program takes on it",
       {.matters_to = cli, .letter = "m"}},
      {"remember", &a.remember, flag, "remember the options of --profile for the machine of -m", {.matters_to = cli}},
      {"turn",
       &a.turn,
       choice,
       "the board is turned over: x from left to right, y from top to bottom",
       {.choices = {"x", "y"}}},
      {"margin", &a.margin, length, "the board's lower left corner lies at this X and Y"},
      {"pins", &a.pin_distance, length, "distance of two alignment holes from the board's edge; 0: none"},
      {"probe-holes", &a.probe_holes, flag, "no pins: after turning over a program finds the two holes with the probe"},
      {"heights", &a.heights, text, "9x6: a program for each side probes its heights at a grid"},
      {"join",
       &a.join,
       length,
       "ends of the edge's lines that are no farther apart are joined; without it as\n[outline] says, or 0.1mm",
       {.matters_to = CamFor::programs}},
      {"as",
       &a.told,
       text,
       "FILE=LAYER: what a file is, where the guess is wrong: top copper, bottom copper,\noutline, drill, or nothing; "
       "may be given again",
       {.matters_to = CamFor::programs}},
      {"json", &a.json, flag, "what was read, and the steps, for scripts", {.matters_to = cli}},
  };
}

}  // namespace passo
