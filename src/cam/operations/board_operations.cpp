// The options of the operations for circuit boards: drill, isolate, outline, and board, which does all three.
#include "cam_rows.hpp"

namespace passo {

std::vector<CamOption> cam_options_of(CamDrillArguments& a) {
  using enum CamKind;
  std::vector<CamOption> rows{
      {"FILE", &a.files, drawings,
       "DXF drawings, drill files or boards of KiCad, EAGLE or EasyEDA; the format is detected from the contents",
       are_needed},
      output_row(a.output),
      picture_row(a.picture, "picture of holes, tools and rapids (FILE.svg or FILE.png)"),
      {"json", &a.json, flag, "print a summary as JSON; needs --output", {.matters_to = cli, .is_of_job = true}},
      units_row(a.units),
      input_row(a.input, "unit of the numbers in the files: mm, cm or inch (default: as the files declare)"),
      scale_row(a.scale),
      {"zeros",
       &a.zeros,
       choice,
       "zeros that drill files omit: leading or trailing (default: as the files declare)",
       {.choices = {"leading", "trailing"}, .matters_to = experts, .is_of_job = true}},
      layer_row(a.layers, "DXF: layer to read; can be repeated (default: all visible layers)"),
      color_row(a.colors),
      name_row(a.names),
      zero_row(a.zero, "position of X0 Y0: file (the file's origin), lower-left (of all holes), or X,Y"),
      mirror_row(a.mirror),
      mirror_at_row(a.mirror_at),
      {"align", &a.align, length, "X,Y,X,Y: positions of two extra holes for alignment pins", experts_of_one_job},
      {"align-drill", &a.align_drill, length, "diameter of the alignment holes", experts_only},
      {"tools", &a.tools, length,
       "available drills: diameters, e.g. 0.8,1.0,1.3, numbers in --tool-table, or all (its drills); default: one\n"
       "drill for each hole diameter"},
      {"tolerance", &a.tolerance, length, "largest difference between a hole and its drill from --tools", experts_only},
      {"drill", &a.drill, length, "diameter of a single drill for all holes, or its number in --tool-table"},
      {"mill", &a.mill, length,
       "diameter of a milling cutter for the wider holes and all slots, or its number in --tool-table"},
      {"mill-step", &a.mill_step, length, "depth of one helical turn of the milling cutter", experts_only},
      clearance_row(a.clearance, "clearance height: rapids run this far above the board"),
      {"feed-height", &a.feed_height, length, "height above the board down to which the drill goes by rapid",
       experts_only},
      {"depth", &a.depth, length, "depth of the holes, a negative Z", {.is_of_machine = true}},
      {"peck", &a.peck, length, "peck depth: the drill retracts out of the hole after each peck"},
      {"feed", &a.feed, feed, "feed rate of drilling, per minute"},
      {"mill-feed", &a.mill_feed, feed, "feed rate of the milling cutter, per minute", experts_only},
      spindle_row(a.spindle),
      park_row(a.park),
      {"plain", &a.plain, flag, "no canned cycles: G0 and G1 instead of G81 and G83"},
      {"route-steps",
       &a.route_steps,
       number,
       "largest number of search steps for the order of each tool's holes",
       {.range = CamRange{0, 1e10}, .matters_to = CamFor::programs}},
  };
  return all_of({rows, tool_rows(a), program_rows(a)});
}

std::vector<CamOption> cam_options_of(CamIsolateArguments& a) {
  using enum CamKind;
  return all_of({
      {
          {"COPPER", &a.files, drawings,
           "copper layers, which are combined: Gerber, a board of KiCad, EAGLE or EasyEDA, or DXF with filled areas",
           are_needed},
          {"edge", &a.edge, file, "board outline; nothing outside it is milled (Gerber, KiCad or DXF)", of_one_job},
          {"join",
           &a.join,
           length,
           "largest gap across which the ends of outline segments are joined",
           {.matters_to = CamFor::programs}},
          {"tool",
           &a.tools,
           length,
           "widths of the available cutters, e.g. 1,0.2, or their numbers in --tool-table; the widest is used first",
           {.usual = usual_isolation_tool}},
          {"v", &a.v, text, "ANGLE,TIP of a V-shaped cutter: included angle in degrees, and tip width"},
          {"depth", &a.depth, length, "depth of the cut, a negative Z"},
          {"passes", &a.passes, number, "number of isolation passes around the copper", {.range = CamRange{1, 1000}}},
          {"width", &a.width, length, "isolation width; sets the number of passes"},
          {"overlap",
           &a.overlap,
           percent,
           "overlap of neighbouring passes, % of the cutter's width",
           {.range = CamRange{0, 95}, .matters_to = experts}},
          {"clear", &a.clear, flag, "remove all copper that does not belong to the circuit"},
          {"voronoi", &a.voronoi, flag, "mill midway between islands, so that each keeps the copper around it",
           experts_only},
          {"tolerance", &a.tolerance, length, "extra distance that the cutter keeps from the copper", experts_only},
          {"allow-loss", &a.allow_loss, length,
           "copper that may be lost on each side of a gap narrower than the cutter; 0: none"},
          {"least-trace", &a.least_trace, length, "width that traces keep there; narrower traces lose nothing",
           experts_only},
          {"accept-joined",
           &a.accept_joined,
           flag,
           "accept nets that stay joined (default: the command fails)",
           {.matters_to = experts, .is_of_job = true}},
      },
      tool_rows(a),
      mill_rows(a),
  });
}

std::vector<CamOption> cam_options_of(CamOutlineArguments& a) {
  using enum CamKind;
  return all_of({
      {{"EDGE", &a.files, drawings,
        "drawings of the board outline: Gerber, DXF, SVG, or a board of KiCad, EAGLE or EasyEDA", are_needed}},
      tool_rows(a),
      edge_rows(a),
      mill_rows(a),
  });
}

std::vector<CamOption> cam_options_of(CamBoardArguments& a) {
  using enum CamKind;
  std::vector<CamOption> rows{
      {"JOB", &a.paths, drawings,
       "Gerber and drill files, folders of them, a zip archive, or a board of KiCad, EAGLE or EasyEDA", are_needed},
      {"output", &a.output, file, "folder for programs, pictures and board.html", {.matters_to = cli, .letter = "o"}},
      {"profile",
       &a.profile,
       file,
       "options of drill, isolate and outline (TOML; default: those remembered for\nthe machine of -m)",
       {.matters_to = cli}},
      {"machine",
       &a.machine,
       file,
       "machine file (TOML), to estimate the time of each program",
       {.matters_to = cli, .letter = "m"}},
      {"remember", &a.remember, flag, "remember the options of --profile for the machine of -m", {.matters_to = cli}},
      {"turn",
       &a.turn,
       choice,
       "how the board is flipped: x, left to right; y, top to bottom",
       {.choices = {"x", "y"}}},
      {"margin", &a.margin, length, "X and Y of the board's lower left corner"},
      {"pins", &a.pin_distance, length, "distance of the two alignment holes from the board's edge; 0: no holes"},
      {"probe-holes", &a.probe_holes, flag, "no pins: after the board is flipped, a program probes the two holes"},
      {"copies", &a.copies, text, "copies of the board in a grid on one blank, COLUMNSxROWS, e.g. 3x4"},
      {"gap", &a.gap, length, "gap between two copies"},
      {"park", &a.park, text,
       "X,Y: park position at tool changes and ends (default: as in the profile, or 0,0); last: above the last cut, "
       "so\n"
       "that all programs form one route",
       experts_only},
      {"mask", &a.mask, length,
       "diameter of a cutter that clears the openings of a cured solder mask (default:\nno program for the mask)"},
      {"mask-depth", &a.mask_depth, length, "depth of these openings, a negative Z", experts_only},
      {"stencil", &a.stencil, length,
       "diameter of a cutter that cuts a stencil for solder paste (default: no stencil)"},
      {"stencil-depth", &a.stencil_depth, length, "depth of the cut through the stencil's film, a negative Z",
       experts_only},
      {"heights", &a.heights, text,
       "grid of a height map, COLUMNSxROWS, e.g. 9x6; adds a probing program for each side"},
      {"join",
       &a.join,
       length,
       "largest gap across which the ends of outline segments are joined (default: as in [outline], or 0.1mm)",
       {.matters_to = CamFor::programs}},
      {"as",
       &a.told,
       text,
       "FILE=LAYER: corrects the layer of a file: top copper, bottom copper, outline,\ndrill or nothing; can be "
       "repeated",
       {.matters_to = CamFor::programs}},
      {"accept-joined",
       &a.accept_joined,
       flag,
       "accept nets that stay joined (default: the command fails)",
       {.matters_to = experts}},
      {"json", &a.json, flag, "print the layers and the steps as JSON", {.matters_to = cli}},
  };
  return all_of({rows, tool_rows(a), program_rows(a)});
}

}  // namespace passo
