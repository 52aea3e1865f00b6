// Simulation: a piece of stock that a program was cut from, and what would have gone wrong.
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
  std::string target;  // empty: nothing was compared
  HeightField field;
  double volume_before = 0;           // mm³
  std::vector<std::int32_t> numbers;  // of the tools, as the program has them
  std::vector<ToolShape> tools = {};  // in the same order
  CutSummary summary;
  std::optional<FieldDifference> difference = {};
};

// "X1.00 Y2.00 Z3.00", and "0.125 mm": as findings and reports name them.
std::string place_in_words(const Vector3& place);
std::string mm_in_words(double mm);

// Adds a finding for each trouble.
void add_findings(const Simulation& simulation, Diagnostics& findings);

}  // namespace passo
