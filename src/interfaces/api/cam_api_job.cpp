// CamApi: job files, the drawings that their operations select shapes of, and tool libraries.
#include <algorithm>
#include <numbers>

#include "api_json.hpp"
#include "cam_api.hpp"
#include "part_job_draft.hpp"
#include <fmt/format.h>

#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

bool is_kept(const CamService& maker, const std::string& name) {
  const std::vector<std::string> files = maker.files();
  return std::ranges::find(files, name) != files.end();
}

WebAnswer no_job_file() {
  return error_answer(404, "http.not-found",
                      fmt::format("there is no job file of this name, of at most {} bytes", longest_job_text));
}

std::optional<std::string> text_member(const Json& said, const char* key) {
  if (!said.contains(key) || !said[key].is_string()) return {};
  return said[key].get<std::string>();
}

// As the simulation of the stock has it: a drill is a cone.
Json stock_tool_json(const CuttingTool& tool) {
  constexpr double degrees_per_radian = 180 / std::numbers::pi;
  const bool is_drill = tool.shape == CuttingShape::drill;
  const Mm tip = tool.shape == CuttingShape::bull ? tool.corner_radius : tool.tip;
  return {{"number", tool.number},
          {"words", describe(tool)},
          {"kind", is_drill ? "vee" : std::string(name_of(tool.shape))},
          {"diameter", tool.diameter.value()},
          {"angle", rounded(tool.angle.value * degrees_per_radian)},
          {"tip", tip.value()}};
}

}  // namespace

WebAnswer CamApi::draft_answer(const std::string& name) const {
  const CamService& maker = *shared_.options.maker;
  const auto text = is_kept(maker, name) ? maker.content(name, longest_job_text) : std::nullopt;
  if (!text) return no_job_file();
  return json_answer(200, draft_of_job(*text, {name, maker.folder(), maker.files()}));
}

WebAnswer CamApi::job_file(const ApiCall& call) {
  const auto name = name_from(call.request.query, "");
  if (!name) return name.error();
  return draft_answer(*name);
}

WebAnswer CamApi::edit_job_file(const ApiCall& call) {
  const Json& said = call.body;
  if (!said.is_object()) return bad_body("the body is not a JSON object");
  for (const auto& [key, value] : said.items()) {
    if (key != "name" && key != "stamp" && key != "edits" && key != "text") {
      return bad_body("there is no \"" + key.substr(0, 40) + "\"");
    }
  }
  const auto name = text_member(said, "name");
  const auto stamp = text_member(said, "stamp");
  if (!name || !stamp) return bad_body("expected \"name\", and the \"stamp\" of the job file that is changed");
  if (said.contains("text") && !said["text"].is_string())
    return bad_body("\"text\": expected the text of the job file");
  if (shared_.options.maker == nullptr) return no_maker();
  CamService& maker = *shared_.options.maker;
  const auto before = is_kept(maker, *name) ? maker.content(*name, longest_job_text) : std::nullopt;
  if (!before) return no_job_file();
  if (stamp_of_job(*before) != *stamp) {
    return error_answer(409, "make.job-changed", "the job file was changed in the meantime: open it again");
  }
  std::string text = text_member(said, "text").value_or(*before);
  if (text.size() > longest_job_text) return bad_body(fmt::format("\"text\": at most {} bytes", longest_job_text));
  if (said.contains("edits")) {
    auto edited = edited_job(text, said["edits"]);
    if (!edited) return error_answer(409, "make.cannot-edit", edited.error());
    text = std::move(*edited);
  }
  if (text != *before && !maker.keep(*name, text)) {
    return error_answer(507, "make.no-room",
                        "there is no room for this file: remove other files first, or free disk space");
  }
  return draft_answer(*name);
}

WebAnswer CamApi::shapes(const ApiCall& call) {
  const auto name = name_from(call.request.query, "");
  if (!name) return name.error();
  CamService& maker = *shared_.options.maker;
  if (!is_kept(maker, *name)) return error_answer(404, "http.not-found", "there is no drawing of this name");
  const CamShapes shapes = maker.shapes(*name);
  const Json drawing = shapes.state == CamResult::State::done ? Json::parse(shapes.json, nullptr, false) : Json();
  const bool is_done = drawing.is_object();
  const bool has_failed =
      shapes.state == CamResult::State::failed || (shapes.state == CamResult::State::done && !is_done);
  return json_answer(200, {{"name", *name},
                           {"state", is_done      ? "done"
                                     : has_failed ? "failed"
                                                  : "running"},
                           {"drawing", is_done ? drawing : Json()},
                           {"words", shapes.words}});
}

WebAnswer CamApi::tools(const ApiCall& call) {
  const auto name = name_from(call.request.query, "tools.toml");
  if (!name) return name.error();
  if (call.request.body.size() > longest_job_text) {
    return bad_body(fmt::format("expected a tool library of at most {} bytes", longest_job_text));
  }
  Diagnostics findings;
  const auto library = ToolLibrary::parse(call.request.body, *name, findings);
  Json tools = Json::array();
  if (library) {
    for (const CuttingTool& tool : library->tools()) tools.push_back(stock_tool_json(tool));
  }
  return json_answer(200, {{"tools", std::move(tools)}, {"findings", as_json(findings)}});
}

}  // namespace passo
