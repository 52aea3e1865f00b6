#include "passo/carve/relief_program.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "relief_passes.hpp"
#include "removal_rate_control.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// Text that may stand in a comment of G-code.
std::string without_brackets(std::string_view text) {
  std::string words(text.substr(0, 120));
  for (char& c : words) {
    if (c == '(' || c == ')' || c == '%' || static_cast<unsigned char>(c) < ' ') c = '_';
  }
  return words;
}

class ReliefProgram {
 public:
  ReliefProgram(const HeightGrid& surface, const ReliefProgramOptions& options, const ReliefSink& sink,
                const ReliefProgress& progress)
      : surface_(surface),
        options_(options),
        progress_(progress),
        writer_(sink),
        pass_(writer_, options),
        lattice_{.x0 = options.x0.value(),
                 .y0 = options.y0.value(),
                 .pitch_x = surface.pitch_x.value(),
                 .pitch_y = surface.pitch_y.value()},
        removal_(writer_) {}

  ReliefReport write(bool wants_carved);

 private:
  using Cut = void (*)(ReliefPass&, const HeightGrid&, const NodeLattice&, const std::function<void(double)>&);

  void begin();
  Mm change_height() const { return std::max(options_.change.height, options_.clearance); }
  void watch_stock();
  void begin_tool(const char* what, const ReliefTool& tool);
  void end_tool(const char* what, const ReliefTool& tool, Mm step);
  void cut(Cut way, const HeightGrid& surface, bool turned);
  void finish();
  // What the report is to hold of this cutter.
  void record(const ReliefTool& tool, Mm overrun, const std::function<void()>& act);

  const HeightGrid& surface_;
  const ReliefProgramOptions& options_;
  const ReliefProgress& progress_;
  MoveWriter writer_;
  ReliefPass pass_;
  NodeLattice lattice_;
  ReliefReport report_;
  std::optional<StockInWork> stock_;
  RemovalRateControl removal_;
  bool wants_carved_ = false;
  int tools_ = 1;
  int tool_ = 0;
  double parts_done_ = 0;
  double parts_ = 1;
};

void ReliefProgram::begin() {
  writer_.line("({}: a relief, by passo cam relief)", without_brackets(options_.name));
  for (const std::string& words : options_.words) writer_.line("({})", without_brackets(words));
  writer_.line("(Z0 is the top of the stock)");
  writer_.line("G17 G21 G40 G80 G90 G94");
  writer_.line("G0 Z{:g}", change_height().value());
}

void ReliefProgram::begin_tool(const char* what, const ReliefTool& tool) {
  ++tool_;
  const std::string words = describe(tool.cutter);
  writer_.line("");
  writer_.line("({}: {})", what, words);
  if (tools_ > 1) {
    if (tool_ > 1) writer_.line("G0 Z{:g}", change_height().value());
    if (tool_ > 1 && !options_.change.coolant.empty()) writer_.line("M9");
    if (tool_ > 1 && options_.change.spindle) writer_.line("M5");
    writer_.line("G0 X{:g} Y{:g}", options_.change.park.x.value(), options_.change.park.y.value());
    writer_.line("(MSG, tool {}: {})", tool_, words);
    writer_.line("T{} M6", tool_);
    writer_.line("G0 Z{:g}", change_height().value());
  }
  if (options_.change.spindle) {
    writer_.line("M3 S{}", *options_.change.spindle);
    const double seconds = options_.change.spindle_seconds;
    if (seconds > 0) writer_.line("G4 P{:g} (the spindle reaches its speed)", seconds);
  }
  if (!options_.change.coolant.empty()) writer_.line("{}", options_.change.coolant);
  writer_.begin_at(carved_height(options_.clearance.value()), carved_height(change_height().value()));
  writer_.set_feeds({.along = tool.feed, .down = tool.plunge});
  if (!stock_) return;
  stock_->use(tool.cutter);
  const double fastest = tool.fastest.value() > 0 ? tool.fastest / tool.feed : 1;
  removal_.set({.mm3_a_minute = tool.removal, .fastest = std::max(1.0, fastest)}, tool.cutter.radius);
}

void ReliefProgram::end_tool(const char* what, const ReliefTool& tool, Mm step) {
  pass_.lift();
  const double removal = removal_.take_most();
  const CarvingCost cost = writer_.take_cost();
  report_.parts.push_back({.what = what,
                           .tool = describe(tool.cutter),
                           .step = step,
                           .moves = cost.moves,
                           .arcs = cost.arcs,
                           .cut = Mm(cost.cut_mm),
                           .rapid = Mm(cost.rapid_mm),
                           .removal = removal,
                           .minutes = cost.feed_minutes});
}

void ReliefProgram::cut(Cut way, const HeightGrid& surface, bool turned) {
  NodeLattice lattice = lattice_;
  lattice.turned = turned;
  way(pass_, surface, lattice, [&](double share) { progress_((parts_done_ + share) / parts_); });
  parts_done_ += 1;
}

void ReliefProgram::record(const ReliefTool& tool, Mm overrun, const std::function<void()>& act) {
  if (!wants_carved_) {
    act();
    return;
  }
  const auto margin = [&](Mm pitch) { return static_cast<std::size_t>(std::ceil(overrun / pitch)) + 1; };
  TipRecord tips(surface_, margin(surface_.pitch_x), margin(surface_.pitch_y));
  pass_.set_record(&tips);
  act();
  pass_.set_record(nullptr);
  tips.carve(tool.cutter, options_.threads, report_.carved);
}

void ReliefProgram::finish() {
  if (options_.way == FinishStrategy::contours) cut(finish_contours, surface_, false);
  if (options_.way == FinishStrategy::spiral) cut(finish_spiral, surface_, false);
  const bool has_gaps = !options_.area.is_all() || options_.rows.has_even_scallops ||
                        options_.rows.direction != RowDirection::there_and_back;
  const Cut rows = options_.rows.angle.value != 0 ? finish_rows_at_angle : has_gaps ? finish_rows_in_area : finish_rows;
  if (options_.way == FinishStrategy::rows || options_.way == FinishStrategy::both) cut(rows, surface_, false);
  if (options_.way == FinishStrategy::columns || options_.way == FinishStrategy::both) {
    cut(rows, surface_.transposed(), true);
  }
}

// Only where somebody asks for it: it costs time.
void ReliefProgram::watch_stock() {
  const auto holds = [](const auto& part) { return part && part->tool.removal > 0; };
  const bool is_asked = !options_.area.is_all() || options_.rows.has_even_scallops ||
                        options_.rows.direction != RowDirection::there_and_back || options_.rows.angle.value != 0 ||
                        options_.way == FinishStrategy::contours || options_.rows.has_pencil ||
                        options_.finish.removal > 0 ||
                        (options_.roughing && options_.roughing->way == RoughStrategy::offsets) ||
                        holds(options_.roughing) || holds(options_.rest);
  if (!is_asked) return;
  Mm beyond = finishing_overrun(options_);
  if (options_.roughing) beyond = std::max(beyond, roughing_overrun(options_));
  if (options_.rest) beyond = std::max(beyond, rest_overrun(options_));
  stock_.emplace(surface_, options_, beyond, [this](std::uint32_t number, double mm3) { removal_.told(number, mm3); });
  pass_.set_stock(&*stock_);
  removal_.set_stock(&*stock_);
  writer_.set_taker(
      {.take = [this](const CarvedCut& cut) { removal_.add(cut); }, .settle = [this] { removal_.settle(); }});
}

ReliefReport ReliefProgram::write(bool wants_carved) {
  wants_carved_ = wants_carved;
  if (wants_carved) {
    report_.carved = {.columns = surface_.columns, .rows = surface_.rows};
    report_.carved.heights.assign(surface_.heights.size(), 0.0F);
  }
  tools_ = 1 + (options_.roughing ? 1 : 0) + (options_.rest ? 1 : 0);
  parts_ = tools_ + (options_.way == FinishStrategy::both ? 1 : 0) + (options_.rows.has_pencil ? 1 : 0);
  begin();
  watch_stock();
  const auto nodes_step = [&](const ReliefTool& tool, bool is_roughing, Mm pitch) {
    return pitch * static_cast<double>(step_nodes(step_of(tool, options_, is_roughing), pitch));
  };
  if (options_.roughing) {
    const ReliefTool& tool = options_.roughing->tool;
    begin_tool("roughing", tool);
    record(tool, roughing_overrun(options_), [&] {
      cut(options_.roughing->way == RoughStrategy::offsets ? rough_by_offsets : rough_out, surface_, false);
    });
    end_tool("roughing", tool, nodes_step(tool, true, surface_.pitch_y));
  }
  begin_tool("finishing", options_.finish);
  record(options_.finish, finishing_overrun(options_), [&] { finish(); });
  const Mm pitch = options_.way == FinishStrategy::columns ? surface_.pitch_x : surface_.pitch_y;
  end_tool("finishing", options_.finish,
           options_.rows.angle.value != 0 ? step_of(options_.finish, options_, false)
                                          : nodes_step(options_.finish, false, pitch));
  if (options_.rest) {
    const ReliefTool& tool = options_.rest->tool;
    begin_tool("rest finishing", tool);
    record(tool, rest_overrun(options_), [&] { cut(finish_rest, surface_, false); });
    end_tool("rest finishing", tool, nodes_step(tool, false, surface_.pitch_y));
  }
  if (options_.rows.has_pencil) {
    const ReliefTool& tool = options_.rest ? options_.rest->tool : options_.finish;
    writer_.restore_plane();
    writer_.line("(pencil: along inner edges)");
    record(tool, options_.rest ? rest_overrun(options_) : finishing_overrun(options_),
           [&] { cut(finish_pencil, surface_, false); });
    end_tool("pencil", tool, Mm(0));
  }
  writer_.restore_plane();
  writer_.line("G0 Z{:g}", change_height().value());
  if (!options_.change.coolant.empty()) writer_.line("M9");
  if (options_.change.spindle) writer_.line("M5");
  writer_.line("G0 X{:g} Y{:g}", options_.change.park.x.value(), options_.change.park.y.value());
  writer_.line("M2");
  writer_.flush();
  return std::move(report_);
}

}  // namespace

ReliefReport write_relief(const HeightGrid& surface, const ReliefProgramOptions& options, const ReliefSink& sink,
                          const ReliefProgress& progress, bool wants_carved) {
  return ReliefProgram(surface, options, sink, progress).write(wants_carved);
}

}  // namespace passo
