// Functions that block until a board has answered, for callers with nothing else to do: tests, benchmarks, short
// commands. All other work with a machine goes through MachineSession, which never waits.
#pragma once

#include <limits>

#include "passo/link/board_session.hpp"

namespace passo {

inline constexpr Seconds endless{std::numeric_limits<double>::infinity()};

// Polls until `done()`, an error, or the end of the time. Returns the last `done()`.
template <class Done>
bool await(BoardSession& session, Done done, Seconds within = endless) {
  const Seconds end = session.now() + within;
  while (!done() && !session.error() && end - session.now() > hardly_any) session.poll(end - session.now());
  return done();
}

// Performs the handshake and waits for the answer. If it returns false, error() gives the reason.
inline bool greet(BoardSession& session, const Greeting& greeting) {
  session.greet(greeting);
  return await(session, [&] { return session.ready(); });
}
// Queries the board before the handshake, and waits for the answer. Empty: the board does not answer.
std::optional<About> ask_about(BoardSession& session, Seconds within);
std::optional<BoardStatus> ask_status(BoardSession& session, Seconds within);
// A board without a host plays at most a stop ramp and two dwells of 67 s.
inline constexpr Seconds longest_way_to_rest{150};
// Queries the board until it is stopped. Two answers must agree, because a chip may not have counted the item of its
// last event yet. Empty: no answer came `within` this time, or the board was still moving after `longest_way_to_rest`
// (see its last status).
std::optional<BoardStatus> ask_status_at_rest(BoardSession& session, Seconds within);

// Waits for room in the queue, then sends.
inline void send(BoardSession& session, const LinkItem& item) {
  await(session, [&] { return session.room() > 0; });
  if (session.error()) return;
  std::visit([&](const auto& one) { session.send(one); }, item);
}
// Waits until all sent items are executed.
inline void drain(BoardSession& session) {
  await(session, [&] { return !session.busy(); });
}

}  // namespace passo
