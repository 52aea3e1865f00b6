// Peers that talk and are no board: the session ends with a message, in twice its patience.
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "passo/link/await.hpp"
#include "passo/wire/decoder.hpp"

namespace passo {
namespace {

constexpr LinkTimeouts care{.answer_within = Seconds(0.1), .patience = Seconds(5)};

// A port whose time goes on by a hundredth of a second with each wait and a little with each frame, and a peer that is
// told and asked in between.
class PeerPort final : public BoardPort {
 public:
  using Bytes = std::vector<std::uint8_t>;
  std::function<void(const WireFrame&, Bytes&)> on_frame;  // the peer's answer
  std::function<void(Bytes&)> talk;                        // what the peer says by itself
  bool echoes = false;

  void receive(std::span<const std::uint8_t> bytes) override {
    time_ += Seconds(1e-3);  // a line has its speed
    if (echoes) said_.insert(said_.end(), bytes.begin(), bytes.end());
    for (const std::uint8_t byte : bytes) {
      if (decoder_.feed(byte) != Decoded::frame) continue;
      if (decoder_.frame().type == MessageType::hello) decoder_.set_motors(decoder_.frame().payload[1]);
      if (on_frame) on_frame(decoder_.frame(), said_);
    }
  }
  bool run(Seconds most) override {
    time_ += std::min(most, Seconds(0.01));
    if (talk) talk(said_);
    return !said_.empty();
  }
  std::span<const std::uint8_t> replies() override {
    taken_ = std::exchange(said_, {});
    return taken_;
  }
  Seconds elapsed() const override { return time_; }

 private:
  Seconds time_{0};
  Decoder decoder_;
  Bytes said_;
  Bytes taken_;
};

template <class... What>
void put(PeerPort::Bytes& bytes, const What&... what) {
  std::uint8_t frame[largest_frame];
  bytes.insert(bytes.end(), frame, frame + encode(what..., frame));
}

// Greets and sends as far as the peer lets it. Returns how long until the error.
Seconds time_to_error(PeerPort& port, BoardSession& session) {
  const Seconds begin = port.elapsed();
  greet(session, {.motors = 3, .session = 7});
  const std::vector<LinkItem> items{BoardSegment{.events = 1, .interval = 100U << 16}};
  if (!session.error()) session.replace(session.executed(), items);
  drain(session);
  return port.elapsed() - begin;
}

// Answers as a board does up to the end of the greeting, and tells afterwards what `status_of` makes of the answer.
void answer_like_a_board(PeerPort& port, const std::function<void(BoardStatus&)>& forge) {
  port.on_frame = [forge, last = std::uint8_t{0}](const WireFrame& frame, PeerPort::Bytes& bytes) mutable {
    if (frame.type == MessageType::hello) {
      last = frame.sequence;
      put(bytes, HelloReply{.motors = 3, .capacity = 30, .clock = 16'000'000}, std::uint8_t{0});
    } else if (frame.type == MessageType::ask) {
      BoardStatus status{.session = 7,
                         .executed = last,
                         .taken = last,
                         .free = 30,
                         .state = board_trusted,
                         .motors = 3,
                         .answers = frame.sequence};
      forge(status);
      put(bytes, status, frame.payload[1], std::uint8_t{0});
    }
  };
}

TEST(StubbornPeer, that_talks_at_random_is_given_up) {
  PeerPort port;
  std::mt19937 random(1);
  port.talk = [&](PeerPort::Bytes& bytes) {
    for (int i = 0; i < 20; ++i) bytes.push_back(static_cast<std::uint8_t>(random()));
  };
  BoardSession session(port, care);
  EXPECT_LE(time_to_error(port, session), 2 * care.patience + Seconds(0.2));
  EXPECT_TRUE(session.error());
}

TEST(StubbornPeer, that_returns_what_it_hears_is_given_up) {
  PeerPort port;
  port.echoes = true;
  BoardSession session(port, care);
  EXPECT_LE(time_to_error(port, session), 2 * care.patience + Seconds(0.2));
  EXPECT_EQ(session.error(), LinkError::no_progress);
}

TEST(StubbornPeer, that_says_whole_frames_that_answer_nothing_is_given_up) {
  for (const bool greets : {false, true}) {
    SCOPED_TRACE(greets);
    PeerPort port;
    if (greets) answer_like_a_board(port, [](BoardStatus&) {});
    port.talk = [](PeerPort::Bytes& bytes) {
      put(bytes, Credit{.executed = 0, .taken = 0, .free = 30}, std::uint8_t{0});
      put(bytes, ErrorReport{.reason = WireError::out_of_sequence, .expected = 1}, std::uint8_t{0});
    };
    BoardSession session(port, care);
    EXPECT_LE(time_to_error(port, session), 2 * care.patience + Seconds(0.2));
    EXPECT_EQ(session.error(), LinkError::no_progress);
  }
}

TEST(StubbornPeer, that_tells_of_more_than_was_sent_or_of_nothing_done_is_given_up) {
  const std::function<void(BoardStatus&)> forgeries[] = {
      [](BoardStatus& status) { status.taken = 99; },
      [](BoardStatus& status) { status.executed = 99; },
      [](BoardStatus& status) { status.executed = status.taken = 99; },
      [](BoardStatus& status) { status.free = 200; },
      [](BoardStatus& status) { status.taken = static_cast<std::uint8_t>(status.taken + 2); },
      [](BoardStatus& status) { status.state |= board_moves; },
  };
  for (const auto& forge : forgeries) {
    PeerPort port;
    bool greeted = false;
    answer_like_a_board(port, [&](BoardStatus& status) {
      if (greeted) forge(status);
    });
    BoardSession session(port, care);
    ASSERT_TRUE(greet(session, {.motors = 3, .session = 7}));
    greeted = true;
    const std::vector<LinkItem> items{BoardSegment{.events = 1, .interval = 100U << 16}};
    session.replace(session.executed(), items);
    const Seconds begin = port.elapsed();
    drain(session);
    EXPECT_TRUE(session.error());
    EXPECT_LE(port.elapsed() - begin, 2 * care.patience + Seconds(0.2));
  }
}

TEST(StubbornPeer, that_never_answers_a_question_is_given_up) {
  PeerPort port;
  answer_like_a_board(port, [](BoardStatus&) {});
  BoardSession session(port, care);
  ASSERT_TRUE(greet(session, {.motors = 3, .session = 7}));
  const Seconds begin = port.elapsed();
  session.recall_contact();
  await(session, [&] { return session.settled(); });
  EXPECT_EQ(session.error(), LinkError::no_progress);
  EXPECT_LE(port.elapsed() - begin, 2 * care.patience + Seconds(0.2));
}

// It answers each question, and never rests: another host drives it, or it only says so.
TEST(StubbornPeer, that_moves_for_ever_is_not_waited_for_for_ever) {
  PeerPort port;
  std::uint16_t executed = 0;
  answer_like_a_board(port, [&](BoardStatus& status) {
    status.state |= board_moves;
    status.executed = ++executed;
  });
  BoardSession session(port, care);
  const Seconds begin = port.elapsed();
  EXPECT_FALSE(ask_status_at_rest(session, Seconds(2)));
  EXPECT_GE(port.elapsed() - begin, longest_way_to_rest);
  EXPECT_LE(port.elapsed() - begin, longest_way_to_rest + Seconds(2.1));
  ASSERT_TRUE(session.status()) << "by which the caller knows why";
  EXPECT_NE(session.status()->state & board_moves, 0);
}

// It rests each time at another place.
TEST(StubbornPeer, that_rests_at_no_place_twice_is_not_waited_for_for_ever) {
  PeerPort port;
  std::uint16_t executed = 0;
  answer_like_a_board(port, [&](BoardStatus& status) { status.executed = ++executed; });
  BoardSession session(port, care);
  EXPECT_FALSE(ask_status_at_rest(session, Seconds(2)));
  EXPECT_LE(port.elapsed(), longest_way_to_rest + Seconds(2.1));
}

// The hello and its answer keep their form in all versions; a question of another version is not understood.
TEST(StubbornPeer, of_another_version_is_refused_by_the_answer_to_the_hello) {
  for (const std::uint8_t version :
       {std::uint8_t{0}, std::uint8_t{protocol_version - 1}, std::uint8_t{protocol_version + 1}, std::uint8_t{255}}) {
    SCOPED_TRACE(int{version});
    PeerPort port;
    port.on_frame = [&](const WireFrame& frame, PeerPort::Bytes& bytes) {
      if (frame.type == MessageType::hello) {
        put(bytes, HelloReply{.version = version, .motors = 3, .capacity = 30, .clock = 16'000'000}, std::uint8_t{0});
      } else {
        put(bytes, ErrorReport{.reason = WireError::bad_value, .expected = 1}, std::uint8_t{0});
      }
    };
    BoardSession session(port, care);
    EXPECT_FALSE(ask_status(session, Seconds(4)));
    EXPECT_LE(port.elapsed(), Seconds(4.1));
    const Seconds begin = port.elapsed();
    EXPECT_FALSE(greet(session, {.motors = 3, .session = 7}));
    EXPECT_EQ(session.error(), LinkError::wrong_version);
    EXPECT_LE(port.elapsed() - begin, Seconds(0.2));
  }
}

// A man in the middle says that more was taken than was sent, by every message that can say so.
TEST(StubbornPeer, that_forges_what_was_taken_ends_in_its_time) {
  for (unsigned ahead = 1; ahead < 256; ahead += 3) {
    SCOPED_TRACE(ahead);
    PeerPort port;
    answer_like_a_board(port, [](BoardStatus&) {});
    BoardSession session(port, care);
    ASSERT_TRUE(greet(session, {.motors = 3, .session = 7}));
    const auto forged = static_cast<std::uint8_t>(session.sent() + 2 + ahead);
    port.talk = [&](PeerPort::Bytes& bytes) {
      put(bytes, Credit{.executed = forged, .taken = forged, .free = 30}, std::uint8_t{0});
      put(bytes, ErrorReport{.reason = WireError::out_of_sequence, .expected = forged}, std::uint8_t{0});
    };
    const std::vector<LinkItem> items{BoardSegment{.events = 1, .interval = 100U << 16}};
    session.replace(session.executed(), items);
    const Seconds begin = port.elapsed();
    drain(session);
    EXPECT_TRUE(session.error());
    EXPECT_LE(port.elapsed() - begin, 2 * care.patience + Seconds(0.2));
  }
}

}  // namespace
}  // namespace passo
