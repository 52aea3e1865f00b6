#include "cut_loads.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <numbers>
#include <thread>

#include "program_input.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace passo {
namespace {

constexpr double shortest_piece = 1;  // mm
constexpr double most_pieces = 4096;  // of a feed

// The distance from the axis at which the cutter's underside is so high above the tip: where the cut is widest.
double reach_at(const Cutter& cutter, double depth) {
  const double radius = cutter.radius.value();
  if (cutter.height(cutter.radius).value() <= depth) return radius;
  double low = 0;
  double high = radius;
  constexpr int halvings = 30;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (cutter.height(Mm(middle)).value() <= depth ? low : high) = middle;
  }
  return high;
}

// Watches the cuts, and gives each feed its force. Many short feeds in a row are one stretch, as long as the tool's
// radius: a column of cells more or less in a tiny feed says nothing.
class ForceMeter {
 public:
  ForceMeter(CutOutcome& outcome, const CutMaterial& material) : outcome_(outcome), material_(material) {}

  void expect(std::size_t index, double revolutions, MmPerSecond speed) {
    expected_.push_back({index, material_.revolutions_per_minute.value_or(revolutions), speed.value()});
  }
  // The cuts come in the order in which they were expected; cuts of rapids are not expected.
  void watch(const MoveCut& cut) {
    outcome_.simulation.summary.add(cut);
    if (cut.move.rapid) return finish();
    const Expected feed = expected_.front();
    expected_.pop_front();
    if (cut.volume > 0 && !(feed.revolutions > 0) && silent_line_ == 0) silent_line_ = cut.move.line;
    if (!feeds_.empty() && (cut.move.tool != tool_ || feed.revolutions != feeds_.back().revolutions)) finish();
    tool_ = cut.move.tool;
    feeds_.push_back(feed);
    line_ = cut.move.line;
    way_ += cut.way;
    volume_ += cut.volume;
    depth_ = std::max(depth_, cut.depth);
    if (way_ >= outcome_.simulation.tools[tool_].cutter.radius.value()) finish();
  }
  // Call it at the end.
  void finish() {
    constexpr double least_cells = 5;
    constexpr double seconds_a_minute = 60;
    if (volume_ > 0 && feeds_.back().revolutions > 0) {
      const double way = std::max(way_, least_cells * outcome_.simulation.field.cell());
      const double reach = reach_at(outcome_.simulation.tools[tool_].cutter, depth_);
      const double cutting_speed = 2 * std::numbers::pi * reach * feeds_.back().revolutions / seconds_a_minute;
      give(material_.specific_force * volume_ / way / cutting_speed);
    }
    feeds_.clear();
    way_ = 0;
    volume_ = 0;
    depth_ = 0;
  }
  // The first line that cuts and has no spindle speed; 0: all have one.
  std::uint32_t silent_line() const { return silent_line_; }

 private:
  struct Expected {
    std::size_t index = 0;
    double revolutions = 0;
    double speed = 0;
  };

  void give(double newtons_per_speed) {
    for (const Expected& feed : feeds_) {
      outcome_.loads.raise(feed.index, newtons_per_speed);
      const double force = newtons_per_speed * feed.speed;
      if (force > outcome_.force.value) outcome_.force = {force, line_};
    }
  }

  CutOutcome& outcome_;
  CutMaterial material_;
  std::deque<Expected> expected_;
  std::uint32_t silent_line_ = 0;
  // The stretch.
  std::vector<Expected> feeds_;
  std::size_t tool_ = 0;
  std::uint32_t line_ = 0;
  double way_ = 0;
  double volume_ = 0;
  double depth_ = 0;
};

void cut_feed(StockCutter& cutter, ForceMeter& meter, const TipMove& move, const StockMove& kind, std::size_t index,
              double piece) {
  const Curve& curve = move.segment->curve;
  const double length = curve.length().value();
  const double count = std::clamp(std::ceil(length / piece), 1.0, most_pieces);
  StockMove part = kind;
  part.time = kind.time / count;
  for (double i = 0; i < count; ++i) {
    meter.expect(index, move.revolutions_per_minute, move.segment->speed);
    if (count == 1) {
      cutter.cut(curve, Vector3::of(move.zero), part);
    } else {
      cutter.cut(curve.part(Mm(length * i / count), Mm(length * (i + 1) / count)), Vector3::of(move.zero), part);
    }
  }
}

void add_silent(std::uint32_t line, const std::string& program, Diagnostics& findings) {
  if (line == 0) return;
  findings.add({.severity = Severity::warning,
                .code = "check.no-spindle-speed",
                .file = program,
                .place = {.line = line, .column = 0, .length = 1},
                .message = "the tool cuts, and no spindle speed is known: the force of such cuts is left out",
                .expected = "S and M3 in the program, or --spindle-speed",
                .text = {}});
}

}  // namespace

std::size_t CutLoads::add(const Segment& feed) {
  loads_.push_back({feed.source.line, static_cast<float>(feed.curve.length().value()), 0});
  return loads_.size() - 1;
}

void CutLoads::raise(std::size_t index, double newtons_per_speed) {
  float& load = loads_[index].newtons_per_speed;
  load = std::max(load, static_cast<float>(newtons_per_speed));
}

bool CutLoads::fits(const Load& load, const Segment& feed) const {
  constexpr double of_a_float = 1e-5;
  const double length = feed.curve.length().value();
  return load.line == feed.source.line && std::abs(double{load.length} - length) <= of_a_float * (1 + length);
}

double CutLoads::of(const PlannedMove& move) {
  const Segment& segment = move.segment;
  if (segment.rapid || segment.takes_up_backlash) return 0;
  const bool is_next_part = move.from() > Mm(0);
  if (is_next_part) return present_;
  // A feed that is missing on one side must not shift all that follow.
  constexpr std::size_t most_ahead = 64;
  for (std::size_t i = next_; i < std::min(next_ + most_ahead, loads_.size()); ++i) {
    if (!fits(loads_[i], segment)) continue;
    next_ = i + 1;
    present_ = loads_[i].newtons_per_speed;
    return present_;
  }
  ++unknown_;
  present_ = 0;
  return 0;
}

std::optional<CutOutcome> cut_by_program(const StockJob& job, const StockWishes& wishes, const CutMaterial& material,
                                         Diagnostics& findings) {
  Diagnostics known;  // the check has shown them
  const FeedLook look = look_at_feeds(job, wishes, known);
  const auto tools = shapes_of(job, wishes, look);
  if (!tools) return std::nullopt;
  Result<HeightField, std::string> field = stock_field(wishes, look);
  if (!field) {
    fail(exit_bad_program, field.error());
    return std::nullopt;
  }
  CutOutcome outcome{.loads = {},
                     .simulation = {.program = job.program.name(),
                                    .target = {},
                                    .field = std::move(*field),
                                    .numbers = {},
                                    .tools = *tools,
                                    .summary = CutSummary(*tools)},
                     .force = {}};
  Simulation& simulation = outcome.simulation;
  simulation.volume_before = simulation.field.volume();
  for (const auto& [number, line] : look.tools) simulation.numbers.push_back(number);

  ForceMeter meter(outcome, material);
  StockCutter cutter(simulation.field,
                     {.tools = *tools, .clamps = wishes.clamps, .threads = std::thread::hardware_concurrency()},
                     [&](const MoveCut& cut) { meter.watch(cut); });
  SimulatedPath path(job.program.again(), options_above(job, look, simulation.field), job.machine, known);
  const auto places = look.places();
  TipMove move;
  while (path.next(move)) {
    const auto place = places.find(move.tool);
    if (place == places.end() || move.segment->takes_up_backlash) continue;
    const StockMove kind{.line = move.segment->source.line,
                         .tool = place->second,
                         .rapid = move.segment->rapid,
                         .time = move.time,
                         .rounding = move.segment->tolerance};
    if (kind.rapid) {
      cutter.cut(move.segment->curve, Vector3::of(move.zero), kind);
    } else {
      const double piece = std::max((*tools)[place->second].cutter.radius.value(), shortest_piece);
      cut_feed(cutter, meter, move, kind, outcome.loads.add(*move.segment), piece);
    }
  }
  cutter.finish();
  meter.finish();
  add_findings(simulation, findings);
  add_silent(meter.silent_line(), simulation.program, findings);
  return outcome;
}

std::string to_text(const CutOutcome& cut) {
  constexpr double mm3_a_cm3 = 1000;
  const CutSummary& summary = cut.simulation.summary;
  std::string text = fmt::format("cut             {:.2f} cm\u00B3 removed", summary.volume() / mm3_a_cm3);
  if (summary.rate().value > 0) {
    text += fmt::format(", {:.4g} mm\u00B3/s at most, line {}", summary.rate().value, summary.rate().line);
  }
  if (cut.force.value > 0) text += fmt::format("; {:.3g} N at most, line {}", cut.force.value, cut.force.line);
  return text + "\n";
}

nlohmann::ordered_json as_json(const CutOutcome& cut) {
  const CutSummary& summary = cut.simulation.summary;
  return {{"removed_mm3", summary.volume()},
          {"most_rate_mm3_s", summary.rate().value},
          {"most_force_n", cut.force.value},
          {"most_force_line", cut.force.line},
          {"feeds_without_force", cut.loads.unknown()}};
}

}  // namespace passo
