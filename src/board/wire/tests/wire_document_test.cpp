// The example session of docs/wire.md is the wire's golden trace. Other bytes mean that the protocol has changed.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "passo/wire/announcement.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

std::string hex(const std::uint8_t* frame, std::uint8_t size) {
  std::string text;
  for (std::uint8_t i = 0; i < size; ++i) {
    static constexpr char digits[] = "0123456789ABCDEF";
    if (i != 0) text += ' ';
    text += digits[frame[i] >> 4];
    text += digits[frame[i] & 15];
  }
  return text;
}

std::vector<std::string> example_session() {
  std::vector<std::string> lines;
  std::uint8_t frame[largest_frame];
  const auto line = [&](std::uint8_t size) { lines.push_back(hex(frame, size)); };
  const PinSetup setup{.inputs = input_limit | input_emergency_stop,
                       .outputs = inverted_enable,
                       .drivers_rest = 200,
                       .timing = {.pulse = 40, .set_up = 11, .hold = 11, .event_ticks = 160},
                       .alarms = input_start,
                       .filter = 100};
  line(encode(setup, 0, frame));
  PinSetup has = setup;
  has.timing = {.pulse = 41, .set_up = 44, .hold = 63, .event_ticks = 129};
  line(encode(has, 0, frame));
  line(encode(Hello{.motors = 2}, 0, frame));
  line(encode(HelloReply{.motors = 4, .capacity = 32, .clock = 16'000'000}, 0, frame));
  line(encode(Session{.number = 0x1234, .silence = {.spindle = 20, .mist = 20, .flood = 20}}, 0, frame));
  line(encode(Ask{.motors = 2, .question = Question::about}, 0, frame));
  line(encode(
      About{.firmware = 101, .highest_event_rate = 140'000, .baud = 1'000'000, .name = "uno cnc3", .step_pulse = 19}, 1,
      frame));
  line(encode(BoardOutputs{.switches = spindle_on | flood_on, .spindle_rpm = 12000}, 1, frame));
  line(encode(Credit{.executed = 1, .taken = 1, .free = 32}, 2, frame));
  // After item 1 come 300 events: the first after 160.5 ticks, each next one a 256th of a tick sooner. X goes down at
  // every event, Y goes up at 0x4BA5/65536 of them. Then a tail brings both to rest.
  const BoardSegment segment{
      .events = 300, .directions = 1, .flips = 1, .interval = 0x00A08000, .change = -256, .increments = {0, 0x4BA5}};
  const BoardSegment tail{
      .events = 50, .directions = 1, .flips = 1, .interval = 0x009FB800, .change = 0x40000, .increments = {0, 0x4BA5}};
  Announcement announcement(2, 1, 2);
  announcement.add(frame, encode(segment, 2, 3, frame));
  announcement.add(frame, encode(tail, 2, 4, frame));
  line(encode(announcement.replace(), 2, frame));
  line(encode(segment, 2, 3, frame));
  line(encode(tail, 2, 4, frame));
  line(encode(Credit{.executed = 1, .taken = 4, .free = 30}, 3, frame));
  line(encode(ErrorReport{.reason = WireError::out_of_sequence, .expected = 5}, 4, frame));
  line(encode(Credit{.executed = 3, .taken = 4, .free = 31}, 5, frame));
  line(encode(Credit{.executed = 4, .taken = 4, .free = 32}, 6, frame));
  line(encode(Ask{.motors = 2}, 1, frame));
  const BoardStatus status{.session = 0x1234,
                           .executed = 4,
                           .taken = 4,
                           .free = 32,
                           .state = board_trusted,
                           .motors = 2,
                           .inputs = input_probe,
                           .answers = 1,
                           .positions = {-350, 103}};
  line(encode(status, 2, 7, frame));
  // 41,300 counts, 340 of them after the tenth index; at rest.
  line(encode(Ask{.motors = 2, .question = Question::spindle}, 2, frame));
  const Turned turned{.progress = {.executed = 4, .taken = 4, .free = 32},
                      .answers = 2,
                      .spindle = {.count = 41'300, .tick = 30'000'000, .at_index = 40'960, .indexes = 10}};
  line(encode(turned, 8, frame));
  return lines;
}

TEST(WireDocument, shows_the_bytes_that_the_encoder_writes) {
  std::ifstream file(PASSO_SOURCE_DIR "/docs/wire.md");
  std::stringstream text;
  text << file.rdbuf();
  std::size_t from = 0;
  for (const std::string& line : example_session()) {
    const std::size_t at = text.str().find("  " + line + "\n", from);
    EXPECT_NE(at, std::string::npos) << "docs/wire.md lacks, or has not in this order:\n" << line;
    if (at != std::string::npos) from = at;
  }
}

}  // namespace
}  // namespace passo
