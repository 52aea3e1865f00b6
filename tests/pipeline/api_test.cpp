// The API around a session on a virtual machine, in virtual time: what each request does, who may ask, and what hostile
// bodies do.
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "api_kit.hpp"
#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "passo/activity/homing_repeats.hpp"
#include "passo/api/api_routes.hpp"
#include "passo/api/program_store.hpp"
#include "passo/api/web_api.hpp"

namespace passo::test {
namespace {

TEST(ApiDescription, has_just_the_members_that_are_told) {
  const Json document = openapi();
  const Json& schemas = document["components"]["schemas"];
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G1 X9 F100\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  const Json status = run.get("/status");
  expect_members(schemas["Status"], status, "Status");
  expect_members(schemas["Status"]["properties"]["outputs"], status["outputs"], "outputs");
  expect_members(schemas["Status"]["properties"]["overrides"], status["overrides"], "overrides");
  expect_members(schemas["Status"]["properties"]["inputs"], status["inputs"], "inputs");
  expect_members(schemas["Owner"], status["owner"], "Owner");
  expect_members(schemas["Job"], status["job"], "Job");
  expect_members(schemas["Program"], run.get(fmt::format("/programs/{}", id)), "Program");
  expect_members(schemas["Machine"], run.get("/machine"), "Machine");
  const Json abilities = run.get("/machine")["abilities"];
  ASSERT_EQ(abilities.size(), ability_count);
  // Boards of ours home all axes together.
  for (const Json& one : abilities)
    EXPECT_EQ(one["can"], one["ability"] != "home-axis" && one["ability"] != "board-files") << one["ability"];
  expect_members(schemas["Machine"]["properties"]["axes"]["items"], run.get("/machine")["axes"][0], "axes");
  expect_members(schemas["Health"], run.get("/health"), "Health");
}

// Each example of a body is understood, and a body with one member more is not.
TEST(ApiDescription, has_bodies_that_are_understood) {
  const Json document = openapi();
  int examples = 0;
  for (const auto& [path, operations] : document["paths"].items()) {
    if (!operations.contains("post") || path == "/owner") continue;
    const Json& content = operations["post"].value("requestBody", Json::object());
    if (!content.contains("content") || !content["content"].contains("application/json")) continue;
    const Json& body = content["content"]["application/json"];
    ApiRun run;
    run.own();
    std::string to = path;
    if (const std::size_t id = to.find("{id}"); id != std::string::npos) {
      to.replace(id, 4, std::to_string(run.upload("G21 G1 X9 F100\nM2\n")));
    }
    run.post(to, body["example"].dump());
    EXPECT_NE(run.status, 400U) << path;
    expect_members(body["schema"], body["example"], path);
    Json more = body["example"];
    more["other"] = 1;
    EXPECT_EQ(run.post(to, more.dump())["error"]["code"], "http.bad-body") << path;
    EXPECT_EQ(run.status, 400U) << path;
    ++examples;
  }
  EXPECT_GE(examples, 5);
}

// Notes what was ordered, and answers at once.
class NotedStudies final : public Studies {
 public:
  bool begin(const StudyOrder& order) override {
    last = order;
    found = {.state = StudyResult::State::done, .words = "said", .report = R"({"margin": null})"};
    return true;
  }
  const StudyResult& result() override { return found; }
  std::string loads() const override { return "line,load\n1,0.500\n"; }
  std::string picture() const override { return ""; }
  StudyOrder last;
  StudyResult found;
};

// Says how far it is, and makes nothing.
class SlowMaker final : public CamService {
 public:
  std::vector<std::string> files() const override { return {"holes.drl", "plate.toml"}; }
  bool keep(const std::string& name, std::string_view bytes) override {
    kept[name] = bytes;
    return true;
  }
  std::optional<std::string> content(const std::string& name, std::size_t most) const override {
    const auto found = kept.find(name);
    return found != kept.end() && found->second.size() <= most ? std::optional(found->second) : std::nullopt;
  }
  std::string folder() const override { return "/nowhere/"; }
  CamShapes shapes(const std::string&) override { return drawn; }
  bool remove(const std::string& name) override { return kept.erase(name) > 0; }
  void clear() override { kept.clear(); }
  bool begin(const CamOrder& order) override {
    now = {.state = CamResult::State::running, .job = order.job};
    return true;
  }
  const CamResult& result() override { return now; }
  std::string program(std::size_t) const override { return "M2\n"; }
  std::string picture(std::optional<std::size_t>) const override { return ""; }
  std::string page() const override { return ""; }
  CamResult now;
  CamShapes drawn;
  std::map<std::string, std::string> kept;
};

TEST(ApiCam, shows_the_progress_of_its_job) {
  SlowMaker maker;
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, &maker);
  expect_members(openapi()["components"]["schemas"]["Cam"], run.get("/cam"), "Cam");
  EXPECT_EQ(run.get("/cam")["progress"], 0);
  EXPECT_EQ(run.post("/cam", R"({"job": "drill", "files": ["holes.drl"]})")["progress"], 0);
  EXPECT_EQ(run.status, 202U);
  maker.now.progress = 0.42;
  EXPECT_EQ(run.get("/cam")["progress"], 0.42);
  EXPECT_EQ(run.get("/cam")["state"], "running");
  maker.now.state = CamResult::State::done;
  maker.now.names = {"holes-drill.ngc"};
  maker.now.progress = 1;
  EXPECT_EQ(run.get("/cam")["progress"], 1);
}

TEST(ApiCam, edits_a_job_file_and_keeps_all_else) {
  SlowMaker maker;
  const std::string text =
      "# A plate.\n[job]\ndrawing = \"plate.svg\"\nmine = 1 # unknown\n\n[tool.1]\nshape = \"flat\"\ndiameter_mm = "
      "6\n\n"
      "[[operation]] # one\nkind = \"pocket\"\ntool = 1\ndeph = -3 # aligned\n\n[[operation]]\nkind = "
      "\"profile\"\ntool = 1\n";
  maker.kept["plate.toml"] = text;
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, &maker);
  Json draft = run.get("/cam/job?name=plate.toml");
  EXPECT_EQ(run.status, 200U);
  expect_members(openapi()["components"]["schemas"]["CamJobFile"], draft, "CamJobFile");
  EXPECT_EQ(draft["text"], text);
  EXPECT_EQ(draft["editable"], true);
  EXPECT_EQ(draft["good"], false);
  EXPECT_EQ(draft["operations"][0]["values"]["deph"], -3);
  EXPECT_EQ(draft["operations"][0]["lines"]["deph"], 13);
  bool finds_line = false;
  for (const Json& finding : draft["findings"])
    finds_line = finds_line || (finding["line"] == 13 && finding["column"] == 1);
  EXPECT_TRUE(finds_line) << draft["findings"];
  const auto edit = [&](const Json& stamp, const std::string& edits) {
    return run.post("/cam/job",
                    fmt::format(R"({{"name": "plate.toml", "stamp": {}, "edits": [{}]}})", stamp.dump(), edits));
  };
  draft = edit(draft["stamp"], R"({"do": "unset", "path": "operation.1.deph"}, {"do": "unset", "path": "job.mine"},
                                  {"do": "set", "path": "operation.2.tab", "value": [[1, 2], [3, 4]]},
                                  {"do": "move", "number": 2, "to": 1})");
  EXPECT_EQ(run.status, 200U) << draft;
  EXPECT_EQ(draft["good"], true) << draft["findings"];
  EXPECT_EQ(maker.kept["plate.toml"],
            "# A plate.\n[job]\ndrawing = \"plate.svg\"\n\n[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\n\n"
            "[[operation]]\nkind = \"profile\"\ntool = 1\ntab = [[1, 2], [3, 4]]\n\n"
            "[[operation]] # one\nkind = \"pocket\"\ntool = 1\n");
  EXPECT_EQ(draft["tools"][0]["number"], 1);
  const std::string good = maker.kept["plate.toml"];
  // Someone else has changed the file meanwhile; an edit fails; a value is no value.
  edit("0", R"({"do": "remove", "number": 1})");
  EXPECT_EQ(run.status, 409U);
  for (const char* const wrong : {R"({"do": "copy", "number": 1}, {"do": "copy", "number": 9})",
                                  R"({"do": "set", "path": "operation.1.x", "value": null})",
                                  R"({"do": "set", "path": "operation.1.x y", "value": 1})",
                                  R"({"do": "insert", "number": 1, "values": {"a\nb": 1}})", R"({"do": "shred"})", "7",
                                  R"({"do": "set", "path": 7, "value": [[[[1]]]]})"}) {
    edit(draft["stamp"], wrong);
    EXPECT_EQ(run.status, 409U) << wrong;
    EXPECT_EQ(maker.kept["plate.toml"], good) << wrong;
  }
  // A key that is too deep for the parser, and a text that is too long for a line.
  std::string deep = "operation.1";
  for (int i = 0; i < 2000; ++i) deep += ".x";
  for (const std::string& wrong :
       {fmt::format(R"({{"do": "set", "path": "{}", "value": 1}})", deep),
        fmt::format(R"({{"do": "set", "path": "operation.1.title", "value": "{}"}})", std::string(5000, 'x'))}) {
    edit(draft["stamp"], wrong);
    EXPECT_EQ(run.status, 409U) << wrong.substr(0, 40);
    EXPECT_EQ(maker.kept["plate.toml"], good) << wrong.substr(0, 40);
  }
  for (const char* const no_text : {"7", "null", "[\"[job]\"]"}) {
    run.post("/cam/job",
             fmt::format(R"({{"name": "plate.toml", "stamp": {}, "text": {}}})", draft["stamp"].dump(), no_text));
    EXPECT_EQ(run.status, 400U) << no_text;
    EXPECT_EQ(maker.kept["plate.toml"], good) << no_text;
  }
  // Clamps are a list of their own; tables that are not there are begun.
  draft =
      edit(draft["stamp"], R"({"do": "insert", "list": "clamp", "number": 1, "values": {"from": [0, 0], "to": [1, 1],
                                  "height": 2}}, {"do": "copy", "list": "clamp", "number": 1},
                                 {"do": "set", "path": "clamp.2.height", "value": 3},
                                 {"do": "set", "path": "nest.quantity", "value": 2},
                                 {"do": "set", "path": "tool.2.shape", "value": "flat"},
                                 {"do": "set", "path": "tool.2.diameter_mm", "value": 3})");
  EXPECT_EQ(run.status, 200U) << draft;
  EXPECT_EQ(draft["clamp_paths"], Json({"clamp.1", "clamp.2"}));
  EXPECT_EQ(draft["clamps"][1]["height"], 3);
  EXPECT_EQ(draft["nest"]["quantity"], 2);
  EXPECT_EQ(draft["tool_tables"]["2"]["diameter_mm"], 3);
  draft = edit(draft["stamp"], R"({"do": "remove", "list": "clamp", "number": 1})");
  EXPECT_EQ(draft["clamp_paths"], Json::array({"clamp.1"}));
  EXPECT_EQ(draft["clamps"][0]["height"], 3);
  edit(draft["stamp"], R"({"do": "remove", "list": "tool", "number": 1})");
  EXPECT_EQ(run.status, 409U);
  edit(draft["stamp"], R"({"do": "remove", "path": "tool.7"})");
  EXPECT_EQ(run.status, 409U);
  draft = edit(draft["stamp"], R"({"do": "remove", "path": "tool.2"})");
  EXPECT_EQ(run.status, 200U) << draft;
  EXPECT_FALSE(draft["tool_tables"].contains("2")) << draft["tool_tables"];
  // A text with errors is kept, so that it can be mended.
  draft = run.post("/cam/job",
                   fmt::format(R"({{"name": "plate.toml", "stamp": {}, "text": "[job\n"}})", draft["stamp"].dump()));
  EXPECT_EQ(draft["editable"], false);
  EXPECT_EQ(draft["findings"][0]["line"], 1);
  edit(draft["stamp"], R"({"do": "copy", "number": 1})");
  EXPECT_EQ(run.status, 409U);
}

TEST(ApiCam, reads_no_tool_library_that_was_not_sent) {
  SlowMaker maker;
  maker.kept["plate.toml"] = "[job]\ntools = \"/dev/zero\"\n[[operation]]\nkind = \"drill\"\ntool = 1\n";
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, &maker);
  EXPECT_EQ(run.get("/cam/job?name=plate.toml")["findings"][0]["code"], "job.outside");
  run.get("/cam/job?name=other.toml");
  EXPECT_EQ(run.status, 404U);
}

TEST(ApiCam, removes_one_file_or_all) {
  SlowMaker maker;
  maker.kept = {{"a.svg", ""}, {"b c.svg", ""}, {"d.svg", ""}};
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, &maker);
  run.ask("DELETE", "/cam/files?name=b%20c.svg");
  EXPECT_EQ(run.status, 200U);
  EXPECT_EQ(maker.kept.size(), 2U);
  run.ask("DELETE", "/cam/files?name=b%20c.svg");
  EXPECT_EQ(run.status, 404U);
  run.ask("DELETE", "/cam/files?name=..%2Fa.svg");
  EXPECT_EQ(run.status, 400U);
  EXPECT_EQ(maker.kept.size(), 2U);
  run.ask("DELETE", "/cam/files");
  EXPECT_EQ(run.status, 200U);
  EXPECT_TRUE(maker.kept.empty());
}

TEST(ApiTools, are_read_as_the_simulation_has_them) {
  ApiRun run(GrblRun::at_zero());
  std::ifstream file(PASSO_SOURCE_DIR "/examples/tools/router-tools.toml");
  std::ostringstream text;
  text << file.rdbuf();
  const Json library = run.ask("POST", "/tools?name=router.toml", text.str(), "", "application/octet-stream");
  expect_members(openapi()["components"]["schemas"]["ToolLibrary"], library, "ToolLibrary");
  ASSERT_EQ(library["tools"].size(), 8U) << library;
  const auto shape = [&](std::size_t i) {
    const Json& tool = library["tools"][i];
    return fmt::format("{} {} {} {} {}", tool["number"].dump(), tool["kind"].get<std::string>(),
                       tool["diameter"].dump(), tool["angle"].dump(), tool["tip"].dump());
  };
  EXPECT_EQ(shape(2), "3 vee 6.0 60.0 0.1");
  EXPECT_EQ(shape(3).substr(0, 10), "4 bull 6.0");
  EXPECT_EQ(shape(4), "5 taper 6.0 12.0 1.0");
  EXPECT_EQ(shape(7), "8 vee 3.0 118.0 0.0") << "a drill";
  const Json wrong =
      run.ask("POST", "/tools", "[tool.1]\ndiameter_mm = 3\nshape = \"round\"\n", "", "application/octet-stream");
  EXPECT_TRUE(wrong["tools"].empty());
  EXPECT_EQ(wrong["findings"][0]["line"], 3) << wrong;
}

TEST(ApiCam, tells_the_shapes_of_a_drawing) {
  SlowMaker maker;
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, &maker);
  EXPECT_EQ(run.get("/cam/shapes?name=holes.drl")["state"], "running");
  maker.drawn = {.state = CamResult::State::done, .json = R"({"shapes": []})", .words = "note"};
  const Json shapes = run.get("/cam/shapes?name=holes.drl");
  expect_members(openapi()["components"]["schemas"]["CamShapes"], shapes, "CamShapes");
  EXPECT_EQ(shapes["state"], "done");
  EXPECT_TRUE(shapes["drawing"]["shapes"].is_array());
  run.get("/cam/shapes?name=other.svg");
  EXPECT_EQ(run.status, 404U);
}

TEST(ApiStudies, are_ordered_with_all_that_they_need) {
  NotedStudies studies;
  ApiRun run(GrblRun::at_zero(), nullptr, {}, &studies);
  expect_members(openapi()["components"]["schemas"]["Study"], run.get("/study"), "Study");
  EXPECT_EQ(run.get("/study")["state"], "none");
  run.get("/study/loads");
  EXPECT_EQ(run.status, 404U) << "nothing is done yet";
  run.own();
  run.post("/work", R"({"place": {"x": 5}})");
  const std::uint64_t id = run.upload("G21 G1 X9 F100\nM2\n");
  const Json answer = run.post("/study", fmt::format(R"({{"study": "motors", "program": {}, "machine": "text"}})", id));
  EXPECT_EQ(run.status, 202U) << answer;
  EXPECT_EQ(answer["program"], id);
  EXPECT_EQ(studies.last.program, "G21 G1 X9 F100\nM2\n");
  EXPECT_EQ(studies.last.machine, "text");
  EXPECT_EQ(studies.last.dialect, "linuxcnc");
  EXPECT_NE(studies.last.parameters.find("5221\t-5.0"), std::string::npos) << "the offsets of the work";
  EXPECT_TRUE(answer["report"]["margin"].is_null());
  run.post("/study", R"({"study": "tune", "machine": "text", "margin": 0.5})");
  EXPECT_EQ(run.status, 202U);
  EXPECT_EQ(studies.last.kind, StudyOrder::Kind::tune);
  EXPECT_EQ(studies.last.options, std::vector<std::string>{"--margin=0.5"});
  run.post("/study", R"({"study": "tune", "machine": "text", "margin": "0.4"})");
  EXPECT_EQ(studies.last.options, std::vector<std::string>{"--margin=0.4"});
  run.post("/study", R"({"study": "tune", "machine": "text", "axes": "X", "keep-velocity": true})");
  EXPECT_EQ(studies.last.options, (std::vector<std::string>{"--axes=X", "--keep-velocity"}));
  expect_members(openapi()["components"]["schemas"]["StudyOptions"], run.get("/study/options"), "StudyOptions");
  run.get("/study/picture");
  EXPECT_EQ(run.status, 404U) << "there is none";
}

TEST(ApiStudies, refuse_what_is_no_order) {
  NotedStudies studies;
  ApiRun run(GrblRun::at_zero(), nullptr, {}, &studies);
  for (const char* body :
       {"", "[]", R"({"study": "moon"})", R"({"study": "tune"})", R"({"study": "tune", "machine": "m", "margin": 2})",
        R"({"study": "tune", "machine": "m", "margin": "much"})", R"({"study": "motors", "machine": "m"})",
        R"({"study": "motors", "machine": "m", "program": -1})", R"({"study": "tune", "machine": 5})"}) {
    run.post("/study", body);
    EXPECT_EQ(run.status, 400U) << body;
  }
  run.post("/study", R"({"study": "motors", "machine": "m", "program": 99})");
  EXPECT_EQ(run.status, 404U);
  EXPECT_TRUE(studies.last.machine.empty()) << "none was ordered";
}

TEST(Api, runs_a_program_after_its_check_and_tells_how_far_it_is) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G90\nG1 X10 F600\nG1 Y10\nM2\n", "?name=part.ngc");
  const Json job = run.post(fmt::format("/programs/{}/run", id));
  EXPECT_EQ(run.status, 202U);
  EXPECT_EQ(job["state"], "checking");
  ASSERT_TRUE(run.turn_until_state("Run"));
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] > 5.0; }));
  EXPECT_EQ(run.get("/status")["line"], 2);
  // Of what is executed, though all of it is planned.
  EXPECT_NEAR(run.get("/status")["progress"].get<double>(), 0.25, 0.05);
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["y"] > 5.0; }));
  EXPECT_EQ(run.get("/status")["line"], 3);
  EXPECT_NEAR(run.get("/status")["progress"].get<double>(), 0.75, 0.05);
  ASSERT_TRUE(run.turn_until_state("Idle"));
  EXPECT_EQ(run.get("/status")["job"]["state"], "done");
  EXPECT_EQ(run.get("/status")["place"]["y"], 10.0);
}

TEST(Api, a_program_with_errors_moves_nothing_and_says_why) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G90\nG1 X10\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "failed"; }));
  const Json program = run.get(fmt::format("/programs/{}", id));
  EXPECT_EQ(program["state"], "bad");
  EXPECT_EQ(program["findings"][0]["line"], 2);
  EXPECT_EQ(program["findings"][0]["code"], "gcode.missing-feed");
  EXPECT_EQ(program["findings"][0]["message_sentence"],
            Json({{"code", "gcode.missing-feed"}, {"arguments", Json::object()}}));
  EXPECT_EQ(program["findings"][0]["expected_sentence"]["code"], "expected.feed-first");
  EXPECT_EQ(run.get("/status")["job"]["why_sentence"]["arguments"]["finding.code"], "gcode.missing-feed");
  EXPECT_EQ(run.run.board().counts().events, 0U);
}

TEST(Api, holds_resumes_and_stops) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G90 M3 S1000\nG1 X30 F600\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] > 3.0; }));
  EXPECT_EQ(run.ask("POST", "/hold", "", "nobody")["ticket"].is_number(), true) << "everybody may";
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["rests"] == true; }));
  EXPECT_EQ(run.get("/status")["holds"], Json({"operator"}));
  EXPECT_EQ(run.ask("POST", "/resume", "", "nobody")["error"]["code"], "owner.not-you");
  EXPECT_EQ(run.status, 403U);
  run.post("/outputs", R"({"spindle_stands": true})");
  EXPECT_EQ(run.status, 200U);
  EXPECT_EQ(run.get("/status")["outputs"]["spindle"], "off");
  run.post("/resume");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] > 15.0; }));
  run.ask("POST", "/stop", "", "nobody");
  ASSERT_TRUE(run.turn_until_state("Idle"));
  EXPECT_EQ(run.get("/status")["job"]["state"], "stopped");
  EXPECT_LT(run.get("/status")["place"]["x"], 25.0);
}

TEST(Api, a_job_that_is_about_to_begin_is_called_off_by_a_hold_and_by_a_stop) {
  for (const char* call : {"/hold", "/stop"}) {
    ApiRun run;
    run.own();
    run.post(fmt::format("/programs/{}/run", run.upload("G21 G1 X30 F600\nM2\n")));
    EXPECT_EQ(run.get("/status")["job"]["state"], "checking");
    run.ask("POST", call, "", "nobody");
    EXPECT_EQ(run.status, 200U);
    run.pass(Seconds(1));
    EXPECT_EQ(run.get("/status")["job"]["state"], "stopped");
    EXPECT_EQ(run.run.board().counts().events, 0U);
  }
}

// So a client that hears late never takes the rest before a motion for its end.
TEST(Api, a_motion_begins_with_a_version_of_the_status) {
  ApiRun run;
  run.own();
  const Json before = run.get("/status");
  const Json taken = run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 1, "lease": 5})");
  EXPECT_GT(taken["change"], before["change"]);
  EXPECT_EQ(run.get("/status")["state"], "Jog");
  EXPECT_EQ(run.get("/status")["change"], taken["change"]);
  ASSERT_TRUE(run.turn_until_state("Idle"));
  EXPECT_GT(run.get("/status")["change"], taken["change"]);
}

TEST(Api, a_jog_ends_with_its_lease) {
  ApiRun run;
  run.own();
  run.post("/jog", R"({"direction": {"x": 1}, "speed": 1200})");
  EXPECT_EQ(run.status, 200U);
  for (int i = 0; i < 10; ++i) {
    run.pass(Seconds(0.1));
    run.post("/jog/renew");
    EXPECT_EQ(run.status, 200U);
  }
  EXPECT_EQ(run.get("/status")["state"], "Jog");
  ASSERT_TRUE(run.turn_until_state("Idle"));
  EXPECT_GT(run.get("/status")["place"]["x"], 18.0);
  EXPECT_LT(run.get("/status")["place"]["x"], 27.0);
  EXPECT_EQ(run.post("/jog/renew")["error"]["code"], "machine.nothing-runs");
  EXPECT_EQ(run.status, 409U);
}

TEST(Api, motion_has_one_owner_and_passes_at_rest) {
  ApiRun run;
  EXPECT_EQ(run.post("/home")["error"]["code"], "owner.not-you") << "nobody is not enough";
  run.own();
  const std::string first = run.key;
  const std::uint64_t id = run.upload("G21 G90\nG1 X30 F600\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until_state("Run"));
  EXPECT_EQ(run.post("/owner")["error"]["code"], "owner.moves");
  EXPECT_EQ(run.status, 409U);
  run.post("/hold");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["rests"] == true; }));
  run.own();
  EXPECT_NE(run.key, first);
  EXPECT_EQ(run.ask("POST", "/resume", "", first)["error"]["code"], "owner.not-you");
  run.post("/resume");
  EXPECT_EQ(run.status, 200U);
  ASSERT_TRUE(run.turn_until_state("Idle"));
  EXPECT_EQ(run.get("/status")["place"]["x"], 30.0);
  run.ask("DELETE", "/owner");
  EXPECT_EQ(run.get("/status")["owner"]["kind"], "nobody");
}

TEST(Api, a_silent_owner_loses_the_motion_while_nothing_moves) {
  ApiRun run;
  run.own();
  run.pass(MachineControl::silent_for - Seconds(1));
  run.post("/hold");  // refused, but heard
  run.pass(MachineControl::silent_for - Seconds(1));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::client);
  run.pass(Seconds(3));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::nobody);
}

TEST(Api, senders_and_clients_share_a_machine_one_after_the_other) {
  ApiRun run;
  ASSERT_TRUE(run.owner.claim_for_sender());
  run.run.send("G1 X20 F600\n");
  ASSERT_TRUE(run.turn_until_state("Run"));
  EXPECT_EQ(run.post("/owner")["error"]["code"], "owner.moves") << "for the sender";
  ASSERT_TRUE(run.turn_until_state("Line"));
  run.own();
  ASSERT_TRUE(run.turn_until_state("Idle"));
  run.run.replies.clear();
  run.run.send("G1 X0\n$G\n?");
  run.pass(Seconds(0.1));
  EXPECT_EQ(run.run.replies.front().substr(0, 5), "<Idle");
  EXPECT_EQ(run.run.replies[1], "error:9");
  EXPECT_EQ(run.run.replies.back(), "ok") << "a question is answered";
  run.post("/jog", R"({"direction": {"y": 1}, "speed": 600, "distance": 3, "lease": 5})");
  ASSERT_TRUE(run.turn_until_state("Idle"));
  run.ask("DELETE", "/owner");
  ASSERT_TRUE(run.owner.claim_for_sender());
  run.run.grbl().let_drive(true);
  run.run.send("G91 G1 Y1 F600\n");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["y"] == 4.0; })) << run.get("/status");
  EXPECT_EQ(run.get("/status")["place"]["x"], 20.0);
}

TEST(Api, a_sender_that_only_watches_may_hold) {
  ApiRun run;
  run.own();
  run.post(fmt::format("/programs/{}/run", run.upload("G21 G1 X30 F600\nM2\n")));
  ASSERT_TRUE(run.turn_until_state("Run"));
  run.run.send("~\x18!");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["state"] == "Hold"; }));
  EXPECT_EQ(run.get("/status")["job"]["state"], "running");
}

TEST(Api, refuses_what_it_does_not_know) {
  ApiRun run;
  run.own();
  EXPECT_EQ(run.get("/nothing")["error"]["code"], "http.not-found");
  EXPECT_EQ(run.get("/programs/99")["error"]["code"], "http.not-found");
  EXPECT_EQ(run.get("/programs/99999999999999999999999")["error"]["code"], "http.not-found");
  EXPECT_EQ(run.get("/programs/1x")["error"]["code"], "http.not-found");
  EXPECT_EQ(run.get("/hold")["error"]["code"], "http.method");
  EXPECT_EQ(run.ask("DELETE", "/status")["error"]["code"], "http.method");
  for (const char* body : {"", "{", "[]", "7", "null", R"({"direction": 5, "speed": 1})", R"({"direction": {"q": 1}})",
                           R"({"direction": {}, "speed": 1})", R"({"direction": {"x": "1"}, "speed": 1})",
                           R"({"direction": {"x": 1}, "speed": "fast"})", R"({"direction": {"x": 1}, "speed": 1e999})",
                           R"({"direction": {"x": 1}, "speed": -1})", R"({"direction": {"x": 1}})"}) {
    run.post("/jog", body);
    EXPECT_EQ(run.status, 400U) << body;
  }
  EXPECT_EQ(run.post("/override", R"({"feed": 3})")["error"]["code"], "machine.bad-value");
  EXPECT_EQ(run.run.board().counts().events, 0U);
}

TEST(Api, programs_are_bounded_in_number) {
  ApiRun run;
  run.own();
  for (std::size_t i = 0; i < ProgramStore::most_programs; ++i) run.upload("M2\n");
  EXPECT_EQ(run.ask("POST", "/programs", "M2\n")["error"]["code"], "programs.no-room");
  EXPECT_EQ(run.status, 507U);
  run.ask("DELETE", "/programs/1");
  EXPECT_EQ(run.status, 200U);
  run.upload("M2\n");
}

TEST(Api, counts_for_prometheus) {
  ApiRun run;
  const WebAnswer answer = run.api.answer({.method = "GET", .path = "/api/v1/metrics"});
  EXPECT_NE(answer.body.find("passo_state{state=\"Idle\"} 1\n"), std::string::npos);
  EXPECT_NE(answer.body.find("# TYPE passo_jobs_ended_total counter\n"), std::string::npos);
  std::istringstream lines(answer.body);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(line.starts_with("# ") || line.starts_with("passo_")) << line;
  }
}

TEST(Api, takes_requests_over_the_stream) {
  ApiRun run;
  run.own();
  const Json answer = Json::parse(run.api.hear(
      Json({{"do", "/api/v1/jog"}, {"key", run.key}, {"body", {{"direction", {{"x", 1}}}, {"speed", 600}}}}).dump(),
      1));
  EXPECT_EQ(answer["status"], 200);
  ASSERT_TRUE(run.turn_until_state("Jog"));
  EXPECT_EQ(Json::parse(run.api.hear("nonsense", 1))["status"], 404);
  EXPECT_EQ(Json::parse(run.api.hear(R"({"do": 5})", 1))["status"], 404);
  EXPECT_EQ(Json::parse(run.api.hear(R"({"do": "/api/v1/jog/renew"})", 1))["status"], 403);
}

// A machine whose jobs are kept.
TEST(Api, a_program_that_was_checked_from_this_place_begins_at_once) {
  ApiRun run;
  run.own();
  std::string text = "G21 G90 F600\n";
  for (int i = 0; i < 20'000; ++i) text += i % 2 == 0 ? "G1 X1\n" : "G1 X0\n";
  const std::string program = fmt::format("/programs/{}", run.upload(text + "M2\n"));
  const auto turns_to = [&](const std::string& state) {
    int turns = 0;
    for (; turns < 10'000 && run.get("/status")["state"] != state && run.get(program)["state"] != state; ++turns)
      run.poll();
    return turns;
  };
  run.post(program + "/check");
  EXPECT_GT(turns_to("good"), 4);
  run.post(program + "/run");
  EXPECT_LE(turns_to("Run"), 2);
  run.pass(Seconds(0.05));
  run.post("/stop");
  ASSERT_TRUE(run.turn_until_state("Idle"));
  run.post(program + "/run");
  EXPECT_GT(turns_to("Run"), 2) << "from another place";
}

TEST(HomingRepeats, are_counted_from_the_first_homing_since_the_place_was_known) {
  const MachineDescription machine = example_machine("router");
  const AxisDescription& x = machine.axes[0];
  const double switch_at = x.home->switch_at;
  const double step = 1 / x.steps_per_unit;
  HomingRepeats repeats(machine);
  repeats.record({{.axis = Axis::x, .way = 123, .place = 0}}, std::nullopt);
  // Stands at 0, and the switch closes one step farther, then two steps nearer than that.
  for (const double shift : {step, -2 * step}) {
    repeats.record({{.axis = Axis::x, .way = switch_at + shift, .place = 0}}, Point());
  }
  auto all = repeats.axes();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].homings, 3U);
  EXPECT_EQ(all[0].spread_steps, 2);
  EXPECT_NEAR(all[0].last, -2000 * step, 1e-9);
  EXPECT_NEAR(all[0].mean, 0, 1e-9) << "0, 1 and -1 steps";
  repeats.record({{.axis = Axis::x, .way = 5, .place = 0}}, std::nullopt);
  EXPECT_EQ(repeats.axes()[0].homings, 1U);
}

class KeptApi : public testing::Test {
 protected:
  KeptApi() { std::filesystem::create_directories(folder_); }
  ~KeptApi() override { std::filesystem::remove_all(folder_); }
  std::unique_ptr<JobHistory> open() const { return std::move(*JobHistory::open((folder_ / "jobs").string())); }

 private:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("passo-api-" + std::to_string(getpid()));
};

TEST_F(KeptApi, a_queued_job_waits_until_somebody_runs_it) {
  {
    const auto history = open();
    ApiRun run(GrblRun::at_zero(), history.get());
    EXPECT_EQ(run.ask("POST", "/queue?name=a.ngc", "G21 G90 G1 X3 F600\nM2\n")["id"], 1);
    EXPECT_EQ(run.status, 201U);
    run.ask("POST", "/queue?name=b.ngc&dialect=grbl", "G1 X1 F600\n");
    run.pass(Seconds(5));
    EXPECT_EQ(run.run.board().counts().events, 0U) << "never by itself";
    EXPECT_EQ(run.post("/queue/1/run")["error"]["code"], "owner.not-you");
  }
  const auto history = open();
  ApiRun run(GrblRun::at_zero(), history.get());
  EXPECT_EQ(run.get("/queue")["jobs"].size(), 2U) << "after another start";
  run.own();
  EXPECT_EQ(run.post("/queue/1/run")["state"], "checking");
  EXPECT_EQ(run.post("/queue/2/run")["error"]["code"], "machine.busy");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
  EXPECT_EQ(run.get("/status")["place"]["x"], 3.0);
  EXPECT_EQ(run.get("/queue")["jobs"][0]["name"], "b.ngc");
  const Json ended = run.get("/history")["jobs"];
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(ended[0]["state"], "done");
  EXPECT_GT(ended[0]["ended_at"], ended[0]["begun_at"]);
  expect_members(openapi()["components"]["schemas"]["HistoryJob"], ended[0], "HistoryJob");
  EXPECT_EQ(run.post("/queue/1/run")["error"]["code"], "http.not-found") << "it is done";
  run.ask("DELETE", "/queue/2");
  EXPECT_EQ(run.get("/queue")["jobs"].size(), 0U);
}

// A client that got no answer repeats its request. Whatever has become of the job, no second one comes into being.
TEST_F(KeptApi, an_attempt_is_queued_once) {
  const std::string text = "G21 G90 G1 X3 F600\nM2\n";
  {
    const auto history = open();
    ApiRun run(GrblRun::at_zero(), history.get());
    EXPECT_EQ(run.get("/queue/attempts/part-7")["error"]["code"], "http.not-found");
    EXPECT_EQ(run.ask("PUT", "/queue/attempts/part-7?name=a.ngc", text)["attempt"], "part-7");
    EXPECT_EQ(run.status, 201U);
    EXPECT_EQ(run.ask("PUT", "/queue/attempts/part-7?name=a.ngc", text)["id"], 1);
    EXPECT_EQ(run.status, 200U);
    EXPECT_EQ(run.ask("PUT", "/queue/attempts/part-7?name=a.ngc", "G1 X4 F600\nM2\n")["error"]["code"],
              "queue.other-program");
    EXPECT_EQ(run.ask("PUT", "/queue/attempts/part.7", text)["error"]["code"], "queue.attempt");
    EXPECT_EQ(run.get("/queue")["jobs"].size(), 1U);
  }
  const auto history = open();
  ApiRun run(GrblRun::at_zero(), history.get());
  run.own();
  EXPECT_EQ(run.post("/queue/1/run")["state"], "checking");
  EXPECT_EQ(run.get("/queue/attempts/part-7")["state"], "running");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
  EXPECT_EQ(run.ask("PUT", "/queue/attempts/part-7?name=a.ngc", text)["state"], "done");
  expect_members(openapi()["components"]["schemas"]["HistoryJob"], run.get("/queue/attempts/part-7"), "HistoryJob");
  EXPECT_EQ(run.get("/queue")["jobs"].size(), 0U) << "it is not made again";
  run.ask("PUT", "/queue/attempts/part-8", text);
  run.ask("DELETE", "/queue/2");
  EXPECT_EQ(run.ask("PUT", "/queue/attempts/part-8", text)["error"]["code"], "queue.attempt-removed");
  EXPECT_EQ(run.status, 410U);
}

TEST_F(KeptApi, each_end_is_kept_with_its_reason) {
  const auto history = open();
  ApiRun run(GrblRun::at_zero(), history.get());
  run.own();
  run.post(fmt::format("/programs/{}/run", run.upload("G1 X1\n")));
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "failed"; }));
  run.post(fmt::format("/programs/{}/run", run.upload("G21 G1 X30 F600\nM2\n")));
  ASSERT_TRUE(run.turn_until_state("Run"));
  run.post("/stop");
  ASSERT_TRUE(run.turn_until_state("Idle"));
  const Json ended = run.get("/history?most=5")["jobs"];
  ASSERT_EQ(ended.size(), 2U);
  EXPECT_EQ(ended[0]["state"], "stopped");
  EXPECT_EQ(ended[0]["why"], "stopped by test");
  EXPECT_EQ(ended[1]["state"], "failed");
  EXPECT_EQ(ended[1]["why"].get<std::string>().substr(0, 8), "line 1: ") << ended[1];
  run.post(fmt::format("/programs/{}/run", run.upload("G21 G1 X30 F600\nM2\n")));
  ASSERT_TRUE(run.turn_until_state("Run"));
  run.run.board().set_switch(input_emergency_stop, true);
  ASSERT_TRUE(run.turn_until_state("Alarm"));
  EXPECT_EQ(run.get("/alarms")["alarms"].size(), 1U);
  EXPECT_EQ(run.get("/history?most=1")["jobs"][0]["state"], "failed");
}

TEST_F(KeptApi, a_job_that_ran_when_the_program_was_killed_is_interrupted) {
  {
    const auto history = open();
    ApiRun run(GrblRun::at_zero(), history.get());
    run.own();
    run.post(fmt::format("/programs/{}/run", run.upload("G21 G1 X30 F600\nM2\n")));
    ASSERT_TRUE(run.turn_until_state("Run"));
  }
  const auto history = open();
  EXPECT_EQ(history->ended(9)[0].state, HistoryState::interrupted);
  EXPECT_NE(history->ended(9)[0].why.find("was killed"), std::string::npos);
  EXPECT_TRUE(history->program_of(1)) << "it can run again";
}

TEST(Api, without_a_folder_there_is_no_queue) {
  ApiRun run;
  run.own();
  for (const char* path : {"/queue", "/history", "/alarms"}) {
    EXPECT_EQ(run.get(path)["error"]["code"], "data.none") << path;
  }
  EXPECT_EQ(run.post("/queue", "M2")["error"]["code"], "data.none");
}

// Whatever comes, each request has an answer in JSON, and the machine obeys afterwards.
TEST(ApiHostile, random_requests_end_in_a_machine_that_obeys) {
  std::mt19937_64 random(seed());
  const std::string bodies[] = {"",
                                "{}",
                                "{\"feed\": 0}",
                                "{\"feed\": 2, \"rapids\": 0.05}",
                                R"({"direction": {"x": 1, "y": -1}, "speed": 3000, "lease": 0.1})",
                                R"({"direction": {"z": -1e308}, "speed": 1e308, "distance": 1e308})",
                                R"({"place": {"x": 1e300}})",
                                R"({"flood": true, "mist": null})",
                                "[[[[[[[[",
                                R"({"door": true})",
                                "\xff\xfe",
                                R"({"spindle_stands": true})",
                                std::string(60'000, '[')};
  for (int trial = 0; trial < fewer(12, 2); ++trial) {
    ApiRun run;
    run.own();
    const std::uint64_t id = run.upload("G21 G90 M3 S500\nG1 X20 F900\nM0\nG1 Y9\nM8\nG1 X0\nM2\n");
    for (int i = 0; i < 120; ++i) {
      const ApiRoute& route = api_routes()[random() % api_routes().size()];
      if (route.path.ends_with("/owner") || route.path.ends_with("/position")) continue;
      std::string path(route.path);
      const std::size_t place = path.find("{id}");
      if (place != std::string::npos) path.replace(place, 4, std::to_string(random() % 3 + id - 1));
      if (route.method == "DELETE") continue;
      const Json answer = run.ask(std::string(route.method), path, bodies[random() % std::size(bodies)]);
      if (!path.ends_with("metrics") && !path.ends_with("/text") && path != "/pulses") {
        EXPECT_FALSE(answer.is_discarded()) << path;
      }
      if (random() % 3 == 0) run.pass(Seconds(0.02));
    }
    if (run.run.session().state() == MachineState::sleep) run.post("/wake");
    run.post("/override", R"({"feed": 1, "rapids": 1})");
    run.post("/stop");
    ASSERT_TRUE(run.turn_until([&] { return !run.run.session().busy() && !run.api.is_checking(); }))
        << trial << run.get("/status");
    run.pass(Seconds(0.1));
    ASSERT_FALSE(run.run.session().busy()) << trial << run.get("/status");
    run.post("/jog", R"({"direction": {"y": 1}, "speed": 600, "distance": 1, "lease": 5})");
    EXPECT_EQ(run.status, 200U) << trial << run.get("/status");
    ASSERT_TRUE(run.turn_until_state("Idle"));
  }
}

}  // namespace
}  // namespace passo::test
