#include "passo/transport/inquiry.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr Seconds between_questions{0.25};
constexpr std::size_t most_heard = 256;

}  // namespace

Inquiry::Inquiry(BoardPort& port) : port_(port) {
  decoder_.set_motors(max_motors);
}

bool Inquiry::ask(Question question, MessageType answer, Seconds within) {
  const Seconds end = port_.elapsed() + within;
  while (port_.elapsed() < end) {
    std::uint8_t frame[largest_frame];
    const std::uint8_t size = encode(Ask{.motors = max_motors, .question = question}, std::uint8_t{0}, frame);
    port_.receive({frame, size});
    const Seconds again = std::min(end, port_.elapsed() + between_questions);
    while (port_.elapsed() < again && port_.run(again - port_.elapsed())) {
      for (const std::uint8_t byte : port_.replies()) {
        if (byte >= ' ' && byte < 127 && heard_.size() < most_heard) heard_ += static_cast<char>(byte);
        if (decoder_.feed(byte) == Decoded::frame && decoder_.frame().type == answer) return true;
      }
    }
  }
  return false;
}

std::optional<About> Inquiry::about(Seconds within) {
  if (!ask(Question::about, MessageType::about, within)) return {};
  About about;
  decode(decoder_.frame(), about);
  return about;
}

std::optional<BoardStatus> Inquiry::status(Seconds within) {
  if (!ask(Question::status, MessageType::status, within)) return {};
  BoardStatus status;
  decode(decoder_.frame(), max_motors, status);
  return status;
}

std::optional<BoardStatus> Inquiry::status_at_rest(Seconds within) {
  std::optional<BoardStatus> before;
  for (;;) {
    const auto now = status(within);
    if (!now) return {};
    const bool rests = (now->state & board_moves) == 0;
    if (rests && before && before->executed == now->executed && before->event == now->event) return now;
    before = rests ? now : std::nullopt;
  }
}

}  // namespace passo
