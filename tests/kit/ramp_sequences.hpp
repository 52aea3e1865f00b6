// The ramps of ../shared/golden/ramp.csv. They were computed from the definitions with 50 digits, by code that shares
// nothing with Passo. Tests that read them are skipped if the file is missing.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace passo::test {

struct RampSequence {
  double clock = 0;
  int steps_per_turn = 0;
  double acceleration = 0;
  std::vector<double> recursive;
  std::vector<double> exact;
  std::vector<std::uint32_t> table;  // empty if the method is not applicable
  std::vector<double> ends;
};

// Returns an empty list if the file is missing.
inline std::vector<RampSequence> ramp_sequences() {
  std::ifstream file(PASSO_SOURCE_DIR "/../shared/golden/ramp.csv");
  std::string line;
  std::getline(file, line);
  std::map<std::tuple<double, int, double>, RampSequence> found;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    const std::tuple key(std::stod(cells.at(0)), std::stoi(cells.at(1)), std::stod(cells.at(2)));
    RampSequence& sequence = found[key];
    std::tie(sequence.clock, sequence.steps_per_turn, sequence.acceleration) = key;
    sequence.recursive.push_back(std::stod(cells.at(4)));
    sequence.exact.push_back(std::stod(cells.at(5)));
    if (!cells.at(6).empty()) sequence.table.push_back(static_cast<std::uint32_t>(std::stoul(cells.at(6))));
    sequence.ends.push_back(std::stod(cells.at(7)));
  }
  std::vector<RampSequence> all;
  for (auto& [key, sequence] : found) all.push_back(std::move(sequence));
  return all;
}

}  // namespace passo::test
