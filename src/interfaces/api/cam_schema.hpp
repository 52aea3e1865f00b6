// The parameters of a CAM operation or a study, as JSON Schema and as a check. Private to api/.
#pragma once

#include <string>
#include <vector>

#include "api_call.hpp"

#include "passo/base/result.hpp"
#include "passo/operations/cam_operation.hpp"

namespace passo {

// Returns the schema of an operation's options. Extensions to JSON Schema begin with "x-": x-accepts (file name
// extensions), x-most-files, x-instead-of-files (an option), x-parts (operations that a profile may configure); for an
// option x-kind, x-for (experts, programs), x-of-job (for a board, set by the order as a whole) and x-of-machine (the
// machine file may set another default).
Json schema_of(const CamOperation& operation);

// Null if an order has no option of this name.
const CamOption* find_ordered(std::span<const CamOption> options, std::string_view name);

// Converts the value of an option to command-line arguments: each value as a text. `files`: the uploaded files. The
// error: what was expected.
Result<std::vector<std::string>, std::string> ordered_values(const CamOption& option, const Json& value,
                                                             const std::vector<std::string>& files);

}  // namespace passo
