// Small files in which this computer remembers something of a board from one command to the next: a journal, a place.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace passo {

// The path of the file about a board, in the folder for state. Empty: there is no such folder. `ending`: ".journal" or
// ".place".
std::string state_file(const std::string& folder, const std::string& board, std::string_view ending);
// Reads such a file. A file that is too long for a journal gives an empty text. Nothing: there is no readable file.
std::optional<std::string> read_state_file(const std::string& path);
// Replaces such a file atomically: after a crash, the disk has the old or the new file. Returns its descriptor, open
// for writing; less than 0: it cannot be written, and this is -errno.
int replace_state_file(const std::string& path, std::string_view text);
// Writes all bytes at this offset. False: errno tells why not.
[[nodiscard]] bool write_all(int descriptor, std::string_view bytes, std::size_t offset);

}  // namespace passo
