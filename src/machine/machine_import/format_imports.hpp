// The mapping of each format to a model. They report each key of the tree, and fail by an error of the context.
#pragma once

#include "import_context.hpp"
#include "imported_model.hpp"

namespace passo {

void import_settings(const SourceNode& tree, ImportContext& context, ImportedModel& model);
void import_fluidnc(const SourceNode& tree, ImportContext& context, ImportedModel& model);
void import_linuxcnc(const SourceNode& tree, ImportContext& context, ImportedModel& model);
void import_mach3(const SourceNode& tree, ImportContext& context, ImportedModel& model);

}  // namespace passo
