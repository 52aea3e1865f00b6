#include "passo/link/await.hpp"

namespace passo {

std::optional<About> ask_about(BoardSession& session, Seconds within) {
  session.inquire(Question::about);
  await(
      session, [&] { return session.settled(); }, within);
  return session.about();
}

std::optional<BoardStatus> ask_status(BoardSession& session, Seconds within) {
  session.inquire(Question::status);
  await(
      session, [&] { return session.settled(); }, within);
  return session.status();
}

std::optional<BoardStatus> ask_status_at_rest(BoardSession& session, Seconds within) {
  std::optional<BoardStatus> before;
  const Seconds end = session.now() + longest_way_to_rest;
  while (session.now() < end) {
    const auto now = ask_status(session, within);
    if (!now) return {};
    const bool rests = (now->state & board_moves) == 0;
    if (rests && before && before->executed == now->executed && before->event == now->event) return now;
    before = rests ? now : std::nullopt;
  }
  return {};
}

}  // namespace passo
