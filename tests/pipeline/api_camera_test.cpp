// The camera by the API: stills, the zero and the way to the cross-hair, and the stills of jobs. In virtual time.
#include <memory>

#include "api_kit.hpp"
#include "kit/scratch_folder.hpp"
#include <gmock/gmock.h>

namespace passo::test {
namespace {

using testing::HasSubstr;

// A camera whose pictures come when a test says so.
class PosedCamera final : public Camera {
 public:
  void watch(bool) override {}
  std::uint64_t want_picture() override {
    ++wanted;
    return newest_.number;
  }
  CameraPicture newest() override { return newest_; }
  CameraStatus status() override { return state; }
  void pose(const std::string& jpeg) {
    newest_ = {.number = newest_.number + 1, .jpeg = std::make_shared<const std::string>(jpeg)};
  }

  CameraStatus state;
  int wanted = 0;

 private:
  CameraPicture newest_;
};

// A still that is waited for.
struct Asked {
  WebAnswer now;
  bool comes() {
    WebAnswer known;
    if (!now.later(known)) return false;
    now = std::move(known);
    return true;
  }
};

struct CameraRun {
  explicit CameraRun(JobHistory* history = nullptr) : api(GrblRun::at_zero(), history) {
    api.api.use({.description = {.offset_x = Mm(30), .offset_y = Mm(-12.5), .rotation = 90}, .pictures = &camera});
    api.own();
  }
  Asked ask_for_still() { return {api.api.answer({.method = "GET", .path = "/api/v1/camera/still"})}; }

  PosedCamera camera;
  ApiRun api;
};

std::string code_in(const Json& answer) {
  return answer.contains("error") ? answer["error"]["code"].get<std::string>() : std::string();
}

TEST(ApiCamera, is_not_there_without_a_camera_in_the_machine_file) {
  ApiRun run;
  run.own();
  EXPECT_EQ(run.get("/machine")["camera"], Json());
  EXPECT_EQ(run.get("/status")["camera"], Json());
  EXPECT_EQ(code_in(run.get("/camera/still")), "camera.none");
  EXPECT_EQ(run.status, 404U);
  EXPECT_EQ(code_in(run.get("/camera/stream")), "camera.none");
  EXPECT_FALSE(run.api.find({.method = "GET", .path = "/api/v1/camera/stream"}).is_pictures);
  EXPECT_EQ(code_in(run.post("/go", R"({"to": "cross_hair"})")), "camera.none");
  EXPECT_EQ(code_in(run.post("/work", R"({"place": {"x": 0}, "cross_hair": true})")), "camera.none");
}

TEST(ApiCamera, is_described_with_its_state) {
  CameraRun run;
  EXPECT_EQ(run.api.get("/machine")["camera"],
            Json::parse(R"({"offset": {"x": 30.0, "y": -12.5}, "rotation": 90, "mirrored": false})"));
  run.camera.state = {.state = CameraStatus::State::waiting,
                      .age = Seconds(2.5),
                      .problem = {.code = "camera.silent", .text = "the camera sends no pictures"}};
  const Json camera = run.api.get("/status")["camera"];
  EXPECT_EQ(camera["state"], "waiting");
  EXPECT_EQ(camera["age"], 2.5);
  EXPECT_EQ(camera["problem_sentence"]["code"], "camera.silent");
  const Json described = openapi()["components"]["schemas"]["Status"]["properties"]["camera"]["oneOf"][1];
  expect_members(described, camera, "camera");
  EXPECT_TRUE(run.api.api.find({.method = "GET", .path = "/api/v1/camera/stream"}).is_pictures);
  EXPECT_FALSE(run.api.api.find({.method = "POST", .path = "/api/v1/camera/stream"}).is_pictures);
  EXPECT_FALSE(run.api.api.find({.method = "GET", .path = "/api/v1/camera/still"}).is_pictures);
}

TEST(ApiCamera, gives_the_next_picture) {
  CameraRun run;
  run.camera.pose("old");
  Asked asked = run.ask_for_still();
  EXPECT_EQ(run.camera.wanted, 1);
  run.api.pass(Seconds(1));
  EXPECT_FALSE(asked.comes());
  run.camera.pose("new");
  ASSERT_TRUE(asked.comes());
  EXPECT_EQ(asked.now.status, 200U);
  EXPECT_EQ(asked.now.type, "image/jpeg");
  EXPECT_EQ(asked.now.body, "new");
}

TEST(ApiCamera, waits_no_longer_than_some_seconds) {
  CameraRun run;
  run.camera.state.problem = {.code = "camera.unreachable", .text = "the camera cannot be reached"};
  Asked asked = run.ask_for_still();
  run.api.pass(Seconds(4.5));
  EXPECT_FALSE(asked.comes());
  run.api.pass(Seconds(1));
  ASSERT_TRUE(asked.comes());
  EXPECT_EQ(asked.now.status, 503U);
  EXPECT_THAT(asked.now.body, HasSubstr("camera.no-picture"));
  EXPECT_THAT(asked.now.body, HasSubstr("the camera cannot be reached"));
  run.camera.state = {};
  asked = run.ask_for_still();
  run.api.pass(Seconds(6));
  ASSERT_TRUE(asked.comes());
  EXPECT_THAT(asked.now.body, HasSubstr("no picture has come from the camera in time"));
}

TEST(ApiCamera, sets_the_work_zero_at_the_cross_hair) {
  CameraRun run;
  ApiRun& api = run.api;
  api.post("/jog", R"({"direction": {"x": 1, "y": 1}, "speed": 3000, "distance": 10})");
  ASSERT_TRUE(api.turn_until_state("Idle"));
  const Json place = api.get("/status")["place"];
  const Json before = api.get("/status")["work_offset"];
  api.post("/work", R"({"place": {"x": 0, "y": 0}, "cross_hair": true})");
  ASSERT_EQ(api.status, 200U);
  const Json after = api.get("/status")["work_offset"];
  EXPECT_NEAR(after["x"].get<double>(), place["x"].get<double>() + 30, 1e-6);
  EXPECT_NEAR(after["y"].get<double>(), place["y"].get<double>() - 12.5, 1e-6);
  EXPECT_EQ(after["z"], before["z"]) << "the camera knows no height";
  // One axis alone, and a place that is not the zero.
  api.post("/work", R"({"place": {"x": 5}, "cross_hair": true})");
  const Json one = api.get("/status")["work_offset"];
  EXPECT_NEAR(one["x"].get<double>(), place["x"].get<double>() + 25, 1e-6);
  EXPECT_NEAR(one["y"].get<double>(), after["y"].get<double>(), 1e-6);
  const std::string stranger = "somebody";
  EXPECT_EQ(code_in(api.ask("POST", "/work", R"({"place": {"x": 0}, "cross_hair": true})", stranger)), "owner.not-you");
}

// The work's axes are rotated: the point under the cross-hair is the zero all the same.
TEST(ApiCamera, sets_the_zero_of_a_rotated_work) {
  CameraRun run;
  ApiRun& api = run.api;
  api.post("/mdi", R"({"line": "G10 L2 P1 R30"})");
  ASSERT_TRUE(api.turn_until([&] { return api.get("/status")["work_rotation"] == 30.0; }));
  api.post("/work", R"({"place": {"x": 0, "y": 0}, "cross_hair": true})");
  ASSERT_EQ(api.status, 200U);
  const Json status = api.get("/status");
  EXPECT_NEAR(status["work_offset"]["x"].get<double>(), status["place"]["x"].get<double>() + 30, 1e-6);
  EXPECT_NEAR(status["work_offset"]["y"].get<double>(), status["place"]["y"].get<double>() - 12.5, 1e-6);
}

TEST(ApiCamera, moves_the_tool_to_the_cross_hair_z_first) {
  CameraRun run;
  ApiRun& api = run.api;
  const double top = api.get("/machine")["top"];
  const Json job = api.post("/go", R"({"to": "cross_hair"})");
  ASSERT_EQ(api.status, 202U) << job;
  EXPECT_EQ(job["name"], "go to the cross-hair");
  bool was_low = false;
  const auto ends = [&] {
    const Json place = api.get("/status")["place"];
    was_low = was_low || (place["x"].get<double>() > 0.01 && place["z"].get<double>() < top - 0.01);
    return api.api.job().state == JobState::done;
  };
  ASSERT_TRUE(api.turn_until(ends)) << api.get("/status");
  EXPECT_FALSE(was_low);
  const Json place = api.get("/status")["place"];
  EXPECT_NEAR(place["x"].get<double>(), 30, 0.01);
  EXPECT_NEAR(place["y"].get<double>(), -12.5, 0.01);
  EXPECT_EQ(code_in(api.ask("POST", "/go", R"({"to": "cross_hair"})", "somebody")), "owner.not-you");
  EXPECT_EQ(code_in(api.post("/go", R"({"to": "cross_hair", "z": 1})")), "http.bad-body");
}

TEST(ApiCamera, does_not_move_the_tool_beyond_the_travel) {
  CameraRun run;
  run.api.api.use({.description = {.offset_x = Mm(900)}, .pictures = &run.camera});
  EXPECT_EQ(code_in(run.api.post("/go", R"({"to": "cross_hair"})")), "goto.outside");
}

class ApiJobStills : public testing::Test {
 protected:
  ApiJobStills()
      : history(std::move(*JobHistory::open((folder_.path() / "jobs.sqlite").string()))), run(history.get()) {}
  // Runs a program of some seconds to its end; the camera takes a picture whenever one is wanted.
  void run_program(bool poses) {
    const std::uint64_t id = run.api.upload("G21 G90\nG1 X10 F600\nG1 X0\nM2\n", "?name=part.ngc");
    run.api.post(fmt::format("/programs/{}/run", id));
    ASSERT_EQ(run.api.status, 202U);
    int posed = run.camera.wanted;
    const auto follow = [&] {
      if (poses && run.camera.wanted > std::exchange(posed, run.camera.wanted)) {
        run.camera.pose(fmt::format("picture {}", run.camera.wanted));
      }
      return run.api.api.job().state == JobState::done;
    };
    ASSERT_TRUE(run.api.turn_until(follow)) << run.api.get("/status");
    follow();
    for (int i = 0; i < 5; ++i) run.api.poll();
  }
  Json stills() { return run.api.get("/history")["jobs"][0]["stills"]; }

  ScratchFolder folder_;
  std::unique_ptr<JobHistory> history;
  CameraRun run;
};

TEST_F(ApiJobStills, are_taken_at_the_start_and_at_the_end) {
  run_program(true);
  const Json all = stills();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["moment"], "start");
  EXPECT_EQ(all[1]["moment"], "end");
  EXPECT_LT(all[0]["at"], all[1]["at"]);
  const Json described = openapi()["components"]["schemas"]["HistoryJob"]["properties"]["stills"]["items"];
  expect_members(described, all[0], "stills");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string path = fmt::format("/api/v1/history/stills/{}", all[i]["id"].get<int>());
    const WebAnswer answer = run.api.api.answer({.method = "GET", .path = path});
    EXPECT_EQ(answer.type, "image/jpeg");
    EXPECT_EQ(answer.body, fmt::format("picture {}", i + 1));
  }
  run.api.get("/history/stills/99");
  EXPECT_EQ(run.api.status, 404U);
}

TEST_F(ApiJobStills, of_a_silent_camera_delay_nothing_and_are_left_out) {
  const Seconds begin = run.api.run.session().now();
  run_program(false);
  const Seconds silent = run.api.run.session().now() - begin;
  EXPECT_EQ(stills().size(), 0U);
  run.api.pass(Seconds(6));
  run.camera.pose("too late");
  run.api.pass(Seconds(0.1));
  EXPECT_EQ(stills().size(), 0U);
  const Seconds again = run.api.run.session().now();
  run_program(true);
  EXPECT_NEAR((run.api.run.session().now() - again).value(), silent.value(), 0.5);
  EXPECT_EQ(stills().size(), 2U);
}

TEST_F(ApiJobStills, are_not_taken_of_small_jobs_or_of_jobs_that_did_not_run) {
  run.api.post("/go", R"({"to": "cross_hair"})");
  ASSERT_TRUE(run.api.turn_until([&] { return run.api.api.job().state == JobState::done; }));
  const std::uint64_t id = run.api.upload("G1 X1 F\n");
  run.api.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.api.turn_until([&] { return run.api.api.job().state == JobState::failed; }));
  run.api.pass(Seconds(0.1));
  EXPECT_EQ(run.camera.wanted, 0);
}

}  // namespace
}  // namespace passo::test
