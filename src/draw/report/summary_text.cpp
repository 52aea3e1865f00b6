#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/report/line_words.hpp"
#include "passo/report/summary.hpp"

namespace passo {
namespace {

// Hours appear only if there are some. There are always three digits after the point, so that columns align at it.
std::string duration(Seconds time) {
  const auto milliseconds = std::llround(time.value() * 1000);
  const auto seconds = milliseconds / 1000;
  const auto rest = fmt::format("{:02}.{:03}", seconds % 60, milliseconds % 1000);
  if (seconds >= 3600) return fmt::format("{}:{:02}:{}", seconds / 3600, seconds / 60 % 60, rest);
  return fmt::format("{}:{}", seconds / 60, rest);
}

std::string share(double part, double whole) {
  return whole > 0 ? fmt::format("{:5.1f} %", 100 * part / whole) : "";
}

// Control characters in file names must not reach the terminal.
std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) c = ' ';
  }
  return text;
}

std::string sizes(std::uint64_t bytes) {
  if (bytes < 10'000) return counted(bytes, "byte");
  if (bytes < 10'000'000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

std::string so_often(int count) {
  return count == 0 ? "never" : count == 1 ? "once" : fmt::format("{} times", count);
}

class Text {
 public:
  Text(bool colour, LengthUnits units) : colour_(colour), inches_(units == LengthUnits::inch) {}

  void title(const RunSummary& summary) {
    out_ += strong(printable(summary.program));
    if (!summary.machine.empty()) out_ += " on " + summary.machine;
    out_ += "\n";
  }

  void times(const RunSummary& summary) {
    const double all = summary.time().value();
    heading("Time", all < 3600 ? "min:s" : "h:min:s");
    line("cutting", duration(summary.cutting_time), share(summary.cutting_time.value(), all));
    line("rapid", duration(summary.rapid_time), share(summary.rapid_time.value(), all));
    line("dwell", duration(summary.dwell_time), share(summary.dwell_time.value(), all));
    line("total", duration(summary.time()), summary.dwells > 0 ? "  with " + counted(summary.dwells, "dwell") : "");
  }

  void distances(const RunSummary& summary) {
    const Mm all = summary.cutting_distance + summary.rapid_distance;
    heading("Distance", unit());
    line("cutting", length(summary.cutting_distance), share(summary.cutting_distance.value(), all.value()));
    line("rapid", length(summary.rapid_distance), share(summary.rapid_distance.value(), all.value()));
    line("total", length(all),
         fmt::format("  in {}: {}, {}", counted(summary.moves, "move"), counted(summary.rapids, "rapid"),
                     counted(summary.arcs, "arc")));
  }

  void turns(const RunSummary& summary) {
    const double all = summary.cutting_turn + summary.rapid_turn;
    if (!(all > 0)) return;
    heading("Turning", "degrees; moves of A B C only");
    line("cutting", place(summary.cutting_turn, Axis::a), share(summary.cutting_turn, all));
    line("rapid", place(summary.rapid_turn, Axis::a), share(summary.rapid_turn, all));
  }

  void tools(const RunSummary& summary) {
    heading("Tools", fmt::format("{}; feeds in {}/min; depth is the lowest Z at feed", unit(), unit()));
    out_ += fmt::format("  {:4}{:>14}{:>14}{:>14}{:>20}{:>12}\n", "", "cutting", "rapid", "distance", "feed", "depth");
    for (const ToolSummary& tool : summary.tools) {
      out_ += fmt::format("  {:4}{:>14}{:>14}{:>14}{:>20}{:>12}\n",
                          tool.tool > 0 ? fmt::format("T{}", tool.tool) : std::string("-"), duration(tool.cutting_time),
                          duration(tool.rapid_time), length(tool.cutting_distance), feeds(tool.feed, Axis::x),
                          tool.depth ? place(*tool.depth, Axis::z) : "");
    }
    for (const ToolSummary& tool : summary.tools) {
      if (!tool.turn_feed) continue;
      out_ += fmt::format("  {:4}rotates {} degrees at feed, {}/min\n",
                          tool.tool > 0 ? fmt::format("T{}", tool.tool) : std::string("-"),
                          place(tool.cutting_turn, Axis::a), feeds(tool.turn_feed, Axis::a));
    }
  }

  void extents(const RunSummary& summary) {
    heading("Extents", unit_of_places(summary));
    table_of_extents(
        summary, "machine", [&](std::size_t i) { return summary.axes[i].machine_extents; },
        [&](std::size_t i) { return summary.axes[i].cutting_extents; });
    for (const WorkSummary& work : summary.work) {
      table_of_extents(
          summary, name_of_system(work.system), [&](std::size_t i) { return work.extents[i]; },
          [&](std::size_t i) { return work.cutting[i]; });
    }
  }

  void axes(const RunSummary& summary) {
    heading("Axes", unit_of_places(summary));
    out_ += fmt::format("  {:4}{:>10}{:>14}", "", "peak /min", "peak /s\u00B2");
    if (summary.board) out_ += fmt::format("{:>13}{:>14}{:>12}", "steps net", "steps total", "at the end");
    out_ += "\n";
    for (const AxisSummary& axis : summary.axes) {
      out_ += fmt::format("  {:4}{:>10.1f}{:>14.1f}", letter_of(axis.axis),
                          in_units(axis.peak_speed.value() * seconds_per_minute, axis.axis),
                          in_units(axis.peak_acceleration.value(), axis.axis));
      if (summary.board) {
        out_ += fmt::format("{:>13}{:>14}{:>12}", grouped(axis.net_steps.count), grouped(axis.total_steps.count),
                            place(axis.position, axis.axis));
      }
      out_ += "\n";
    }
  }

  void board(const RunSummary& summary, const BoardSummary& board) {
    heading("Board", "");
    line("end", duration(board.end), waiting(summary, board));
    line("pulses", grouped(board.pulses), "  in " + counted(board.events, "event"));
    line("sent", sizes(board.bytes), "  in " + counted(board.frames, "frame"));
    if (board.busiest_second > 0) line("at most", sizes(board.busiest_second), "  in a second");
    if (board.held_items > 0) {
      line("holds", counted(board.held_items, "item"),
           fmt::format("  and stopped {} because motion arrived too late", so_often(board.rests)));
    }
    if (board.stood_still) {
      line("stopped", "during motion", "  its events came too late, and steps may be lost");
    }
    if (!board.without_line) return;
    const Seconds cost = board.cost_of_line();
    if (cost < least_cost_of_line) {
      line("line", "none", "  no longer than without it");
    } else {
      line("line", duration(cost), "  longer than without it: " + percent_of(cost, *board.without_line));
    }
  }

  void holds(const RunSummary& summary) {
    heading("Holds", "s");
    for (const HoldSummary& hold : summary.holds) {
      out_ += fmt::format("  at {:.3f}: slower after {:.1f} ms, stopped at {:.3f} at", hold.asked.value(),
                          hold.reaction.value() * 1e3, hold.rest.value());
      add_place(summary, hold.place);
      out_ += hold.resumed ? fmt::format("; continued at {:.3f}\n", hold.resumed->value()) : "; ended there\n";
    }
  }

  void probes(const RunSummary& summary, const ProbeSummary& probes) {
    heading("Probe", unit_of_places(summary));
    out_ += fmt::format("  {}, {} touched; at most {} from contact to stop\n", counted(probes.moves, "move"),
                        grouped(probes.touched), length(probes.farthest_overrun));
    out_ += probes.last_touched ? "  the last one touched at" : "  the last one touched nothing, up to";
    add_place(summary, probes.last_contact);
    out_ += ", stopped at";
    add_place(summary, probes.last_rest);
    out_ += " (machine)\n";
  }

  void tails(const RunSummary& summary) {
    heading("Stopped without the computer", "s");
    for (const StopRampSummary& tail : summary.tails) {
      out_ += fmt::format("  stopped at {:.3f} at", tail.rest.value());
      add_place(summary, tail.place);
      out_ += fmt::format("; continued at {:.3f}\n", tail.resumed.value());
    }
  }

  void physics(const PhysicsSummary& physics) {
    heading("Motors", fmt::format("{}; margin is the smallest fraction of the torque that was left", unit()));
    out_ += fmt::format("  {:4}{:>12}{:>12}{:>12}{:>10}{:>8}{:>12}\n", "", "steps lost", "off by", "following",
                        "margin", "line", "really at");
    for (const PhysicsSummary::Motor& motor : physics.motors) {
      out_ += fmt::format("  {:4}{:>12}{:>12}{:>12}{:>8.0f} %{:>8}{:>12}\n", letter_of(motor.axis),
                          grouped(motor.lost_steps), place(motor.lost, motor.axis),
                          place(motor.following_error, motor.axis), 100 * motor.least_margin, motor.line,
                          place(motor.position, motor.axis));
    }
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(shown, physics.losses.size()); ++i) {
      const PhysicsSummary::Loss& loss = physics.losses[i];
      out_ += fmt::format("  at {:.3f} s, line {}: {} lost {}\n", loss.time.value(), loss.line, letter_of(loss.axis),
                          counted(loss.steps, "step"));
    }
    if (physics.losses.size() > shown) out_ += "  and " + counted(physics.losses.size() - shown, "more time") + "\n";
  }

  void port(const PortSummary& port) {
    heading("Parallel port and PIC", fmt::format("in steps; really at in {}", unit()));
    out_ += fmt::format("  {:4}{:>12}{:>12}{:>14}{:>14}{:>12}{:>12}\n", "", "commanded", "sampled", "commanded net",
                        "sampled net", "true net", "really at");
    for (const PortSummary::Motor& motor : port.motors) {
      out_ += fmt::format("  {:4}{:>12}{:>12}{:>14}{:>14}{:>12.2f}{:>12}\n", letter_of(motor.axis),
                          grouped(motor.commanded), grouped(motor.sampled), grouped(motor.commanded_net),
                          grouped(motor.sampled_net), motor.true_net, place(motor.true_end, motor.axis));
    }
    line("writes", grouped(port.register_writes), "  of the port's registers");
    line("relay", port.relay_is_closed ? "closed" : "open",
         fmt::format("  at the end; it closed {}", so_often(port.relay_closings)));
    if (port.lost_pulses() == 0) return;
    line("lost", counted(port.lost_pulses(), "pulse"), "  that the PIC did not sample");
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < std::min(shown, port.lost.size()); ++i) {
      const PortSummary::LostPulse& lost = port.lost[i];
      out_ +=
          fmt::format("  at {:.6f} s, line {}: {} lost a pulse\n", lost.time.value(), lost.line, letter_of(lost.axis));
    }
  }

  std::string take() { return std::move(out_); }

 private:
  std::string strong(std::string_view text) const {
    return colour_ ? fmt::format("\x1b[1m{}\x1b[0m", text) : std::string(text);
  }
  // Over a line the board waits where the program does: at rest, for more motion or for answers. The motion's times do
  // not hold that.
  static std::string waiting(const RunSummary& summary, const BoardSummary& board) {
    const Seconds more = board.end - summary.time();
    if (board.held_items == 0 || std::llround(more.value() * 1000) <= 0) return {};
    return fmt::format("  {} more than the total: waiting", duration(more));
  }
  void heading(std::string_view name, std::string_view unit) {
    out_ += "\n" + strong(name);
    if (!unit.empty()) out_ += fmt::format(", {}", unit);
    out_ += "\n";
  }
  void line(std::string_view name, std::string_view value, std::string_view note) {
    out_ += fmt::format("  {:10}{:>18}", name, value);
    if (!note.empty()) out_ += fmt::format("  {}", note);
    out_ += "\n";
  }
  void add_place(const RunSummary& summary, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Axis axis = summary.axes[i].axis;
      out_ += fmt::format(" {}{}", letter_of(axis), place(values[i], axis));
    }
  }
  // A row for each axis: how far the path goes, and how far it goes at feed.
  template <class All, class Cutting>
  void table_of_extents(const RunSummary& summary, std::string_view name, const All& all, const Cutting& cutting) {
    out_ += fmt::format("  {:8}{:>12}{:>12}{:>16}{:>12}\n", name, "from", "to", "cutting from", "to");
    for (std::size_t i = 0; i < summary.axes.size(); ++i) {
      const Axis axis = summary.axes[i].axis;
      out_ += fmt::format("  {:8}{:>24}{:>28}\n", letter_of(axis), range(all(i), axis), range(cutting(i), axis));
    }
  }
  std::string range(const std::optional<Range>& extents, Axis axis) const {
    if (!extents) return "no motion";
    return fmt::format("{:>12}{:>12}", place(extents->low, axis), place(extents->high, axis));
  }
  std::string feeds(const std::optional<Range>& feed, Axis axis) const {
    if (!feed) return "";
    const auto shown = [&](double speed) { return fmt::format("{:.1f}", in_units(speed * seconds_per_minute, axis)); };
    const std::string low = shown(feed->low);
    const std::string high = shown(feed->high);
    return low == high ? low : fmt::format("{} to {}", low, high);
  }

  // Lengths are shown in the program's units. Degrees are degrees.
  double in_units(double value, Axis axis) const { return inches_ && !is_rotary(axis) ? value / mm_per_inch : value; }
  // Three decimals of a millimetre or degree, four of an inch, but never "-0.000".
  std::string place(double value, Axis axis) const {
    const std::string text = fmt::format("{:.{}f}", in_units(value, axis), inches_ && !is_rotary(axis) ? 4 : 3);
    return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
  }
  std::string length(Mm value) const { return place(value.value(), Axis::x); }
  std::string_view unit() const { return inches_ ? "inches" : "mm"; }
  std::string unit_of_places(const RunSummary& summary) const {
    for (const AxisSummary& axis : summary.axes) {
      if (is_rotary(axis.axis)) return fmt::format("{}; A B C in degrees", unit());
    }
    return std::string(unit());
  }

  bool colour_;
  bool inches_;
  std::string out_;
};

}  // namespace

std::string percent_of(Seconds part, Seconds whole) {
  const double percent = whole > Seconds(0) ? 100 * (part / whole) : 0;
  return percent < 0.1 ? "under 0.1 %" : fmt::format("{:.1f} %", percent);
}

std::int64_t PortSummary::lost_pulses() const {
  std::int64_t lost_ones = 0;
  for (const Motor& motor : motors) lost_ones += motor.commanded - motor.sampled;
  return lost_ones;
}

bool PortSummary::is_true() const {
  constexpr double half_a_step = 0.5;
  return std::ranges::all_of(motors, [](const Motor& motor) {
    return motor.commanded == motor.sampled && motor.commanded_net == motor.sampled_net &&
           std::abs(motor.true_net - static_cast<double>(motor.commanded_net)) < half_a_step;
  });
}

bool PhysicsSummary::lost() const {
  return !losses.empty();
}

std::string to_text(const RunSummary& summary, bool colour) {
  Text text(colour, summary.units);
  text.title(summary);
  text.times(summary);
  text.distances(summary);
  text.turns(summary);
  if (!summary.tools.empty()) text.tools(summary);
  text.extents(summary);
  text.axes(summary);
  if (summary.board) text.board(summary, *summary.board);
  if (!summary.holds.empty()) text.holds(summary);
  if (summary.probes) text.probes(summary, *summary.probes);
  if (!summary.tails.empty()) text.tails(summary);
  if (summary.physics) text.physics(*summary.physics);
  if (summary.board && summary.board->port) text.port(*summary.board->port);
  return text.take();
}

}  // namespace passo
