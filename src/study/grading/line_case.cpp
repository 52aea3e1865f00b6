#include "passo/grading/line_case.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/interpolate/master_slave.hpp"

namespace passo {

std::vector<LineCase> line_cases(std::size_t motors, bool signs) {
  static const std::vector<LineCase> unsigned_cases = {
      {{10, 4}, "the table of the method; one decision variable for all motors ends at (10, 5)"},
      {{7, 3}, "its figure"},
      {{4, 10}, "the second motor is the master"},
      {{1, 1}, "one diagonal pulse"},
      {{12, 12}, "a diagonal"},
      {{9, 0}, "the second motor stands still"},
      {{0, 9}, "the first motor stands still"},
      {{0, 0}, "no pulse at all"},
      {{2, 1}, "a tie at the first pulse: 0.5 is rounded to 1"},
      {{1, 2}, "the same with the second motor as the master"},
      {{8, 5}, "a tie at an odd half: 2.5 is rounded to 3"},
      {{22, 15}, "a tie that (15/22)*11 in floating point misses"},
      {{15, 22}, "the same with the second motor as the master"},
      {{27, 3}, "a slope with a whole quotient"},
      {{3, 29}, "a remainder above a slope of 1"},
      {{100, 1}, "a single step, in the middle"},
      {{100, 99}, "a single pause, in the middle"},
      {{997, 613}, "two primes"},
      {{40'000, 12'345}, "a long move: twice its length does not fit 16 bits"},
      {{7, 5, 3}, "three motors"},
      {{3, 7, 5}, "three motors, the second is the master"},
      {{2, 6, 9}, "three motors, the third is the master"},
      {{10, 4, 6}, "two slaves with different decision variables"},
      {{10, 0, 4}, "the second of three motors stands still"},
      {{0, 0, 5}, "only the third motor moves"},
      {{0, 0, 0}, "three motors, no pulse at all"},
      {{22, 15, 11}, "ties of two slaves at one pulse"},
      {{9, 7, 4, 2}, "four motors"},
      {{1, 2, 3, 4, 5}, "five motors, the last is the master"},
      {{16, 1, 2, 4, 8, 15, 3, 0}, "eight motors"}};
  static const std::vector<LineCase> signed_cases = {{{-10, 4}, "the first motor counts down"},
                                                     {{10, -4}, "the second motor counts down"},
                                                     {{-10, -4}, "both count down"},
                                                     {{-4, 10}, "the slave counts down"},
                                                     {{4, -10}, "the master counts down"},
                                                     {{-4, -10}, "both count down, the second is the master"},
                                                     {{2, -1}, "a tie below zero: -0.5 is rounded to -1"},
                                                     {{-22, -15}, "a tie below zero that floating point misses"},
                                                     {{-7, 5, -3}, "three motors in both directions"}};
  std::vector<LineCase> cases = unsigned_cases;
  if (signs) cases.insert(cases.end(), signed_cases.begin(), signed_cases.end());
  if (motors == 0) return cases;
  std::erase_if(cases, [&](const LineCase& one) { return one.steps.size() > motors; });
  std::vector<LineCase> padded;
  for (LineCase& one : cases) {
    one.steps.resize(motors, 0);
    if (std::ranges::find(padded, one.steps, &LineCase::steps) == padded.end()) padded.push_back(std::move(one));
  }
  return padded;
}

std::vector<StepCounts> line_positions(const StepCounts& steps) {
  std::int32_t distances[most_graded_motors] = {};
  for (std::size_t motor = 0; motor < steps.size(); ++motor) distances[motor] = static_cast<std::int32_t>(steps[motor]);
  std::vector<StepCounts> positions;
  StepCounts position(steps.size(), 0);
  for (MasterSlave<most_graded_motors> line(distances); !line.done();) {
    const Pulse pulse = line.next();
    for (std::size_t motor = 0; motor < steps.size(); ++motor) {
      if ((pulse.steps >> motor & 1) == 0) continue;
      position[motor] += (pulse.directions >> motor & 1) != 0 ? -1 : 1;
    }
    positions.push_back(position);
  }
  return positions;
}

std::string describe_steps(const StepCounts& steps) {
  return fmt::format("({})", fmt::join(steps, ", "));
}

}  // namespace passo
