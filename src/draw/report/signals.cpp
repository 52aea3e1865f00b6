#include "passo/report/signals.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "axis_ticks.hpp"
#include "canvas.hpp"
#include "sheet.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

const Colour high_colour{0.93, 0.55, 0.10};
const Colour low_colour{0.93, 0.94, 0.95};
const Pen time_grid{.colour = {0.80, 0.82, 0.85}, .width = 1};

// The levels at each time at which a signal changes, and at the start.
class Rows {
 public:
  explicit Rows(const Signals& signals) {
    rows_[0];
    for (std::size_t i = 0; i < signals.signals.size(); ++i) {
      for (const SignalChange& change : signals.signals[i].changes) rows_[change.at][i] = change.high;
    }
  }
  // Calls visit(at, changed, levels) in order of time. `changed`: the number of a signal, and its new level.
  template <class Visit>
  void each(std::size_t count, const Visit& visit) const {
    std::vector<bool> levels(count, false);
    for (const auto& [at, changed] : rows_) {
      for (const auto& [which, high] : changed) levels[which] = high;
      visit(at, changed, levels);
    }
  }

 private:
  std::map<std::int64_t, std::map<std::size_t, bool>> rows_;
};

// The code of a signal in the VCD: two printable signs.
std::string code(std::size_t number) {
  return {static_cast<char>('!' + number / 90), static_cast<char>('!' + number % 90)};
}

void draw_lane(Canvas& canvas, const Area& lane, const Signal& signal, std::int64_t end) {
  using namespace sheet;
  canvas.fill(lane, low_colour);
  const double per_ns = lane.width / static_cast<double>(end);
  for (std::size_t i = 0; i < signal.changes.size(); ++i) {
    if (!signal.changes[i].high || signal.changes[i].at >= end) continue;
    const std::int64_t to = i + 1 < signal.changes.size() ? std::min(signal.changes[i + 1].at, end) : end;
    const auto from = static_cast<double>(signal.changes[i].at);
    canvas.fill({lane.x + from * per_ns, lane.y, (static_cast<double>(to) - from) * per_ns, lane.height}, high_colour);
  }
  canvas.text({lane.x - 9, lane.y + lane.height / 2}, signal.name, label, Align::right);
}

}  // namespace

std::size_t Signals::count_of_changes() const {
  std::size_t count = 0;
  for (const Signal& signal : signals) count += signal.changes.size();
  return count;
}

void write_signals_csv(const Signals& signals, OutputFile& file) {
  std::string text = "t";
  for (const Signal& signal : signals.signals) text += "," + signal.name;
  file.write(text + "\n");
  Rows(signals).each(signals.signals.size(),
                     [&](std::int64_t at, const auto& /*changed*/, const std::vector<bool>& levels) {
                       std::string row = fmt::format("{:.9f}", static_cast<double>(at) * 1e-9);
                       for (const bool high : levels) row += high ? ",1" : ",0";
                       file.write(row + "\n");
                     });
}

void write_signals_vcd(const Signals& signals, OutputFile& file) {
  std::string text = fmt::format("$version Passo $end\n$timescale 1 ns $end\n$scope module {} $end\n", signals.title);
  for (std::size_t i = 0; i < signals.signals.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "$var wire 1 {} {} $end\n", code(i), signals.signals[i].name);
  }
  file.write(text + "$upscope $end\n$enddefinitions $end\n");
  Rows(signals).each(signals.signals.size(),
                     [&](std::int64_t at, const auto& changed, const std::vector<bool>& levels) {
                       std::string moment = fmt::format("#{}\n", at);
                       if (at == 0) {
                         moment += "$dumpvars\n";
                         for (std::size_t i = 0; i < levels.size(); ++i)
                           moment += fmt::format("{:d}{}\n", bool{levels[i]}, code(i));
                         moment += "$end\n";
                       } else {
                         for (const auto& [which, high] : changed) moment += fmt::format("{:d}{}\n", high, code(which));
                       }
                       file.write(moment);
                     });
  file.write(fmt::format("#{}\n", signals.end));
}

Status<OutputError> draw_signals(const Signals& signals, const PictureOptions& options, OutputFile& file) {
  using namespace sheet;
  Canvas canvas(options, file);
  begin_sheet(canvas, options);
  double widest = 0;
  for (const Signal& signal : signals.signals) widest = std::max(widest, canvas.text_width(signal.name, label));
  const double left = margin + widest + 9;
  const Area all{left, 110, options.width - left - margin, options.height - 110.0 - 70};
  const std::int64_t end = std::max<std::int64_t>(signals.end, 1);
  const bool in_ms = end < 2'000'000'000;
  const double time_end = static_cast<double>(end) * (in_ms ? 1e-6 : 1e-9);
  const auto room = [&](const std::string& text) { return canvas.text_width(text, label) + 30; };
  const std::vector<Tick> marks = ticks(0, time_end, all.width / time_end, room);
  const double lane = all.height / static_cast<double>(std::max<std::size_t>(signals.signals.size(), 1));
  for (std::size_t i = 0; i < signals.signals.size(); ++i) {
    const Area row{all.x, all.y + static_cast<double>(i) * lane + lane * 0.12, all.width, lane * 0.76};
    draw_lane(canvas, row, signals.signals[i], end);
  }
  for (const Tick& mark : marks) {
    const double x = all.x + mark.value / time_end * all.width;
    canvas.line({x, all.y}, {x, all.bottom()}, time_grid);
    canvas.text({x, all.bottom() + 16}, mark.label, label, Align::centre);
  }
  canvas.text({all.x + all.width / 2, all.bottom() + 42}, in_ms ? "Time, ms" : "Time, s", caption, Align::centre);
  return canvas.finish();
}

}  // namespace passo
