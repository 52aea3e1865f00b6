// The files of a board beside its session: listed, sent, deleted, and run by the board itself.
#include <algorithm>
#include <string>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include "kit/strict_card_board.hpp"
#include <gmock/gmock.h>

namespace passo::test {
namespace {

using testing::HasSubstr;
using CardRun = GrblSessionRunOn<StrictCardBoard>;
using State = StorageResult::State;

constexpr const char* there_and_back = "G21 G90\nG1 X50 F1200\nG1 X0\nM2\n";

struct BoardStorages : testing::TestWithParam<bool> {
  BoardStorages()
      : run(example_machine("router"), {}, GetParam() ? strict_fluidnc_with_card() : strict_grblhal_with_card()) {}

  std::string at(const std::string& name) const { return (GetParam() ? "/sd/" : "/") + name; }
  BoardStorage& storage() { return *run.session.storage(); }
  void put(const std::string& name, const std::string& text) { run.board.files()[at(name)] = text; }
  bool finish(Seconds most = Seconds(60)) {
    return run.play([&] { return storage().result().state != State::running; }, most);
  }
  // Plays the order to its end.
  State order(StorageOrder wanted) {
    refusal = storage().begin(std::move(wanted));
    if (refusal) return State::none;
    EXPECT_TRUE(finish());
    return storage().result().state;
  }
  std::vector<std::string> paths() {
    std::vector<std::string> all;
    for (const StoredFile& one : storage().result().files) all.push_back(one.path);
    return all;
  }
  std::optional<Ticket> begin_file(const std::string& text) {
    put("part.nc", text);
    EXPECT_TRUE(run.go_online());
    return run.ask(request::RunBoardFile{at("part.nc")});
  }
  bool play_to(double x) {
    return run.play([&] { return run.grbl.place()[Axis::x] > x; });
  }

  CardRun run;
  std::optional<Refusal> refusal;
};
INSTANTIATE_TEST_SUITE_P(Firmwares, BoardStorages, testing::Bool(),
                         [](const auto& one) { return one.param ? "FluidNC" : "grblHAL"; });

TEST_P(BoardStorages, list_send_and_delete_files) {
  ASSERT_TRUE(run.go_online());
  ASSERT_TRUE(run.session.abilities().can(Ability::board_files));
  put("old.nc", "G0 X1\n");
  ASSERT_EQ(order({}), State::done);
  EXPECT_EQ(paths(), std::vector<std::string>{at("old.nc")});
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "G1 X" + std::to_string(i % 50) + "\n";
  ASSERT_EQ(order({.kind = StorageOrder::Kind::upload, .path = at("new.nc"), .content = text}), State::done)
      << storage().result().why.text;
  EXPECT_EQ(run.board.files()[at("new.nc")], text);
  EXPECT_EQ(storage().result().uploads, 1U);
  EXPECT_EQ(paths(), (std::vector<std::string>{at("new.nc"), at("old.nc")})) << "it is listed again";
  ASSERT_EQ(order({.kind = StorageOrder::Kind::remove, .path = at("old.nc")}), State::done);
  EXPECT_EQ(paths(), std::vector<std::string>{at("new.nc")});
  // The board goes on as before.
  const auto ticket = run.ask_and_wait(grbl_start(there_and_back));
  ASSERT_TRUE(ticket);
  EXPECT_EQ(ticket->outcome, Outcome::done) << run.session.trouble_words();
}

TEST_P(BoardStorages, delete_only_what_is_in_the_list) {
  ASSERT_TRUE(run.go_online());
  put("part.nc", "G0 X1\n");
  ASSERT_EQ(order({}), State::done);
  for (const std::string& path : {at("jobs"), at(""), std::string("/"), at("a\nG0X9")}) {
    EXPECT_EQ(order({.kind = StorageOrder::Kind::remove, .path = path}), State::none) << path;
    EXPECT_EQ(refusal->code(), RefusalCode::cannot);
  }
  run.board.files().clear();  // somebody has taken the card
  EXPECT_EQ(order({.kind = StorageOrder::Kind::remove, .path = at("part.nc")}), State::failed);
  EXPECT_EQ(storage().result().why.code, "board-files.refused");
  EXPECT_EQ(run.session.state(), MachineState::idle);
}

TEST_P(BoardStorages, say_that_no_card_is_there) {
  if (GetParam()) GTEST_SKIP() << "FluidNC still has its flash memory";
  run.board.has_card = false;
  ASSERT_TRUE(run.go_online());
  EXPECT_EQ(order({}), State::failed);
  EXPECT_THAT(storage().result().why.text, HasSubstr("is a card inserted?"));
}

TEST_P(BoardStorages, tell_how_far_an_upload_is_and_refuse_motion_meanwhile) {
  ASSERT_TRUE(run.go_online());
  int packets = 0;
  run.board.receiver().disturb = [&](std::string& packet) {
    if (++packets % 5 == 0) packet[9] ^= 1;  // each fifth is torn, and sent again
  };
  const std::string text(64 * 1024, 'G');
  ASSERT_FALSE(storage().begin({.kind = StorageOrder::Kind::upload, .path = at("big.nc"), .content = text}));
  double share = 0;
  while (storage().result().state == State::running && share < 0.5) {
    run.play_for(Seconds(0.02));
    EXPECT_GE(storage().result().share, share) << "it never goes back";
    share = storage().result().share;
  }
  EXPECT_FALSE(run.ask(grbl_start(there_and_back)));
  EXPECT_EQ(run.refusal->code(), RefusalCode::busy);
  EXPECT_FALSE(run.ask(request::RunBoardFile{at("big.nc")}));
  EXPECT_TRUE(storage().begin({})) << "one order at a time";
  ASSERT_TRUE(finish(Seconds(600)));
  EXPECT_EQ(storage().result().state, State::done) << storage().result().why.text;
  EXPECT_EQ(run.board.files()[at("big.nc")], text);
}

TEST_P(BoardStorages, end_an_upload_at_a_stop) {
  ASSERT_TRUE(run.go_online());
  const std::string text(64 * 1024, 'G');
  ASSERT_FALSE(storage().begin({.kind = StorageOrder::Kind::upload, .path = at("big.nc"), .content = text}));
  ASSERT_TRUE(run.play([&] { return storage().result().share > 0.2; }));
  ASSERT_TRUE(run.ask_and_wait(request::Stop{}));
  ASSERT_TRUE(finish());
  EXPECT_EQ(storage().result().state, State::failed);
  EXPECT_THAT(storage().result().why.text, HasSubstr("interrupted"));
  ASSERT_TRUE(run.play([&] { return run.session.sender().ready(); }));
  const auto done = run.ask_and_wait(grbl_start(there_and_back));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::done) << run.session.trouble_words();
}

TEST_P(BoardStorages, end_with_a_lost_connection) {
  ASSERT_TRUE(run.go_online());
  const std::string text(64 * 1024, 'G');
  ASSERT_FALSE(storage().begin({.kind = StorageOrder::Kind::upload, .path = at("big.nc"), .content = text}));
  ASSERT_TRUE(run.play([&] { return storage().result().share > 0.2; }));
  run.port.unplugged = true;
  ASSERT_TRUE(run.play_until(MachineState::fault, Seconds(2)));
  EXPECT_EQ(storage().result().state, State::failed);
  EXPECT_EQ(storage().result().why.code, "board-files.lost");
}

TEST_P(BoardStorages, run_a_file_to_its_end) {
  const auto ticket = begin_file(there_and_back);
  ASSERT_TRUE(ticket);
  EXPECT_EQ(run.session.state(), MachineState::run);
  double share = 0;
  ASSERT_TRUE(run.play([&] {
    const MachineStatus status = run.session.status();
    if (run.session.busy()) EXPECT_EQ(status.executes.board_file, at("part.nc"));
    EXPECT_EQ(status.executes.line, 0U) << "its lines are not known";
    if (status.progress) {
      EXPECT_GE(*status.progress, share);
      share = *status.progress;
    }
    return run.answer_to(*ticket).has_value();
  }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done) << run.session.trouble_words();
  EXPECT_GT(share, 0.6);
  EXPECT_EQ(run.board.runs, 1) << "it is begun once";
  EXPECT_FALSE(run.board.interfered) << "only real-time commands may be sent meanwhile";
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_EQ(run.session.status().executes.board_file, "");
  EXPECT_FALSE(run.session.lost_place());
}

TEST_P(BoardStorages, hold_and_resume_a_file) {
  const auto ticket = begin_file(there_and_back);
  ASSERT_TRUE(play_to(10));
  EXPECT_FALSE(run.ask(grbl_start(there_and_back))) << "no other job begins";
  EXPECT_TRUE(storage().begin({})) << "no file is listed";
  const auto held = run.ask_and_wait(request::Hold{}, Seconds(2));
  ASSERT_TRUE(held);
  EXPECT_EQ(held->outcome, Outcome::done);
  EXPECT_EQ(run.session.state(), MachineState::hold);
  EXPECT_TRUE(run.session.status().rests);
  const double rests_at = run.grbl.place()[Axis::x];
  run.play_for(Seconds(70));
  EXPECT_EQ(run.grbl.place()[Axis::x], rests_at);
  EXPECT_FALSE(run.answer_to(*ticket));
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
  EXPECT_NEAR(run.grbl.place()[Axis::x], 0, 1e-9);
}

TEST_P(BoardStorages, stop_a_file_and_keep_the_position) {
  const auto ticket = begin_file(there_and_back);
  ASSERT_TRUE(play_to(10));
  ASSERT_TRUE(run.ask_and_wait(request::Stop{}, Seconds(5)));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::stopped);
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_FALSE(run.session.lost_place());
  const double rests_at = run.grbl.place()[Axis::x];
  EXPECT_LT(rests_at, 50);
  EXPECT_NEAR(run.session.status().position.place[Axis::x], rests_at, 1e-3);
  run.play_for(Seconds(5));
  EXPECT_EQ(run.grbl.place()[Axis::x], rests_at) << "the board has forgotten the file";
  EXPECT_EQ(run.board.runs, 1);
}

TEST_P(BoardStorages, wait_for_the_operator_where_the_file_does) {
  const auto ticket = begin_file("G21 G90\nG1 X5 F1200\nM0\nG1 X9\nM2\n");
  ASSERT_TRUE(run.play_until(MachineState::hold, Seconds(10)));
  run.play_for(Seconds(90));
  EXPECT_EQ(run.session.state(), MachineState::hold) << run.session.trouble_words();
  ASSERT_TRUE(run.ask(request::Resume{}));
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done);
}

TEST_P(BoardStorages, let_a_file_dwell_for_long) {
  const auto ticket = begin_file("G21 G90\nG4 P100\nG1 X5 F1200\nM2\n");
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }, Seconds(200)));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done) << run.session.trouble_words();
}

TEST_P(BoardStorages, tell_the_error_of_a_file) {
  const auto ticket = begin_file("G21 G90\nG1 X5 F1200\nG99\nG1 X50\nM2\n");
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  const auto end = *run.answer_to(*ticket);
  EXPECT_EQ(end.outcome, Outcome::failed);
  ASSERT_TRUE(end.fault);
  EXPECT_THAT(end.fault->sentence().text, HasSubstr("at line 3"));
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_FALSE(run.session.lost_place());
  EXPECT_NEAR(run.grbl.place()[Axis::x], 5, 1e-9);
}

TEST_P(BoardStorages, refuse_a_file_that_is_not_there) {
  ASSERT_TRUE(run.go_online());
  const auto done = run.ask_and_wait(request::RunBoardFile{at("none.nc")});
  ASSERT_TRUE(done);
  EXPECT_EQ(done->outcome, Outcome::failed);
  EXPECT_EQ(run.session.state(), MachineState::idle);
  EXPECT_FALSE(run.ask(request::RunBoardFile{at("what?.nc")}));
  EXPECT_FALSE(run.ask(request::RunBoardFile{at("a\nG0 X9")}));
  EXPECT_EQ(run.board.runs, 0);
}

TEST_P(BoardStorages, say_that_a_lost_board_may_go_on_and_stop_it_by_a_reset) {
  const auto ticket = begin_file(there_and_back);
  ASSERT_TRUE(play_to(5));
  run.port.unplugged = true;
  ASSERT_TRUE(run.play_until(MachineState::fault, Seconds(2)));
  EXPECT_THAT(run.session.trouble_words(), HasSubstr("may go on with " + at("part.nc")));
  EXPECT_TRUE(run.session.lost_place());
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::failed);
  // The cable is back: the board still moves, and nothing begins. A reset stops it.
  run.port.unplugged = false;
  ASSERT_TRUE(run.ask(request::ResetMachine{}));
  ASSERT_TRUE(run.play_until(MachineState::fault, Seconds(10)));
  EXPECT_EQ(run.session.fault()->code, "grbl.busy");
  ASSERT_TRUE(run.ask(request::ResetMachine{}));
  ASSERT_TRUE(run.play_until(MachineState::idle, Seconds(10)));
  EXPECT_EQ(run.grbl.speed(), 0);
  EXPECT_TRUE(run.session.lost_place());
  EXPECT_EQ(run.board.runs, 1) << "it is not begun again";
}

TEST_P(BoardStorages, take_over_what_a_file_has_changed) {
  const auto ticket = begin_file("G21 G90\nG10 L2 P1 X7\nG1 X5 F1200\nM2\n");
  ASSERT_TRUE(run.play([&] { return run.answer_to(*ticket).has_value(); }));
  EXPECT_EQ(run.answer_to(*ticket)->outcome, Outcome::done) << run.session.trouble_words();
  EXPECT_NEAR(run.session.board().offsets.at("G54")[Axis::x], 7, 1e-9);
}

TEST(BoardStorage, is_missing_on_a_board_without_a_card) {
  GrblSessionRun run(example_machine("router"));
  ASSERT_TRUE(run.go_online());
  EXPECT_EQ(run.session.storage(), nullptr);
  EXPECT_FALSE(run.session.abilities().can(Ability::board_files));
  EXPECT_FALSE(run.ask(request::RunBoardFile{"/part.nc"}));
  EXPECT_EQ(run.refusal->code(), RefusalCode::cannot);
}

TEST(BoardStorage, takes_no_upload_where_the_board_has_no_ymodem) {
  CardRun run(example_machine("router"), {}, strict_grblhal_with_card("ENUMS,SD"));
  ASSERT_TRUE(run.go_online());
  ASSERT_NE(run.session.storage(), nullptr);
  ASSERT_TRUE(run.session.storage()->why_no_upload());
  EXPECT_TRUE(run.session.storage()->begin({.kind = StorageOrder::Kind::upload, .path = "/a.nc", .content = "M2\n"}));
}

}  // namespace
}  // namespace passo::test
