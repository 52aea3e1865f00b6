// read_zip_member: one file of a zip archive in memory, for other readers of archives.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

// The error is a sentence without a full stop: the archive is damaged, or the file is missing, needs a password, or has
// more than `most` bytes.
Result<std::string, std::string> read_zip_member(std::string_view bytes, const std::string& name, std::size_t most);

}  // namespace passo
