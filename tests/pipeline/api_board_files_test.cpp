// The files of a board over the API: who may use them, what is checked before the board runs one, and what a status
// says meanwhile. In virtual time, on a StrictGrbl with a card.
#include <algorithm>
#include <functional>
#include <string>

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include "kit/strict_card_board.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "passo/api/web_api.hpp"

namespace passo::test {
namespace {

using nlohmann::json;

constexpr const char* there_and_back = "G21 G90\nG1 X50 F1200\nG1 X0\nM2\n";

struct ApiBoardFiles : testing::Test {
  ApiBoardFiles() {
    EXPECT_TRUE(run.go_online());
    key = ask("POST", "/owner", R"({"name": "test"})")["key"];
  }
  json ask(const std::string& method, const std::string& path, const std::string& body = "") {
    const WebAnswer answer =
        api.answer({.method = method, .path = "/api/v1" + path, .query = {}, .key = key, .type = "", .body = body});
    status = answer.status;
    return json::parse(answer.body, nullptr, false);
  }
  json get(const std::string& path) { return ask("GET", path); }
  static std::string code_of(const json& answer) {
    return answer.contains("error") ? answer["error"].value("code", "") : "";
  }
  void poll() {
    run.session.poll(Seconds(0.02));
    api.on_change(run.session.take_changes());
    api.poll();
  }
  bool turn_until(const std::function<bool()>& is_so) {
    for (const Seconds end = run.session.now() + Seconds(300); !is_so() && run.session.now() < end;) poll();
    return is_so();
  }
  // The state of the files when the order has ended.
  json finish() {
    EXPECT_TRUE(turn_until([&] { return get("/board/files")["state"] != "running"; }));
    return get("/board/files");
  }
  json send(const std::string& path, const std::string& text) {
    ask("PUT", "/board/files" + path, text);
    EXPECT_EQ(status, 202U);
    return finish();
  }
  bool job_is(JobState state) {
    return turn_until([&] { return api.job().state == state; });
  }

  GrblSessionRunOn<StrictCardBoard> run{example_machine("router"), {}, strict_grblhal_with_card()};
  MachineControl owner;
  WebApi api{run.description,
             run.session,
             owner,
             {.version = "1", .openapi = "{}", .make_key = [] { return "key"; }, .page = {}}};
  std::string key;
  unsigned status = 0;
};

TEST_F(ApiBoardFiles, are_listed_sent_and_deleted_by_the_client_in_control) {
  EXPECT_TRUE(get("/board/files")["files"].is_null()) << "they are not listed yet";
  EXPECT_EQ(get("/board/files")["folder"], "/");
  run.board.files()["/old.nc"] = "G0 X1\n";
  ask("POST", "/board/files");
  EXPECT_EQ(status, 202U);
  json all = finish();
  ASSERT_EQ(all["files"].size(), 1U);
  EXPECT_EQ(all["files"][0]["path"], "/old.nc");
  EXPECT_TRUE(all["files"][0]["program"].is_null()) << "its text is not known";
  all = send("/new%20part.nc", there_and_back);
  EXPECT_EQ(all["state"], "done") << all;
  EXPECT_EQ(run.board.files()["/new part.nc"], there_and_back);
  ASSERT_EQ(all["files"].size(), 2U);
  EXPECT_EQ(all["files"][0]["path"], "/new part.nc");
  const std::uint64_t program = all["files"][0]["program"];
  EXPECT_EQ(get("/programs")["programs"][0]["id"], program) << "it can be looked at, and checked";
  ask("DELETE", "/board/files/old.nc");
  EXPECT_EQ(status, 202U);
  EXPECT_EQ(finish()["files"].size(), 1U);
  EXPECT_EQ(code_of(ask("DELETE", "/board/files/old.nc")), "machine.cannot");
  EXPECT_EQ(code_of(ask("PUT", "/board/files/a%zz", "M2\n")), "http.bad-name");
  EXPECT_EQ(code_of(ask("PUT", "/board/files/what%3F.nc", "M2\n")), "machine.cannot");
  EXPECT_EQ(get("/programs")["programs"].size(), 1U) << "what was refused is not kept";
  key = "nobody";
  for (const auto& [method, path] : {std::pair("POST", "/board/files"), std::pair("PUT", "/board/files/a.nc"),
                                     std::pair("DELETE", "/board/files/a.nc"), std::pair("POST", "/board/run")}) {
    ask(method, path, std::string(path) == "/board/run" ? R"({"path": "/new part.nc"})" : "");
    EXPECT_EQ(status, 403U) << method << path;
  }
}

TEST_F(ApiBoardFiles, tell_the_progress_and_the_time_left_of_an_upload) {
  // Long enough for an estimate, which is not made in the first second.
  ask("PUT", "/board/files/big.nc", std::string(1'500'000, ' '));
  double share = 0;
  bool was_left_told = false;
  ASSERT_TRUE(turn_until([&] {
    const json now = get("/board/files");
    EXPECT_GE(now["share"].get<double>(), share);
    share = now["share"];
    was_left_told = was_left_told || now["left"].is_number();
    return now["state"] != "running";
  }));
  EXPECT_TRUE(was_left_told);
  EXPECT_EQ(get("/board/files")["state"], "done");
  EXPECT_EQ(get("/board/files")["share"], 1);
}

TEST_F(ApiBoardFiles, that_were_sent_from_here_are_checked_before_the_board_runs_them) {
  send("/good.nc", there_and_back);
  send("/far.nc", "G21 G90\nG1 X5000 F1200\nM2\n");
  ask("POST", "/board/run", R"({"path": "/far.nc"})");
  EXPECT_EQ(status, 202U);
  ASSERT_TRUE(job_is(JobState::failed));
  EXPECT_EQ(run.board.runs, 0) << "the board has not begun";
  ask("POST", "/board/run", R"({"path": "/far.nc", "unchecked": true})");
  ASSERT_TRUE(job_is(JobState::failed)) << "what can be checked is checked";
  EXPECT_EQ(run.board.runs, 0);
  ask("POST", "/board/run", R"({"path": "/good.nc"})");
  ASSERT_TRUE(job_is(JobState::running));
  ASSERT_TRUE(turn_until([&] { return run.grbl.place()[Axis::x] > 10; }));
  const json now = get("/status");
  EXPECT_EQ(now["state"], "Run");
  EXPECT_EQ(now["board_file"], "/good.nc");
  EXPECT_EQ(now["line"], 0);
  EXPECT_TRUE(now["left"].is_null());
  EXPECT_EQ(now["job"]["name"], "/good.nc");
  ASSERT_TRUE(job_is(JobState::done));
  EXPECT_EQ(run.board.runs, 1);
  EXPECT_TRUE(get("/status")["board_file"].is_null());
}

TEST_F(ApiBoardFiles, of_unknown_text_run_only_if_the_client_says_so) {
  run.board.files()["/other.nc"] = there_and_back;
  EXPECT_EQ(code_of(ask("POST", "/board/run", R"({"path": "/other.nc"})")), "board-files.unchecked");
  EXPECT_EQ(run.board.runs, 0);
  ask("POST", "/board/run", R"({"path": "/other.nc", "unchecked": true})");
  EXPECT_EQ(status, 202U);
  ASSERT_TRUE(job_is(JobState::running));
  ASSERT_TRUE(job_is(JobState::done));
  EXPECT_EQ(run.board.runs, 1);
}

// Somebody has changed the card.
TEST_F(ApiBoardFiles, of_another_size_than_was_sent_are_unknown) {
  send("/part.nc", there_and_back);
  run.board.files()["/part.nc"] = "G21 G90\nG1 X-150 F1200\nM2\n";
  ask("POST", "/board/files");
  EXPECT_TRUE(finish()["files"][0]["program"].is_null());
  EXPECT_EQ(code_of(ask("POST", "/board/run", R"({"path": "/part.nc"})")), "board-files.unchecked");
}

TEST_F(ApiBoardFiles, keep_other_jobs_and_files_waiting_while_one_runs) {
  send("/part.nc", there_and_back);
  const std::uint64_t program = ask("POST", "/programs", "G21 G90\nG1 X9 F600\nM2\n")["id"];
  ask("POST", "/board/run", R"({"path": "/part.nc"})");
  ASSERT_TRUE(turn_until([&] { return run.grbl.place()[Axis::x] > 10; }));
  ask("POST", fmt::format("/programs/{}/run", program));
  EXPECT_EQ(status, 409U);
  for (const auto& [method, path, body] :
       {std::tuple("POST", "/board/files", ""), std::tuple("PUT", "/board/files/a.nc", "M2\n"),
        std::tuple("DELETE", "/board/files/part.nc", ""),
        std::tuple("POST", "/board/run", R"({"path": "/part.nc"})")}) {
    ask(method, path, body);
    EXPECT_EQ(status, 409U) << method << path;
  }
  ask("POST", "/hold");
  ASSERT_TRUE(turn_until([&] { return get("/status")["state"] == "Hold" && get("/status")["rests"] == true; }));
  ask("POST", "/resume");
  ASSERT_TRUE(turn_until([&] { return get("/status")["state"] == "Run"; }));
  ask("POST", "/stop");
  ASSERT_TRUE(job_is(JobState::stopped));
  EXPECT_EQ(run.board.runs, 1);
  EXPECT_FALSE(run.board.interfered);
  EXPECT_EQ(get("/status")["lost_place"], false);
}

TEST_F(ApiBoardFiles, are_none_of_bad_bodies) {
  for (const char* body :
       {"{}", R"({"path": 5})", R"({"path": "/a.nc", "unchecked": "yes"})", R"({"path": "/a", "x": 1})"}) {
    EXPECT_EQ(code_of(ask("POST", "/board/run", body)), "http.bad-body") << body;
  }
}

TEST(ApiBoardFilesOfOthers, are_told_as_an_ability) {
  GrblSessionRun run(example_machine("router"));
  ASSERT_TRUE(run.go_online());
  MachineControl owner;
  WebApi api(run.description, run.session, owner,
             {.version = "1", .openapi = "{}", .make_key = [] { return "key"; }, .page = {}});
  const auto ask = [&](const char* method, const char* path, const char* body) {
    return json::parse(
        api.answer({.method = method, .path = path, .query = {}, .key = "key", .type = "", .body = body}).body);
  };
  ask("POST", "/api/v1/owner", R"({"name": "test"})");
  EXPECT_EQ(ask("GET", "/api/v1/board/files", "")["has_storage"], false);
  EXPECT_EQ(ask("POST", "/api/v1/board/files", "")["error"]["code"], "machine.cannot");
  const json machine = ask("GET", "/api/v1/machine", "");
  const auto found =
      std::ranges::find_if(machine["abilities"], [](const json& one) { return one["ability"] == "board-files"; });
  ASSERT_NE(found, machine["abilities"].end());
  EXPECT_EQ((*found)["can"], false);
}

}  // namespace
}  // namespace passo::test
