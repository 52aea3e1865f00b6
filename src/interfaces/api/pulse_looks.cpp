// The pulses that the board makes, one by one.
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "api_json.hpp"

#include "passo/link/sent_segments.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {
namespace {

static_assert(std::endian::native == std::endian::little, "pulses are written as they lie in memory");

constexpr std::size_t most_pulses = 20'000;  // some 0.3 ms of work
constexpr Seconds longest_window{20};        // so that 32 bits hold its ticks
constexpr Seconds usual_window{0.1};

std::optional<Seconds> seconds_of(std::string_view query, std::string_view key) {
  const std::string_view digits = query_value(query, key);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value);
  return !digits.empty() && is_number ? std::optional<Seconds>(value) : std::nullopt;
}

template <class Number>
void put(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

}  // namespace

WebAnswer pulses_answer(BoardMachineSession& session, const MachineDescription& machine, std::string_view query) {
  const SentSegments& sent = session.board().sent_segments();
  const Seconds now = session.now();
  const auto from = seconds_of(query, "from");
  const auto to = seconds_of(query, "to");
  if ((!from && !query_value(query, "from").empty()) || (!to && !query_value(query, "to").empty())) {
    return bad_body("from and to are seconds of the board's clock");
  }
  const Seconds end = to.value_or(sent.window(now, now, now, 0).newest);
  const Seconds begin = std::max(from.value_or(end - usual_window), end - longest_window);
  const PulseWindow window = sent.window(begin, end, now, most_pulses);
  const double tick = 1 / machine.board.clock.value();
  std::string bytes;
  bytes.reserve(80 + 8 * window.pulses.size());
  for (const Seconds time : {window.begin, window.end, window.oldest, window.newest}) put(bytes, time.value());
  put(bytes, tick);
  for (const std::int32_t count : window.counts) put(bytes, count);
  put(bytes, static_cast<std::uint32_t>(window.pulses.size()));
  put(bytes, static_cast<std::uint32_t>(session.board().motors()));
  for (const BoardPulse& pulse : window.pulses) {
    put(bytes, static_cast<std::uint32_t>((pulse.time - window.begin).value() / tick + 0.5));
    put(bytes, pulse.stepped);
    put(bytes, pulse.directions);
    put(bytes, std::uint16_t{0});
  }
  return {.type = "application/octet-stream", .body = std::move(bytes)};
}

}  // namespace passo
