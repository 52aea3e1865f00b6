// set_option: stores a value of a job file in the member that an option's row names. Private to part_job/.
#pragma once

#include <string>

#include "passo/operations/cam_option.hpp"
#include "passo/toml/toml_document.hpp"

namespace passo {

// Returns the expected form; empty: the value is stored. Lengths and feeds are checked only by the operation.
std::string set_option(const CamOption& option, const TomlValue& value);

}  // namespace passo
