#include "passo/api/program_uploads.hpp"

#include <utility>

namespace passo {

const ProgramUpload* ProgramUploads::begin(std::string name, Dialect dialect, std::size_t bytes, Seconds now) {
  if (uploads_.size() >= most_uploads || bytes > most_bytes - bytes_) drop_silent(now);
  if (uploads_.size() >= most_uploads || bytes > most_bytes - bytes_) return nullptr;
  bytes_ += bytes;
  const std::uint64_t id = ++last_id_;
  ProgramUpload& upload = uploads_[id];
  upload = {.id = id, .name = std::move(name), .dialect = dialect, .bytes = bytes, .text = {}, .heard = now};
  return &upload;
}

const ProgramUpload* ProgramUploads::find(std::uint64_t id) const {
  const auto found = uploads_.find(id);
  return found == uploads_.end() ? nullptr : &found->second;
}

ProgramUploads::Taken ProgramUploads::append(std::uint64_t id, std::size_t from, std::string_view piece, Seconds now) {
  ProgramUpload& upload = uploads_.at(id);
  upload.heard = now;
  if (from != upload.text.size()) return Taken::gap;
  if (piece.size() > upload.bytes - from) return Taken::too_long;
  upload.text += piece;
  return upload.text.size() == upload.bytes ? Taken::whole : Taken::more;
}

ProgramUpload ProgramUploads::remove(std::uint64_t id) {
  ProgramUpload upload = std::move(uploads_.at(id));
  bytes_ -= upload.bytes;
  uploads_.erase(id);
  return upload;
}

void ProgramUploads::drop_silent(Seconds now) {
  for (auto upload = uploads_.begin(); upload != uploads_.end();) {
    const bool is_silent = now - upload->second.heard > longest_silence;
    if (is_silent) bytes_ -= upload->second.bytes;
    upload = is_silent ? uploads_.erase(upload) : std::next(upload);
  }
}

}  // namespace passo
