#include "grbl_time_left.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace passo {
namespace {

constexpr std::uint64_t items_between_looks = 64;
// With less the motion stands still, and nobody knows for how long.
constexpr double least_factor = 0.01;

}  // namespace

GrblTiming grbl_timing_of(const GrblMachine& board, double bytes_per_second) {
  return {.limits = limits_of(board),
          .line = {.bytes_per_second = bytes_per_second, .buffer = board.bytes},
          .target = GrblTarget::of(board)};
}

std::optional<MotionTimes> predict_on_grbl(const ProgramReader& program, const MachineDescription& machine,
                                           const InterpreterOptions& options, GrblTiming timing,
                                           const MotionFactors& factors, const std::function<bool()>& goes_on) {
  timing.limits.feed_factor = std::max(factors.feed, least_factor);
  timing.limits.rapid_factor = std::max(factors.rapids, least_factor);
  MotionTimes times;
  GrblTimes predicted(program, machine, options, timing,
                      [&times](Seconds nominal, Seconds planned) { times.add(nominal, planned); });
  while (!predicted.go_on(items_between_looks)) {
    if (!goes_on()) return {};
  }
  return times;
}

GrblTimeLeft::GrblTimeLeft(ProgramReader program, const MachineDescription& machine, InterpreterOptions options,
                           GrblTiming timing, Seconds nominal)
    : program_(std::move(program)),
      machine_(machine),
      options_(std::move(options)),
      timing_(std::move(timing)),
      nominal_(nominal) {}

GrblTimeLeft::~GrblTimeLeft() {
  ends_ = true;
  if (prediction_.valid()) prediction_.wait();
}

std::optional<Seconds> GrblTimeLeft::left(const MachineStatus& status) {
  if (!timing_.is_known()) return {};
  const MotionFactors factors{.feed = status.overrides.feed, .rapids = status.overrides.rapids};
  if (prediction_.valid() && prediction_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    times_ = prediction_.get();
  }
  if (!prediction_.valid() && (!times_ || factors_ != factors)) {
    factors_ = factors;
    prediction_ = std::async(std::launch::async, [this, factors] {
      return predict_on_grbl(program_, machine_, options_, timing_, factors, [this] { return !ends_; });
    });
  }
  if (!times_ || !status.progress || factors_ != factors || prediction_.valid()) return {};
  return times_->left_from(nominal_ * *status.progress);
}

}  // namespace passo
