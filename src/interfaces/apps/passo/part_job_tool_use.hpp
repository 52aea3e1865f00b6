// How the operations of a job use their tools, as seen in the trial.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "part_job_trial.hpp"

#include "passo/part_job/part_job.hpp"

namespace passo {

// Returns the value of an option, in the job's unit without a unit's name. Empty: the operation has no such option.
std::string option_text(PartOperation operation, std::string_view name);

// Returns the origin of the feeds, and warnings about the use of the tool.
std::vector<std::string> tool_notes(const PartJob& job, const PartOperation& operation, const TriedOperation& tried);

}  // namespace passo
