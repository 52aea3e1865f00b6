#include "cam_rows.hpp"

#include <utility>

namespace passo {

std::vector<CamOption> all_of(std::initializer_list<std::vector<CamOption>> parts) {
  std::vector<CamOption> rows;
  for (const std::vector<CamOption>& part : parts) rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

CamOption units_row(std::string& units) {
  using enum CamKind;
  return {"units",
          &units,
          choice,
          "of the program, and of lengths without a unit: mm, cm or inch",
          {.choices = {"mm", "cm", "inch"}, .matters_to = experts}};
}

CamOption join_row(std::string& join) {
  using enum CamKind;
  return {"join", &join, length, "ends of lines that are no farther apart are joined", experts_only};
}

CamOption ramp_row(double& angle) {
  using enum CamKind;
  return {"ramp",
          &angle,
          degrees,
          "go down along the way, this steep in degrees; 0: straight down",
          {.range = CamRange{0, 60}}};
}

CamOption clearance_row(std::string& clearance, const char* help) {
  using enum CamKind;
  return {"clearance", &clearance, length, help, {.is_of_machine = true}};
}

CamOption spindle_row(std::uint32_t& spindle) {
  using enum CamKind;
  return {"spindle", &spindle, turns, "turns a minute; 0: the program leaves the spindle alone"};
}

CamOption layer_row(std::vector<std::string>& layers, const char* help, CamFor matters_to) {
  using enum CamKind;
  return {"layer", &layers, text, help, {.matters_to = matters_to, .is_of_job = true}};
}

CamOption output_row(std::string& output) {
  using enum CamKind;
  return {"output",
          &output,
          file,
          "write the program to a file; without it to standard output",
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
          "DXF: the numbers times this are in the unit of --input, without it of --units", experts_of_one_job};
}

CamOption zero_row(std::string& zero, const char* help) {
  return {"zero", &zero, CamKind::place, help, {.choices = {"file", "lower-left"}, .is_of_job = true}};
}

CamOption mirror_row(std::string& mirror) {
  const char* const help = "the board is turned over: x from left to right, y from top to bottom";
  return {"mirror", &mirror, CamKind::choice, help, {.choices = {"x", "y"}, .is_of_job = true}};
}

CamOption mirror_at_row(std::string& place) {
  return {"mirror-at", &place, CamKind::length, "about this X or Y of the drawing; without it 0", experts_of_one_job};
}

CamOption park_row(std::string& park) {
  return {"park", &park, CamKind::length, "X,Y at the start, at tool changes and at the end", experts_only};
}

std::vector<CamOption> mill_rows(CamMillArguments& a, CamFor layer) {
  using enum CamKind;
  return {
      output_row(a.output),
      picture_row(a.picture, "draw what is milled, and the rapids (FILE.svg or FILE.png)"),
      {"json", &a.json, flag, "what was done, for scripts; needs --output", {.matters_to = cli, .is_of_job = true}},
      units_row(a.units),
      input_row(a.input, "DXF: unit of the file's numbers; without it as the file says"),
      scale_row(a.scale),
      layer_row(a.layers, "DXF, KiCad: read this layer; may be given again. Without it all that are on", layer),
      zero_row(a.zero, "where X0 Y0 is: file, lower-left of the board, or X,Y"),
      mirror_row(a.mirror),
      mirror_at_row(a.mirror_at),
      {"align", &a.align, length, "X,Y,X,Y: turned over so that these two holes change places", experts_of_one_job},
      {"conventional", &a.conventional, flag, "conventional milling; without it climb milling"},
      clearance_row(a.clearance, "height of the rapids above the board"),
      {"feed", &a.feed, feed, "a minute, along the way"},
      {"plunge-feed", &a.plunge_feed, feed, "a minute, straight down"},
      spindle_row(a.spindle),
      park_row(a.park),
  };
}

std::vector<CamOption> edge_rows(CamOutlineArguments& a) {
  using enum CamKind;
  return {
      {"tool", &a.tool, length, "diameter of the cutter"},
      {"depth", &a.depth, length, "of the cut, below 0", {.is_of_machine = true}},
      {"step", &a.step, length, "how deep a turn goes, at most"},
      join_row(a.join),
      {"tabs", &a.tabs, number, "so many tabs hold each board", {.range = CamRange{0, 1000}}},
      {"tab", &a.tab_places, length, "a tab near X,Y; may be given again", experts_of_one_job},
      {"tab-width", &a.tab_width, length, "of the tab that stays"},
      {"tab-height", &a.tab_height, length, "of the tab, above the full depth"},
      ramp_row(a.ramp),
      {"lead", &a.lead, length, "come to the edge on a quarter of a circle of this radius"},
      {"dog-bones", &a.dog_bones, flag, "cut inner corners so that a sharp corner fits in"},
  };
}

}  // namespace passo
