#include "part_job_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <thread>
#include <utility>

#include "part_job_teeth.hpp"
#include "part_job_tool_use.hpp"
#include <fmt/format.h>

#include "passo/cutting/stock_job.hpp"
#include "passo/diagnostics/file_bytes.hpp"
#include "passo/operations/length_text.hpp"

namespace passo {
namespace {

constexpr double least_depth = 0.005;         // mm; less is rounding
constexpr std::size_t most_points = 200'000;  // of a picture

Diagnostic trouble(const char* code, const TrialProgram& program, std::uint32_t line, std::string message,
                   std::string expected) {
  return {.severity = Severity::error,
          .code = code,
          .file = program.file,
          .place = {.line = line, .column = 0, .length = 1},
          .message = std::move(message),
          .expected = std::move(expected),
          .text = {}};
}

std::string place_words(const Vector3& place) {
  return fmt::format("X{:.2f} Y{:.2f} Z{:.2f}", place.x, place.y, place.z);
}

bool is_around_boss(const PartOperation& operation) {
  const auto* const thread = std::get_if<CamThreadArguments>(&operation.arguments);
  return thread != nullptr && thread->external;
}

// "a clearance above 25, the top of 'jaw', or a clamp elsewhere", for a rapid that goes `deep` mm into the clamp.
std::string way_over(const PartJob& job, const PartOperation& operation, const PartClamp& clamp, double deep) {
  constexpr double rounding = 0.01;
  const double unit = *mm_of_unit(job.units);
  const auto height = [&](const char* option) {
    const Result<Mm, std::string> read = parse_length(option, option_text(operation, option), unit);
    return read ? read->value() : 0.0;
  };
  const bool is_change = clamp.height - deep > height("change-height") - rounding;
  const char* const option = is_change ? "change-height" : "clearance";
  if (height(option) > clamp.height) return "a clamp elsewhere";
  return fmt::format("a {} above {:g}, the top of '{}', or a clamp elsewhere", option, clamp.height / unit, clamp.name);
}

class ProgramTrial {
 public:
  ProgramTrial(const PartJob& job, const TrialProgram& program, Trial& trial, Diagnostics& findings)
      : job_(job), program_(program), trial_(trial), findings_(findings) {}

  void run();

 private:
  StockWishes wishes() const;
  void record(const MoveCut& cut);
  void judge(const MoveCut& cut, const PartOperation& operation);
  void judge_depth(const Vector3& low, const Vector3& high, std::uint32_t line, std::size_t tool);
  void report_below();
  void collect_teeth(StockCutter& cutter, const TipMove& move, const StockMove& kind);
  void judge_teeth();
  bool clamps_are_small();
  void report(const char* code, const MoveCut& cut, const PartOperation& operation, const std::string& what,
              std::string expected);
  void draw(const Curve& curve, const Vector3& zero, std::uint32_t line);
  void draw_rapid(const Curve& curve, const Vector3& zero);
  std::size_t operation_at(std::uint32_t line) const;
  const PartClamp* clamp_at(const Vector3& place) const;

  const PartJob& job_;
  const TrialProgram& program_;
  Trial& trial_;
  Diagnostics& findings_;
  std::vector<ToolShape> tools_;
  std::vector<std::int32_t> numbers_;
  // How far below the stock an operation goes with a tool.
  struct Below {
    double depth = 0;
    Vector3 place{};
    std::uint32_t line = 0;
  };
  std::map<std::pair<std::size_t, std::size_t>, Below> deepest_;  // by operation and tool
  std::map<std::string, std::size_t> reported_;                   // what was reported of an operation
  TeethWay teeth_;                                                // the feeds around a boss, up to now
  std::size_t points_ = 0;
  bool is_somewhere_ = false;  // the program has moved to a position in X and Y; before, the tool may be anywhere
};

StockWishes ProgramTrial::wishes() const {
  StockWishes wishes;
  for (const auto& [number, tool] : job_.tools) wishes.shapes.emplace(number, tool.shape);
  constexpr double clamp_depth = 900;  // mm
  for (const PartClamp& clamp : job_.clamps) {
    wishes.clamps.push_back(
        {{clamp.x[0], clamp.y[0], clamp.height - clamp_depth}, {clamp.x[1], clamp.y[1], clamp.height}});
  }
  if (job_.stock) {
    const PartStock& stock = *job_.stock;
    wishes.block.x = {stock.x, stock.x + stock.width};
    wishes.block.y = {stock.y, stock.y + stock.length};
    wishes.block.z = {-stock.thickness, 0.0};
  }
  return wishes;
}

std::size_t ProgramTrial::operation_at(std::uint32_t line) const {
  const auto after = std::ranges::upper_bound(program_.first_lines, line);
  const auto at = after == program_.first_lines.begin() ? 0 : after - program_.first_lines.begin() - 1;
  return program_.operations[static_cast<std::size_t>(at)];
}

const PartClamp* ProgramTrial::clamp_at(const Vector3& place) const {
  const PartClamp* nearest = nullptr;
  double least = 1e300;
  for (const PartClamp& clamp : job_.clamps) {
    const double x = std::max({clamp.x[0] - place.x, 0.0, place.x - clamp.x[1]});
    const double y = std::max({clamp.y[0] - place.y, 0.0, place.y - clamp.y[1]});
    if (std::hypot(x, y) >= least) continue;
    least = std::hypot(x, y);
    nearest = &clamp;
  }
  return nearest;
}

// The first place of each trouble of an operation, with the number of further moves.
void ProgramTrial::report(const char* code, const MoveCut& cut, const PartOperation& operation, const std::string& what,
                          std::string expected) {
  const std::string key = fmt::format("{} {} {}", code, operation.title, expected);
  if (reported_[key]++ > 0) return;
  findings_.add(trouble(code, program_, cut.move.line,
                        fmt::format("'{}', tool {}: {}", operation.title, numbers_[cut.move.tool], what),
                        std::move(expected)));
}

void ProgramTrial::judge(const MoveCut& cut, const PartOperation& operation) {
  const char* const move = cut.move.rapid ? "a rapid" : "a feed move";
  if (cut.clamp > least_depth) {
    const PartClamp* const clamp = clamp_at(cut.clamp_place);
    report("job.clamp", cut, operation,
           fmt::format("{} goes {:.2f} mm into '{}' at {}", move, cut.clamp, clamp != nullptr ? clamp->name : "a clamp",
                       place_words(cut.clamp_place)),
           clamp == nullptr ? "no clamp in the way"
           : cut.move.rapid ? way_over(job_, operation, *clamp, cut.clamp)
                            : fmt::format("'{}' farther away from the cut", clamp->name));
  }
  if (cut.move.rapid && cut.depth > least_depth) {
    report("job.rapid-in-stock", cut, operation,
           fmt::format("a rapid goes {:.2f} mm into the stock at {}", cut.depth, place_words(cut.place)),
           "rapids above the stock");
  }
  const ToolShape& tool = tools_[cut.move.tool];
  if (tool.neck_radius > Mm(0) && !cut.move.rapid && cut.depth > least_depth) {
    report("job.neck", cut, operation,
           fmt::format("the neck goes {:.2f} mm into the stock at {}", cut.depth, place_words(cut.place)),
           is_around_boss(operation) ? "an operation before it that clears the stock around the boss, deep enough"
                                     : "an operation before it that makes the bore, wide and deep enough");
  }
  if (cut.holder > least_depth) {
    report("job.holder", cut, operation,
           fmt::format("the holder goes {:.2f} mm into the stock at {}", cut.holder, place_words(cut.holder_place)),
           "a tool with a longer stick-out (stick_out_mm), or less depth");
  }
}

// Where the material is gone already, a feed below the stock cuts into the table all the same. Of the layers of an
// operation, the deepest one is reported.
void ProgramTrial::judge_depth(const Vector3& low, const Vector3& high, std::uint32_t line, std::size_t tool) {
  if (!job_.stock) return;
  const PartStock& stock = *job_.stock;
  const double below = -low.z - stock.thickness;
  const bool is_over_stock =
      high.x > stock.x && low.x < stock.x + stock.width && high.y > stock.y && low.y < stock.y + stock.length;
  if (below <= stock.margin_below + least_depth || !is_over_stock) return;
  Below& deepest = deepest_[{operation_at(line), tool}];
  if (below <= deepest.depth) return;
  deepest = {below, low, line};
}

void ProgramTrial::report_below() {
  for (const auto& [whose, deepest] : deepest_) {
    const auto& [operation, tool] = whose;
    report("job.below", MoveCut{.move = {.line = deepest.line, .tool = tool}}, job_.operations[operation],
           fmt::format("the tip goes {:.2f} mm below the stock at {}", deepest.depth, place_words(deepest.place)),
           fmt::format("at most {:g} mm: a depth of {:g} mm or less, or a larger stock.below", job_.stock->margin_below,
                       job_.stock->thickness + job_.stock->margin_below));
  }
}

void ProgramTrial::record(const MoveCut& cut) {
  const std::size_t index = operation_at(cut.move.line);
  TriedOperation& tried = trial_.operations[index];
  ++tried.moves;
  tried.removed_mm3 += cut.volume;
  if (cut.move.rapid) {
    tried.rapid_mm += cut.way;
  } else {
    tried.cut_mm += cut.way;
    tried.cut_s += cut.move.time.value();
    if (cut.volume > 0) {
      tried.pass_mm = std::max(tried.pass_mm, cut.depth);
      tried.plunges = tried.plunges || (cut.way_level <= 1e-6 && cut.depth > least_depth);
    }
  }
  judge(cut, job_.operations[index]);
}

// The feeds around a boss. The stock must be as it is before them.
void ProgramTrial::collect_teeth(StockCutter& cutter, const TipMove& move, const StockMove& kind) {
  if (!is_around_boss(job_.operations[operation_at(kind.line)])) return;
  if (teeth_.empty()) cutter.finish();
  teeth_.add(move.segment->curve, Vector3::of(move.zero), kind.line, kind.tool, tools_[kind.tool]);
}

void ProgramTrial::judge_teeth() {
  if (teeth_.empty()) return;
  const std::size_t tool = teeth_.tool();
  const auto hit = teeth_.take_hit(*trial_.field, tools_[tool]);
  if (!hit) return;
  report(
      "job.teeth", MoveCut{.move = {.line = hit->line, .tool = tool}}, job_.operations[operation_at(hit->line)],
      fmt::format("the teeth go {:.2f} mm into the stock at {}, beside the boss at X{:.2f} Y{:.2f}", hit->depth,
                  place_words(hit->place), hit->axis.x, hit->axis.y),
      fmt::format("the stock around the boss cleared before, to {:.2f} mm from its axis and as deep as the thread, or "
                  "a thread mill of smaller diameter",
                  hit->reach));
}

// Adds a feed to the picture.
void ProgramTrial::draw(const Curve& curve, const Vector3& zero, std::uint32_t line) {
  TriedOperation& tried = trial_.operations[operation_at(line)];
  const double low = Vector3::of(curve.extents().low).z - zero.z;
  tried.depth_mm = std::max(tried.depth_mm, -low);
  if (points_ > most_points) return;
  const double length = curve.length().value();
  const bool is_line = curve.shape() == Curve::Shape::line;
  const auto pieces = is_line ? 1 : static_cast<int>(std::clamp(length / 0.5, 1.0, 64.0));
  const auto point = [&](int i) {
    const Vector3 at = Vector3::of(curve.at(Mm(length * i / pieces)));
    return MillPoint{.at = {to_nanometres(Mm(at.x - zero.x)), to_nanometres(Mm(at.y - zero.y))}};
  };
  const MillPoint first = point(0);
  const bool goes_on = !tried.ways.empty() && tried.ways.back().back().at == first.at;
  if (!goes_on) tried.ways.push_back({first});
  for (int i = 1; i <= pieces; ++i) tried.ways.back().push_back(point(i));
  points_ += static_cast<std::size_t>(pieces);
}

// Adds a rapid to the picture, except the first one, which begins where the machine happens to be.
void ProgramTrial::draw_rapid(const Curve& curve, const Vector3& zero) {
  const auto point = [&](const Vector3& at) {
    return DrawnPoint{to_nanometres(Mm(at.x - zero.x)), to_nanometres(Mm(at.y - zero.y))};
  };
  const DrawnPoint from = point(Vector3::of(curve.start()));
  const DrawnPoint to = point(Vector3::of(curve.end()));
  if (from == to || points_ > most_points) return;
  if (!std::exchange(is_somewhere_, true)) return;
  const bool goes_on = !trial_.rapids.empty() && trial_.rapids.back().back() == from;
  if (!goes_on) trial_.rapids.push_back({from});
  trial_.rapids.back().push_back(to);
  ++points_;
}

// The cutter passes over clamps that have too many cells, so there must be none.
bool ProgramTrial::clamps_are_small() {
  bool are_small = true;
  const StockWishes wanted = wishes();
  for (std::size_t i = 0; i < wanted.clamps.size(); ++i) {
    if (HeightField::create(wanted.clamps[i], StockCutter::clamp_cell(wanted.clamps[i], *trial_.field))) continue;
    findings_.add(of_file("job.clamp-size", job_.file, fmt::format("'{}' is too large", job_.clamps[i].name),
                          "a clamp only as large as the part of it that the tools can reach"));
    are_small = false;
  }
  return are_small;
}

void ProgramTrial::run() {
  const StockWishes wanted = wishes();
  const StockJob stock_job{ProgramReader::from_text(program_.file, program_.text), {}, nullptr};
  Diagnostics found;
  const FeedLook look = survey_feeds(stock_job, wanted, found);
  for (const Diagnostic& finding : found.all()) findings_.add(finding);
  if (found.any_error()) return;
  auto shapes = shapes_of(stock_job, wanted, look);
  if (!shapes) return;  // a job's tools all have shapes
  tools_ = std::move(*shapes);
  numbers_ = look.numbers();
  if (!trial_.field) {
    auto field = stock_field(wanted, look);
    if (!field) return;
    trial_.field.emplace(std::move(*field));
    trial_.stock_mm3 = trial_.field->volume();
  }
  if (!clamps_are_small()) return;
  CutHooks hooks;
  hooks.cut = [this](const MoveCut& cut) { record(cut); };
  hooks.feed = [this](StockCutter& cutter, const TipMove& move, const StockMove& kind) {
    const Vector3 zero = Vector3::of(move.zero);
    const Box box = move.segment->curve.extents();
    judge_depth(Vector3::of(box.low) - zero, Vector3::of(box.high) - zero, kind.line, kind.tool);
    draw(move.segment->curve, zero, kind.line);
    collect_teeth(cutter, move, kind);
    cutter.cut(move.segment->curve, Vector3::of(move.zero), kind);
  };
  hooks.rapid = [this](const TipMove& move, const StockMove&) {
    judge_teeth();
    draw_rapid(move.segment->curve, Vector3::of(move.zero));
  };
  const unsigned threads = std::clamp(std::thread::hardware_concurrency(), 1U, 64U);
  cut_stock(stock_job, wanted, look, tools_, threads, *trial_.field, hooks);
  judge_teeth();
  report_below();
}

}  // namespace

Trial try_programs(const PartJob& job, const std::vector<TrialProgram>& programs, Diagnostics& findings) {
  Trial trial;
  trial.operations.resize(job.operations.size());
  for (const TrialProgram& program : programs) ProgramTrial(job, program, trial, findings).run();
  return trial;
}

}  // namespace passo
