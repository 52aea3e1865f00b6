// Any bytes off the wire: the board loses no place for items, turns no motor that is not there, and comes to rest. The
// first byte of the input chooses: bytes as they are, or contents of frames that get a right CRC, so that they are
// listened to.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "passo/firmware/board.hpp"
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

// Hears how much room there is, when it is asked for.
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
    // Time goes on while bytes come.
    if (byte % 4 == 0) play(byte);
  }
  void come_to_rest() {
    play(most_events);
    require(board_.idle(), "does not come to rest");
    // A replacement that was begun and never completed keeps its places until another begins, or a hello.
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

// Type, sequence number and payload, one frame after the other.
void check_frames(const std::uint8_t* data, std::size_t size) {
  Bench bench;
  std::size_t at = 0;
  while (at + 2 <= size) {
    const std::uint8_t payload = payload_size(data[at], motors);
    std::uint8_t frame[largest_frame];
    Encoder encoder(frame, static_cast<MessageType>(data[at]), data[at + 1]);
    at += 2;
    if (payload == 0 || at + payload > size) continue;
    for (std::uint8_t i = 0; i < payload; ++i) encoder.put8(data[at++]);
    const std::uint8_t whole = encoder.finish();
    for (std::uint8_t i = 0; i < whole; ++i) bench.take(frame[i]);
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
