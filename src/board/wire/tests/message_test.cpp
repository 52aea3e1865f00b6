#include "passo/wire/message.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "random_messages.hpp"

#include "passo/wire/decoder.hpp"

namespace passo {
namespace {

// Carries a frame over the wire: returns the frame as the other side has it.
WireFrame carried(const std::uint8_t* frame, std::uint8_t size, std::uint8_t motors = 0) {
  Decoder decoder;
  decoder.set_motors(motors);
  for (std::uint8_t i = 0; i + 1 < size; ++i) EXPECT_EQ(decoder.feed(frame[i]), Decoded::pending);
  EXPECT_EQ(decoder.feed(frame[size - 1]), Decoded::frame);
  return decoder.frame();
}

TEST(Message, a_segment_keeps_every_field_for_every_number_of_motors) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  RandomMessages random(seed);
  for (int i = 0; i < 8000; ++i) {
    const auto motors = static_cast<std::uint8_t>(1 + i % max_motors);
    const BoardSegment sent = random.segment(motors);
    std::uint8_t frame[largest_frame];
    BoardSegment received;
    decode(carried(frame, encode(sent, motors, static_cast<std::uint8_t>(i), frame), motors), motors, received);
    ASSERT_EQ(received.events, sent.events);
    ASSERT_EQ(received.directions, sent.directions);
    ASSERT_EQ(received.flips, sent.flips);
    ASSERT_EQ(received.form, sent.form);
    ASSERT_EQ(received.bend, sent.bend);
    ASSERT_EQ(received.interval, sent.interval);
    ASSERT_EQ(received.change, sent.change);
    for (unsigned m = 0; m < max_motors; ++m) ASSERT_EQ(received.increments[m], sent.increments[m]);
  }
}

TEST(Message, a_change_keeps_its_sign_at_both_ends_of_its_range) {
  for (const std::int32_t change : {0, 1, -1, fine_change, -fine_change, fine_change + 1, -fine_change - 1,
                                    largest_change, -largest_change, 0xA5A5, -0x5A5A5B, -0x5A5A5B00}) {
    std::uint8_t frame[largest_frame];
    BoardSegment received;
    decode(carried(frame, encode(BoardSegment{.events = 1, .change = change}, 1, 0, frame), 1), 1, received);
    EXPECT_EQ(received.change, change);
  }
}

TEST(Message, all_others_keep_every_field_too) {
  std::uint8_t frame[largest_frame];
  Hello hello;
  decode(carried(frame, encode(Hello{.version = 7, .motors = 0xA5}, 1, frame)), hello);
  EXPECT_EQ(hello.version, 7);
  EXPECT_EQ(hello.motors, 0xA5);

  BoardOutputs outputs;
  decode(carried(frame, encode(BoardOutputs{.switches = 0x0F, .spindle_rpm = 0xA5A4}, 2, frame)), outputs);
  EXPECT_EQ(outputs.switches, 0x0F);
  EXPECT_EQ(outputs.spindle_rpm, 0xA5A4);

  HelloReply reply;
  const HelloReply board{.version = 1, .motors = 4, .capacity = 32, .clock = 0xF4240A5};
  decode(carried(frame, encode(board, 3, frame)), reply);
  EXPECT_EQ(reply.version, 1);
  EXPECT_EQ(reply.motors, 4);
  EXPECT_EQ(reply.capacity, 32);
  EXPECT_EQ(reply.clock, 0xF4240A5U);

  Credit credit;
  decode(carried(frame, encode(Credit{.executed = 0x12A5, .taken = 0xA6, .free = 31}, 4, frame)), credit);
  EXPECT_EQ(credit.executed, 0x12A5);
  EXPECT_EQ(credit.taken, 0xA6);
  EXPECT_EQ(credit.free, 31);

  ErrorReport error;
  const ErrorReport sent{.reason = WireError::out_of_sequence, .expected = 0xA5};
  decode(carried(frame, encode(sent, 5, frame)), error);
  EXPECT_EQ(error.reason, WireError::out_of_sequence);
  EXPECT_EQ(error.expected, 0xA5);
}

TEST(Message, what_version_2_brings_keeps_every_field) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  RandomMessages random(seed);
  for (int i = 0; i < 2000; ++i) {
    std::uint8_t frame[largest_frame];
    const auto motors = static_cast<std::uint8_t>(1 + i % max_motors);
    const BoardStatus status = random.status();
    BoardStatus heard;
    decode(carried(frame, encode(status, motors, 1, frame), motors), motors, heard);
    ASSERT_EQ(std::tie(heard.session, heard.executed, heard.taken, heard.free, heard.event, heard.state),
              std::tie(status.session, status.executed, status.taken, status.free, status.event, status.state));
    ASSERT_EQ(std::tie(heard.reset, heard.motors, heard.inputs, heard.answers),
              std::tie(status.reset, status.motors, status.inputs, status.answers));
    for (unsigned m = 0; m < max_motors; ++m) ASSERT_EQ(heard.positions[m], m < motors ? status.positions[m] : 0);

    const Captured captured = random.captured();
    Captured seen;
    decode(carried(frame, encode(captured, motors, 2, frame), motors), motors, seen);
    ASSERT_EQ(std::tie(seen.input, seen.item, seen.event), std::tie(captured.input, captured.item, captured.event));
    for (unsigned m = 0; m < max_motors; ++m) ASSERT_EQ(seen.positions[m], m < motors ? captured.positions[m] : 0);

    const About about = random.about();
    About read;
    decode(carried(frame, encode(about, 3, frame)), read);
    ASSERT_EQ(std::tie(read.firmware, read.highest_event_rate, read.baud),
              std::tie(about.firmware, about.highest_event_rate, about.baud));
    ASSERT_TRUE(std::equal(std::begin(about.name), std::end(about.name), std::begin(read.name)));

    const Replace replace = random.replace();
    Replace told;
    decode(carried(frame, encode(replace, 4, frame)), told);
    ASSERT_EQ(std::tie(told.after, told.count), std::tie(replace.after, replace.count));
    ASSERT_EQ(std::tie(told.sums.first, told.sums.second), std::tie(replace.sums.first, replace.sums.second));

    const Fault fault{
        .reason = FaultReason::limit, .inputs = random.word(), .event = random.byte(), .executed = random.word()};
    Fault known;
    decode(carried(frame, encode(fault, 5, frame)), known);
    ASSERT_EQ(std::tie(known.reason, known.inputs, known.event, known.executed),
              std::tie(fault.reason, fault.inputs, fault.event, fault.executed));

    Session session;
    decode(carried(frame, encode(Session{.number = replace.after}, 6, frame)), session);
    ASSERT_EQ(session.number, replace.after);
    Ask ask;
    decode(carried(frame, encode(Ask{.motors = motors, .question = Question::about}, 7, frame)), ask);
    ASSERT_EQ(std::tie(ask.version, ask.motors), std::tie(protocol_version, motors));
    ASSERT_EQ(ask.question, Question::about);
  }
}

TEST(Message, what_version_5_brings_keeps_every_field) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  RandomMessages random(seed);
  for (int i = 0; i < 2000; ++i) {
    std::uint8_t frame[largest_frame];
    const Turned sent = random.turned();
    Turned heard;
    decode(carried(frame, encode(sent, 1, frame)), heard);
    ASSERT_EQ(std::tie(heard.progress.executed, heard.progress.taken, heard.progress.free, heard.event, heard.answers),
              std::tie(sent.progress.executed, sent.progress.taken, sent.progress.free, sent.event, sent.answers));
    ASSERT_EQ(std::tie(heard.spindle.count, heard.spindle.tick, heard.spindle.at_index, heard.spindle.indexes),
              std::tie(sent.spindle.count, sent.spindle.tick, sent.spindle.at_index, sent.spindle.indexes));
  }
}

TEST(Message, carries_its_sequence_number_even_where_that_is_a_sync_byte) {
  std::uint8_t frame[largest_frame];
  EXPECT_EQ(carried(frame, encode(Credit(), 0xA5, frame)).sequence, 0xA5);
}

}  // namespace
}  // namespace passo
