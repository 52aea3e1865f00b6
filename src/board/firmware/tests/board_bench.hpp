// A test bench: a board with four queue places, and a log instead of motors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passo/firmware/board.hpp"
#include "passo/wire/announcement.hpp"

namespace passo {

// Logs what the board does, with the ticks since the start.
struct Bench {
  void step(std::uint8_t stepped, std::uint8_t directions) {
    log.push_back(std::to_string(now) + " step " + std::to_string(stepped) + " down " + std::to_string(directions));
  }
  void outputs(const BoardOutputs& outputs) {
    log.push_back(std::to_string(now) + " outputs " + std::to_string(outputs.switches) + " rpm " +
                  std::to_string(outputs.spindle_rpm));
    on = outputs.switches;
  }
  bool switch_off(std::uint8_t switches) {
    const unsigned was_on = on & switches;
    on &= ~unsigned{switches};
    if (was_on != 0) log.push_back(std::to_string(now) + " off " + std::to_string(was_on));
    return was_on != 0;
  }
  void send(std::uint8_t byte) {
    if (decoder.feed(byte) == Decoded::frame) replies.push_back(decoder.frame());
  }

  std::int64_t now = 0;
  unsigned on = 0;  // the outputs
  std::vector<std::string> log;
  Decoder decoder;
  std::vector<WireFrame> replies;
};

inline constexpr std::size_t capacity = 4;

// Sends a message to the board, as its host does.
template <class SomeBoard, class... What>
void send_to(SomeBoard& board, const What&... what) {
  std::uint8_t frame[largest_frame];
  const std::uint8_t size = encode(what..., frame);
  for (std::uint8_t i = 0; i < size; ++i) board.receive(frame[i]);
}

// A board on a bench of any kind.
template <class SomeBench>
class BoardOn : public testing::Test {
 protected:
  template <class... What>
  void send(const What&... what) {
    send_to(board_, what...);
  }
  // Returns the frame that answers the question of that number.
  WireFrame answer_to(Question question, std::uint8_t number) {
    bench_.replies.clear();
    send(Ask{.motors = 3, .question = question}, number);
    EXPECT_EQ(bench_.replies.size(), 1U);
    return bench_.replies.empty() ? WireFrame() : bench_.replies.back();
  }

  SomeBench bench_;
  Board<SomeBench, capacity> board_{
      bench_,
      {.motors = 4, .clock = 16'000'000, .about = {.highest_event_rate = 100'000, .baud = 500'000, .name = "bench"}}};
};

class BoardTest : public BoardOn<Bench> {
 protected:
  void send_bytes(const std::uint8_t* frame, std::uint8_t size) {
    for (std::uint8_t i = 0; i < size; ++i) board_.receive(frame[i]);
  }
  void greet(std::uint8_t sequence = 0) {
    send(Hello{.motors = 3}, sequence);
    bench_.replies.clear();
  }
  static BoardSegment segment_of(std::uint8_t events, std::uint32_t ticks) {
    return {.events = events, .flips = 1, .interval = ticks << 16};
  }
  void send_segment(std::uint8_t sequence, std::uint8_t events = 1, std::uint32_t ticks = 10) {
    send(segment_of(events, ticks), std::uint8_t{3}, sequence);
  }
  void event() {
    bench_.now += board_.ticks_to_next_event();
    board_.on_event();
  }
  void play_to_the_end() {
    while (!board_.idle()) event();
  }
  ErrorReport last_error() {
    ErrorReport error;
    EXPECT_FALSE(bench_.replies.empty());
    if (bench_.replies.empty()) return error;
    EXPECT_EQ(bench_.replies.back().type, MessageType::error);
    decode(bench_.replies.back(), error);
    return error;
  }
  Credit last_credit() {
    Credit credit;
    EXPECT_FALSE(bench_.replies.empty());
    if (bench_.replies.empty()) return credit;
    EXPECT_EQ(bench_.replies.back().type, MessageType::credit);
    decode(bench_.replies.back(), credit);
    return credit;
  }
};

}  // namespace passo
