// What `passo simulate` says: figures as text or JSON, and what would go wrong as findings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/stock/cut_summary.hpp"
#include "passo/stock/field_comparison.hpp"

namespace passo {

struct Simulation {
  std::string program;
  std::string target;  // empty: nothing was compared
  HeightField field;
  double volume_before = 0;           // mm³
  std::vector<std::int32_t> numbers;  // of the tools, as the program has them
  std::vector<ToolShape> tools = {};  // in the same order
  CutSummary summary;
  std::optional<FieldDifference> difference = {};
};

// Adds a finding for each trouble.
void add_findings(const Simulation& simulation, Diagnostics& findings);

std::string to_text(const Simulation& simulation);
std::string to_json(const Simulation& simulation, const Diagnostics& findings);
// The words below a picture's title.
std::string in_short(const Simulation& simulation);

}  // namespace passo
