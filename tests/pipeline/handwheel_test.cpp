// The handwheel at a board's pins moves the machine, served over a serial link in virtual time: the session and the API
// are those of `passo serve`. Motion is that of the board's own counts.
#include <algorithm>
#include <cmath>
#include <string>

#include "api_kit.hpp"
#include <gtest/gtest.h>

#include "passo/machine/virtual_line.hpp"
#include "passo/pendant/board_handwheel.hpp"

namespace passo::test::wheel {
namespace {

// Of the router's X.
constexpr double highest = 100;       // mm/s
constexpr double acceleration = 800;  // mm/s²
// The wheel is read every 15 ms, and the link has a delay of its own.
constexpr double reads = 0.04;

constexpr double braking(double speed) {
  return speed / acceleration;
}

MachineDescription router_with_wheel() {
  MachineDescription machine = example_machine("router");
  HandwheelDescription wheel;
  wheel.axes = {Axis::x, Axis::y, Axis::z, std::nullopt};
  machine.handwheel = wheel;
  return machine;
}

class AtWheel {
 public:
  explicit AtWheel(bool is_fitted = true)
      : board(description.motor_count(), description.board.clock, description.board.highest_event_rate,
              static_cast<std::size_t>(description.board.held_items)),
        plant_(plant_of(description)),
        line_(board, description.board.clock, LineOptions()),
        session(description, line_,
                {.over_a_line = true,
                 .care = {.answer_within = Seconds(0.1), .patience = Seconds(2)},
                 .greeting = {.session = 1},
                 .tells_place = true,
                 .start = GrblRun::at_zero()}),
        api(description, session, owner,
            {.version = "1", .openapi = "{}", .make_key = [] { return std::string("key"); }}),
        handwheel(*description.handwheel, session.board(),
                  {.machine = description, .session = session, .owner = owner, .api = api}, status) {
    if (is_fitted) wheel = &board.fit_handwheel();
    board.connect(plant_);
    board.wire(pin_setup(description));
    line_.set_trouble([this](bool, VirtualLine::Bytes bytes) { return is_cut ? VirtualLine::Bytes() : bytes; });
    while (session.state() == MachineState::offline) session.poll(Seconds(0.005));
    if (is_fitted) select(handwheel_axis);
  }

  void select(int selectors) {
    wheel->selected = static_cast<std::uint8_t>(selectors);
    pass(Seconds(0.1));
  }
  void turn_once() {
    session.poll(Seconds(0.002));
    api.on_change(session.take_changes());
    api.poll();
    handwheel.poll(now());
    const double at_now = at(0) + at(1) + at(2);
    if (at_now != last_at_) moved_at_ = now();
    last_at_ = at_now;
  }
  void pass(Seconds time) {
    for (const Seconds end = now() + time; now() < end;) turn_once();
  }
  // Turns the wheel evenly by so many edges.
  void turn(int edges, double edges_a_second) {
    const Seconds begin = now();
    const int way = edges > 0 ? 1 : -1;
    for (int made = 0; made != edges;) {
      turn_once();
      const int due = std::min(std::abs(edges), static_cast<int>((now() - begin).value() * edges_a_second));
      wheel->count += static_cast<std::uint32_t>(way * due - made);
      made = way * due;
    }
  }
  // Waits until the motors stand. Returns when they last moved, after `from`.
  double stand_after(Seconds from) {
    pass(Seconds(0.1));  // it begins soon, if it does
    for (const Seconds end = now() + Seconds(10); now() < end && now() - moved_at_ < Seconds(0.5);) turn_once();
    return (moved_at_ - from).value();
  }
  // mm, by the board's counts.
  double at(std::size_t motor) const {
    const AxisDescription& axis = description.axes[motor];
    const double steps = static_cast<double>(board.counts().motors[motor].position);
    return (axis.inverted ? -steps : steps) / axis.steps_per_unit;
  }
  Seconds now() const { return session.now(); }

  const MachineDescription description = router_with_wheel();
  VirtualMachine board;
  HandwheelCount* wheel = nullptr;
  bool is_cut = false;

 private:
  IdealPlant plant_;
  VirtualLine line_;
  double last_at_ = 0;
  Seconds moved_at_{0};

 public:
  BoardMachineSession session;
  MachineControl owner;
  WebApi api;
  PendantStatus status;
  BoardHandwheel handwheel;
};

TEST(Handwheel, moves_the_selected_axis_by_a_step_for_each_detent) {
  AtWheel at;
  EXPECT_TRUE(at.status.is_connected);
  EXPECT_EQ(at.status.axis, Axis::x);
  EXPECT_EQ(at.status.step, 0.01);
  at.turn(5 * 4, 40);
  at.stand_after(at.now());
  EXPECT_NEAR(at.at(0), 0.05, 0.002);
  at.select(handwheel_axis << 1 | handwheel_tenfold);
  at.turn(-3 * 4, 20);
  at.stand_after(at.now());
  EXPECT_NEAR(at.at(1), -0.3, 0.002);
  at.select(handwheel_axis << 2 | handwheel_hundredfold);
  at.turn(2 * 4, 20);
  at.turn(-4, 20);
  at.stand_after(at.now());
  EXPECT_NEAR(at.at(2), 1, 0.002);
  EXPECT_NEAR(at.at(0), 0.05, 0.002);
}

TEST(Handwheel, that_trembles_between_two_detents_moves_nothing) {
  AtWheel at;
  at.select(handwheel_axis | handwheel_hundredfold);
  for (int i = 0; i < 20; ++i) {
    at.turn(3, 1000);
    at.turn(-3, 1000);
  }
  EXPECT_EQ(at.at(0), 0);
}

TEST(Handwheel, that_turns_faster_than_the_machine_moves_queues_up_no_motion) {
  AtWheel at;
  at.select(handwheel_axis | handwheel_hundredfold);
  // 2 kHz of edges: 500 mm/s.
  at.turn(4000, 2000);
  const double end_of_turn = at.at(0);
  const double late = at.stand_after(at.now());
  std::printf("stands %.3f s after the last edge, %.1f mm on\n", late, at.at(0) - end_of_turn);
  EXPECT_LT(late, 0.1 + 2 * braking(highest * 0.5) + reads);
  EXPECT_GT(at.at(0), 50);
  EXPECT_NEAR(at.at(0), std::round(at.at(0)), 0.003) << "whole steps";
  at.pass(Seconds(1));
  EXPECT_EQ(at.session.state(), MachineState::idle);
}

// How the motion ends early.
struct Loss {
  const char* name;
  void (*happens)(AtWheel& at);
};
const Loss losses[] = {
    {"the wheel's cable is pulled", [](AtWheel& at) { at.wheel->selected = 0; }},
    {"a position without an axis is selected", [](AtWheel& at) { at.wheel->selected = handwheel_axis << 3; }},
    {"two axes are selected", [](AtWheel& at) { at.wheel->selected |= handwheel_axis << 1; }},
    {"the link to the board is cut", [](AtWheel& at) { at.is_cut = true; }},
};

TEST(Handwheel, that_is_lost_moves_nothing_any_more) {
  for (const Loss& loss : losses) {
    SCOPED_TRACE(loss.name);
    AtWheel at;
    at.select(handwheel_axis | handwheel_hundredfold);
    at.turn(1200, 2000);
    ASSERT_EQ(at.session.state(), MachineState::jog);
    loss.happens(at);
    const Seconds lost = at.now();
    // Somebody turns on.
    at.turn(400, 2000);
    const double late = at.stand_after(lost);
    std::printf("%s: stands %.3f s later\n", loss.name, late);
    EXPECT_LT(late, 0.1 + 2 * braking(highest * 0.5) + reads);
    const double end = at.at(0);
    EXPECT_GT(end, 10);
    at.pass(Seconds(1));
    EXPECT_EQ(at.at(0), end);
    EXPECT_EQ(at.at(2), 0);
  }
}

// The computer stops: nothing is sent any more, and the board plays what it has.
TEST(Handwheel, stands_soon_when_the_computer_stops) {
  AtWheel at;
  at.select(handwheel_axis | handwheel_hundredfold);
  at.turn(1200, 2000);
  ASSERT_EQ(at.session.state(), MachineState::jog);
  const double before = at.at(0);
  const auto let_pass = [&](Seconds time) {
    for (const Seconds end = at.board.elapsed() + time; at.board.elapsed() < end;) {
      static_cast<void>(at.board.run(end - at.board.elapsed()));
      static_cast<void>(at.board.replies());
    }
  };
  let_pass(Seconds(0.1 + 2 * braking(highest * 0.5) + reads));
  const double end = at.at(0);
  EXPECT_GT(end, before);
  let_pass(Seconds(2));
  EXPECT_EQ(at.at(0), end);
}

TEST(Handwheel, is_there_again_when_the_link_is) {
  AtWheel at;
  at.select(handwheel_axis | handwheel_tenfold);
  at.is_cut = true;
  at.pass(Seconds(0.4));
  EXPECT_FALSE(at.status.is_connected);
  at.wheel->count += 400;
  at.is_cut = false;
  at.pass(Seconds(0.6));
  EXPECT_TRUE(at.status.is_connected);
  EXPECT_EQ(at.at(0), 0) << "what was turned meanwhile moves nothing";
  at.turn(4, 20);
  at.stand_after(at.now());
  EXPECT_NEAR(at.at(0), 0.1, 0.002);
}

TEST(Handwheel, does_not_move_the_machine_while_a_job_runs_nor_afterwards) {
  AtWheel at;
  at.select(handwheel_axis << 2 | handwheel_hundredfold);
  const auto ask = [&](const std::string& path, const std::string& body, const std::string& type) {
    const WebAnswer answer = at.api.answer(
        {.method = "POST", .path = "/api/v1" + path, .query = {}, .key = "key", .type = type, .body = body});
    EXPECT_LT(answer.status, 300U) << path << answer.body;
    return Json::parse(answer.body, nullptr, false);
  };
  ask("/owner", R"({"name": "page"})", "application/json");
  const Json program = ask("/programs", "G21 G90\nG1 X20 F1200\nG1 X0\nM2\n", "");
  ask(fmt::format("/programs/{}/run", program["id"].get<int>()), "", "");
  for (int i = 0; i < 5000 && at.session.state() != MachineState::run; ++i) at.turn_once();
  ASSERT_EQ(at.session.state(), MachineState::run);
  at.turn(800, 1000);
  ASSERT_EQ(at.session.state(), MachineState::run);
  for (int i = 0; i < 50'000 && at.session.state() != MachineState::idle; ++i) at.turn_once();
  at.pass(Seconds(1));
  EXPECT_EQ(at.at(2), 0);
  EXPECT_NEAR(at.at(0), 0, 0.002);
  EXPECT_TRUE(at.owner.is_client("key")) << "the page has control as before";
}

TEST(Handwheel, tells_how_many_edges_it_has_missed) {
  AtWheel at;
  at.wheel->jumps = 3;
  at.pass(Seconds(0.1));
  EXPECT_EQ(at.status.missed, 3);
  EXPECT_EQ(has_handwheel(at.session.board(), Seconds(1)), true);
}

TEST(Handwheel, is_missed_where_the_board_has_none) {
  AtWheel at(false);
  at.pass(Seconds(0.3));
  EXPECT_FALSE(at.status.is_connected);
  EXPECT_EQ(at.session.state(), MachineState::idle) << "an old board serves on";
  EXPECT_EQ(has_handwheel(at.session.board(), Seconds(1)), false);
}

TEST(Handwheel, is_listed_with_the_machine) {
  ApiRun run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, nullptr, nullptr, nullptr, {}, router_with_wheel());
  const Json machine = run.get("/machine");
  EXPECT_EQ(machine["handwheel"]["axes"][2], "z");
  EXPECT_EQ(machine["handwheel"]["axes"][3], nullptr);
  EXPECT_EQ(machine["handwheel"]["counts_per_detent"], 4);
  expect_members(openapi()["components"]["schemas"]["Machine"], machine, "Machine");
  ApiRun without;
  EXPECT_EQ(without.get("/machine")["handwheel"], nullptr);
}

}  // namespace
}  // namespace passo::test::wheel
