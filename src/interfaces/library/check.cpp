#include <algorithm>
#include <utility>

#include "inner_types.hpp"
#include "motion_content.hpp"
#include "program_content.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/judge/judgement.hpp"
#include "passo/session/planned_program.hpp"
#include "passo/verdict/margin_words.hpp"

namespace passo::v1 {
namespace {

std::optional<AxisRange> range_of(const std::optional<passo::Range>& range) {
  if (!range) return std::nullopt;
  return AxisRange{range->low, range->high};
}

StepVerdict verdict_of(passo::Verdict verdict) {
  switch (verdict) {
    case passo::Verdict::safe: return StepVerdict::safe;
    case passo::Verdict::doubtful: return StepVerdict::doubtful;
    case passo::Verdict::lost: break;
  }
  return StepVerdict::lost;
}

WeakSpot weak_spot_of(const passo::MarginSpot& spot) {
  return {.axis = outer(spot.axis),
          .line = spot.line,
          .time_s = spot.time.value(),
          .verdict = verdict_of(spot.verdict),
          .load = spot.load(),
          .cause = passo::cause_of(spot),
          .cure = passo::cure_of(spot)};
}

MotionReport report_of(const passo::Judgement& judged) {
  const passo::RunSummary& summary = judged.summary;
  MotionReport report{.cutting_time_s = summary.cutting_time.value(),
                      .rapid_time_s = summary.rapid_time.value(),
                      .dwell_time_s = summary.dwell_time.value(),
                      .cutting_length_mm = summary.cutting_distance.value(),
                      .rapid_length_mm = summary.rapid_distance.value(),
                      .moves = summary.moves,
                      .tool_changes = judged.tool_changes,
                      .axes = {},
                      .speed_limits = {},
                      .slowest_lines = {},
                      .motors = {},
                      .weak_spots = {}};
  for (const passo::AxisSummary& axis : summary.axes) {
    report.axes.push_back({.axis = outer(axis.axis),
                           .extents = range_of(axis.machine_extents),
                           .cutting_extents = range_of(axis.cutting_extents),
                           .highest_mm_per_s = axis.peak_speed.value(),
                           .highest_mm_per_s2 = axis.peak_acceleration.value()});
  }
  for (const passo::SpeedShare& share : judged.speed.shares) {
    report.speed_limits.push_back(
        {.limit = passo::describe(share.bound), .time_s = share.time.value(), .first_line = share.first_line});
  }
  for (const passo::SpeedPart& part : judged.speed.slowest) {
    if (!part.is_slow()) continue;
    report.slowest_lines.push_back({.line = part.line,
                                    .mean_mm_per_s = part.mean().value(),
                                    .programmed_mm_per_s = part.programmed.value(),
                                    .lost_s = part.lost.value(),
                                    .limit = passo::describe(part.bound)});
  }
  if (!judged.knows_motors) return report;
  report.motors = verdict_of(judged.margin.verdict);
  for (const passo::MarginSpot& spot : judged.margin.worst) {
    if (spot.verdict != passo::Verdict::safe) report.weak_spots.push_back(weak_spot_of(spot));
  }
  return report;
}

constexpr double least_factor = 0.01;
constexpr double most_feed_factor = 2;

// A check without errors, and its findings.
struct FirstLook {
  passo::Diagnostics diagnostics;
  passo::InterpreterOptions options;
  passo::ProgramCheck check;
  std::vector<Finding> findings;

  bool good() const { return check.good && !diagnostics.any_error(); }
};

// Of `progress` this part is the first look.
constexpr double share_of_first_look = 0.3;

void look(const Program& program, const Machine& machine, const CheckOptions& options, FirstLook& first) {
  if (!(options.feed_factor >= least_factor && options.feed_factor <= most_feed_factor &&
        options.rapid_factor >= least_factor && options.rapid_factor <= 1)) {
    first.diagnostics.add({.severity = passo::Severity::error,
                           .code = "check.factor",
                           .file = {},
                           .place = {},
                           .message = fmt::format("the factors of feed and rapids are {} and {}", options.feed_factor,
                                                  options.rapid_factor),
                           .expected = fmt::format("{0} to {1}, and {0} to 1", least_factor, most_feed_factor),
                           .text = {}});
  }
  first.options = interpreter_options_of(options.read, first.diagnostics);
  if (!first.diagnostics.any_error()) {
    constexpr std::uint64_t items_between_calls = 4096;
    passo::ProgramChecker checker(program.content().reader.again(), machine.content().description, first.options,
                                  first.diagnostics);
    const double bytes = static_cast<double>(std::max<std::uint64_t>(program.content().reader.size(), 1));
    // Lines in loops come again, and count once.
    std::uint32_t line = 0;
    std::uint64_t read = 0;
    checker.watch_operations([&](const passo::Operation& operation) {
      if (operation.source.line <= line) return;
      line = operation.source.line;
      read += operation.text.size() + 1;
    });
    while (!checker.go_on(items_between_calls)) {
      if (options.progress) options.progress(share_of_first_look * std::min(static_cast<double>(read) / bytes, 1.0));
    }
    first.check = checker.result();
  }
  first.findings = findings_of(first.diagnostics);
}

}  // namespace

Machine::Machine(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

namespace {

Outcome<Machine> machine_of(std::optional<passo::MachineDescription> description,
                            const passo::Diagnostics& diagnostics) {
  if (!description) return Outcome<Machine>(findings_of(diagnostics));
  return {Machine(std::make_shared<const Machine::Content>(Machine::Content{std::move(*description)})),
          findings_of(diagnostics)};
}

}  // namespace

Outcome<Machine> Machine::open(const std::string& path) {
  passo::Diagnostics diagnostics;
  auto description = passo::load_machine_file(path, diagnostics);
  return machine_of(std::move(description), diagnostics);
}

Outcome<Machine> Machine::from_text(std::string_view text, const std::string& name) {
  passo::Diagnostics diagnostics;
  auto description = passo::parse_machine(text, name, diagnostics);
  return machine_of(std::move(description), diagnostics);
}

const std::string& Machine::name() const {
  return content_->description.name;
}

std::vector<Axis> Machine::axes() const {
  std::vector<Axis> axes;
  for (const passo::AxisDescription& axis : content_->description.axes) axes.push_back(outer(axis.axis));
  return axes;
}

Limits Machine::limits() const {
  Limits limits;
  for (const passo::AxisDescription& axis : content_->description.axes) {
    limits[outer(axis.axis)] = {.velocity_mm_per_s = axis.velocity.value(),
                                .acceleration_mm_per_s2 = axis.acceleration.value(),
                                .jerk_mm_per_s3 = axis.jerk.value()};
  }
  return limits;
}

StepOptions Machine::step_options() const {
  const passo::MachineDescription& machine = content_->description;
  StepOptions options;
  const passo::Kinematics kinematics = passo::kinematics_of(machine);
  for (const passo::MotorRow& row : kinematics.rows()) options[outer(row.steps.axis())] = row.steps.factor();
  options.ticks_per_s = machine.board.clock.value();
  options.events_per_s = machine.board.highest_event_rate.value();
  return options;
}

bool Machine::knows_motors() const {
  return std::ranges::any_of(content_->description.axes, [](const auto& axis) { return axis.motor.has_value(); });
}

ProgramReport check(const Program& program, const Machine& machine, const CheckOptions& options) {
  FirstLook first;
  look(program, machine, options, first);
  ProgramReport report{.findings = first.findings, .motion = {}};
  if (first.good() && options.plans) {
    const auto progress = [&](double share) {
      options.progress(share_of_first_look + (1 - share_of_first_look) * (share > 0 ? std::min(share, 1.0) : 0));
    };
    const passo::Judgement judged =
        passo::judge(program.content().reader.again(), machine.content().description, first.options, first.check, {},
                     options.progress ? std::function<void(double)>(progress) : nullptr,
                     {.feed = options.feed_factor, .rapids = options.rapid_factor});
    report.motion = report_of(judged);
  }
  if (options.progress) options.progress(1);
  return report;
}

Outcome<Motion> plan(const Program& program, const Machine& machine, const CheckOptions& options) {
  FirstLook first;
  look(program, machine, options, first);
  if (!first.good()) return Outcome<Motion>(std::move(first.findings));
  const passo::MachineDescription& description = machine.content().description;
  passo::PlannedProgram planned(program.content().reader.again(), description, first.options, first.check,
                                {.feed = options.feed_factor, .rapids = options.rapid_factor});
  MotionRecording recording(first.options.start, passo::motion_limits(description).velocity);
  passo::MotionItem item;
  constexpr unsigned items_between_calls = 1024;
  for (unsigned items = 0; planned.next(item); ++items) {
    if (!recording.add(item)) {
      first.findings.push_back(error_of("plan.too-long", program.name(), 0, "the motion does not fit into memory",
                                        fmt::format("at most {} moves", Motion::Content::most_moves)));
      return Outcome<Motion>(std::move(first.findings));
    }
    if (options.progress && items % items_between_calls == 0) {
      const double share = planned.nominal_time() / first.check.nominal_time;
      // Without a nominal time it is no number.
      options.progress(share_of_first_look + (1 - share_of_first_look) * (share > 0 ? std::min(share, 1.0) : 0));
    }
  }
  if (options.progress) options.progress(1);
  return {recording.motion(passo::step_options(description)), std::move(first.findings)};
}

}  // namespace passo::v1
