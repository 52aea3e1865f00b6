// What is left of the lives of tools: the limits of the tool library, less what the records count.
#pragma once

#include <vector>

#include "passo/activity/cut_forecast.hpp"
#include "passo/job/tool_records.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {

// The tools of the library that have a limit.
LivesLeft lives_left(const ToolLibrary& library, const std::vector<ToolRecord>& records);

}  // namespace passo
