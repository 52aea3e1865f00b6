// Runs the operations of a job file: each by the function of its command, with the job's drawings, zero and tools.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "passo/base/work_progress.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/part_job/part_job.hpp"

namespace passo {

struct MadeOperation {
  std::string program = {};                // its own program
  std::vector<std::string> contours = {};  // what it cuts, each in words: "12 x 8 mm at X20 Y10"
  nlohmann::ordered_json figures = {};     // what its command prints with --json; empty: nothing
  std::vector<std::string> notes = {};
};

// What all operations share.
struct PartJobZero {
  std::string words = "file";  // for --zero
};

// The zero of the job: of --zero lower-left, the corner of all drawings together. Also checks that the layers of the
// operations exist. Nothing: there are errors in `findings`.
std::optional<PartJobZero> find_zero(const PartJob& job, Diagnostics& findings);

// The outside of all closed contours and holes that the operations cut, from the job's zero. Facing is left out, which
// is of the whole stock. Empty: there are none.
Region outline_of_part(const PartJob& job, const PartJobZero& zero);

// Warns about the options in [job] that have an effect in no operation.
void warn_of_idle_defaults(const PartJob& job, Diagnostics& findings);

// Nothing: there are errors in `findings`. `folder`: for files that are only needed while the operation runs.
std::optional<MadeOperation> make_operation(const PartJob& job, const PartOperation& operation, const PartJobZero& zero,
                                            const std::string& folder, Diagnostics& findings,
                                            const WorkProgress& progress);

}  // namespace passo
