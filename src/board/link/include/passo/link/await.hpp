// Functions that wait for a board, for callers that have nothing else to do: tests, benchmarks, short commands. All
// other work with a machine goes through MachineSession, which never waits.
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

// Says hello and waits until the board has answered. False: error() tells why.
inline bool greet(BoardSession& session, const Greeting& greeting) {
  session.greet(greeting);
  return await(session, [&] { return session.ready(); });
}
// Asks the board before the hello, and waits for the answer. Empty: the board is silent.
std::optional<About> ask_about(BoardSession& session, Seconds within);
std::optional<BoardStatus> ask_status(BoardSession& session, Seconds within);
// What a board holds without a host are some braking and at most two dwells of 67 s.
inline constexpr Seconds longest_way_to_rest{150};
// Asks again until the board rests. Two answers must be alike, because a chip that has made its last event may not have
// counted the item yet. Empty: an answer did not come `within` this time; or the board still moves after
// `longest_way_to_rest`, and its last status says so.
std::optional<BoardStatus> ask_status_at_rest(BoardSession& session, Seconds within);

// Waits for room, then sends.
inline void send(BoardSession& session, const LinkItem& item) {
  await(session, [&] { return session.room() > 0; });
  if (session.error()) return;
  std::visit([&](const auto& one) { session.send(one); }, item);
}
// Waits until all that was sent is done.
inline void drain(BoardSession& session) {
  await(session, [&] { return !session.busy(); });
}

}  // namespace passo
