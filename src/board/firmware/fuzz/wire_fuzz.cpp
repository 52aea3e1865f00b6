// Any bytes off the wire: the board loses no place for items, turns no motor that does not exist, and comes to rest.
// The first byte of the input chooses: the bytes are either raw, or contents of frames that get a correct CRC, so that
// the board accepts them.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "passo/firmware/board.hpp"
#include "passo/wire/announcement.hpp"
#include "passo/wire/decoder.hpp"

namespace passo {
namespace {

constexpr std::uint8_t motors = 3;
constexpr std::uint8_t places = 16;

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

// Receives the board's answer about its free places.
struct Host {
  void step(std::uint8_t stepped, std::uint8_t) { require(stepped >> motors == 0, "a motor that is not there"); }
  void outputs(const BoardOutputs&) {}
  void send(std::uint8_t byte) {
    if (decoder.feed(byte) != Decoded::frame || decoder.frame().type != MessageType::credit) return;
    Credit credit;
    decode(decoder.frame(), credit);
    free = credit.free;
  }
  Decoder decoder;
  std::uint8_t free = 0;
};

class Bench {
 public:
  void take(std::uint8_t byte) {
    board_.receive(byte);
    if (board_.owes_report()) board_.report();
    // Time passes while bytes come.
    if (byte % 4 == 0) play(byte);
  }
  void come_to_rest() {
    play(most_events);
    require(board_.idle(), "does not come to rest");
    // A replacement that was begun but never completed keeps its places until the next one begins, or a hello.
    std::uint8_t frame[largest_frame];
    const std::uint8_t size = encode(Hello{.motors = motors}, 0, frame);
    for (std::uint8_t i = 0; i < size; ++i) board_.receive(frame[i]);
    host_.decoder = Decoder();
    board_.report();
    require(host_.free == places, "places are lost");
  }

 private:
  static constexpr unsigned most_events = 65535U * places + 1;

  void play(unsigned events) {
    for (unsigned i = 0; i < events && !board_.idle(); ++i) {
      static_cast<void>(board_.ticks_to_next_event());
      board_.on_event();
      if (board_.owes_report()) board_.report();
    }
  }

  Host host_;
  Board<Host, places> board_{host_, {.motors = motors, .clock = 16'000'000}};
};

void check_bytes(const std::uint8_t* data, std::size_t size) {
  Bench bench;
  for (std::size_t i = 0; i < size; ++i) bench.take(data[i]);
  bench.come_to_rest();
}

std::vector<WireFrame> frames_in(const std::uint8_t* data, std::size_t size) {
  std::vector<WireFrame> frames;
  for (std::size_t at = 0; at + 2 <= size;) {
    WireFrame frame{.type = static_cast<MessageType>(data[at]), .sequence = data[at + 1], .payload = {}};
    const std::uint8_t payload = payload_size(data[at], motors);
    at += 2;
    if (payload == 0 || at + payload > size) continue;
    std::copy_n(data + at, payload, frame.payload);
    at += payload;
    frames.push_back(frame);
  }
  return frames;
}

std::uint8_t bytes_of(const WireFrame& frame, std::uint8_t* bytes) {
  Encoder encoder(bytes, frame.type, frame.sequence);
  const std::uint8_t payload = payload_size(static_cast<std::uint8_t>(frame.type), motors);
  for (std::uint8_t i = 0; i < payload; ++i) encoder.put8(frame.payload[i]);
  return encoder.finish();
}

// Gives the replace the right sums for what follows it. With random sums hardly anything would be replaced.
WireFrame announced(const std::vector<WireFrame>& frames, std::size_t at, std::uint8_t hello) {
  WireFrame frame = frames[at];
  Replace replace;
  decode(frame, replace);
  const auto number = static_cast<std::uint16_t>(hello + static_cast<std::uint8_t>(frame.sequence - hello));
  Announcement announcement(number, replace.after, motors);
  std::uint8_t bytes[largest_frame];
  for (std::size_t i = 1; i <= replace.count && at + i < frames.size(); ++i) {
    announcement.add(bytes, bytes_of(frames[at + i], bytes));
  }
  const Replace right = announcement.replace();
  const std::uint16_t sums[2] = {right.sums.first, right.sums.second};
  for (unsigned i = 0; i < 4; ++i) frame.payload[3 + i] = static_cast<std::uint8_t>(sums[i / 2] >> i % 2 * 8);
  return frame;
}

// Type, sequence number and payload, one frame after the other. The last byte of a replacement's sums chooses whether
// they stay or are made right.
void check_frames(const std::uint8_t* data, std::size_t size) {
  Bench bench;
  const std::vector<WireFrame> frames = frames_in(data, size);
  std::uint8_t hello = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].type == MessageType::hello) hello = frames[i].sequence;
    const bool right = frames[i].type == MessageType::replace && frames[i].payload[6] < 0x80;
    std::uint8_t bytes[largest_frame];
    const std::uint8_t whole = bytes_of(right ? announced(frames, i, hello) : frames[i], bytes);
    for (std::uint8_t k = 0; k < whole; ++k) bench.take(bytes[k]);
  }
  bench.come_to_rest();
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  (data[0] % 2 == 0 ? passo::check_bytes : passo::check_frames)(data + 1, size - 1);
  return 0;
}
