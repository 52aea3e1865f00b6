// A picture of a drill plan: holes and slots in actual size, coloured by tool, and the rapids between them.
#pragma once

#include "passo/cam/drill_plan.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"

namespace passo {

// Draws into `file`; the caller commits it. `park`, `link`: as in DrillOptions.
Status<OutputError> draw_drill_plan(const DrillPlan& plan, DrawnPoint park, const RouteLink& link,
                                    const PictureOptions& options, OutputFile& file);

}  // namespace passo
