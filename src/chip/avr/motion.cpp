// The firmware `motion`: a Board on the chip. One loop; the step timer is the only interrupt.
#include "chip_player.hpp"
#include "passo/chip/line_decoder.hpp"
#include "passo/firmware/board.hpp"
#include "serial_line.hpp"

#ifndef PASSO_BAUD
#define PASSO_BAUD 500000
#endif

namespace passo::chip {
namespace {

constexpr uint32_t clock = 16'000'000;
// All that a host may have under way fits into the page of received bytes: 11 frames of 22 bytes and one to replace.
constexpr uint8_t queue_capacity = 11;

struct Hardware {
  void step(uint8_t, uint8_t) {}
  void outputs(const BoardOutputs&) {}
  void send(uint8_t byte) { line.send(byte); }
  void breathe() { SerialLine::breathe(); }

  SerialLine line;
};

Hardware hardware;
constexpr BoardIdentity identity = {
    .motors = uno_cnc_shield.motors,
    .clock = clock,
    .reset = ResetCause::power_on,
    .about = {.firmware = 100, .highest_event_rate = 125'000, .baud = 500'000, .name = "uno cnc3"}};
Board<Hardware, queue_capacity, ChipPlayer, LineDecoder> board(hardware, identity);

void set_pins() {
  Register<0x2a>::write(uno_cnc_shield.steps_on('D') | uno_cnc_shield.directions_on('D'));
}

// The way of one byte, by itself: a loop around it would keep addresses in registers that are the interrupt's.
[[gnu::noinline]] void receive() {
  board.receive(hardware.line.take());
}

// Once around the loop. Events come first: nothing else here may take longer than what is ahead of the interrupt.
[[gnu::noinline]] void turn() {
  static uint8_t patience = 0;
  SerialLine& line = hardware.line;
  line.poll();
  for (uint8_t taken = 0; line.has_byte() && (taken < 6 || ChipPlayer::wants_more()) && taken < 32; ++taken) {
    receive();
    SerialLine::breathe();
  }
  ChipPlayer::refill();
  line.poll();
  board.settle();
  line.poll();
  ChipPlayer::refill();
  line.poll();
  // A credit tells what those before it told: while bytes wait, it can wait too.
  if (!board.owes_report() || !line.can_send()) return;
  if (line.has_byte() && (++patience & 7) != 0) return;
  board.report();
}

}  // namespace
}  // namespace passo::chip

extern "C" int main() {
  using namespace passo::chip;
  set_pins();
  ChipPlayer::prepare();
  board.player().restart(0);
  SerialLine::open(clock, PASSO_BAUD);
  asm volatile("sei");
  for (;;) turn();
}
