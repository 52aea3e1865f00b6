// Layouts of pads and their isolation, proved, for the tests of isolation.
#pragma once

#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "passo/cam/isolation.hpp"
#include "passo/cam/isolation_proof.hpp"

namespace passo::test {

inline DrawnPoint spot(double x, double y) {
  return {to_nanometres(Mm(x)), to_nanometres(Mm(y))};
}
inline Nanometres wide(double mm) {
  return to_nanometres(Mm(mm));
}
inline Region pad(double x, double y, double size) {
  return filled({rectangle({spot(x - size / 2, y - size / 2), spot(x + size / 2, y + size / 2)})});
}
inline IsolationOptions with(std::vector<double> cutters) {
  IsolationOptions options;
  for (const double cutter : cutters) options.cutters.push_back({wide(cutter), "cutter"});
  return options;
}
struct Isolated {
  IsolationPlan plan;
  IsolationProof proof;
};
inline Isolated isolated(const Region& copper, const IsolationOptions& options) {
  Diagnostics findings;
  Isolated result;
  result.plan = plan_isolation(copper, options, findings);
  EXPECT_FALSE(findings.any_error());
  result.proof =
      prove_isolation(copper, result.plan.mill, options.voronoi ? options.board : Region{}, {}, result.plan.kept);
  return result;
}
// Two pads of 2 mm, this far apart.
inline Region two_pads(double gap) {
  return united(pad(0, 0, 2), pad(2 + gap, 0, 2));
}

}  // namespace passo::test
