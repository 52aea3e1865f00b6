#include "place_file.hpp"

#include "journal_file.hpp"
#include "program_input.hpp"
#include <unistd.h>

namespace passo {

PlaceFile::PlaceFile(const std::string& board) : path_(state_file(board, ".place")) {}

std::optional<PlaceRecord> PlaceFile::read() const {
  if (path_.empty()) return {};
  const std::optional<std::string> text = read_state_file(path_);
  return text ? read_place_record(*text) : std::nullopt;
}

void PlaceFile::write(const PlaceRecord& record) const {
  if (path_.empty()) return;
  const int descriptor = replace_state_file(path_, text_of(record));
  if (descriptor < 0)
    return note(path_ + " cannot be written, so the next command will not know where the machine stands");
  close(descriptor);
}

}  // namespace passo
