// The refiller against a list of this test's own: what the board holds always ends at rest, what is late is taken up
// again, and what does not fit is made to.
#include "passo/drive/queue_updater.hpp"

#include <deque>

#include "kit/stage_test.hpp"

#include "passo/base/tap.hpp"
#include "passo/wire/segment_parts.hpp"

namespace passo {
namespace {

using test::xyz;

// A board as docs/wire.md has it, without a wire: it plays an item at each go_on().
class ListedBoard final : public Link {
 public:
  explicit ListedBoard(std::size_t places) : places_(places) {}

  bool deaf = false;  // what comes, comes too late

  void send(const BoardSegment&) override { ADD_FAILURE() << "a segment without a replace"; }
  void send(const BoardOutputs&) override { ADD_FAILURE() << "outputs without a replace"; }
  ItemNumber replace(ItemNumber after, std::span<const LinkItem> items) override {
    EXPECT_LE(static_cast<int>(items.size()), room());
    const auto first = static_cast<ItemNumber>(++sent_ + 1);
    most_ = std::max(most_, list_.size() + items.size());
    std::deque<Held> kept;
    bool found = after == executed_;
    for (const Held& held : list_) {
      if (found) break;
      kept.push_back(held);
      found = held.number == after;
    }
    for (std::size_t i = 0; i < items.size(); ++i) kept.push_back({.number = ++sent_, .item = items[i]});
    if (found && !deaf) list_ = kept;
    return first;
  }
  ItemNumber sent() const override { return sent_; }
  ItemNumber executed() const override { return executed_; }
  int room() const override { return std::min(places(), 127); }
  int places() const override { return static_cast<int>(places_ - list_.size()); }
  bool rests() const override { return list_.empty(); }
  bool busy() const override { return !list_.empty(); }
  void go_on() {
    if (list_.empty()) return;  // what was sent was dropped
    play(list_.front().item);
    executed_ = list_.front().number;
    list_.pop_front();
    EXPECT_TRUE(!list_.empty() || speed_at_rest_) << "the list ran out amid motion";
  }
  void watch_probe(ProbeUntil, std::uint8_t) override {}
  const ProbeReport& probe_report() const override { return report_; }
  void recall_contact() override {}
  void read_spindle() override {}
  void rehearse(std::size_t) override {}
  bool settled() const override { return true; }
  void ask() override {}
  void ask_for_spindle(bool) override {}
  std::optional<Turned> take_turned() override { return {}; }
  bool answered() const override { return true; }
  Seconds answer_time() const override { return Seconds(0); }
  Seconds time_a_frame() const override { return Seconds(0); }
  Seconds now() const override { return Seconds(0); }
  std::optional<LinkError> error() const override { return error_; }
  void fail(LinkError error) override { error_ = error; }
  std::uint64_t frames_sent() const override { return 0; }
  std::uint64_t bytes_sent() const override { return 0; }

  int steps() const { return steps_; }
  int reversals() const { return reversals_; }
  double ticks() const { return ticks_; }
  std::size_t most_held() const { return most_; }

 private:
  struct Held {
    ItemNumber number = 0;
    LinkItem item;
  };

  // Steps are the carries of a sum; with a flip, the events without one.
  void play(const LinkItem& item) {
    const auto* segment = std::get_if<BoardSegment>(&item);
    if (segment == nullptr) return;
    const std::uint32_t sum = fraction_ + std::uint32_t{segment->increments[0]} * segment->events;
    fraction_ = sum & 0xFFFFU;
    const int carries = static_cast<int>(sum >> 16);
    const int made = (segment->flips & 1U) != 0 ? segment->events - carries : carries;
    const int signed_steps = (segment->directions & 1U) != 0 ? -made : made;
    if (signed_steps < 0) ++reversals_;
    steps_ += signed_steps;
    const double events = segment->events;
    const std::int64_t time = duration(*segment, most_events);
    ticks_ += static_cast<double>(time) / 65536;
    const double last = static_cast<double>(time - duration(*segment, segment->events - 1)) / 65536;
    // The rate of steps in the last event: so slow that one can begin and end with it.
    speed_at_rest_ = made == 0 || made / events / last < most_at_rest;
  }

  static constexpr double most_at_rest = 1.0 / 1500;  // steps a tick, of 1 MHz

  std::size_t places_;
  std::deque<Held> list_;
  ItemNumber sent_ = 0;
  ItemNumber executed_ = 0;
  std::optional<LinkError> error_;
  ProbeReport report_;
  std::uint32_t fraction_ = 0x8000;
  int steps_ = 0;
  int reversals_ = 0;
  double ticks_ = 0;
  bool speed_at_rest_ = true;
  std::size_t most_ = 0;
};

Segment line(double from, double to, double speed) {
  return {.curve = Curve::line(xyz(from, 0), xyz(to, 0)), .speed = MmPerSecond(speed), .mode = PathMode::continuous};
}

StepOptions steps(Axis first) {
  StepOptions options;
  options.kinematics = {{.steps = {first, 100}}, {.steps = {Axis::y, 100}}};
  options.clock = {.tick_rate = Hertz(1e6), .highest_event_rate = Hertz(50e3)};
  return options;
}

MotionLimits limits(double jerk) {
  MotionLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z, Axis::a}) {
    limits.velocity[axis] = MmPerSecond(100);
    limits.acceleration[axis] = MmPerSecond2(500);
    limits.jerk[axis] = MmPerSecond3(jerk);
  }
  return limits;
}

class RefillerTest : public testing::TestWithParam<double> {
 protected:
  // Plays the path; `each` may do something before each turn, and tells whether to go on.
  struct Street {
    Street(const std::vector<PathItem>& items, std::size_t places, Axis first = Axis::x)
        : source(items),
          board(places),
          watched(planner),
          generator(watched, steps(first)),
          refiller(stages(), steps(first), {}) {
      watched.watch([this](const MotionItem& item) { refiller.watch(item); });
    }
    QueueUpdater::Stages stages() {
      return {.path = path,
              .planner = planner,
              .generator = generator,
              .items = generator,
              .link = board,
              .outputs = outputs};
    }
    const QueueUpdateLedger& ledger() { return *refiller.ledger(); }
    test::ListSource<PathItem> source;
    RewindablePath path{source};
    Planner planner{path, limits(GetParam())};
    ListedBoard board;
    Tap<MotionItem> watched;
    StepGenerator generator;
    CommandedOutputs outputs;
    QueueUpdater refiller;
  };

  template <class Each>
  static Feed::Progress play(Street& street, const Each& each) {
    for (int turn = 0; turn < 1'000'000; ++turn) {
      each(turn);
      const Feed::Progress told = street.refiller.advance();
      if (told == Feed::Progress::waits) {
        street.board.go_on();
      } else if (told != Feed::Progress::goes_on) {
        return told;
      }
    }
    ADD_FAILURE() << "it never ends";
    return Feed::Progress::ended;
  }
  static Feed::Progress play(Street& street) {
    return play(street, [](int) {});
  }
};

TEST_P(RefillerTest, keeps_a_board_with_many_places_going_without_a_rest) {
  Street street({line(0, 30, 80), line(30, 60, 40)}, 240);
  EXPECT_EQ(play(street), Feed::Progress::ended);
  EXPECT_FALSE(street.board.error());
  EXPECT_EQ(street.board.steps(), 6000);
  EXPECT_EQ(street.ledger().recoveries(), 0);
  EXPECT_GT(street.ledger().refills(), 5U);
  EXPECT_NEAR(street.refiller.ahead().value(), 0, 1e-9);
}

TEST_P(RefillerTest, takes_up_again_where_the_tail_came_to_rest) {
  Street street({line(0, 30, 80), line(30, 60, 40)}, 240);
  // Deaf for 200 turns, three times.
  const auto each = [&](int turn) { street.board.deaf = turn % 400 > 100 && turn % 400 < 300 && turn < 1200; };
  EXPECT_EQ(play(street, each), Feed::Progress::ended);
  EXPECT_FALSE(street.board.error());
  EXPECT_EQ(street.board.steps(), 6000);
  EXPECT_EQ(street.board.reversals(), 0);
  EXPECT_GE(street.ledger().recoveries(), 1);
}

TEST_P(RefillerTest, never_sends_more_than_a_board_with_few_places_holds) {
  for (const std::size_t places : {16U, 24U, 31U}) {
    SCOPED_TRACE(places);
    Street street({line(0, 30, 80), line(30, 60, 40)}, places);
    EXPECT_EQ(play(street), Feed::Progress::ended);
    EXPECT_FALSE(street.board.error());
    EXPECT_EQ(street.board.steps(), 6000);
    EXPECT_LE(street.board.most_held(), places);
  }
}

// Round a small circle tails are long: each few degrees are a segment.
TEST_P(RefillerTest, goes_slower_where_tails_are_long) {
  std::vector<PathItem> circles;
  for (int i = 0; i < 5; ++i) {
    Segment circle = line(0, 1, 80);
    circle.curve = Curve::arc(xyz(0, 0), xyz(0, 0), Axis::x, Axis::y, 3, 0, 6.283185307179586);
    circles.emplace_back(circle);
  }
  Street street(circles, 14);
  EXPECT_EQ(play(street), Feed::Progress::ended);
  EXPECT_FALSE(street.board.error());
  EXPECT_EQ(street.board.steps(), 0);
  EXPECT_GT(street.ledger().slowdowns(), 0);
}

// Over many short lines too. Here A turns a degree for each 10 nm of the path, which has 1 µm/s then: what is slow was
// measured in mm of the path, so the path never went slower.
TEST_P(RefillerTest, goes_slower_where_tails_are_long_and_an_axis_mostly_turns) {
  std::vector<PathItem> lines;
  const auto place = [](int i) {
    Point at = xyz(1e-5 * i, 0);
    at[Axis::a] = i;
    return at;
  };
  for (int i = 0; i < 300; ++i) {
    Segment turn = line(0, 1, 80);
    turn.curve = Curve::line(place(i), place(i + 1));
    lines.emplace_back(turn);
  }
  Street street(lines, 14, Axis::a);
  EXPECT_EQ(play(street), Feed::Progress::ended);
  EXPECT_FALSE(street.board.error());
  EXPECT_EQ(street.board.steps(), 30'000);
  EXPECT_GT(street.ledger().slowdowns(), 0);
}

TEST_P(RefillerTest, sends_a_dwell_of_hours_to_a_board_with_few_places) {
  Street street({line(0, 10, 80), Action{.kind = Action::Kind::dwell, .dwell = Seconds(7200)}, line(10, 20, 80)}, 16);
  EXPECT_EQ(play(street), Feed::Progress::ended);
  EXPECT_FALSE(street.board.error());
  EXPECT_EQ(street.board.steps(), 2000);
  EXPECT_NEAR(street.board.ticks() / 1e6, 7205, 5);
}

TEST_P(RefillerTest, says_so_where_a_board_has_too_few_places_at_any_speed) {
  Street street({line(0, 10, 80)}, 2);
  EXPECT_EQ(play(street), Feed::Progress::ended);
  EXPECT_EQ(street.board.error(), LinkError::too_few_places);
}

TEST_P(RefillerTest, rests_in_a_hold_and_goes_on) {
  Street street({line(0, 60, 40)}, 31);
  const auto hold = [&](int turn) {
    if (turn == 40) street.planner.hold();
  };
  ASSERT_EQ(play(street, hold), Feed::Progress::rests_in_hold);
  EXPECT_FALSE(street.board.busy());
  EXPECT_GT(street.board.steps(), 100);
  EXPECT_LT(street.board.steps(), 5900);
  street.planner.resume();
  EXPECT_EQ(play(street), Feed::Progress::ended);
  EXPECT_EQ(street.board.steps(), 6000);
  EXPECT_EQ(street.ledger().recoveries(), 0);
}

INSTANTIATE_TEST_SUITE_P(Jerk, RefillerTest, testing::Values(0.0, 25'000.0));

}  // namespace
}  // namespace passo
