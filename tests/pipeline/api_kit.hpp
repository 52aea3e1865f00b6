// An API around a session on a virtual machine, in virtual time, and its description.
#pragma once

#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "grbl_kit.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/api/web_api.hpp"

namespace passo::test {

using Json = nlohmann::ordered_json;

// Times programs at once.
class PromptTimer final : public MotionTimer {
 public:
  explicit PromptTimer(const MachineDescription& machine) : machine_(machine) {}
  void begin(MotionTiming wanted) override {
    found_ = time_motion(wanted, machine_, [] { return true; });
  }
  std::optional<MotionTimes> take_times() override { return std::exchange(found_, std::nullopt); }

 private:
  const MachineDescription& machine_;
  std::optional<MotionTimes> found_;
};

// A machine with a sender's door and a client's door.
class ApiRun {
 public:
  explicit ApiRun(const KnownPosition& start = GrblRun::at_zero(), JobHistory* history = nullptr,
                  const std::vector<Touchable>& things = {}, Studies* studies = nullptr,
                  const ToolTable& known_tools = {}, CamService* maker = nullptr, FirstContact* contact = nullptr,
                  BoardSettings* settings = nullptr, const std::string& macro_folder = {},
                  const MachineDescription& machine = example_machine("router"))
      : run(machine, start, things),
        api(run.description(), run.session(), owner,
            {.version = "1",
             .openapi = "{}",
             .make_key = [this] { return fmt::format("key{}", ++keys_); },
             .page = {},
             .history = history,
             .wall_time = [this] { return 1e9 + run.session().now().value(); },
             .macro_folder = macro_folder,
             .tools = known_tools,
             .keep_offsets =
                 [this](const SavedParameters& parameters, const ToolTable& tools) {
                   if (keep) keep(parameters, tools);
                   return disk_trouble;
                 },
             .maker = maker,
             .contact = contact,
             .settings = settings,
             .studies = studies,
             .timer = &timer_}) {}

  Json ask(const std::string& method, const std::string& path, const std::string& body = "", const std::string& by = "",
           const std::string& type = "") {
    const std::size_t mark = std::min(path.find('?'), path.size());
    const WebAnswer answer = api.answer({.method = method,
                                         .path = "/api/v1" + path.substr(0, mark),
                                         .query = path.substr(std::min(mark + 1, path.size())),
                                         .key = by.empty() ? key : by,
                                         .type = type,
                                         .body = body});
    status = answer.status;
    return Json::parse(answer.body, nullptr, false);
  }
  Json post(const std::string& path, const std::string& body = "") { return ask("POST", path, body); }
  Json get(const std::string& path) { return ask("GET", path); }

  void poll() {
    run.session().poll(Seconds(0.005));
    const auto changes = run.session().take_changes();
    run.grbl().poll(changes);
    api.on_change(changes);
    api.poll();
    run.collect();
  }
  // Asks about the condition every 20 ms, and every 100 ms after the first second: a status costs more than a turn.
  template <class Condition>
  bool turn_until(Condition condition, Seconds within = Seconds(300)) {
    const Seconds begin = run.session().now();
    while (!condition() && run.session().now() < begin + within) {
      const int turns = run.session().now() < begin + Seconds(1) ? 4 : 20;
      for (int turn = 0; turn < turns; ++turn) poll();
    }
    return condition();
  }
  bool turn_until_state(const std::string& state) {
    return turn_until([&] { return get("/status")["state"] == state; });
  }
  void pass(Seconds time) {
    for (const Seconds end = run.session().now() + time; run.session().now() < end;) poll();
  }
  void own() {
    const Json answer = post("/owner", R"({"name": "test"})");
    ASSERT_EQ(status, 200U) << answer;
    key = answer["key"];
    run.grbl().let_drive(owner.is_sender());
  }
  std::uint64_t upload(const std::string& text, const std::string& query = "") {
    const Json answer = ask("POST", "/programs" + query, text);
    EXPECT_EQ(status, 201U) << answer;
    return answer["id"];
  }

  GrblRun run;
  std::function<void(const SavedParameters&, const ToolTable&)> keep;
  std::string disk_trouble;  // why offsets cannot be kept
  MachineControl owner;
  WebApi api;
  std::string key;
  unsigned status = 0;

 private:
  PromptTimer timer_{run.description()};
  int keys_ = 0;
};

inline Json openapi() {
  std::ifstream file(PASSO_SOURCE_DIR "/docs/api/openapi.json");
  return Json::parse(file);
}

inline void expect_members(const Json& schema, const Json& value, const std::string& what) {
  std::set<std::string> described;
  std::set<std::string> found;
  for (const auto& [name, member] : schema["properties"].items()) described.insert(name);
  for (const auto& [name, member] : value.items()) found.insert(name);
  EXPECT_EQ(described, found) << what;
}

}  // namespace passo::test
