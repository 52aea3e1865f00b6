// Nests the copies of a job's part on sheets, and writes the programs of its operations for each copy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "part_job_operation.hpp"

#include "passo/nesting/nesting.hpp"

namespace passo {

struct NestedJob {
  Nest nest = {};
  NestOptions options = {};
  Region outline = {};  // of the part, in its own coordinates

  // The part on a sheet, moved to the stock, and where the offcut begins.
  Region outlines_on(std::size_t sheet, const PartStock& stock) const;
  Nanometres offcut_of(std::size_t sheet, const PartStock& stock) const;
};

// The lower left corner of the stock.
DrawnPoint corner_of(const PartStock& stock);

// `made`: as in PartJob::operations. Errors "job.nest-…" are in `findings`; then there is nothing.
std::optional<NestedJob> nest_job(const PartJob& job, const std::vector<MadeOperation>& made, const PartJobZero& zero,
                                  Diagnostics& findings, const WorkProgress& progress);

// The programs of an operation for all copies on a sheet: tool after tool, each copy near the one before.
std::vector<std::string> programs_on_sheet(const PartJob& job, const std::string& program, const std::string& park,
                                           const NestedJob& nested, std::size_t sheet);

}  // namespace passo
