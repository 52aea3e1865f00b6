// Whatever comes over its line, the emulated board moves by no more than what valid frames say, finds the next valid
// frame, and does not start anew.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "emulator/streamed_run.hpp"
#include "kit/frames_in.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_frame(std::mt19937_64& random, std::uint8_t motors) {
  std::uint8_t frame[largest_frame];
  const auto number = static_cast<std::uint8_t>(random());
  std::uint8_t size = 0;
  switch (random() % 4) {
    case 0: size = encode(Hello{.motors = motors}, number, frame); break;
    case 1: size = encode(BoardSegment{.events = 200, .flips = 7, .interval = 200 << 16}, motors, number, frame); break;
    case 2: size = encode(Replace{.after = number, .count = 3}, number, frame); break;
    default: size = encode(BoardOutputs{.switches = 15, .spindle_rpm = 9'000}, number, frame); break;
  }
  return {frame, frame + size};
}

// Random bytes, bytes that look like the start of a frame, and frames cut short, with a byte lost, doubled or wrong.
Bytes garbage(std::mt19937_64& random, std::uint8_t motors) {
  if (random() % 3 == 0) {
    Bytes bytes(1 + random() % 200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4 == 0 ? sync_byte : random());
    return bytes;
  }
  Bytes frame = random_frame(random, motors);
  const auto at = static_cast<std::ptrdiff_t>(random() % frame.size());
  const auto bit = static_cast<std::uint8_t>(1U << (random() % 8));
  switch (random() % 4) {
    case 0: frame.resize(static_cast<std::size_t>(at)); break;
    case 1: frame.erase(frame.begin() + at); break;
    case 2:
      frame.insert(frame.begin() + at, static_cast<std::uint8_t>(frame[static_cast<std::size_t>(at)] ^ bit));
      break;
    default: frame[static_cast<std::size_t>(at)] ^= bit; break;
  }
  return frame;
}

class Noise {
 public:
  explicit Noise(const BoardUnderTest& board)
      : motors_(static_cast<std::uint8_t>(board.motors.size())), bench_(board), random_(test::seed()) {
    bench_.start({});
  }

  // A burst of garbage, then a question, which is answered.
  void burst() {
    Bytes bytes;
    const std::size_t size = 50 + random_() % 400;
    while (bytes.size() < size) {
      const Bytes more = garbage(random_, motors_);
      bytes.insert(bytes.end(), more.begin(), more.end());
    }
    std::uint8_t question[largest_frame];
    const std::uint8_t length = encode(Ask{.motors = motors_}, 0, question);
    if (!leaves_one_frame(bytes, {question, length})) return;
    bench_.ports().forget_changes();
    bench_.uart().send(bytes);
    bench_.ask();
    bench_.run((bytes.size() + 100) * 320 + 50'000);
    ASSERT_TRUE(bench_.status().has_value()) << "it has not found the question behind the garbage";
    EXPECT_EQ(bench_.status()->reset, ResetCause::power_on) << "the watchdog has fired";
    EXPECT_TRUE(bench_.ports().changes().empty()) << "nothing of that was a frame";
    bytes_ += bytes.size();
    ++bursts_;
  }
  // A motion with garbage between its frames.
  void motion() {
    const StreamKind kind{.shortest_interval = 400, .longest_interval = 500, .shortest_segment = 100, .segments = 12};
    const std::vector<BoardSegment> stream = random_stream(random_, motors_, kind);
    bench_.before_item = [this](std::span<const std::uint8_t> frame) {
      Bytes bytes = garbage(random_, motors_);
      bytes.resize(std::min<std::size_t>(bytes.size(), 40));
      if (!leaves_one_frame(bytes, frame)) return;
      bench_.uart().send(bytes);
      bytes_ += bytes.size();
    };
    const EdgeCheck check = bench_.play(stream);
    bench_.before_item = nullptr;
    EXPECT_TRUE(check.exact()) << check.steps << " of " << check.expected << " steps, " << check.complaints
                               << " complaints"
                               << (bench_.error()
                                       ? ", the last one " + std::to_string(static_cast<int>(bench_.error()->reason))
                                       : "");
    EXPECT_LE(check.error, 4);
    EXPECT_EQ(check.overruns, 0U);
    ++motions_;
  }
  void report() const {
    std::printf("%zu bytes of garbage, %d bursts, %d motions amid them\n", bytes_, bursts_, motions_);
  }

 private:
  // Garbage may be a whole frame by itself, one of 65,536 that look like one; or together with its neighbours: with the
  // last byte of the frame before it in the place of a sync byte that was lost, with the first two of the next frame in
  // the place of its CRC.
  bool leaves_one_frame(const Bytes& garbage, std::span<const std::uint8_t> frame) const {
    Bytes bytes = {bench_.last_byte()};
    bytes.insert(bytes.end(), garbage.begin(), garbage.end());
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    return test::frames_in(bytes, motors_) == 1;
  }

  std::uint8_t motors_;
  BoardBench bench_;
  std::mt19937_64 random_;
  std::size_t bytes_ = 0;
  int bursts_ = 0;
  int motions_ = 0;
};

void expect_no_harm(const BoardUnderTest& board) {
  const char* const runs = std::getenv("PASSO_RUNS");
  const int rounds = runs == nullptr ? 6 : std::atoi(runs);
  Noise noise(board);
  for (int round = 0; round < rounds && !testing::Test::HasFailure(); ++round) {
    for (int i = 0; i < 10 && !testing::Test::HasFatalFailure(); ++i) noise.burst();
    noise.motion();
  }
  noise.report();
}

// More questions than there is room for answers, and answers longer than what the board says otherwise, because they
// tell of more motors than it has: what it says is whole frames, and afterwards it answers as ever.
//
// A Mega takes some 3,700 cycles for such a question, and the line brings one in 2,880. The 900 bytes of a hundred are
// more than the 256 that it can keep, and no host has so many under way (decision 0126). So its memory for received
// bytes overflows once, and it complains once. The UART itself loses nothing.
void expect_whole_answers(const BoardUnderTest& board, int most_complaints) {
  BoardBench bench(board);
  bench.start({});
  int answers = 0;
  int complaints = 0;
  int refused = 0;
  Decoder decoder;
  decoder.set_motors(max_motors);
  bench.uart().on_byte = [&](std::uint8_t byte) {
    const Decoded told = decoder.feed(byte);
    refused += told == Decoded::refused ? 1 : 0;
    if (told != Decoded::frame) return;
    if (decoder.frame().type == MessageType::error) {
      ++complaints;
      return;
    }
    BoardStatus status;
    decode(decoder.frame(), max_motors, status);
    EXPECT_EQ(decoder.frame().type, MessageType::status);
    ++answers;
  };
  constexpr int questions = 100;
  const auto ask = [&bench](int number) {
    std::uint8_t frame[largest_frame];
    bench.uart().send({frame, encode(Ask{.motors = max_motors}, static_cast<std::uint8_t>(number), frame)});
  };
  for (int i = 0; i < questions; ++i) ask(i);
  bench.run((questions + 10) * 10 * 320 + 100'000);
  EXPECT_EQ(refused, 0);
  // A third of what the line could carry: a question has 9 bytes, its answer 52.
  EXPECT_GE(answers, questions * 9 / 52 / 3);
  EXPECT_LT(answers, questions);
  for (int i = 0; i < 5; ++i) {
    const int before = answers;
    ask(i);
    bench.run(100'000);
    EXPECT_EQ(answers, before + 1);
  }
  EXPECT_EQ(refused, 0);
  EXPECT_LE(complaints, most_complaints);
  EXPECT_EQ(bench.uart().overruns(), 0U);
}

TEST(UnoNoise, answers_a_flood_of_questions_with_whole_frames) {
  expect_whole_answers(uno_under_test(PASSO_MOTION_UNO), 0);
}
TEST(MegaNoise, answers_a_flood_of_questions_with_whole_frames) {
  expect_whole_answers(mega_under_test(PASSO_MOTION_MEGA, 4), 1);
}

TEST(UnoNoise, moves_nothing_and_is_forgotten_with_the_next_frame) {
  expect_no_harm(uno_under_test(PASSO_MOTION_UNO));
}
TEST(MegaNoise, moves_nothing_and_is_forgotten_with_the_next_frame) {
  expect_no_harm(mega_under_test(PASSO_MOTION_MEGA, 4));
}

}  // namespace
}  // namespace passo
