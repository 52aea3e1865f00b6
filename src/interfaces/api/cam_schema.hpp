// What an order of a CAM operation or a study may say, as JSON Schema and as a check. Private to api/.
#pragma once

#include <string>
#include <vector>

#include "api_call.hpp"

#include "passo/base/result.hpp"
#include "passo/operations/cam_operation.hpp"

namespace passo {

// The options of an operation. What JSON Schema has no word for begins with "x-": x-accepts (endings of its files),
// x-most-files, x-instead-of-files (an option), x-parts (operations that a profile may speak of); of an option x-kind,
// x-for (experts, programs), x-of-job (the board's order decides it for its parts) and x-of-machine (the machine file
// may have another default).
Json schema_of(const CamOperation& operation);

// Null: an order has no option of this name.
const CamOption* find_ordered(std::span<const CamOption> options, std::string_view name);

// What an option is told, as words for the command line: each value as a text. `files`: those that were sent.
// The error: what was expected.
Result<std::vector<std::string>, std::string> ordered_values(const CamOption& option, const Json& value,
                                                             const std::vector<std::string>& files);

}  // namespace passo
