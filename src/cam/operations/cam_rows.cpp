#include "cam_rows.hpp"

#include <utility>

namespace passo {

std::vector<CamOption> all_of(std::initializer_list<std::vector<CamOption>> parts) {
  std::vector<CamOption> rows;
  for (const std::vector<CamOption>& part : parts) rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

std::vector<CamOption> tool_rows(CamToolArguments& a) {
  using enum CamKind;
  return {
      {"tool-table", &a.tool_table, file, "tool library (TOML); cutters can then be given by their numbers, e.g. T3",
       of_one_job},
      {"material",
       &a.material,
       choice,
       "material to cut; it and the tool determine feeds, spindle speed, depth of a pass and stepover",
       {.choices = {"softwood", "hardwood", "plywood", "mdf", "acrylic", "hdpe", "fr4", "foam", "aluminium", "brass"},
        .is_of_job = true}},
      {"limits",
       &a.limits,
       file,
       "machine file; its highest feed rates and spindle speed limit those from --material",
       {.matters_to = cli, .is_of_job = true}},
  };
}

CamOption units_row(std::string& units) {
  using enum CamKind;
  return {"units",
          &units,
          choice,
          "unit of the program, and of lengths given without a unit: mm, cm or inch",
          {.choices = {"mm", "cm", "inch"}, .matters_to = experts}};
}

std::vector<CamOption> controller_rows(CamProgramArguments& a) {
  using enum CamKind;
  return {
      {"for",
       &a.controller,
       choice,
       "controller that runs the program: passo, linuxcnc, grbl, grblhal, mach3 or fanuc-like",
       {.choices = {"passo", "linuxcnc", "grbl", "grblhal", "mach3", "fanuc-like"}}},
      {"start-text",
       &a.start_text,
       file,
       "file with lines for the start of the program; {placeholders} are replaced",
       {.matters_to = cli}},
      {"tool-change-text",
       &a.tool_change_text,
       file,
       "file with lines that replace those of a tool change, e.g. T{tool} M6",
       {.matters_to = cli}},
      {"end-text",
       &a.end_text,
       file,
       "file with lines for the end of the program, before M2 or M30",
       {.matters_to = cli}},
  };
}

std::vector<CamOption> program_rows(CamProgramArguments& a) {
  using enum CamKind;
  return all_of({controller_rows(a),
                 {{"change-height", &a.change_height, length,
                   "Z at the start, at tool changes and at the end of the program", experts_only},
                  {"spindle-delay",
                   &a.spindle_delay,
                   number,
                   "pause after the spindle has started, seconds",
                   {.range = CamRange{0, 60}, .matters_to = experts}},
                  {"coolant",
                   &a.coolant,
                   choice,
                   "coolant while the program cuts: off, mist (M7) or flood (M8)",
                   {.choices = {"off", "mist", "flood"}, .matters_to = experts}}}});
}

CamOption join_row(std::string& join) {
  using enum CamKind;
  return {"join", &join, length, "largest gap across which the ends of lines are joined", experts_only};
}

CamOption ramp_row(double& angle) {
  using enum CamKind;
  return {"ramp",
          &angle,
          degrees,
          "ramp angle of the descent along the toolpath, degrees; 0: straight down",
          {.range = CamRange{0, 60}}};
}

CamOption clearance_row(std::string& clearance, const char* help) {
  using enum CamKind;
  return {"clearance", &clearance, length, help, {.is_of_machine = true}};
}

CamOption spindle_row(std::uint32_t& spindle) {
  using enum CamKind;
  return {"spindle", &spindle, turns, "spindle speed, rpm; 0: no spindle commands in the program"};
}

CamOption layer_row(std::vector<std::string>& layers, const char* help, CamFor matters_to) {
  using enum CamKind;
  return {"layer", &layers, text, help, {.matters_to = matters_to, .is_of_job = true}};
}

CamOption color_row(std::vector<std::string>& colors) {
  return {"color", &colors, CamKind::text,
          "SVG, DXF: colour of shapes to read, e.g. red or #f00 (SVG: of the stroke, else of the fill; DXF: also its "
          "number, 30); can be repeated",
          experts_of_one_job};
}

CamOption name_row(std::vector<std::string>& names) {
  return {"name", &names, CamKind::text,
          "SVG: id or label of a shape or group to read; DXF: name of a block or layer, or handle; can be repeated",
          experts_of_one_job};
}

CamOption output_row(std::string& output) {
  using enum CamKind;
  return {"output",
          &output,
          file,
          "file for the program (default: standard output)",
          {.matters_to = cli, .is_of_job = true, .letter = "o"}};
}

CamOption picture_row(std::string& picture, const char* help) {
  using enum CamKind;
  return {"picture", &picture, file, help, {.matters_to = cli, .is_of_job = true, .letter = "p"}};
}

CamOption input_row(std::string& input, const char* help) {
  const CamTraits traits{.choices = {"mm", "cm", "inch"}, .matters_to = experts, .is_of_job = true};
  return {"input", &input, CamKind::choice, help, traits};
}

CamOption scale_row(std::optional<double>& scale) {
  return {"scale", &scale, CamKind::number,
          "DXF: scale factor; scaled values are in the unit of --input (default: that of --units)", experts_of_one_job};
}

CamOption zero_row(std::string& zero, const char* help) {
  return {"zero", &zero, CamKind::place, help, {.choices = {"file", "lower-left"}, .is_of_job = true}};
}

CamOption mirror_row(std::string& mirror) {
  const char* const help = "mirror for the other side: x, flipped left to right; y, flipped top to bottom";
  return {"mirror", &mirror, CamKind::choice, help, {.choices = {"x", "y"}, .is_of_job = true}};
}

CamOption mirror_at_row(std::string& place) {
  return {"mirror-at", &place, CamKind::length, "X or Y of the mirror axis, in the drawing (default: 0)",
          experts_of_one_job};
}

CamOption park_row(std::string& park) {
  return {"park", &park, CamKind::length, "X,Y: park position at tool changes and at the end of the program",
          experts_only};
}

std::vector<CamOption> mill_rows(CamMillArguments& a, CamFor layer) {
  using enum CamKind;
  std::vector<CamOption> rows{
      output_row(a.output),
      picture_row(a.picture, "picture of the milled areas and the rapids (FILE.svg or FILE.png)"),
      {"json", &a.json, flag, "print a summary as JSON; needs --output", {.matters_to = cli, .is_of_job = true}},
      units_row(a.units),
      input_row(a.input, "DXF: unit of the numbers in the file (default: as the file declares)"),
      scale_row(a.scale),
      layer_row(a.layers, "DXF, KiCad: layer to read; can be repeated (default: all visible layers)", layer),
      color_row(a.colors),
      name_row(a.names),
      zero_row(a.zero, "position of X0 Y0: file (the file's origin), lower-left (of the board), or X,Y"),
      mirror_row(a.mirror),
      mirror_at_row(a.mirror_at),
      {"align", &a.align, length, "X,Y,X,Y: two alignment holes; the mirror axis is midway between them",
       experts_of_one_job},
      {"conventional", &a.conventional, flag, "conventional milling (default: climb milling)"},
      clearance_row(a.clearance, "clearance height: rapids run this far above the work"),
      {"feed", &a.feed, feed, "feed rate along the toolpath, per minute"},
      {"plunge-feed", &a.plunge_feed, feed, "highest feed rate downwards, also along the toolpath, per minute"},
      spindle_row(a.spindle),
      park_row(a.park),
  };
  return all_of({rows, program_rows(a)});
}

std::vector<CamOption> edge_rows(CamOutlineArguments& a) {
  using enum CamKind;
  return {
      {"tool", &a.tool, length, "diameter of the cutter"},
      {"depth", &a.depth, length, "depth of the cut, a negative Z", {.is_of_machine = true}},
      {"step", &a.step, length, "largest depth of one pass around the contour"},
      join_row(a.join),
      {"tabs",
       &a.tabs,
       number,
       "number of tabs on each contour, which hold the part, or the scrap in an opening",
       {.range = CamRange{0, 1000}}},
      {"no-tabs", &a.no_tabs, flag, "no tabs: tape or a vacuum holds the part and the scrap"},
      {"tab", &a.tab_places, length, "X,Y: position near which a tab is placed; can be repeated", experts_of_one_job},
      {"tab-width", &a.tab_width, length, "width of a tab"},
      {"tab-height", &a.tab_height, length, "height of a tab above the full depth"},
      ramp_row(a.ramp),
      {"lead", &a.lead, length, "radius of the lead-in, a quarter circle that meets the contour"},
      {"dog-bones", &a.dog_bones, flag, "dog-bone relief cuts in inside corners, so that a square corner fits"},
  };
}

}  // namespace passo
