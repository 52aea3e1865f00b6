#include "relief_passes.hpp"

#include <algorithm>
#include <cmath>

#include "row_arcs.hpp"

namespace passo {

TipRecord::TipRecord(const HeightGrid& surface, std::size_t margin_x, std::size_t margin_y)
    : margin_x_(static_cast<std::ptrdiff_t>(margin_x)),
      margin_y_(static_cast<std::ptrdiff_t>(margin_y)),
      depths_{.columns = surface.columns + 2 * margin_x,
              .rows = surface.rows + 2 * margin_y,
              .pitch_x = surface.pitch_x,
              .pitch_y = surface.pitch_y} {
  depths_.heights.assign(depths_.columns * depths_.rows, DroppedCutter::nothing);
}

void TipRecord::add(const NodeLattice& lattice, const NodeRun& run) {
  for (std::size_t i = 0; i < run.heights.size(); ++i) {
    const std::ptrdiff_t x = (lattice.turned ? run.row_at(i) : run.column_at(i)) + margin_x_;
    const std::ptrdiff_t y = (lattice.turned ? run.column_at(i) : run.row_at(i)) + margin_y_;
    float& depth = depths_.heights[static_cast<std::size_t>(y) * depths_.columns + static_cast<std::size_t>(x)];
    depth = std::max(depth, -run.heights[i]);
  }
}

void TipRecord::add(const std::vector<CarvedCut>& way, const NodeLattice& lattice, const TipSurface& surface) {
  const double pitch = std::min(surface.pitch_x(), surface.pitch_y());
  for (const CarvedCut& cut : way) {
    const double parts = std::ceil(length_of(cut) / pitch);
    for (double i = 0; i <= parts; ++i) {
      const CarvedPlace place = place_on(cut, parts > 0 ? i / parts : 1);
      const auto node = [](std::int64_t at, double zero, double apart) {
        return static_cast<std::ptrdiff_t>(std::llround((static_cast<double>(at) / carved_units - zero) / apart));
      };
      const std::ptrdiff_t x = node(place.x, lattice.x0, lattice.pitch_x);
      const std::ptrdiff_t y = node(place.y, lattice.y0, lattice.pitch_y);
      const double least =
          surface.at({static_cast<double>(x) * surface.pitch_x(), static_cast<double>(y) * surface.pitch_y()});
      const auto down = static_cast<float>(-std::max(least, static_cast<double>(place.z) / carved_units));
      float& depth = depths_.heights[static_cast<std::size_t>(y + margin_y_) * depths_.columns +
                                     static_cast<std::size_t>(x + margin_x_)];
      depth = std::max(depth, down);
    }
  }
}

// What is left is the lowest envelope of all places of the cutter: the same dilation, upside down.
void TipRecord::carve(const Cutter& cutter, unsigned threads, CarvedSurface& carved) const {
  const DroppedCutter lowest(depths_, cutter, 0, CutterTable::Kind::sampled);
  std::vector<DroppedCutter::Scratch> scratch(threads);
  std::vector<std::vector<float>> rows(threads, std::vector<float>(carved.columns));
  for_each_row(carved.rows, threads, [&](std::size_t row, std::size_t thread) {
    lowest.heights(static_cast<std::ptrdiff_t>(row) + margin_y_, margin_x_, rows[thread], scratch[thread]);
    float* const to = &carved.heights[row * carved.columns];
    for (std::size_t i = 0; i < carved.columns; ++i) to[i] = std::min(to[i], -rows[thread][i]);
  });
}

void ReliefPass::lift() {
  is_at_work_ = false;
  writer_.rapid_up_down(carved_height(options_.clearance.value()));
}

void ReliefPass::cut(const NodeRun& run) {
  constexpr double least_tolerance = 0.001;  // of arcs, mm
  if (options_.arcs && options_.tolerance.value() >= least_tolerance) {
    cut_run_with_arcs(writer_, lattice_, run, options_.tolerance.value());
  } else {
    cut_run(writer_, lattice_, run, options_.tolerance.value());
  }
  if (record_ != nullptr) record_->add(lattice_, run);
}

void ReliefPass::go_to_work(const NodeRun& run, double free_above) {
  approach(lattice_.at(run.column, run.row, 0), free_above);
  const double pitch = run.step_x != 0 ? lattice_.pitch_x : lattice_.pitch_y;
  const double turned_pitch = run.step_x != 0 ? lattice_.pitch_y : lattice_.pitch_x;
  const double a_node = (lattice_.turned ? turned_pitch : pitch) * std::tan(options_.ramp.value);
  const double deep = free_above - static_cast<double>(run.heights.front());
  if (options_.ramps && deep > 0 && run.heights.size() > 1) {
    constexpr double most_turns = 40;
    const double nodes = std::ceil(deep / a_node);
    const auto there = static_cast<double>(run.heights.size() - 1);
    if (nodes <= most_turns * there) {
      ramp_in(run, free_above, static_cast<std::size_t>(std::min(nodes, there)));
      return;
    }
  }
  writer_.cut_to(lattice_.at(run.column, run.row, carved_height(static_cast<double>(run.heights.front()))));
}

// There and back over the first nodes of the run, deeper at each, and back at the depth of the run.
void ReliefPass::ramp_in(const NodeRun& run, double free_above, std::size_t nodes) {
  const bool along_x = (run.step_x != 0) != lattice_.turned;
  const double a_node = (along_x ? lattice_.pitch_x : lattice_.pitch_y) * std::tan(options_.ramp.value);
  NodeRun part = run;
  part.heights.resize(nodes + 1);
  const CarvedPlace first = lattice_.at(run.column, run.row, carved_height(free_above));
  writer_.cut_to(first);
  double ramp = free_above;
  bool is_deep = false;
  bool is_back = true;  // at the first node
  while (!is_deep || !is_back) {
    NodeRun turn = is_back ? part : part.backwards();
    is_deep = true;
    for (float& height : turn.heights) {
      if (ramp > static_cast<double>(height)) {
        is_deep = false;
        height = static_cast<float>(ramp);
      }
      ramp -= a_node;
    }
    ramp += a_node;  // the turn's last node is the next one's first
    cut_run(writer_, lattice_, turn, options_.tolerance.value());
    is_back = !is_back;
  }
}

RunsBelowTop::RunsBelowTop(ReliefPass& pass)
    : pass_(pass), longest_(2 * (pass.options().clearance + pass.options().finish.cutter.radius).value()) {}

double RunsBelowTop::length_of(const NodeRun& run, std::size_t first, std::size_t last) const {
  const bool along_x = (run.step_x != 0) != pass_.lattice().turned;
  return static_cast<double>(last - first) * (along_x ? pass_.lattice().pitch_x : pass_.lattice().pitch_y);
}

void RunsBelowTop::cut_part(const NodeRun& run, std::size_t first, std::size_t last) {
  NodeRun part{.column = run.column_at(first), .row = run.row_at(first), .step_x = run.step_x, .step_y = run.step_y};
  part.heights.assign(run.heights.begin() + static_cast<std::ptrdiff_t>(first),
                      run.heights.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  if (!is_down_) pass_.go_to_work(part, 0);
  is_down_ = true;
  pass_.cut(part);
}

void RunsBelowTop::cut(const NodeRun& run) {
  constexpr float least = 0.001F;  // mm; less is no work
  const std::size_t last = run.heights.size() - 1;
  std::size_t from = 0;  // where the tool is, or was when it was lifted
  for (std::size_t i = 0; i <= last;) {
    if (run.heights[i] >= -least) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < last && run.heights[end + 1] < -least) ++end;
    const std::size_t begin = std::max(from, i > 0 ? i - 1 : 0);
    if (is_down_ && gone_ + length_of(run, from, begin) > longest_) is_down_ = false;
    if (is_down_) {
      for (const NodeRun& air : air_) pass_.cut(air);
    }
    air_.clear();
    gone_ = 0;
    const std::size_t after = std::min(end + 1, last);
    cut_part(run, is_down_ ? from : begin, after);
    from = after;
    i = end + 1;
  }
  gone_ += length_of(run, from, last);
  if (!is_down_ || from == last) return;
  if (gone_ > longest_) {
    is_down_ = false;
    air_.clear();
    return;
  }
  NodeRun air{.column = run.column_at(from), .row = run.row_at(from), .step_x = run.step_x, .step_y = run.step_y};
  air.heights.assign(run.heights.begin() + static_cast<std::ptrdiff_t>(from), run.heights.end());
  air_.push_back(std::move(air));
}

std::ptrdiff_t nodes_of(Mm distance, Mm pitch) {
  return std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(std::ceil(distance / pitch - 1e-6)));
}

std::ptrdiff_t step_nodes(Mm step, Mm pitch) {
  return std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(std::floor(step / pitch + 1e-6)));
}

Mm step_of(const ReliefTool& tool, const ReliefProgramOptions& options, bool is_roughing) {
  if (tool.step_over.value() > 0) return tool.step_over;
  const Mm diameter = tool.cutter.radius * 2;
  constexpr double part_of_flat = 0.4;
  if (is_roughing || tool.cutter.flat == tool.cutter.radius) return diameter * part_of_flat;
  return std::min(tool.cutter.step_for_scallop(options.scallop), diameter * part_of_flat);
}

Mm finishing_overrun(const ReliefProgramOptions& options) {
  return options.overrun.value_or(options.finish.cutter.radius);
}

Mm roughing_overrun(const ReliefProgramOptions& options) {
  const Mm radius = options.roughing->tool.cutter.radius;
  // The sides of a body are cut: there must be room for the roughing cutter beside what it leaves, and some nodes more.
  const Mm beside = options.beside == BesideGrid::nothing ? radius * 1.1 + options.roughing->stock : radius;
  return options.overrun.value_or(std::max(beside, options.finish.cutter.radius * 2 - radius));
}

Mm rest_overrun(const ReliefProgramOptions& options) {
  return options.overrun.value_or(options.rest->tool.cutter.radius);
}

std::ptrdiff_t AreaSweep::row_of(std::size_t index) const {
  if (!area_.rows.empty()) return area_.rows[index];
  return std::min(area_.first_row + static_cast<std::ptrdiff_t>(index) * area_.step, area_.end_row - 1);
}

void AreaSweep::find_stretches() {
  stretches_.clear();
  all_ = 0;
  for (std::size_t index = 0;; ++index) {
    const std::ptrdiff_t row = row_of(index);
    std::vector<Stretch> here;
    for (std::ptrdiff_t column = area_.first_column; column < area_.end_column; ++column) {
      if (!wants_(column, row)) continue;
      if (!here.empty() && column - here.back().last <= area_.gap + 1) {
        here.back().last = column;
      } else {
        here.push_back({.first = column, .last = column});
      }
    }
    all_ += here.size();
    stretches_.push_back(std::move(here));
    if (area_.rows.empty() ? row == area_.end_row - 1 : index + 1 == area_.rows.size()) return;
  }
}

NodeRun AreaSweep::run_along(std::ptrdiff_t row, std::ptrdiff_t from, std::ptrdiff_t to) const {
  NodeRun run{.column = from, .row = row, .step_x = from <= to ? 1 : -1, .step_y = 0};
  for (std::ptrdiff_t column = from;; column += run.step_x) {
    run.heights.push_back(height_(column, row));
    if (column == to) return run;
  }
}

void AreaSweep::cut(const std::function<void(double)>& progress) {
  find_stretches();
  done_ = 0;
  for (std::size_t index = 0; index < stretches_.size(); ++index) {
    for (Stretch& stretch : stretches_[index]) {
      if (stretch.done) continue;
      cut_from(index, stretch);
      progress(static_cast<double>(done_) / static_cast<double>(std::max<std::size_t>(1, all_)));
    }
  }
}

// Cuts a stretch, and then what lies on from its end, row after row.
void AreaSweep::cut_from(std::size_t index, Stretch& first) {
  const std::ptrdiff_t row = row_of(index);
  const bool is_back = area_.direction < 0;
  const NodeRun run = is_back ? run_along(row, first.last, first.first) : run_along(row, first.first, first.last);
  pass_.go_to_work(run, static_cast<double>(free_above_(run.column, row)));
  pass_.cut(run);
  first.done = true;
  ++done_;
  if (area_.direction != 0) return;
  const Stretch* last = &first;
  std::ptrdiff_t column = first.last;
  while (++index < stretches_.size()) {
    Stretch* next = nullptr;
    for (Stretch& candidate : stretches_[index]) {
      if (!candidate.done && follow(index, *last, column, candidate)) {
        next = &candidate;
        break;
      }
    }
    if (next == nullptr) return;
    next->done = true;
    ++done_;
    last = next;
  }
}

// From the end of the last stretch to the next one and along it, where all the way is wanted. `column` is where the
// tool is, in the row before.
bool AreaSweep::follow(std::size_t index, const Stretch& last, std::ptrdiff_t& column, Stretch& next) {
  const std::ptrdiff_t across = std::clamp(column, next.first, next.last);
  if (across < last.first || across > last.last) return false;
  const std::ptrdiff_t from = row_of(index - 1);
  const std::ptrdiff_t to = row_of(index);
  NodeRun over{.column = across, .row = from, .step_x = 0, .step_y = 1};
  for (std::ptrdiff_t row = from; row <= to; ++row) {
    if (!wants_(across, row)) return false;
    over.heights.push_back(height_(across, row));
  }
  if (across != column) pass_.cut(run_along(from, column, across));
  pass_.cut(over);
  const bool left_is_near = across - next.first < next.last - across;
  const std::ptrdiff_t near_end = left_is_near ? next.first : next.last;
  const std::ptrdiff_t far_end = left_is_near ? next.last : next.first;
  if (near_end != across) pass_.cut(run_along(to, across, near_end));
  if (far_end != near_end) pass_.cut(run_along(to, near_end, far_end));
  column = far_end;
  return true;
}

}  // namespace passo
