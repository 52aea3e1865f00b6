#include "link_delay.hpp"

#include "program_input.hpp"
#include "progress_display.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/report/line_words.hpp"

namespace passo {
namespace {

std::string so_often(int count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

std::optional<LinkDelay> line_cost_with_progress(const ProgramReader& program, const MachineDescription& machine,
                                                 const InterpreterOptions& options, const ProgramCheck& check,
                                                 Seconds without) {
  if (!has_line_cost(machine, check)) return {};
  ProgressDisplay progress(program.name());
  const auto cost = link_delay(program.again(), machine, options, check, without,
                               [&progress](double share) { progress.update(share); });
  if (cost) return *cost;
  progress.clear();
  if (!cost.error().empty()) fail(exit_failed, "the board: " + cost.error());
  return {};
}

std::string to_text(const LinkDelay& cost) {
  std::string words = fmt::format("serial link     to a board with a queue of {}: ", counted(cost.held_items, "item"));
  if (!cost.trouble.empty()) return words + cost.trouble + "\n";
  if (cost.cost() < least_cost_of_line) {
    words += "costs no time";
  } else {
    words += fmt::format("{:.3f} s longer, {}", cost.cost().value(), percent_of(cost.cost(), cost.without));
  }
  if (cost.slowdowns > 0) words += fmt::format("; slower {} because the queue was full", so_often(cost.slowdowns));
  if (cost.rests > 0) words += fmt::format("; stopped {} because motion arrived too late", so_often(cost.rests));
  return words + "\n";
}

nlohmann::ordered_json as_json(const LinkDelay& cost) {
  nlohmann::ordered_json json = {{"held_items", cost.held_items},
                                 {"time_s", cost.over.value()},
                                 {"cost_s", cost.cost().value()},
                                 {"cost_share", cost.share()},
                                 {"slowdowns", cost.slowdowns},
                                 {"rests", cost.rests},
                                 {"trouble", nullptr}};
  if (!cost.trouble.empty()) json["trouble"] = cost.trouble;
  return json;
}

}  // namespace passo
