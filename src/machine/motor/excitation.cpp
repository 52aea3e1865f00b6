#include "passo/motor/excitation.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "passo/firmware/winding_table.hpp"

namespace passo {

Result<Excitation, std::string> Excitation::named(std::string_view name) {
  if (name == "two-on") return Excitation(Kind::two_on, 1, name);
  if (name == "wave") return Excitation(Kind::wave, 1, name);
  if (name == "half-step") return Excitation(Kind::half_step, 2, name);
  constexpr std::string_view micro = "microsteps:";
  if (name.starts_with(micro)) {
    int steps = 0;
    const auto [end, error] = std::from_chars(name.data() + micro.size(), name.data() + name.size(), steps);
    if (error == std::errc() && end == name.data() + name.size() && steps >= 2 && steps <= 256) {
      return Excitation(Kind::microsteps, steps, name);
    }
  }
  return Failure{fmt::format("expected two-on, wave, half-step or microsteps:N (2 to 256), found '{}'", name)};
}

WindingState Excitation::at(std::int64_t place) const {
  WindingState state;
  if (kind_ == Kind::microsteps) {
    const std::int64_t turn = 4 * std::int64_t{steps_};
    const auto part = static_cast<double>(((place % turn) + turn) % turn) / static_cast<double>(turn);
    // Place 0 is the first pattern of two on: both currents positive.
    const double angle = 2 * std::numbers::pi * (part + 0.125);
    constexpr double nothing = 1e-12;  // a cosine that should be 0
    const auto clean = [](double value) { return std::abs(value) < nothing ? 0 : value; };
    state.phase_a = clean(std::cos(angle));
    state.phase_b = clean(std::sin(angle));
    const auto bit = [](bool on, unsigned output) { return static_cast<unsigned>(on) << output; };
    state.pattern = static_cast<std::uint8_t>(bit(state.phase_a > 0, 0) | bit(state.phase_b > 0, 1) |
                                              bit(state.phase_a < 0, 2) | bit(state.phase_b < 0, 3));
    return state;
  }
  const DriveMode mode = kind_ == Kind::two_on ? DriveMode::two_on
                         : kind_ == Kind::wave ? DriveMode::wave
                                               : DriveMode::half_step;
  state.pattern = winding_table(mode).at(static_cast<std::uint8_t>(place & 0xff));
  state.phase_a = static_cast<double>(state.on(0)) - static_cast<double>(state.on(2));
  state.phase_b = static_cast<double>(state.on(1)) - static_cast<double>(state.on(3));
  return state;
}

double Excitation::rotor_degrees(std::int64_t place, std::int32_t full_steps_per_turn) const {
  return static_cast<double>(place) * 360 / (static_cast<double>(full_steps_per_turn) * steps_);
}

}  // namespace passo
