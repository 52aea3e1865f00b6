#include "passo/cutting/cut_loads.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <thread>
#include <utility>

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
    if (volume_ > 0 && feeds_.back().revolutions > 0) {
      const double way = std::max(way_, least_cells * outcome_.simulation.field.cell());
      const double reach = reach_at(outcome_.simulation.tools[tool_].cutter, depth_);
      const double cutting_speed = 2 * std::numbers::pi * reach * feeds_.back().revolutions / seconds_per_minute;
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

}  // namespace

CutOutcome cut_with_force(const StockJob& job, const StockWishes& wishes, const FeedLook& look,
                          const std::vector<ToolShape>& tools, HeightField field, const CutMaterial& material) {
  CutOutcome outcome{.loads = {},
                     .simulation = {.program = job.program.name(),
                                    .target = {},
                                    .field = std::move(field),
                                    .numbers = look.numbers(),
                                    .tools = tools,
                                    .summary = CutSummary(tools)},
                     .force = {}};
  Simulation& simulation = outcome.simulation;
  simulation.volume_before = simulation.field.volume();
  ForceMeter meter(outcome, material);
  CutHooks hooks;
  hooks.cut = [&](const MoveCut& cut) { meter.watch(cut); };
  hooks.feed = [&](StockCutter& cutter, const TipMove& move, const StockMove& kind) {
    const double piece = std::max(tools[kind.tool].cutter.radius.value(), shortest_piece);
    cut_feed(cutter, meter, move, kind, outcome.loads.add(*move.segment), piece);
  };
  cut_stock(job, wishes, look, tools, std::thread::hardware_concurrency(), simulation.field, hooks);
  meter.finish();
  outcome.silent_line = meter.silent_line();
  return outcome;
}

}  // namespace passo
