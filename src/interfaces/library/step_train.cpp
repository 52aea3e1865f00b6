#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>

#include "inner_types.hpp"
#include "motion_content.hpp"
#include <fmt/format.h>

#include "passo/firmware/player.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo::v1 {

struct StepTrain::Content {
  Content(Motion owned, const passo::StepOptions& options, std::vector<Axis> driven)
      : motion(std::move(owned)),
        moves(motion.content()),
        generator(moves, options),
        player(static_cast<std::uint8_t>(driven.size())),
        axes(std::move(driven)),
        ticks_per_s(options.clock.tick_rate.value()) {
    generator.be_exact_to({.least_rate = options.clock.highest_event_rate * passo::slow_share});
  }

  // Plays events until there is a step. Returns false at the end.
  bool play() {
    while (steps.empty()) {
      if (player.done() && !load()) return false;
      tick += player.wait();
      const unsigned directions = player.directions();
      for (unsigned moved = player.play(); moved != 0; moved &= moved - 1) {
        const auto motor = static_cast<std::size_t>(std::countr_zero(moved));
        steps.push_back({.tick = tick, .axis = axes[motor], .forward = (directions >> motor & 1U) == 0});
      }
      if (player.finished()) player.forget();
    }
    return true;
  }

  Motion motion;
  StoredMoves moves;
  passo::StepGenerator generator;
  passo::Player player;
  std::vector<Axis> axes;  // of each motor
  double ticks_per_s;
  std::int64_t tick = 0;
  std::deque<passo::BoardSegment> parts;
  std::deque<Step> steps;

 private:
  bool load() {
    passo::BoardItem item;
    while (parts.empty()) {
      if (!generator.next(item)) return false;
      const auto* segment = std::get_if<passo::BoardSegment>(&item);
      if (segment == nullptr) continue;
      passo::for_each_plain_part(*segment, [this](const passo::BoardSegment& part) { parts.push_back(part); });
    }
    player.load(parts.front());
    parts.pop_front();
    return true;
  }
};

StepTrain::StepTrain(std::unique_ptr<Content> content) : content_(std::move(content)) {}
StepTrain::StepTrain(StepTrain&& other) noexcept = default;
StepTrain& StepTrain::operator=(StepTrain&& other) noexcept = default;
StepTrain::~StepTrain() = default;

double StepTrain::ticks_per_s() const {
  return content_->ticks_per_s;
}

std::size_t StepTrain::read(Step* steps, std::size_t most) {
  std::size_t count = 0;
  while (count < most && content_->play()) {
    for (; count < most && !content_->steps.empty(); content_->steps.pop_front()) {
      steps[count++] = content_->steps.front();
    }
  }
  return count;
}

namespace {

// The steps of the fastest motor are divided into events up to a quarter of the board's highest rate, because a link
// has to carry them. Here is no link: with a board that is four times as fast, up to events_per_s.
constexpr double more_events = 4;
constexpr double least_steps = 1e-3;
constexpr double most_steps = 1e6;
constexpr double least_ticks = 1e4;
constexpr double most_ticks = 1e9;
constexpr double ticks_of_fastest_event = 16;
constexpr double ticks_of_slowest_event = 65535.0 / 2;

std::vector<Finding> step_errors_of(const StepOptions& options, const Motion::Content& motion) {
  std::vector<Finding> errors;
  const auto add = [&](const char* code, std::string message, std::string expected) {
    errors.push_back(error_of(code, "", 0, std::move(message), std::move(expected)));
  };
  if (!(options.ticks_per_s >= least_ticks && options.ticks_per_s <= most_ticks)) {
    add("steps.clock", fmt::format("the clock has {} ticks/s", options.ticks_per_s),
        fmt::format("{:g} to {:g}", least_ticks, most_ticks));
    return errors;
  }
  const double fewest = options.ticks_per_s / ticks_of_slowest_event;
  const double most = options.ticks_per_s / ticks_of_fastest_event;
  if (!(options.events_per_s >= fewest && options.events_per_s <= most)) {
    add("steps.events", fmt::format("{} events/s", options.events_per_s),
        fmt::format("{:g} to {:g} with this clock", std::ceil(fewest), most));
  }
  std::size_t motors = 0;
  for (const Axis axis : all_axes) {
    const double steps = std::abs(options.steps_per_mm[static_cast<std::size_t>(axis)]);
    if (steps == 0) continue;
    ++motors;
    const char letter = letter_of(axis);
    if (!(steps >= least_steps && steps <= most_steps)) {
      add("steps.scale", fmt::format("{} has {} steps per mm or degree", letter, steps),
          fmt::format("{} to {:g}", least_steps, most_steps));
      continue;
    }
    const double fastest = steps * motion.velocities[inner(axis)].value();
    if (fastest > options.events_per_s * (1 + 1e-9)) {
      add("steps.too-fast", fmt::format("{} makes {:.0f} steps/s at its velocity", letter, fastest),
          fmt::format("at most {:g}, the events per second", options.events_per_s));
    }
  }
  if (motion.has_backlash) {
    add("steps.backlash", "the machine of the program has backlash that is taken up",
        "steps() without options, which are those of the machine");
  }
  if (motors == 0 || motors > passo::max_motors) {
    add("steps.motors", fmt::format("{} motors", motors), fmt::format("1 to {} motors", passo::max_motors));
  }
  return errors;
}

}  // namespace

Outcome<StepTrain> Motion::steps(const StepOptions& options) const {
  if (std::vector<Finding> errors = step_errors_of(options, *content_); !errors.empty()) {
    return Outcome<StepTrain>(std::move(errors));
  }
  passo::StepOptions inner_options;
  std::vector<Axis> axes;
  for (const Axis axis : all_axes) {
    const double steps = options.steps_per_mm[static_cast<std::size_t>(axis)];
    if (steps == 0) continue;
    inner_options.kinematics.add({.steps = {inner(axis), steps}});
    axes.push_back(axis);
  }
  inner_options.clock = {.tick_rate = passo::Hertz(options.ticks_per_s),
                         .highest_event_rate = passo::Hertz(more_events * options.events_per_s)};
  inner_options.start = content_->start;
  return StepTrain(std::make_unique<StepTrain::Content>(*this, inner_options, std::move(axes)));
}

Outcome<StepTrain> Motion::steps() const {
  if (!content_->machine) {
    return Outcome<StepTrain>({error_of("steps.no-machine", "", 0, "the motion of a Path has no machine",
                                        "steps() with options, or the motion of a program")});
  }
  std::vector<Axis> axes;
  for (const passo::MotorRow& row : content_->machine->kinematics.rows()) axes.push_back(outer(row.steps.axis()));
  passo::StepOptions options = *content_->machine;
  options.start = content_->start;
  options.clock.highest_event_rate = options.clock.highest_event_rate * more_events;
  return StepTrain(std::make_unique<StepTrain::Content>(*this, options, std::move(axes)));
}

}  // namespace passo::v1
