// A board that stays, and servers of it that come, may die at any moment, and come again: as `passo serve --data` does
// with a board at the end of a line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/journaled_host.hpp"
#include "kit/memory_store.hpp"
#include "kit/step_log.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/api/web_api.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_line.hpp"
#include "passo/machine/virtual_machine.hpp"

namespace passo::test {

// What outlives a server: the board, its line, the journal and the history.
class JobBench {
 public:
  explicit JobBench(const MachineDescription& machine, std::vector<Touchable> things = {})
      : description(machine), things_(std::move(things)) {
    power_up({});
    std::filesystem::create_directories(folder_);
  }
  ~JobBench() { std::filesystem::remove_all(folder_); }
  JobBench(const JobBench&) = delete;
  JobBench& operator=(const JobBench&) = delete;

  // The board starts anew and has forgotten everything. The machine stands at this place, in truth.
  void power_up(const Point& place) {
    line.reset();
    board = std::make_unique<VirtualMachine>(static_cast<std::uint8_t>(description.axes.size()),
                                             description.board.clock, description.board.highest_event_rate,
                                             static_cast<std::size_t>(description.board.held_items));
    plant = std::make_unique<IdealPlant>(plant_of(description, place, things_));
    line = std::make_unique<VirtualLine>(*board, description.board.clock, LineOptions{});
    board->connect(*plant);
    board->add_observer(log);
  }
  // Where the motors are in truth, in steps from machine zero.
  std::array<std::int64_t, StepLog::motors> truth() const {
    std::array<std::int64_t, StepLog::motors> steps{};
    const Truth now = plant->truth_at(board->elapsed());
    for (std::size_t m = 0; m < description.axes.size(); ++m) steps[m] = std::llround(now.positions[m]);
    return steps;
  }
  void let_pass(Seconds time) {
    const Seconds until = board->elapsed() + time;
    while (until - board->elapsed() > Seconds(1e-6)) {
      static_cast<void>(line->run(until - board->elapsed()));
      static_cast<void>(line->replies());
    }
  }
  std::unique_ptr<JobHistory> history() const { return std::move(*JobHistory::open((folder_ / "jobs").string())); }

  MachineDescription description;
  std::unique_ptr<VirtualMachine> board;
  std::unique_ptr<IdealPlant> plant;
  std::unique_ptr<VirtualLine> line;
  MemoryStore store;
  StepLog log;
  std::uint16_t numbers = 1;
  // What a place record keeps: the board's counts at machine zero, and whether they are trusted.
  MotorSteps zero_counts{};
  Trust trust = Trust::counted;
  // What files of offsets keep.
  SavedParameters parameters;
  ToolTable tools;

 private:
  std::vector<Touchable> things_;  // what a probe touches
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  fmt::format("passo-jobs-{}-{}", getpid(), reinterpret_cast<std::uintptr_t>(this));
};

class JobServer final : public JobKeeper {
 public:
  using Json = nlohmann::ordered_json;

  explicit JobServer(JobBench& bench, std::uint64_t dies_at = never, HostEnd end = HostEnd::before_frame)
      : bench_(bench),
        port_(*bench.line, dies_at, end),
        history_(bench.history()),
        session_(bench.description, port_,
                 {.over_a_line = true,
                  .care = {.answer_within = Seconds(0.05), .patience = Seconds(2)},
                  .greeting = {},
                  .tells_place = true,
                  .start = {}}) {
    const auto board_status = ask_status_at_rest(session_.board(), Seconds(5));
    EXPECT_TRUE(board_status);
    if (!board_status) return;
    const Greeting greeting{.session = new_number(), .number = static_cast<std::uint8_t>(bench_.numbers % 200 + 1)};
    std::optional<BrokenOff> found;
    if (const auto journal = Journal::read(bench_.store.bytes)) {
      found = broken_off(*journal, *board_status, greeting);
      JournalWriter writer(bench_.store);
      if (!found->refused) writer.begin(found->head);
    }
    if (board_status->session != 0 || bench_.numbers == 2) session_.start_at(position_of(*board_status));
    session_.greet(greeting);
    while (session_.state() == MachineState::offline) session_.poll(Seconds(0.02));
    api_ = std::make_unique<WebApi>(bench_.description, session_, owner_, options(found));
    key_ = ask("POST", "/owner", "{}").value("key", "");
  }

  JournalStore& store() override { return bench_.store; }
  std::string read() override { return bench_.store.bytes; }
  double noted_at() override { return 0; }
  void remove() override { bench_.store.bytes.clear(); }
  std::uint16_t new_number() override { return ++bench_.numbers; }
  void name_session(std::uint16_t number) override { session_.name_session(number); }

  Json ask(const std::string& method, const std::string& path, const std::string& body = "") {
    const std::size_t mark = std::min(path.find('?'), path.size());
    const WebAnswer answer = api_->answer({.method = method,
                                           .path = "/api/v1" + path.substr(0, mark),
                                           .query = path.substr(std::min(mark + 1, path.size())),
                                           .key = key_,
                                           .body = body});
    status = answer.status;
    return Json::parse(answer.body, nullptr, false);
  }
  Json get(const std::string& path) { return ask("GET", path); }
  Json post(const std::string& path, const std::string& body = "") { return ask("POST", path, body); }
  void poll() {
    session_.poll(Seconds(0.01));
    api_->on_change(session_.take_changes());
    api_->poll();
    if (const auto& zero = session_.zero_counts()) bench_.zero_counts = *zero;
    bench_.trust = session_.status().position.trust;
  }
  template <class Condition>
  bool turn_until(Condition condition, Seconds within = Seconds(300)) {
    const Seconds end = session_.now() + within;
    for (int turns = 0; !condition() && session_.now() < end && turns < 1'000'000; ++turns) poll();
    return condition();
  }
  // The job that was asked for has ended in some way.
  bool to_end() {
    return turn_until([&] { return api_->job().state > JobState::running; });
  }
  void run(const std::string& text) {
    const Json program = ask("POST", "/programs?name=part.ngc", text);
    post(fmt::format("/programs/{}/run", program["id"].get<int>()));
    EXPECT_EQ(status, 202U);
  }
  BoardMachineSession& session() { return session_; }
  WebApi& api() { return *api_; }
  std::string job_state() const { return std::string(name_of(api_->job().state)); }
  std::uint64_t moments() const { return port_.moments(); }

  unsigned status = 0;

 private:
  KnownPosition position_of(const BoardStatus& board) const {
    const MotorPosition motors = steps_since(bench_.zero_counts, board.positions);
    return {.place = kinematics_of(bench_.description).axes(motors), .trust = bench_.trust};
  }
  ApiOptions options(const std::optional<BrokenOff>& found) {
    ApiOptions options{.version = "1", .openapi = "{}", .make_key = [] { return std::string("key"); }};
    options.history = history_.get();
    options.wall_time = [this] { return session_.now().value(); };
    options.keeper = this;
    options.machine_access.stamp = {.name = "m.toml", .size = 1, .fingerprint = 2};
    options.broken_off = found;
    options.parameters = bench_.parameters;
    options.tools = bench_.tools;
    options.keep_offsets = [this](const SavedParameters& parameters, const ToolTable& tools) {
      bench_.parameters = parameters;
      bench_.tools = tools;
      return std::string();
    };
    return options;
  }

  JobBench& bench_;
  MortalPort port_;
  std::unique_ptr<JobHistory> history_;
  BoardMachineSession session_;
  MachineControl owner_;
  std::unique_ptr<WebApi> api_;
  std::string key_;
};

}  // namespace passo::test
