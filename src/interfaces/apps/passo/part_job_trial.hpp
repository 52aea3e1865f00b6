// Tries the programs of a job on its stock, before they are written: what each operation takes, and whether a move
// enters a clamp, goes through the stock as a rapid, or into the table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/cam/mill_plan.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/part_job/part_job.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

struct TriedOperation {
  std::uint64_t moves = 0;
  double cut_mm = 0;  // length of the feeds
  double cut_s = 0;   // at the programmed feeds
  double rapid_mm = 0;
  double depth_mm = 0;             // of the deepest feed below Z0
  double removed_mm3 = 0;          // of the stock
  double pass_mm = 0;              // the deepest cut of a feed
  bool plunges = false;            // a feed goes straight down in the stock
  std::vector<MillRun> ways = {};  // the feeds, for the picture
};

// A program, and the first line of each of its operations, which are indices into PartJob::operations.
struct TrialProgram {
  std::string file = {};
  std::string text = {};
  std::vector<std::uint32_t> first_lines = {};
  std::vector<std::size_t> operations = {};
  std::size_t sheet = 0;
};

struct Trial {
  std::vector<TriedOperation> operations = {};  // as in PartJob::operations
  std::optional<HeightField> field = {};        // what is left; empty: nothing was cut, or it was let go
  std::vector<DrawnRing> rapids = {};           // lines in X and Y, for the picture
  double stock_mm3 = 0;                         // before the first operation
};

// Rapids at this speed, where no machine is known.
inline constexpr double usual_rapid_mm_min = 3000;

// Errors are in `findings`: those of the interpreter, and "job.clamp", "job.rapid-in-stock", "job.neck", "job.teeth",
// "job.holder" and "job.below".
Trial try_programs(const PartJob& job, const std::vector<TrialProgram>& programs, Diagnostics& findings);

}  // namespace passo
