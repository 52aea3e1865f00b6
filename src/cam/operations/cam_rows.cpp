#include "cam_rows.hpp"

#include <utility>

namespace passo {

std::vector<CamOption> all_of(std::initializer_list<std::vector<CamOption>> parts) {
  std::vector<CamOption> rows;
  for (const std::vector<CamOption>& part : parts) rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

CamOption units_row(std::string& units) {
  return {"units",
          &units,
          CamKind::choice,
          "of the program, and of lengths without a unit: mm, cm or inch",
          {.choices = {"mm", "cm", "inch"}, .matters_to = experts}};
}

CamOption join_row(std::string& join) {
  return {
      "join", &join, CamKind::length, "ends of lines that are no farther apart are joined", {.matters_to = experts}};
}

CamOption ramp_row(double& degrees) {
  return {"ramp",
          &degrees,
          CamKind::degrees,
          "go down along the way, this steep in degrees; 0: straight down",
          {.range = CamRange{0, 60}}};
}

CamOption clearance_row(std::string& clearance, const char* help) {
  return {"clearance", &clearance, CamKind::length, help, {.is_of_machine = true}};
}

CamOption spindle_row(std::uint32_t& spindle) {
  return {"spindle", &spindle, CamKind::turns, "turns a minute; 0: the program leaves the spindle alone"};
}

CamOption layer_row(std::vector<std::string>& layers, const char* help, CamFor matters_to) {
  return {"layer", &layers, CamKind::text, help, {.matters_to = matters_to, .is_of_job = true}};
}

CamOption output_row(std::string& output) {
  return {"output",
          &output,
          CamKind::file,
          "write the program to a file; without it to standard output",
          {.matters_to = cli, .is_of_job = true, .letter = "o"}};
}

CamOption picture_row(std::string& picture, const char* help) {
  return {"picture", &picture, CamKind::file, help, {.matters_to = cli, .is_of_job = true, .letter = "p"}};
}

std::vector<CamOption> mill_rows(CamMillArguments& a, CamFor layer) {
  return {
      output_row(a.output),
      picture_row(a.picture, "draw what is milled, and the rapids (FILE.svg or FILE.png)"),
      {"json",
       &a.json,
       CamKind::flag,
       "what was done, for scripts; needs --output",
       {.matters_to = cli, .is_of_job = true}},
      units_row(a.units),
      {"input",
       &a.input,
       CamKind::choice,
       "DXF: unit of the file's numbers; without it as the file says",
       {.choices = {"mm", "cm", "inch"}, .matters_to = experts, .is_of_job = true}},
      {"scale",
       &a.scale,
       CamKind::number,
       "DXF: the numbers times this are in the unit of --input, without it of --units",
       {.matters_to = experts, .is_of_job = true}},
      layer_row(a.layers, "DXF, KiCad: read this layer; may be given again. Without it all that are on", layer),
      {"zero",
       &a.zero,
       CamKind::place,
       "where X0 Y0 is: file, lower-left of the board, or X,Y",
       {.choices = {"file", "lower-left"}, .is_of_job = true}},
      {"mirror",
       &a.mirror,
       CamKind::choice,
       "the board is turned over: x from left to right, y from top to bottom",
       {.choices = {"x", "y"}, .is_of_job = true}},
      {"mirror-at",
       &a.mirror_at,
       CamKind::length,
       "about this X or Y of the drawing; without it 0",
       {.matters_to = experts, .is_of_job = true}},
      {"align",
       &a.align,
       CamKind::length,
       "X,Y,X,Y: turned over so that these two holes change places",
       {.matters_to = experts, .is_of_job = true}},
      {"conventional", &a.conventional, CamKind::flag, "conventional milling; without it climb milling"},
      clearance_row(a.clearance, "height of the rapids above the board"),
      {"feed", &a.feed, CamKind::feed, "a minute, along the way"},
      {"plunge-feed", &a.plunge_feed, CamKind::feed, "a minute, straight down"},
      spindle_row(a.spindle),
      {"park", &a.park, CamKind::length, "X,Y at the start, at tool changes and at the end", {.matters_to = experts}},
  };
}

std::vector<CamOption> edge_rows(CamOutlineArguments& a) {
  return {
      {"tool", &a.tool, CamKind::length, "diameter of the cutter"},
      {"depth", &a.depth, CamKind::length, "of the cut, below 0", {.is_of_machine = true}},
      {"step", &a.step, CamKind::length, "how deep a turn goes, at most"},
      join_row(a.join),
      {"tabs", &a.tabs, CamKind::number, "so many tabs hold each board", {.range = CamRange{0, 1000}}},
      {"tab",
       &a.tab_places,
       CamKind::length,
       "a tab near X,Y; may be given again",
       {.matters_to = experts, .is_of_job = true}},
      {"tab-width", &a.tab_width, CamKind::length, "of the tab that stays"},
      {"tab-height", &a.tab_height, CamKind::length, "of the tab, above the full depth"},
      ramp_row(a.ramp),
      {"lead", &a.lead, CamKind::length, "come to the edge on a quarter of a circle of this radius"},
      {"dog-bones", &a.dog_bones, CamKind::flag, "cut inner corners so that a sharp corner fits in"},
  };
}

}  // namespace passo
