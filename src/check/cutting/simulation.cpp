#include "passo/cutting/simulation.hpp"

#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

struct TroubleWords {
  const char* code;
  const char* message;  // with the tool and the depth
  const char* expected;
  Severity severity = Severity::error;
};

TroubleWords describe(CutTrouble::Kind kind) {
  switch (kind) {
    case CutTrouble::Kind::rapid:
      return {"simulate.rapid", "the rapid of T{0} goes through the stock, {1} deep", "a path above the stock, or G1"};
    case CutTrouble::Kind::flutes:
      return {"simulate.flutes", "T{0} cuts {1} deeper than the length of its flutes",
              "a longer tool, or several passes at smaller depths"};
    case CutTrouble::Kind::holder:
      return {"simulate.holder", "the holder of T{0} collides with the stock, {1} deep",
              "a tool with a longer stick-out"};
    case CutTrouble::Kind::clamp:
      return {"simulate.clamp", "T{0} collides with a clamp, {1} deep", "a path around or above the clamp"};
    case CutTrouble::Kind::below: break;
  }
  return {"simulate.below", "T{0} cuts {1} below the stock, into the table or spoilboard", "", Severity::warning};
}

}  // namespace

std::string place_in_words(const Vector3& place) {
  return fmt::format("X{:.2f} Y{:.2f} Z{:.2f}", place.x, place.y, place.z);
}

std::string mm_in_words(double mm) {
  return fmt::format("{:.3f} mm", mm);
}

void add_findings(const Simulation& simulation, Diagnostics& findings) {
  const auto add = [&](Severity severity, const char* code, std::uint32_t line, std::string message,
                       const char* expected) {
    findings.add({.severity = severity,
                  .code = code,
                  .file = simulation.program,
                  .place = {.line = line, .column = 0, .length = 1},
                  .message = std::move(message),
                  .expected = expected,
                  .text = {}});
  };
  for (const CutTrouble& trouble : simulation.summary.troubles()) {
    const TroubleWords words = describe(trouble.kind);
    const std::string message =
        fmt::format(fmt::runtime(words.message), simulation.numbers[trouble.tool], mm_in_words(trouble.depth));
    add(words.severity, words.code, trouble.line, message + ", at " + place_in_words(trouble.place), words.expected);
  }
  if (!simulation.difference || simulation.difference->gouge.cells == 0) return;
  const FieldDifference::Side& gouge = simulation.difference->gouge;
  add(Severity::error, "simulate.gouge", 0,
      fmt::format("{:.3f} mm\u00B3 are cut out of {}, {} deep at {}", gouge.volume, simulation.target,
                  mm_in_words(gouge.largest), place_in_words(gouge.place)),
      "");
}

}  // namespace passo
