// What is made of drawings: parts, pockets, letters, and foam.
#include "cam_rows.hpp"

namespace passo {
namespace {

constexpr const char* vector_drawings = "drawings: SVG, DXF or HPGL";

CamOption sheet_row(std::string& sheet) {
  using enum CamKind;
  return {"sheet", &sheet, length,
          "W,H of the material, from X0 Y0 on: a drawing beyond it is refused, the picture shows it", experts_only};
}

}  // namespace

std::vector<CamOption> cam_options_of(CamProfileArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, vector_drawings, are_needed},
       {"side",
        &a.side,
        choice,
        "part: outside of what is drawn, inside in its holes; outside, inside: of each loop; on: the line",
        {.choices = {"part", "outside", "inside", "on"}}}},
      edge_rows(a),
      mill_rows(a, CamFor::everyone),
      {sheet_row(a.sheet)},
  });
}

std::vector<CamOption> cam_options_of(CamPocketArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, vector_drawings, are_needed},
       {"tool", &a.tool, length, "diameter of the cutter"},
       {"depth", &a.depth, length, "of the pocket, below 0", {.is_of_machine = true}},
       {"step", &a.step, length, "how deep a layer is, at most"},
       {"step-over",
        &a.step_over,
        percent,
        "from loop to loop, percent of the cutter's diameter",
        {.range = CamRange{1, 95}}},
       {"engagement",
        &a.engagement,
        degrees,
        "never more than this angle of the cutter in the stock, degrees (constant engagement); 0: loops",
        {.range = CamRange{0, 150}, .matters_to = experts}},
       join_row(a.join),
       ramp_row(a.ramp)},
      mill_rows(a, CamFor::everyone),
      {sheet_row(a.sheet)},
  });
}

namespace {

std::vector<CamOption> letter_rows(CamEngraveArguments& a) {
  using enum CamKind;
  return {
      {"text", &a.text, text, "letters instead of a drawing"},
      {"font",
       &a.font,
       file,
       "font of outlines (.ttf, .otf) or of single lines (.lff, .jhf), or simplex: such a one that is built in",
       {.choices = {"simplex"}}},
      {"height", &a.height, length, "of a capital letter"},
      {"text-align",
       &a.text_align,
       choice,
       "where X0 is in a line of text: left, middle or right",
       {.choices = {"left", "middle", "right"}}},
      {"around", &a.around, length,
       "the text stands on a circle of this radius about X0 Y0; below 0 inside, at the bottom"},
      {"arc", &a.arc, text,
       "FROM,TO: spread the text on this part of the circle, in degrees from X on, counterclockwise", experts_only},
      {"turn",
       &a.turn,
       degrees,
       "the whole text about X0 Y0, degrees counterclockwise",
       {.range = CamRange{-3600, 3600}, .matters_to = experts}},
      {"on-line", &a.on_line, flag, "follow the lines of the drawing, open ones too, --depth deep", experts_only},
      {"line-space",
       &a.line_space,
       number,
       "from line to line, in heights",
       {.range = CamRange{0.1, 100}, .matters_to = experts}},
  };
}

std::vector<CamOption> carving_rows(CamEngraveArguments& a) {
  using enum CamKind;
  return {
      {"angle", &a.angle, degrees, "between the flanks of the cutter, degrees", {.range = CamRange{5, 170}}},
      {"tip", &a.tip, length, "width of its tip"},
      {"tool", &a.tool, length, "its diameter, the widest that it carves"},
      {"depth", &a.depth, length, "the deepest, below 0; without it as the cutter's width allows, on lines -0.3mm"},
      {"step", &a.step, length, "how much deeper it goes at a time; without it to the depth at once", experts_only},
      {"clear", &a.clear, length, "diameter of a flat cutter that clears what is wider, before"},
      {"clear-step", &a.clear_step, length, "how deep a layer of it is, at most", experts_only},
      {"inlay",
       &a.inlay,
       choice,
       "pocket: carve the hole of an inlay; plug: its mirrored counterpart, which stays",
       {.choices = {"pocket", "plug"}, .matters_to = experts}},
      {"inlay-depth", &a.inlay_depth, length, "of the pocket", experts_only},
      {"glue-gap", &a.glue_gap, length, "room below the plug, for glue", experts_only},
      {"saw-gap", &a.saw_gap, length, "between the faces of both, for the saw", experts_only},
      {"margin", &a.margin, length, "cleared around the plug", experts_only},
      join_row(a.join),
  };
}

}  // namespace

std::vector<CamOption> cam_options_of(CamEngraveArguments& a) {
  using enum CamKind;
  return all_of({
      {{"FILE", &a.files, drawings, "drawings: SVG, DXF or HPGL; what closed lines enclose is carved"}},
      letter_rows(a),
      carving_rows(a),
      mill_rows(a),
      {sheet_row(a.sheet)},
  });
}

}  // namespace passo
