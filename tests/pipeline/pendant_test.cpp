// A pendant moves the machine by its reports: on a virtual machine and on a Grbl board, in virtual time.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "api_kit.hpp"
#include "kit/grbl_session_run.hpp"
#include "kit/scratch_folder.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

#include "passo/pendant/pendant_control.hpp"

namespace passo::test {
namespace {

using Report = std::vector<std::uint8_t>;

// The bytes of a WHB04B, as its protocol is described.
struct Whb {
  int feed = 0x0F;  // 0.1 mm, 10 %
  int axis = 0x11;  // X
  int key = 0;
  int second = 0;
  int wheel = 0;
  Report bytes() const {
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    return {4, 0x21, byte(key), byte(second), byte(feed), byte(axis), byte(wheel), 0x21};
  }
};
constexpr int key_reset = 1;
constexpr int key_stop = 2;
constexpr int key_start = 3;
constexpr int key_feed_up = 4;
constexpr int key_workpiece_home = 0x0A;
constexpr int key_fn = 0x0C;
constexpr int key_probe_z = 0x0D;
constexpr int key_continuous = 0x0E;
constexpr int step_1_mm = 0x10;
constexpr int step_100_percent = 0x1B;
constexpr int axis_off = 0x06;
constexpr int axis_z = 0x13;

constexpr std::size_t whb04b = 0;
constexpr std::size_t shuttle_xpress = 1;

// A pendant at a machine that is served.
class Hand {
 public:
  Hand(const PendantMachine& machine, std::function<void()> poll, std::size_t table)
      : session_(machine.session), poll_(std::move(poll)), control(known_pendants()[table], machine, status) {
    control.connect(session_.now());
  }

  void send(const Report& report) { control.receive(report, session_.now()); }
  void send(const Whb& whb) { send(whb.bytes()); }
  // Turns the wheel: `times` reports of `detents`, one every `every`.
  void turn(Whb whb, int detents, int times, Seconds every) {
    whb.wheel = detents;
    for (int i = 0; i < times; ++i) {
      send(whb);
      pass(every);
    }
  }
  void press(int key, int second = 0) {
    send(Whb{.key = key, .second = second});
    pass(Seconds(0.02));
    send(Whb{});
    pass(Seconds(0.02));
  }
  void pass(Seconds time) {
    for (const Seconds end = session_.now() + time; session_.now() < end;) turn_once();
  }
  void turn_once() {
    poll_();
    control.poll(session_.now());
    const double now_at = at(Axis::x) + at(Axis::y) + at(Axis::z);
    if (now_at != last_at_) moved_at_ = session_.now();
    last_at_ = now_at;
  }
  // Waits until the machine rests. Returns when it last moved, after `from`.
  Seconds rest_after(Seconds from) {
    for (const Seconds end = session_.now() + Seconds(20); session_.now() < end;) {
      turn_once();
      if (!session_.busy() && session_.now() - moved_at_ > Seconds(0.5)) break;
    }
    EXPECT_FALSE(session_.busy());
    return moved_at_ - from;
  }
  double at(Axis axis) const { return session_.status().now_at[axis]; }
  Seconds now() const { return session_.now(); }
  MachineSession& session() { return session_; }

 private:
  MachineSession& session_;
  std::function<void()> poll_;
  double last_at_ = 0;
  Seconds moved_at_{0};

 public:
  PendantStatus status;
  PendantControl control;
};

// The router on a virtual machine.
class AtRouter {
 public:
  explicit AtRouter(std::size_t table = whb04b, const std::string& macros = {})
      : run(GrblRun::at_zero(), nullptr, {}, nullptr, {}, nullptr, nullptr, nullptr, macros),
        hand(
            {.machine = run.run.description(), .session = run.run.session(), .owner = run.owner, .api = run.api},
            [this] { run.poll(); }, table) {
    hand.send(Whb{});
  }
  ApiRun run;
  Hand hand;
};

// A board with Grbl.
class AtGrbl {
 public:
  explicit AtGrbl(std::size_t table = whb04b)
      : run(example_machine("router")),
        api(run.description, run.session, owner,
            {.version = "1", .openapi = "{}", .make_key = [] { return std::string("key"); }}),
        hand(
            {.machine = run.description, .session = run.session, .owner = owner, .api = api},
            [this] {
              run.session.poll(Seconds(0.005));
              api.on_change(run.session.take_changes());
              api.poll();
            },
            table) {
    EXPECT_TRUE(run.go_online());
    hand.send(Whb{});
  }
  GrblSessionRun run;
  MachineControl owner;
  WebApi api;
  Hand hand;
};

// Of the router's X.
constexpr double highest = 100;       // mm/s
constexpr double acceleration = 800;  // mm/s²
// The session's motion is planned ahead, and a virtual machine is looked at every 5 ms.
constexpr double looks = 0.02;

double braking(double speed) {
  return speed / acceleration;
}

TEST(Pendant, moves_one_step_for_each_detent) {
  AtRouter at;
  at.hand.turn(Whb{}, 1, 3, Seconds(0.3));
  at.hand.rest_after(at.hand.now());
  EXPECT_NEAR(at.hand.at(Axis::x), 0.3, 0.002);
  at.hand.turn(Whb{}, -2, 1, Seconds(0.3));
  EXPECT_NEAR(at.hand.at(Axis::x), 0.1, 0.002);
  at.hand.turn(Whb{.axis = axis_z}, 5, 1, Seconds(0.3));
  EXPECT_NEAR(at.hand.at(Axis::z), 0.5, 0.002);
  EXPECT_NEAR(at.hand.at(Axis::x), 0.1, 0.002);
}

TEST(Pendant, that_turns_faster_than_the_machine_moves_queues_up_no_motion) {
  AtRouter at;
  // 200 mm within 0.2 s.
  at.hand.turn({.feed = step_1_mm}, 10, 20, Seconds(0.01));
  const Seconds last = at.hand.now() - Seconds(0.01);
  const double speed = highest * 0.5;
  EXPECT_LT(at.hand.rest_after(last).value(), 0.1 + 2 * braking(speed) + looks);
  const double end = at.hand.at(Axis::x);
  EXPECT_GT(end, 5);
  EXPECT_LT(end, 0.35 * speed);
  EXPECT_NEAR(end, std::round(end), 0.003) << "whole steps";
}

TEST(Pendant, in_continuous_mode_ends_with_the_wheel) {
  AtRouter at;
  at.hand.press(key_continuous);
  EXPECT_TRUE(at.hand.status.is_continuous);
  at.hand.turn({.feed = step_100_percent}, 1, 50, Seconds(0.02));
  const Seconds last = at.hand.now() - Seconds(0.02);
  EXPECT_EQ(at.hand.session().state(), MachineState::jog);
  EXPECT_LT(at.hand.rest_after(last).value(), 0.1 + braking(highest) + looks);
  EXPECT_GT(at.hand.at(Axis::x), 0.7 * highest);
  // The other way, and slower.
  const double from = at.hand.at(Axis::x);
  const Seconds begun = at.hand.now();
  at.hand.turn({.feed = step_1_mm}, -1, 50, Seconds(0.02));
  const double turned = (at.hand.now() - begun).value();
  at.hand.rest_after(at.hand.now());
  EXPECT_NEAR(from - at.hand.at(Axis::x), 0.3 * highest * (turned + 0.08), 2);
}

TEST(Pendant, at_the_end_of_the_travel_rests_however_long_it_is_turned) {
  AtRouter at;
  at.hand.press(key_continuous);
  at.hand.turn({.feed = step_100_percent, .axis = axis_z}, 1, 200, Seconds(0.02));
  EXPECT_NEAR(at.hand.at(Axis::z), 60, 0.01);
  EXPECT_EQ(at.hand.session().state(), MachineState::idle);
  at.hand.pass(Seconds(0.2));
  at.hand.turn({.feed = step_100_percent, .axis = axis_z}, -1, 20, Seconds(0.02));
  EXPECT_LT(at.hand.at(Axis::z), 55);
}

// How the motion of a pendant ends early.
struct Loss {
  const char* name;
  void (*happens)(Hand& hand);
};
const std::vector<Loss> losses = {
    {"its cable is pulled", [](Hand& hand) { hand.control.disconnect(hand.now()); }},
    {"its receiver reports no link",
     [](Hand& hand) {
       hand.send(Report{4, 0, 0, 0, 0, 0, 0, 0});
     }},
    {"the selector is turned off", [](Hand& hand) { hand.send(Whb{.feed = step_1_mm, .axis = axis_off}); }},
    {"the selector is turned", [](Hand& hand) { hand.send(Whb{.feed = step_1_mm, .axis = axis_z}); }},
    {"stop is pressed", [](Hand& hand) { hand.send(Whb{.feed = step_1_mm, .key = key_stop}); }},
    {"reset is pressed", [](Hand& hand) { hand.send(Whb{.feed = step_1_mm, .key = key_reset}); }},
};

TEST(Pendant, that_is_lost_moves_nothing_any_more) {
  for (const Loss& loss : losses) {
    for (const bool is_continuous : {false, true}) {
      SCOPED_TRACE(std::string(loss.name) + (is_continuous ? ", continuous" : ", by steps"));
      AtRouter at;
      if (is_continuous) at.hand.press(key_continuous);
      at.hand.turn({.feed = step_1_mm}, 5, 20, Seconds(0.02));
      ASSERT_TRUE(at.hand.session().busy());
      loss.happens(at.hand);
      EXPECT_LT(at.hand.rest_after(at.hand.now()).value(), 0.1 + braking(highest * 0.5) + looks);
      const double end = at.hand.at(Axis::x);
      at.hand.pass(Seconds(1));
      EXPECT_EQ(at.hand.at(Axis::x), end);
      EXPECT_EQ(at.hand.session().state(), MachineState::idle);
    }
  }
}

TEST(Pendant, with_a_ring_moves_at_its_speed_as_long_as_it_is_held) {
  AtRouter at(shuttle_xpress);
  const auto ring = [&](int position, int buttons = 0) {
    at.hand.send(Report{static_cast<std::uint8_t>(position), 7, 0, static_cast<std::uint8_t>(buttons), 0});
  };
  ring(0);
  ring(3);
  at.hand.pass(Seconds(0.2));
  EXPECT_FALSE(at.hand.session().busy()) << "no axis is selected";
  ring(0);
  ring(0, 0x10);  // X
  ring(0);
  ring(4);  // 20 %
  at.hand.pass(Seconds(0.5));
  const double from = at.hand.at(Axis::x);
  at.hand.pass(Seconds(1));
  EXPECT_NEAR(at.hand.at(Axis::x) - from, 0.2 * highest, 1);
  ring(7);  // 100 %, without a stop in between
  at.hand.pass(Seconds(0.5));
  const double before = at.hand.at(Axis::x);
  at.hand.pass(Seconds(1));
  EXPECT_NEAR(at.hand.at(Axis::x) - before, highest, 3);
  ring(0);
  EXPECT_LT(at.hand.rest_after(at.hand.now()).value(), 0.1 + braking(highest) + looks);
  ring(-5);
  at.hand.pass(Seconds(0.3));
  EXPECT_TRUE(at.hand.session().busy());
  at.hand.control.disconnect(at.hand.now());
  EXPECT_LT(at.hand.rest_after(at.hand.now()).value(), 0.1 + braking(0.4 * highest) + looks);
  // The ring is still turned when it is plugged in again.
  at.hand.control.connect(at.hand.now());
  ring(-5);
  ring(-5);
  at.hand.pass(Seconds(0.3));
  EXPECT_FALSE(at.hand.session().busy());
}

TEST(Pendant, has_control_only_while_it_is_used) {
  AtRouter at;
  at.run.own();
  const std::string page = at.run.key;
  at.hand.turn({.feed = step_1_mm}, 2, 1, Seconds(0.02));
  EXPECT_EQ(at.run.owner.name(), "XHC WHB04B");
  at.run.post("/jog", R"({"direction": {"x": 1}, "speed": 600})");
  EXPECT_EQ(at.run.status, 403U);
  at.hand.pass(Seconds(1));
  EXPECT_TRUE(at.run.owner.is_client(page)) << "it has it again";
  at.run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 1, "lease": 5})");
  EXPECT_EQ(at.run.status, 200U);
  at.hand.turn({.feed = step_1_mm}, 2, 3, Seconds(0.02));
  EXPECT_TRUE(at.run.owner.is_client(page)) << "the machine moves for the page";
  EXPECT_FALSE(at.hand.status.refusal.text.empty());
  AtRouter lonely;
  lonely.hand.turn({}, 2, 1, Seconds(1));
  EXPECT_EQ(lonely.run.owner.kind(), MachineControl::Kind::nobody);
}

TEST(Pendant, does_not_move_the_machine_while_a_job_runs) {
  AtRouter at;
  at.run.own();
  const std::uint64_t id = at.run.upload("G21 G90\nG1 X40 F1200\nG1 X0\nM2\n");
  at.run.post(fmt::format("/programs/{}/run", id));
  ASSERT_EQ(at.run.status, 202U);
  at.hand.turn({.axis = axis_z}, 3, 10, Seconds(0.05));
  ASSERT_EQ(at.hand.session().state(), MachineState::run);
  at.hand.press(key_feed_up);
  EXPECT_NEAR(at.hand.session().status().overrides.feed, 1.1, 1e-9) << "overrides are free";
  at.hand.press(key_start);
  at.hand.pass(Seconds(0.5));
  ASSERT_EQ(at.hand.session().state(), MachineState::hold) << "and so is a hold";
  at.hand.turn({.axis = axis_z}, 3, 10, Seconds(0.05));
  EXPECT_EQ(at.hand.at(Axis::z), 0);
  at.hand.press(key_start);
  at.hand.pass(Seconds(0.2));
  EXPECT_EQ(at.hand.session().state(), MachineState::run);
  ASSERT_TRUE(at.run.turn_until([&] { return at.run.api.job().state == JobState::done; }));
  EXPECT_NEAR(at.hand.at(Axis::z), 0, 1e-9);
}

TEST(Pendant, resumes_the_program_of_a_sender_and_does_not_end_it) {
  AtRouter at;
  at.run.owner.claim_for_sender();
  at.run.run.grbl().let_drive(true);
  at.run.run.grbl().connect();
  at.run.run.send("G1 X40 F1200\n");
  at.hand.pass(Seconds(0.3));
  at.run.run.send("!");
  at.hand.pass(Seconds(0.5));
  ASSERT_EQ(at.hand.session().state(), MachineState::hold);
  at.hand.turn({.axis = axis_z}, 3, 3, Seconds(0.05));
  EXPECT_TRUE(at.run.owner.is_sender());
  ASSERT_EQ(at.hand.session().state(), MachineState::hold);
  at.hand.press(key_start);
  at.hand.pass(Seconds(5));
  EXPECT_NEAR(at.hand.at(Axis::x), 40, 0.002);
  EXPECT_EQ(at.hand.at(Axis::z), 0);
}

TEST(Pendant, lets_a_job_that_waits_for_the_operator_go_on_waiting) {
  AtRouter at;
  at.run.own();
  const std::uint64_t id = at.run.upload("G21 G90\nG1 X4 F1200\nM0\nG1 X0\nM2\n");
  at.run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(at.run.turn_until_state("Hold"));
  at.hand.pass(Seconds(1));
  at.hand.turn({.feed = step_1_mm, .axis = axis_z}, 2, 1, Seconds(1));
  EXPECT_NEAR(at.hand.at(Axis::z), 2, 0.002) << "as from the page";
  at.hand.press(key_start);
  ASSERT_TRUE(at.run.turn_until([&] { return at.run.api.job().state == JobState::done; }, Seconds(30)));
  EXPECT_NEAR(at.hand.at(Axis::x), 0, 0.002);
}

TEST(Pendant, sets_the_zero_of_the_selected_axis) {
  AtRouter at;
  at.hand.turn({.feed = step_1_mm}, 5, 1, Seconds(1));
  at.hand.press(key_workpiece_home, key_fn);
  const Json status = at.run.get("/status");
  EXPECT_NEAR(status["work_offset"]["x"].get<double>(), 5, 0.002);
  EXPECT_EQ(status["work_offset"]["y"], 0.0);
  expect_members(openapi()["components"]["schemas"]["Status"], status, "Status");
}

std::string folder_of_macros() {
  const std::filesystem::path folder = scratch_folder();
  std::ofstream(folder / "probe-z.ngc") << "; title = \"Probe Z\"\nG21 G91\nG0 Y7\n";
  return folder.string();
}

TEST(Pendant, runs_the_macro_of_a_key) {
  AtRouter at(whb04b, folder_of_macros());
  at.hand.press(key_probe_z);
  at.hand.pass(Seconds(3));
  EXPECT_NEAR(at.hand.at(Axis::y), 7, 0.002);
  at.hand.press(key_probe_z, key_fn);
  EXPECT_EQ(at.hand.status.refusal.text, "there is no macro of this name") << "macro-9";
}

TEST(Pendant, that_is_connected_with_a_held_key_does_nothing) {
  AtRouter at(whb04b, folder_of_macros());
  at.hand.control.disconnect(at.hand.now());
  at.hand.control.connect(at.hand.now());
  at.hand.send(Whb{.key = key_probe_z});
  at.hand.pass(Seconds(2));
  EXPECT_EQ(at.hand.at(Axis::y), 0);
  at.hand.press(key_probe_z);
  at.hand.pass(Seconds(3));
  EXPECT_EQ(at.hand.at(Axis::y), 0) << "the same press";
  at.hand.press(key_probe_z);
  at.hand.pass(Seconds(3));
  EXPECT_NEAR(at.hand.at(Axis::y), 7, 0.002);
}

TEST(Pendant, shows_the_position_on_its_display) {
  AtRouter at;
  at.run.api.apply_offsets({{5221, 20}});
  at.hand.turn({.feed = step_1_mm}, 5, 1, Seconds(1));
  const auto reports = at.hand.control.take_display(at.hand.now());
  ASSERT_EQ(reports.size(), 3U);
  EXPECT_EQ(reports[0][5], 15) << "5 - 20";
  EXPECT_EQ(reports[1][1], 0x80) << "the sign";
  EXPECT_TRUE(at.hand.control.take_display(at.hand.now()).empty()) << "nothing is new";
}

TEST(Pendant, moves_a_grbl_machine_and_ends_with_the_wheel) {
  AtGrbl at;
  at.hand.turn({}, 1, 3, Seconds(0.4));
  at.hand.rest_after(at.hand.now());
  EXPECT_NEAR(at.hand.at(Axis::x), 0.3, 0.01);
  at.hand.press(key_continuous);
  at.hand.turn({.feed = step_100_percent}, 1, 50, Seconds(0.02));
  const Seconds last = at.hand.now() - Seconds(0.02);
  ASSERT_EQ(at.hand.session().state(), MachineState::jog);
  // The board reports its position every 0.1 s at best.
  EXPECT_LT(at.hand.rest_after(last).value(), 0.1 + 50.0 / 500 + 0.15);
  const double end = at.hand.at(Axis::x);
  EXPECT_GT(end, 25);
  at.hand.pass(Seconds(1));
  EXPECT_EQ(at.hand.at(Axis::x), end);
}

TEST(Pendant, with_a_ring_changes_the_speed_of_a_grbl_machine) {
  AtGrbl at(shuttle_xpress);
  const auto ring = [&](int position, int buttons = 0) {
    at.hand.send(Report{static_cast<std::uint8_t>(position), 7, 0, static_cast<std::uint8_t>(buttons), 0});
  };
  ring(0);
  ring(0, 0x10);  // X
  ring(4);        // 20 %
  at.hand.pass(Seconds(1));
  const double from = at.hand.at(Axis::x);
  at.hand.pass(Seconds(1));
  EXPECT_NEAR(at.hand.at(Axis::x) - from, 10, 3);
  ring(7);
  at.hand.pass(Seconds(1));
  const double before = at.hand.at(Axis::x);
  at.hand.pass(Seconds(1));
  EXPECT_NEAR(at.hand.at(Axis::x) - before, 50, 10);
  ring(0);
  EXPECT_LT(at.hand.rest_after(at.hand.now()).value(), 50.0 / 500 + 0.25);
}

// Whatever a device sends, the machine ends at rest within its travel.
TEST(Pendant, takes_any_reports) {
  const std::uint64_t seed = first_seed(41);
  SCOPED_TRACE(command_again(seed));
  std::mt19937_64 random(seed);
  for (const std::size_t table : {whb04b, shuttle_xpress}) {
    AtRouter at(table, folder_of_macros());
    for (int i = 0; i < 600; ++i) {
      Report report = table == whb04b ? Whb{}.bytes() : Report(5);
      for (std::uint8_t& byte : report) {
        if (random() % 3 == 0) byte = static_cast<std::uint8_t>(random() % 2 == 0 ? random() : random() % 24);
      }
      if (table == whb04b && random() % 8 != 0) report[0] = 4;
      at.hand.send(report);
      at.hand.turn_once();
    }
    at.hand.control.disconnect(at.hand.now());
    at.hand.pass(Seconds(1));
    if (at.hand.session().busy()) at.run.post("/stop");
    at.hand.rest_after(at.hand.now());
    EXPECT_GE(at.hand.at(Axis::x), -400);
    EXPECT_LE(at.hand.at(Axis::z), 60);
  }
}

}  // namespace
}  // namespace passo::test
