// passo home: finds the machine position by the limit switches.
#include <cstdio>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "grbl_connection.hpp"
#include "grbl_run.hpp"
#include "homing_run.hpp"
#include "machine_connection.hpp"
#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/activity/homing_repeats.hpp"
#include "passo/activity/machine_plant.hpp"

namespace passo {
namespace {

nlohmann::ordered_json to_json(const HomingReport& report, const std::vector<AxisRepeats>& repeats) {
  nlohmann::ordered_json axes = nlohmann::ordered_json::array();
  nlohmann::ordered_json place = nlohmann::ordered_json::object();
  for (const HomedAxis& axis : report.axes) {
    const std::string letter{letter_of(axis.axis)};
    axes.push_back({{"axis", letter}, {"way_mm", axis.way}});
    if (axis.squared) axes.back()["squared_mm"] = *axis.squared;
    place[letter] = axis.place;
  }
  nlohmann::ordered_json all = {{"homed", report.code.empty()}, {"time_s", report.time.value()}};
  all["axes"] = axes;
  all["position_mm"] = place;
  for (const AxisRepeats& one : repeats) {
    all["repeats"].push_back({{"axis", std::string{letter_of(one.axis)}},
                              {"mean_um", one.mean},
                              {"spread_um", one.spread},
                              {"spread_steps", one.spread_steps}});
  }
  if (report.code.empty()) return all;
  all["error"] = {{"code", report.code}, {"message", report.message}};
  if (report.axis) all["error"]["axis"] = std::string{letter_of(*report.axis)};
  return all;
}

void print(const HomingReport& report) {
  for (const HomedAxis& axis : report.axes) {
    fmt::print("{}: switch closed {:.3f} from the start; stopped at {:.3f}\n", letter_of(axis.axis), axis.way,
               axis.place);
    if (axis.squared)
      fmt::print("{}: squared, the second motor moved by {:.3f}\n", letter_of(axis.axis), *axis.squared);
  }
  if (!report.code.empty()) return;
  fmt::print("homed in {:.1f} s; stopped at", report.time.value());
  for (const HomedAxis& axis : report.axes) fmt::print(" {}{:.3f}", letter_of(axis.axis), axis.place);
  fmt::print(" (machine)\n");
}

}  // namespace

int home(const HomeArguments& arguments) {
  Diagnostics diagnostics;
  const std::optional<MachineDescription> machine =
      load_machine_file(arguments.machine, diagnostics, use_with(arguments.board));
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  if (names_grbl_machine(arguments.board)) return home_grbl(arguments, *machine);
  if (!arguments.axis.empty()) {
    return fail(exit_bad_program, "AXIS " + arguments.axis +
                                      ": this board homes all its axes together; only Grbl boards home single axes "
                                      "[home.single-axis]");
  }
  if (machine->homing.empty()) return fail(exit_bad_machine, words_without_homing(arguments.machine));
  end_on_signals();
  int code = exit_done;
  const auto opened = MachineConnection::open(*machine, {.board = arguments.board}, code);
  if (!opened) return code;
  brake_on_signals();
  if (!opened->greet(opened->any_greeting(), code)) return code;
  HomingReport report;
  HomingRepeats homings(*machine);
  int times = 0;
  do {
    const Point stood = opened->session().status().position.place;
    report = home_machine(*opened, !arguments.quiet);
    homings.record(report.axes, times == 0 ? std::nullopt : std::optional(stood));
  } while (report.code.empty() && ++times < arguments.repeat);
  std::vector<AxisRepeats> repeats;
  if (times > 1) repeats = homings.axes();
  if (arguments.json) {
    fmt::print("{}\n", to_json(report, repeats).dump(2));
  } else if (!arguments.quiet) {
    print(report);
    if (!repeats.empty()) fmt::print("homed {} times:\n", times);
    for (const AxisRepeats& one : repeats) fmt::print("{}\n", describe(one));
  }
  if (report.code.empty()) return exit_done;
  const int failed = fail(exit_failed, describe(report));
  return interrupted_by() != 0 ? 128 + interrupted_by() : failed;
}

}  // namespace passo
