// Simulation: the stock as cut by a program, and the problems found.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/vector3.hpp"
#include "passo/stock/cut_summary.hpp"
#include "passo/stock/field_comparison.hpp"

namespace passo {

struct Simulation {
  std::string program;
  std::string target;  // empty: no comparison
  HeightField field;
  double volume_before = 0;           // mm³
  std::vector<std::int32_t> numbers;  // tool numbers, as in the program
  std::vector<ToolShape> tools = {};  // in the order of `numbers`
  CutSummary summary;
  std::optional<FieldDifference> difference = {};
};

// Format a position, "X1.00 Y2.00 Z3.00", and a length, "0.125 mm", for findings and reports.
std::string place_in_words(const Vector3& place);
std::string mm_in_words(double mm);

// Adds a finding for each problem.
void add_findings(const Simulation& simulation, Diagnostics& findings);

}  // namespace passo
