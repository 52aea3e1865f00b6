// Small files that store data about a board between commands: a journal, a position.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace passo {

// Returns the path of the file for a board, in the state folder. Empty: there is no such folder. `ending`: ".journal"
// or ".place".
std::string state_file(const std::string& folder, const std::string& board, std::string_view ending);
// Reads such a file. A file that is too long for a journal gives an empty text. Nothing: there is no readable file.
std::optional<std::string> read_state_file(const std::string& path);
// Replaces such a file atomically: after a crash, the disk has the old or the new file. Returns its descriptor, open
// for writing; a negative value is -errno, if it cannot be written.
int replace_state_file(const std::string& path, std::string_view text);
// Writes all bytes at this offset. If it returns false, errno gives the reason.
[[nodiscard]] bool write_all(int descriptor, std::string_view bytes, std::size_t offset);

}  // namespace passo
