#include "cut_words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace passo {
namespace {

constexpr SentenceRow no_spindle_speed{
    "check.no-spindle-speed",
    "the tool cuts while the spindle speed is unknown; the forces of these cuts are not included"};

}  // namespace

void add_findings(const CutOutcome& cut, Diagnostics& findings) {
  add_findings(cut.simulation, findings);
  if (cut.silent_line == 0) return;
  findings.add({.severity = Severity::warning,
                .code = "check.no-spindle-speed",
                .file = cut.simulation.program,
                .place = {.line = cut.silent_line, .column = 0, .length = 1},
                .message = no_spindle_speed,
                .expected = "S and M3 in the program, or --spindle-speed",
                .text = {}});
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
