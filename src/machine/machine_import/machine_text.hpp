// write_machine_text: a model as the text of a machine file, in the order and style of examples/machines. Each value
// carries its source as a comment, and goes into the report.
#pragma once

#include <string>

#include "import_context.hpp"
#include "imported_model.hpp"
#include "model_completion.hpp"

namespace passo {

// The model is complete (complete_model()).
std::string write_machine_text(const ImportedModel& model, const ImportedBoard& board, ImportContext& context);

}  // namespace passo
