// The options of the operations for drawings: profile, pocket and engrave, and of jobs, which combine them.
#include "cam_rows.hpp"

namespace passo {
namespace {

constexpr const char* vector_drawings = "drawings: SVG, DXF or HPGL";

CamOption sheet_row(std::string& sheet) {
  using enum CamKind;
  return {"sheet", &sheet, length,
          "W,H: size of the material, whose lower left corner is X0 Y0; a drawing that extends beyond it is refused",
          experts_only};
}

// `a`: the arguments of an operation that can finish what it has roughed.
std::vector<CamOption> finish_rows(CamFinishArguments& a) {
  using enum CamKind;
  return {
      {"allowance", &a.allowance, length,
       "stock that roughing leaves on walls (default: 0; with --finish-pass, 5 % of the cutter's diameter)",
       experts_only},
      {"finish-pass", &a.finish_pass, flag,
       "finish the walls in one lap at full depth, with arcs as lead-in and lead-out"},
      {"finish-feed", &a.finish_feed, feed, "feed rate of finishing, per minute (default: --feed)", experts_only},
      {"spring-passes",
       &a.spring_passes,
       number,
       "additional laps on the line of the finishing pass",
       {.range = CamRange{0, 10}, .matters_to = experts}},
  };
}

// A job file has a table for this.
std::vector<CamOption> nest_rows(CamNestArguments& a) {
  using enum CamKind;
  const CamTraits of_nest{.matters_to = experts, .is_of_job = true};
  return {
      {"nest", &a.nest, length,
       "W,H: nest the parts of the drawing on sheets of this size, with a program for each sheet", of_nest},
      {"quantity",
       &a.quantity,
       number,
       "nesting: copies of each part",
       {.range = CamRange{1, 1000}, .matters_to = experts, .is_of_job = true}},
      {"gap", &a.gap, length,
       "nesting: gap between two parts (default: as far as two cuts reach, or one without tabs, and 1 mm)", of_nest},
      {"nest-margin", &a.nest_margin, length,
       "nesting: margin at the edge of the sheet (default: as --gap, or as far as a cut reaches, and 1 mm)", of_nest},
      {"rotations",
       &a.rotations,
       number,
       "nesting: permitted rotations, equally spaced: 1 as drawn, 2 also half a turn (grain), 4 quarter turns",
       {.range = CamRange{1, 72}, .matters_to = experts, .is_of_job = true}},
      {"most-sheets",
       &a.most_sheets,
       number,
       "nesting: refuse to write programs for more sheets than this",
       {.range = CamRange{1, 1000}, .matters_to = cli, .is_of_job = true}},
  };
}

std::vector<CamOption> chamfer_rows(CamProfileArguments& a) {
  using enum CamKind;
  return {
      {"chamfer", &a.chamfer, length,
       "chamfer width: mill a chamfer along the contours with a V-shaped cutter, instead of cutting parts out"},
      {"angle",
       &a.angle,
       degrees,
       "chamfer: included angle of the V-shaped cutter, degrees",
       {.range = CamRange{5, 170}}},
      {"tip", &a.tip, length, "chamfer: tip width of the V-shaped cutter"},
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamProfileArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, vector_drawings, are_needed},
       {"side",
        &a.side,
        choice,
        "side of the line: part (outside the contours, inside their holes), outside, inside, or on (the line)",
        {.choices = {"part", "outside", "inside", "on"}}}},
      tool_rows(a),
      edge_rows(a),
      finish_rows(a),
      chamfer_rows(a),
      mill_rows(a, CamFor::everyone),
      {sheet_row(a.sheet)},
      nest_rows(a),
  });
}

std::vector<CamOption> cam_options_of(CamPocketArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, "drawings: SVG, DXF or HPGL; or Gerber layers, whose drawn areas are the pockets",
        are_needed}},
      tool_rows(a),
      {{"tool", &a.tool, length, "diameter of the cutter, or its number in --tool-table"},
       {"depth", &a.depth, length, "depth of the pocket, a negative Z", {.is_of_machine = true}},
       {"step", &a.step, length, "largest depth of a layer"},
       {"step-over", &a.step_over, percent, "stepover, % of the cutter's diameter", {.range = CamRange{1, 95}}},
       {"engagement",
        &a.engagement,
        degrees,
        "largest engagement angle of the cutter, degrees (adaptive clearing); 0: offset loops",
        {.range = CamRange{0, 150}, .matters_to = experts}},
       join_row(a.join),
       ramp_row(a.ramp)},
      finish_rows(a),
      {{"floor-allowance", &a.floor_allowance, length,
        "stock that roughing leaves on the floor; a finishing pass removes it", experts_only},
       {"lead", &a.lead, length,
        "radius of the arcs into and out of a finishing pass (default: a quarter of the cutter's diameter)",
        experts_only},
       {"link-feed", &a.link_feed, feed,
        "feed rate across cleared areas, per minute (default: four times --feed, at least 1500 mm)", experts_only}},
      mill_rows(a, CamFor::everyone),
      {sheet_row(a.sheet)},
  });
}

namespace {

std::vector<CamOption> thread_mill_rows(CamThreadArguments& a) {
  using enum CamKind;
  return {
      {"tool", &a.tool, length, "diameter of the thread mill over its teeth, or its number in --tool-table"},
      {"neck", &a.neck, length, "diameter of the thread mill's neck, which must not touch the wall"},
      {"reach", &a.reach, length, "length of teeth and neck, up to the shank (default: not checked)", experts_only},
      {"tooth-tip", &a.tooth_tip, length, "width of the flat at the tip of a tooth (default: not checked)",
       experts_only},
      {"teeth",
       &a.teeth,
       number,
       "teeth along the axis, one pitch apart: 1, or the teeth of a full-form thread mill",
       {.range = CamRange{1, 100}}},
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamThreadArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, "drawings: SVG, DXF or drill files; each circle gets a thread", are_needed},
       {"thread", &a.thread, text, "name of the thread: M6, M8x1, 1/4-20, #8-32, 1/4 UNC"},
       {"diameter", &a.diameter, length, "major diameter, instead of --thread", experts_only},
       {"pitch", &a.pitch, length, "pitch, with --diameter", experts_only}},
      tool_rows(a),
      thread_mill_rows(a),
      {{"depth", &a.depth, length, "lowest Z of the tip, negative", {.is_of_machine = true}},
       {"hole", &a.hole, length,
        "diameter of the bore, or of the boss, before threading (default: the thread's minor, or major, diameter)",
        experts_only},
       {"oversize", &a.oversize, length,
        "added to the cut diameter of a bore, or subtracted on a boss, to adjust the fit", experts_only},
       {"passes", &a.passes, number, "radial passes, each of the same chip area", {.range = CamRange{1, 20}}},
       {"external", &a.external, flag, "threads around bosses, instead of in bores"},
       {"left-hand", &a.left_hand, flag, "left-hand threads"}},
      mill_rows(a, CamFor::everyone),
  });
}

namespace {

std::vector<CamOption> letter_rows(CamEngraveArguments& a) {
  using enum CamKind;
  return {
      {"text", &a.text, text, "text to engrave, instead of a drawing"},
      {"font",
       &a.font,
       file,
       "font: a file (.ttf, .otf, .lff, .jhf), an installed family, e.g. \"DejaVu Sans:bold\", or simplex, a built-in "
       "single-line font",
       {.choices = {"simplex"}, .names = "an installed font"}},
      {"height", &a.height, length, "height of a capital letter"},
      {"text-align",
       &a.text_align,
       choice,
       "alignment of the text at X0: left, middle or right",
       {.choices = {"left", "middle", "right"}}},
      {"around", &a.around, length,
       "radius of a circle about X0 Y0 that carries the text; negative: text inside the circle, at the bottom"},
      {"arc", &a.arc, text, "FROM,TO: part of the circle that the text fills, degrees counterclockwise from X",
       experts_only},
      {"turn",
       &a.turn,
       degrees,
       "rotation of the text about X0 Y0, degrees counterclockwise",
       {.range = CamRange{-3600, 3600}, .matters_to = experts}},
      {"on-line", &a.on_line, flag, "engrave along the lines of the drawing, also open ones, at --depth", experts_only},
      {"line-space",
       &a.line_space,
       number,
       "line spacing, in letter heights",
       {.range = CamRange{0.1, 100}, .matters_to = experts}},
  };
}

std::vector<CamOption> trace_rows(CamTraceArguments& a) {
  using enum CamKind;
  return {
      {"trace", &a.trace, flag,
       "the files are pictures (PNG, JPEG or TIFF): trace the outlines of their dark areas (potrace)"},
      {"threshold",
       &a.threshold,
       percent,
       "trace: brightness below which a pixel is dark, % of white",
       {.range = CamRange{0, 100}}},
      {"invert", &a.invert, flag, "trace: carve the bright areas instead"},
      {"turdsize",
       &a.turdsize,
       number,
       "trace: ignore spots of at most this many pixels",
       {.range = CamRange{0, 1e6}, .matters_to = experts}},
      {"width", &a.width, length, "trace: width of the picture"},
  };
}

std::vector<CamOption> carving_rows(CamEngraveArguments& a) {
  using enum CamKind;
  return {
      {"angle", &a.angle, degrees, "included angle of the V-shaped cutter, degrees", {.range = CamRange{5, 170}}},
      {"tip", &a.tip, length, "tip width of the V-shaped cutter"},
      {"tool", &a.tool, length,
       "diameter of the V-shaped cutter (the widest groove that it can carve), or its number in --tool-table"},
      {"depth", &a.depth, length,
       "lowest Z, negative (default: as deep as the cutter's width allows; along lines -0.3mm)"},
      {"step", &a.step, length, "depth of a layer (default: full depth in one pass)", experts_only},
      {"clear", &a.clear, length,
       "diameter of a flat cutter that clears wide areas first, or its number in --tool-table"},
      {"clear-step", &a.clear_step, length, "largest depth of a clearing layer", experts_only},
      {"inlay",
       &a.inlay,
       choice,
       "half of an inlay: pocket (the recess) or plug (its mirrored counterpart)",
       {.choices = {"pocket", "plug"}, .matters_to = experts}},
      {"inlay-depth", &a.inlay_depth, length, "depth of the inlay's pocket", experts_only},
      {"glue-gap", &a.glue_gap, length, "gap for glue below the plug", experts_only},
      {"saw-gap", &a.saw_gap, length, "gap for the saw between the faces of plug and pocket", experts_only},
      {"margin", &a.margin, length, "width of the cleared area around the plug", experts_only},
      join_row(a.join),
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamEngraveArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings,
        "drawings: SVG, DXF or HPGL; closed contours are carved out. With --trace: pictures"}},
      letter_rows(a),
      trace_rows(a),
      tool_rows(a),
      carving_rows(a),
      mill_rows(a),
      {sheet_row(a.sheet)},
  });
}

std::vector<CamOption> cam_options_of(CamJobArguments& a) {
  using enum CamKind;
  return {
      {"FILE", &a.files, drawings, "job file (TOML)", {.is_required = true, .most_files = 1}},
      {"output",
       &a.output,
       file,
       "file for the program (default: output of the job file, or the job file's name with .ngc)",
       {.matters_to = cli, .is_of_job = true, .letter = "o"}},
      picture_row(a.picture, "picture of all operations, each in its colour (FILE.svg or FILE.png)"),
      {"check",
       &a.check,
       flag,
       "write nothing; exit with 1 if the programs on disk are out of date",
       {.matters_to = cli, .is_of_job = true}},
      {"json", &a.json, flag, "print the report as JSON", {.matters_to = cli, .is_of_job = true}},
      {"force",
       &a.force,
       flag,
       "overwrite programs that were edited after the job had written them",
       {.matters_to = cli, .is_of_job = true}},
      {"only-folder",
       &a.only_folder,
       flag,
       "refuse a job file that names files outside its folder",
       {.matters_to = cli, .is_of_job = true}},
  };
}

}  // namespace passo
