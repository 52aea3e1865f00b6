// Framing a job, going to a place, and macros by the API.
#include <filesystem>
#include <fstream>

#include "api_kit.hpp"
#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>

namespace passo::test {
namespace {

constexpr const char* square =
    "G21 G90\nM3 S9000\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F600\nG1 X40\nG1 Y30\nG1 X10 Y10\nG0 Z5\nM2\n";

std::string code_of_error(const Json& answer) {
  return answer.contains("error") ? answer["error"]["code"].get<std::string>() : std::string();
}

// A checked program, with the work zero at X20 Y0 Z-30.
std::uint64_t checked_program(ApiRun& run, const std::string& text = square) {
  run.api.apply_offsets({{5221, 20}, {5223, -30}});
  const std::uint64_t id = run.upload(text, "?name=part.ngc");
  run.post(fmt::format("/programs/{}/check", id));
  EXPECT_TRUE(run.turn_until([&] { return run.get(fmt::format("/programs/{}", id))["state"] == "good"; }));
  return id;
}

struct Reached {
  double low[3] = {1e9, 1e9, 1e9};
  double high[3] = {-1e9, -1e9, -1e9};
};
// Runs the small job to its end, and returns the range of places on its way.
Reached follow(ApiRun& run) {
  Reached reached;
  const auto ends = [&] {
    const Json status = run.get("/status");
    const char* const axes[] = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = status["place"][axes[i]].get<double>();
      reached.low[i] = std::min(reached.low[i], at);
      reached.high[i] = std::max(reached.high[i], at);
    }
    EXPECT_EQ(status["outputs"]["spindle"], "off");
    return run.api.job().state == JobState::done;
  };
  EXPECT_TRUE(run.turn_until(ends)) << run.get("/status");
  return reached;
}

TEST(ApiFraming, goes_around_the_job_and_ends_at_the_clearance_height) {
  ApiRun run;
  run.own();
  const std::uint64_t id = checked_program(run);
  const Json job = run.post(fmt::format("/programs/{}/frame", id), R"({"height": 2, "feed": 3000})");
  ASSERT_EQ(run.status, 202U) << job;
  EXPECT_EQ(job["name"], "frame part.ngc");
  const Reached reached = follow(run);
  EXPECT_NEAR(reached.high[0], 60, 0.02);
  EXPECT_NEAR(reached.high[1], 30, 0.02);
  EXPECT_NEAR(reached.low[2], -28, 0.02) << "never below the height";
  EXPECT_NEAR(run.get("/status")["place"]["z"].get<double>(), -25, 0.01);
  // The framed program is as it was, and lists for people leave the small one out.
  EXPECT_EQ(run.get(fmt::format("/programs/{}", id))["small"], false);
  EXPECT_EQ(run.get("/programs")["programs"].back()["small"], true);
}

TEST(ApiFraming, replaces_its_last_program) {
  ApiRun run;
  run.own();
  const std::uint64_t id = checked_program(run);
  for (const char* shape : {"extents", "hull"}) {
    run.post(fmt::format("/programs/{}/check", id));
    ASSERT_TRUE(run.turn_until([&] { return run.get(fmt::format("/programs/{}", id))["state"] == "good"; }));
    run.post(fmt::format("/programs/{}/frame", id), fmt::format(R"({{"shape": "{}", "feed": 9000}})", shape));
    ASSERT_EQ(run.status, 202U);
    follow(run);
  }
  EXPECT_EQ(run.get("/programs")["programs"].size(), 2U);
}

TEST(ApiFraming, is_refused_with_the_reason) {
  ApiRun run;
  run.own();
  const auto code = [&](std::uint64_t id, const std::string& body) {
    return code_of_error(run.post(fmt::format("/programs/{}/frame", id), body));
  };
  const std::uint64_t fresh = run.upload(square);
  EXPECT_EQ(code(fresh, "{}"), "framing.unchecked");
  run.post(fmt::format("/programs/{}/check", fresh));
  ASSERT_TRUE(run.turn_until([&] { return run.get(fmt::format("/programs/{}", fresh))["state"] == "good"; }));
  EXPECT_EQ(code(fresh, "{}"), "framing.no-zero");
  EXPECT_EQ(code(999, "{}"), "http.not-found");
  const std::uint64_t id = checked_program(run);
  EXPECT_EQ(code(id, R"({"shape": "round"})"), "http.bad-body");
  EXPECT_EQ(code(id, R"({"speed": 1})"), "http.bad-body");
  EXPECT_EQ(code(id, R"({"feed": 0})"), "framing.value");
  EXPECT_EQ(code(id, R"({"height": -91})"), "goto.outside") << "below the travel of Z";
  EXPECT_EQ(code(checked_program(run, "G21 G90\nG0 X5\nM2\n"), "{}"), "framing.no-feeds");
  run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "lease": 1})");
  EXPECT_EQ(code(id, "{}"), "machine.busy");
  ApiRun lost(KnownPosition{});
  lost.own();
  const std::uint64_t other = checked_program(lost);
  EXPECT_EQ(code_of_error(lost.post(fmt::format("/programs/{}/frame", other), "{}")), "run.place-unknown");
}

TEST(ApiFraming, accepts_machine_zero_if_it_is_told_so) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload(square);
  run.post(fmt::format("/programs/{}/check", id));
  ASSERT_TRUE(run.turn_until([&] { return run.get(fmt::format("/programs/{}", id))["state"] == "good"; }));
  run.post(fmt::format("/programs/{}/frame", id), R"({"machine_zero": true})");
  EXPECT_EQ(run.status, 202U);
}

TEST(ApiGoing, moves_z_first) {
  ApiRun run;
  run.own();
  run.api.apply_offsets({{5161, 30}, {5162, -20}, {5163, 10}, {5221, 20}, {5223, -30}});
  const Json job = run.post("/go", R"({"to": "g28"})");
  ASSERT_EQ(run.status, 202U) << job;
  double z_when_x_moves = 1e9;
  ASSERT_TRUE(run.turn_until([&] {
    const Json place = run.get("/status")["place"];
    const double x = place["x"];
    if (x > 0.01 && x < 29.99) z_when_x_moves = std::min(z_when_x_moves, place["z"].get<double>());
    return run.api.job().state == JobState::done;
  }));
  EXPECT_NEAR(z_when_x_moves, 59, 0.02) << "where homing leaves Z";
  EXPECT_NEAR(run.get("/status")["place"]["z"].get<double>(), 10, 0.01);
  run.post("/go", R"({"to": "zero"})");
  ASSERT_EQ(run.status, 202U);
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; }));
  const Json place = run.get("/status")["place"];
  EXPECT_NEAR(place["x"].get<double>(), 20, 0.01);
  EXPECT_NEAR(place["z"].get<double>(), 59, 0.01) << "stays above the work";
}

TEST(ApiGoing, is_refused_with_the_reason) {
  ApiRun run;
  run.own();
  EXPECT_EQ(code_of_error(run.post("/go", R"({"to": "park"})")), "goto.no-park");
  EXPECT_EQ(code_of_error(run.post("/go", R"({"to": "away"})")), "http.bad-body");
  EXPECT_EQ(code_of_error(run.post("/go", R"({"to": "g28", "fast": true})")), "http.bad-body");
  run.api.apply_offsets({{5161, 401}});
  EXPECT_EQ(code_of_error(run.post("/go", R"({"to": "g28"})")), "goto.outside");
  run.key = "stranger";
  EXPECT_EQ(code_of_error(run.post("/go", R"({"to": "g30"})")), "owner.not-you");
}

// A folder with a macro that moves by a value, one that leaves the travel, one that calls itself, and a subroutine.
std::string macro_folder() {
  const std::filesystem::path folder = scratch_folder();
  std::ofstream(folder / "move.ngc") << "; title = \"Move\"\n; key = \"F6\"\n; [value.way]\n; unit = \"mm\"\n"
                                        "; least = 1\n; most = 500\nG21 G91\nM110 P#<way>\n";
  std::ofstream(folder / "again.ngc")
      << "; title = \"Again\"\no<again> sub\no<again> call\no<again> endsub\no<again> call\n";
  std::ofstream(folder / "m110.ngc") << "o<m110> sub\nG0 X#1\no<m110> endsub\n";
  std::ofstream(folder / "wrong.ngc") << "; title = \"Wrong\"\n; colour = 1\n";
  return folder.string();
}

TEST(ApiMacros, are_listed_with_their_values_and_run_as_jobs) {
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, nullptr, nullptr, nullptr, macro_folder());
  run.own();
  const Json all = run.get("/macros");
  ASSERT_EQ(all["macros"].size(), 2U) << all;
  const Json& move = all["macros"][1];
  EXPECT_EQ(move["title"], "Move");
  EXPECT_EQ(move["key"], "F6");
  EXPECT_EQ(move["values"][0]["high"], 500.0);
  EXPECT_EQ(move["values"][0]["default"], Json());
  expect_members(openapi()["components"]["schemas"]["Macro"], move, "Macro");
  EXPECT_EQ(all["findings"][0]["code"], "macro.unknown-key");
  const Json job = run.post("/macros", R"({"name": "move", "values": {"way": 30}})");
  ASSERT_EQ(run.status, 202U) << job;
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  EXPECT_NEAR(run.get("/status")["place"]["x"].get<double>(), 30, 0.01) << "through M110 of the folder";
}

TEST(ApiMacros, move_nothing_if_they_are_wrong) {
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, nullptr, nullptr, nullptr, macro_folder());
  run.own();
  const auto code = [&](const std::string& body) { return code_of_error(run.post("/macros", body)); };
  EXPECT_EQ(code(R"({"name": "move"})"), "macro.missing-value");
  EXPECT_EQ(code(R"({"name": "move", "values": {"way": 501}})"), "macro.wrong-value");
  EXPECT_EQ(code(R"({"name": "move", "values": {"way": 1, "feed": 1}})"), "macro.unknown-value");
  EXPECT_EQ(code(R"({"name": "move", "values": {"way": "far"}})"), "http.bad-body");
  EXPECT_EQ(code(R"({"name": "m110"})"), "macro.none");
  EXPECT_EQ(code(R"({"name": "../move"})"), "macro.none");
  // What only the check finds: recursion, and a move out of the travel.
  for (const char* body : {R"({"name": "again"})", R"({"name": "move", "values": {"way": 450}})"}) {
    run.post("/macros", body);
    ASSERT_EQ(run.status, 202U) << body;
    ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::failed; })) << body;
  }
  EXPECT_NEAR(run.get("/status")["place"]["x"].get<double>(), 0, 1e-9);
  ApiRun none;
  EXPECT_EQ(none.get("/macros")["macros"], Json::array());
}

}  // namespace
}  // namespace passo::test
