#include "passo/verdict/tolerance_trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "passo/motor/torque_band.hpp"

namespace passo {
namespace {

constexpr double always_played = 60;        // s of each axis
constexpr double most_played = 120;         // s
constexpr double after_a_new_kind = 0.05;   // s: a swing grows or fades
constexpr float known = 0.5;                // s: a kind that was played so long is known
constexpr double of_steady_motion = 1;      // s: a motor that swings by itself is out of step by then
constexpr double until_at_rest = 0.5;       // s
constexpr double to_settle = 0.3;           // s: a weight turns the rotor
constexpr double carried = 0.012;           // s: several times L/R, and a period of the ringing
constexpr double lead_in = 0.2;             // s: the swing that was before has faded by then, or shows again
constexpr std::size_t most_skipped = 2048;  // pieces
constexpr double between_samples = 50e-6;   // s; between them a place is in proportion
constexpr double between_looks = 1e-3;      // s: a swing takes longer
constexpr double latest = 1e-4;             // s: events are seldom further apart
// The strengths of the motors after the weakest: how far from the usual one, in tolerances.
constexpr std::array<double, ToleranceTrial::motor_count - 1> offsets = {-1.1, -0.9, -0.5, 0, 1};
// In steps. A place on the border between two steps belongs to the higher one, as on a board. Motion that turns round
// there makes a step up, and goes back at the next line of the board's finest grid.
constexpr double rounding_at_border = 1e-6;
constexpr double finest_line = 1.0 / 256;

double step_at(double place) {
  return std::floor(place + 0.5 + rounding_at_border);
}

}  // namespace

// A place over time: c0 + c1·t + c2·t² + c3·t³, in steps of the driver or in lines of the grid of the board's events.
struct ToleranceTrial::Path {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

  double at(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
  double speed_at(double t) const { return c1 + t * (2 * c2 + t * 3 * c3); }
};

ToleranceTrial::ToleranceTrial(const MotorSetup& setup, double tolerance, double radians_per_unit,
                               RadiansPerSecond fastest)
    : steps_per_unit_(radians_per_unit * setup.motor.rotor.steps_per_revolution *
                      setup.excitation.steps_per_full_step() / (2 * std::numbers::pi)),
      radians_per_unit_(radians_per_unit),
      fastest_(fastest.value) {
  setups_.push_back(with_torque(setup, (1 - reserve) * (1 - tolerance)));
  for (const double off : offsets) setups_.push_back(with_torque(setup, 1 + off * tolerance));
  motors_.reserve(motor_count);
}

TrialFinding ToleranceTrial::play(const AxisPiece& piece) {
  const double duration = piece.duration.value();
  if (!(duration > 0)) return {.judged = true};
  float& of_kind = played_of_kind(piece);
  const bool is_new = of_kind < known;
  to_play_ = is_new ? after_a_new_kind : to_play_ - duration;
  const bool goes_on = played_ < always_played || (played_ < most_played && to_play_ > 0);
  if (!goes_on) stop();
  if (goes_on && motors_.empty()) begin(piece);
  load_before_ = piece.load;
  if (motors_.empty()) {
    skip(piece);
    return {.judged = !is_new};
  }
  const unsigned out_before = out_;
  most_swing_ = 0;
  of_kind += static_cast<float>(follow(piece));
  return finding_since(out_before);
}

TrialFinding ToleranceTrial::finding_since(unsigned out_before) const {
  return {.judged = true,
          .lost = std::popcount(out_ & ~out_before),
          .most_swing = most_swing_,
          .usual_out = (out_ & usual) == usual};
}

TrialFinding ToleranceTrial::stand(Seconds time) {
  load_before_ = 0;
  if (motors_.empty()) {
    if (time.value() >= until_at_rest) forget_skipped();
    if (!skipped_.empty()) skip({.duration = time, .from = skipped_.back().to, .to = skipped_.back().to});
    return {.judged = true};
  }
  const unsigned out_before = out_;
  most_swing_ = 0;
  const double left = std::max(until_at_rest - stood_, 0.0);
  stood_ += time.value();
  if (pending_ > 0) pass(pending_);
  resist({0});
  for (double run = std::min(time.value(), left); run > 0; run -= between_looks) pass(std::min(run, between_looks));
  const TrialFinding finding = finding_since(out_before);
  if (stood_ >= until_at_rest) stop();
  return finding;
}

void ToleranceTrial::skip(const AxisPiece& piece) {
  skipped_.push_back(piece);
  time_skipped_ += piece.duration.value();
  while (time_skipped_ - skipped_.front().duration.value() > lead_in || skipped_.size() > most_skipped) {
    time_skipped_ -= skipped_.front().duration.value();
    skipped_.pop_front();
  }
}

void ToleranceTrial::forget_skipped() {
  skipped_.clear();
  time_skipped_ = 0;
}

// How long pieces of that kind were played.
float& ToleranceTrial::played_of_kind(const AxisPiece& piece) {
  const auto bin_of = [](double load) {
    constexpr double bins_per_load = 8;
    return std::min(static_cast<std::size_t>(std::min(load, 10.0) * bins_per_load), loads - 1);
  };
  const double speed = std::max(std::abs(piece.speed_from), std::abs(piece.speed_to)) * radians_per_unit_;
  constexpr double bins_an_octave = 6;
  const double octaves = std::log2(std::max(fastest_, 1e-9) / std::max(speed, 1e-9));
  const auto slowness = static_cast<std::size_t>(std::clamp(bins_an_octave * octaves, 0.0, double{speeds - 1}));
  return kinds_[(bin_of(piece.load) * loads + bin_of(load_before_)) * speeds + slowness];
}

// In mid-motion the motors enter it earlier, where it is calm: how a rotor swings depends on what was before.
void ToleranceTrial::begin(const AxisPiece& piece) {
  stop();
  for (const MotorSetup& setup : setups_) motors_.emplace_back(setup, Integration::where_needed);
  const auto strength = [](const AxisPiece& one) { return std::abs(one.acceleration()); };
  const auto half = skipped_.begin() + static_cast<std::ptrdiff_t>((skipped_.size() + 1) / 2);
  auto lead = std::ranges::min_element(skipped_.begin(), half, {}, strength);
  const AxisPiece& first = lead == skipped_.end() ? piece : *lead;
  origin_ = step_at(steps_per_unit_ * first.from);
  if (setups_[0].weight.value != 0) {
    for (BoundedMotor& motor : motors_) motor.run(Seconds(to_settle));
  }
  const double full_step = motors_[0].steps_per_full_step();
  if (std::abs(first.speed_from) * steps_per_unit_ * carried > full_step) carry_to(first);
  const unsigned lost_before = ever_lost_;
  for (; lead != skipped_.end(); ++lead) follow(*lead);
  forget_skipped();
  if (out_ == 0) return;
  // The entry was too rough, and says nothing about the program.
  ever_lost_ = lost_before;
  stop();
}

// Brings the motors into the motion in which the piece begins.
void ToleranceTrial::carry_to(const AxisPiece& piece) {
  const double scale = steps_per_unit_;
  const double speed = scale * piece.speed_from;
  const double acceleration = scale * piece.acceleration();
  const double time = acceleration * speed > 0 ? std::min(carried, speed / acceleration) : carried;
  const Path path{.c0 = scale * piece.from - speed * time + acceleration * time * time / 2,
                  .c1 = speed - acceleration * time,
                  .c2 = acceleration / 2,
                  .c3 = 0};
  origin_ = step_at(path.c0);
  follow({path.c0 - origin_, path.c1, path.c2, path.c3}, {}, time, true);
  for (BoundedMotor& motor : motors_) motor.let_go();
  out_ = 0;
}

// Returns the time that was played.
double ToleranceTrial::follow(const AxisPiece& piece) {
  stood_ = 0;
  resist(piece.resistance);
  const double duration = piece.duration.value();
  const double scale = steps_per_unit_;
  double time = duration;
  double way = scale * (piece.to - piece.from);
  if (duration > of_steady_motion && std::abs(piece.speed_to - piece.speed_from) < 1e-9 * std::abs(piece.speed_to)) {
    const double period = 4.0 * motors_[0].steps_per_full_step();
    const double speed = std::abs(way) / duration;
    const double periods = std::floor((duration - of_steady_motion) * speed / period);
    time -= periods * period / speed;
    const double left_out = std::copysign(periods * period, way);
    way -= left_out;
    origin_ += left_out;
  }
  const double first = scale * piece.speed_from;
  const double last = scale * piece.speed_to;
  const Path path{.c0 = scale * piece.to - way - origin_,
                  .c1 = first,
                  .c2 = (3 * way / time - 2 * first - last) / time,
                  .c3 = (first + last - 2 * way / time) / (time * time)};
  follow(path, {.c0 = piece.grid_from, .c1 = (piece.grid_to - piece.grid_from) / duration}, time, false);
  played_ += time;
  return time;
}

void ToleranceTrial::follow(const Path& path, const Path& grid, double duration, bool carried_along) {
  const double events = std::abs(grid.c1);  // a second
  const double parts = std::ceil(duration / between_samples);
  const double part = duration / parts;
  double before = path.at(0);
  for (double i = 1; i <= parts; ++i) {
    if (carried_along) {
      const double speed = path.speed_at((i - 1) * part) / steps_per_unit_ * radians_per_unit_;
      for (BoundedMotor& motor : motors_) motor.carry({speed});
    }
    const double here = path.at(i * part);
    const int way = here > before ? 1 : -1;
    double spent = 0;
    const double first = static_cast<double>(commanded_) + (way > 0 ? 0.5 - rounding_at_border : -0.5 - finest_line);
    for (double border = first; way * (here - border) > 0; border += way) {
      double at = here == before ? 0 : std::clamp((border - before) / (here - before), 0.0, 1.0) * part;
      if (events > 0) {
        const double line = (grid.c1 > 0 ? 1 : -1) * grid.at((i - 1) * part + at);
        at += std::min((std::ceil(line) - line) / events, latest);
      }
      pending_ += at - spent;
      spent = at;
      if (pending_ > 0) pass(pending_);
      step(way);
    }
    pending_ += part - spent;
    if (pending_ > between_looks) pass(pending_);
    before = here;
  }
}

void ToleranceTrial::resist(NewtonMetres torque) {
  if (torque.value == resistance_) return;
  resistance_ = torque.value;
  for (BoundedMotor& motor : motors_) motor.set_resistance(torque);
}

void ToleranceTrial::step(int way) {
  commanded_ += way;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    if ((out_ >> i & 1) == 0) motors_[i].step(way);
  }
}

void ToleranceTrial::pass(double time) {
  pending_ = 0;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    if ((out_ >> i & 1) != 0) continue;
    BoundedMotor& motor = motors_[i];
    motor.run(Seconds(time));
    most_swing_ = std::max(most_swing_, std::abs(motor.lag()));
    if (motor.slipped() == 0) continue;
    out_ |= 1U << i;
    ever_lost_ |= 1U << i;
  }
}

void ToleranceTrial::stop() {
  motors_.clear();
  out_ = 0;
  commanded_ = 0;
  resistance_ = 0;
  pending_ = 0;
  stood_ = 0;
}

}  // namespace passo
