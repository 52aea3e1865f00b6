// Probing cycles, height maps and levelled programs by the API.
#include "api_kit.hpp"
#include <gmock/gmock.h>

namespace passo::test {
namespace {

// A machine whose probe touches everything that is low enough.
std::vector<Touchable> plate(double top) {
  TouchBox box;
  box.ranges[Axis::z].high = top;
  return {box};
}

TEST(ApiProbing, a_surface_becomes_the_zero_of_all_programs) {
  ApiRun run(GrblRun::at_zero(), nullptr, plate(-12.5));
  std::vector<double> kept;
  run.keep = [&](const SavedParameters& parameters, const ToolTable&) { kept.push_back(parameters.at(5223)); };
  run.own();
  const Json job = run.post("/probe", R"({"cycle": "surface", "height": 0.5, "reach": 30})");
  ASSERT_EQ(run.status, 202U) << job;
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  EXPECT_NEAR(run.get("/status")["work_offset"]["z"].get<double>(), -13, 0.004);
  ASSERT_EQ(kept.size(), 1U);
  const Json words = run.get("/log")["words"];
  ASSERT_FALSE(words.empty());
  EXPECT_THAT(words.back()["text"].get<std::string>(), testing::HasSubstr("found: Z0 of G54 is Z-13"));
  // The next program counts from there.
  const std::uint64_t id = run.upload("G0 Z5\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; }));
  EXPECT_NEAR(run.get("/status")["place"]["z"].get<double>(), -8, 0.01);
}

TEST(ApiProbing, a_tool_is_measured_and_used) {
  ApiRun run(GrblRun::at_zero(), nullptr, plate(-20));
  run.own();
  run.post("/probe", R"({"cycle": "tool", "tool": 4, "reach": 40, "zero_z": -45})");
  ASSERT_EQ(run.status, 202U);
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  const std::uint64_t id = run.upload("G43 H4\nG0 Z-40\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  EXPECT_NEAR(run.get("/status")["place"]["z"].get<double>(), -15, 0.01);
}

// What is shown of the work and what becomes its zero lies along its turned axes.
TEST(ApiProbing, a_turned_work_is_told_and_its_zero_lies_along_its_axes) {
  ApiRun run;
  run.own();
  EXPECT_EQ(run.get("/status")["work_rotation"], 0.0);
  run.api.apply_offsets({{5221, 10}, {5222, 20}, {5230, 90}});
  EXPECT_EQ(run.get("/status")["work_rotation"], 90.0);
  EXPECT_EQ(run.get("/status")["work_offset"]["x"], 10.0);
  // The tool stands at X-20 Y10 of the work. Only its X becomes 0: the zero moves along the machine's Y.
  const Json zero = run.post("/work", R"({"place": {"x": 0}})")["work_offset"];
  EXPECT_EQ(zero["x"], 10.0);
  EXPECT_EQ(zero["y"], 0.0);
  const std::uint64_t id = run.upload("G0 X3\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  EXPECT_NEAR(run.get("/status")["place"]["y"].get<double>(), 3, 0.01);
}

TEST(ApiProbing, a_long_path_is_told_while_it_is_checked) {
  ApiRun run;
  std::string text = "G21 G90 F3000\n";
  for (int i = 0; i < 40'000; ++i) text += i % 2 == 0 ? "G1 X1\n" : "G1 X2\n";
  const std::string id = fmt::format("/programs/{}", run.upload(text + "M2\n"));
  const auto bytes = [&](const std::string& query) {
    return run.api.answer({.method = "GET", .path = "/api/v1" + id + "/path", .query = query}).body.size();
  };
  EXPECT_EQ(run.get(id + "/path")["growing"], false);
  run.post(id + "/check");
  EXPECT_EQ(run.get(id)["checks"], 1);
  ASSERT_TRUE(run.turn_until([&] { return run.get(id + "/path")["chunks"] == 1; }));
  const Json growing = run.get(id + "/path");
  EXPECT_EQ(growing["growing"], true);
  EXPECT_EQ(growing["complete"], false);
  EXPECT_EQ(growing["checks"], 1);
  const std::size_t first = bytes("chunk=0&level=0");
  EXPECT_EQ(bytes("chunk=0&level=0&count=4"), first) << "only what is there";
  ASSERT_TRUE(run.turn_until([&] { return run.get(id)["state"] == "good"; }));
  const Json whole = run.get(id + "/path");
  EXPECT_EQ(whole["growing"], false);
  EXPECT_EQ(whole["complete"], true);
  EXPECT_EQ(bytes("chunk=0&level=0"), first) << "what was told stays as it was";
  EXPECT_EQ(bytes("chunk=0&level=0&count=9"), bytes("chunk=0") + bytes("chunk=1") + bytes("chunk=2"));
}

TEST(ApiProbing, a_touch_that_finds_nothing_is_told) {
  ApiRun run(GrblRun::at_zero(), nullptr, plate(-30));
  run.own();
  run.post("/probe", R"({"cycle": "surface", "reach": 3})");
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::failed; })) << run.get("/status");
  const Json job = run.get("/status")["job"];
  EXPECT_THAT(
      job["why"].get<std::string>(),
      testing::MatchesRegex("line [0-9]+: G38.2 finished, but the probe is still open .gcode.probe-untouched."));
}

TEST(ApiProbing, a_height_map_is_stored_with_its_program_and_levels_it) {
  ApiRun run(GrblRun::at_zero(), nullptr, plate(-2.25));
  run.own();
  const std::uint64_t id = run.upload("G21 G90 G0 X12 Y12 Z5\nG1 Z0 F500\nX28\nG0 Z5\nM2\n", "?name=part.ngc");
  const std::string of_it = fmt::format("/programs/{}", id);
  run.get(of_it + "/height-map");
  EXPECT_EQ(run.status, 404U);
  run.post(of_it + "/level");
  EXPECT_EQ(run.status, 404U);
  const Json job = run.post(
      "/probe", fmt::format(R"({{"cycle": "map", "program": {}, "x": 10, "y": 10, "columns": 3, "rows": 2}})", id));
  ASSERT_EQ(run.status, 202U) << job;
  run.post(of_it + "/level");
  EXPECT_NE(run.status, 201U);
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  const Json map = run.get(of_it + "/height-map");
  EXPECT_EQ(map["columns"], Json({10.0, 20.0, 30.0}));
  EXPECT_EQ(map["rows"], Json({10.0, 30.0}));
  EXPECT_NEAR(map["lowest"].get<double>(), -2.25, 0.005);
  expect_members(openapi()["components"]["schemas"]["HeightMap"], map, "HeightMap");
  EXPECT_EQ(
      run.api.answer({.method = "GET", .path = "/api/v1" + of_it + "/height-map", .query = "as=csv"}).body.substr(0, 6),
      "x,y,z\n");
  const Json levelled = run.post(of_it + "/level?tolerance=0.01");
  ASSERT_EQ(run.status, 201U) << levelled;
  EXPECT_EQ(levelled["name"], "level part.ngc");
  const std::string text =
      run.api
          .answer(
              {.method = "GET", .path = fmt::format("/api/v1/programs/{}/text", levelled["id"].get<std::uint64_t>())})
          .body;
  EXPECT_THAT(text, testing::HasSubstr("Z-2.25"));
  EXPECT_EQ(levelled["findings"], Json::array());
}

// As the command warns.
TEST(ApiProbing, a_levelled_program_comes_with_the_warnings) {
  ApiRun run;
  run.own();
  const std::string of_it = fmt::format("/programs/{}", run.upload("G21 G90 F100\nG1 X3\nG91 G1 Z1\nM2\n"));
  run.post(of_it + "/height-map", "0,0,1\n0,9,1\n9,0,1\n9,9,1\n");
  const Json levelled = run.post(of_it + "/level");
  ASSERT_EQ(run.status, 201U) << levelled;
  std::vector<std::string> codes;
  for (const Json& one : levelled["findings"])
    codes.push_back(fmt::format("{} {}", one["line"].get<int>(), one["code"].get<std::string>()));
  EXPECT_EQ(codes, (std::vector<std::string>{"2 level.height", "3 level.place"})) << levelled;
}

TEST(ApiProbing, refuses_what_is_no_cycle_no_map_and_no_wish) {
  ApiRun run;
  run.own();
  for (const char* body :
       {"", "[]", "{}", R"({"cycle": "hole"})", R"({"cycle": "edge"})", R"({"cycle": "edge", "side": 3})",
        R"({"cycle": "surface", "reach": -1})", R"({"cycle": "surface", "columns": 3})",
        R"({"cycle": "surface", "reach": "far"})", R"({"cycle": "map", "columns": 2.5})"}) {
    run.post("/probe", body);
    EXPECT_EQ(run.status, 400U) << body;
  }
  run.post("/probe", R"({"cycle": "map", "program": 99})");
  EXPECT_EQ(run.status, 404U);
  run.ask("POST", "/probe", R"({"cycle": "surface"})", "somebody");
  EXPECT_EQ(run.status, 403U);
  const std::string of_it = fmt::format("/programs/{}", run.upload("G38.2 Z-5 F100\nM2\n"));
  for (const char* body : {"", "x,y,z", "0,0,1\n1,0,1\n", "0,0,1\n0,1,1\n1,0,1\n1,1,nan\n"}) {
    run.post(of_it + "/height-map", body);
    EXPECT_EQ(run.status, 400U) << body;
  }
  run.post(of_it + "/height-map", "0,0,1\n0,9,1\n9,0,1\n9,9,1\n");
  EXPECT_EQ(run.status, 200U);
  for (const char* wish : {"tolerance=0", "tolerance=x", "tolerance=nan", "holes=1"}) {
    run.post(of_it + "/level?" + wish);
    EXPECT_EQ(run.status, 400U) << wish;
  }
  EXPECT_EQ(run.post(of_it + "/level")["error"]["code"], "level.cannot");
  EXPECT_EQ(run.status, 409U);
}

TEST(ApiProbing, a_map_for_a_program_that_was_deleted_stays_with_its_cycle) {
  ApiRun run(GrblRun::at_zero(), nullptr, plate(-2.25));
  run.own();
  const std::uint64_t id = run.upload("G0 X1\nM2\n");
  const Json job = run.post(
      "/probe", fmt::format(R"({{"cycle": "map", "program": {}, "x": 10, "y": 10, "columns": 2, "rows": 2}})", id));
  ASSERT_EQ(run.status, 202U) << job;
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::running; })) << run.get("/status");
  run.ask("DELETE", fmt::format("/programs/{}", id));
  EXPECT_EQ(run.status, 200U);
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  run.get(fmt::format("/programs/{}/height-map", job["program"].get<std::uint64_t>()));
  EXPECT_EQ(run.status, 200U);
}

}  // namespace
}  // namespace passo::test
