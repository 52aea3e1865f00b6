// MachineApi: programs that are uploaded in pieces.
#include <charconv>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// A number of bytes. Empty: it is none.
std::optional<std::size_t> bytes_from(std::string_view text) {
  std::size_t bytes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), bytes);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return bytes;
}

Json upload_json(const ProgramUpload& upload) {
  return {{"id", upload.id}, {"name", upload.name}, {"bytes", upload.bytes}, {"received", upload.text.size()}};
}

}  // namespace

WebAnswer MachineApi::look_at_uploads(const FoundRoute& found) const {
  if (found.route->path == uploads_path) {
    Json list = Json::array();
    for (const auto& [id, upload] : uploads_.all()) list.push_back(upload_json(upload));
    return json_answer(200, {{"uploads", std::move(list)}});
  }
  const ProgramUpload* const upload = uploads_.find(found.id);
  if (upload == nullptr) return error_answer(404, "http.not-found", "there is no such upload");
  return json_answer(200, upload_json(*upload));
}

WebAnswer MachineApi::begin_upload(const WebRequest& request) {
  const auto bytes = bytes_from(query_value(request.query, "bytes"));
  const auto dialect = dialect_from(request.query);
  if (!dialect) return bad_body("the dialect is linuxcnc or grbl");
  if (!bytes || *bytes == 0) {
    return bad_body("bytes: expected how long the program is, 1 or more");
  }
  if (*bytes > ProgramStore::longest_program) return refusal(413);
  auto name = name_from(request.query, "program");
  if (!name) return name.error();
  const bool has_room = programs_.all().size() < ProgramStore::most_programs;
  const ProgramUpload* const upload =
      has_room ? uploads_.begin(std::move(*name), *dialect, *bytes, session_.now()) : nullptr;
  return upload != nullptr ? json_answer(201, upload_json(*upload)) : no_room();
}

WebAnswer MachineApi::change_uploads(const FoundRoute& found, const WebRequest& request) {
  if (found.route->path == uploads_path) return begin_upload(request);
  const ProgramUpload* const upload = uploads_.find(found.id);
  if (upload == nullptr) return error_answer(404, "http.not-found", "there is no such upload");
  if (request.method == "DELETE") {
    uploads_.remove(found.id);
    return json_answer(200, Json::object());
  }
  const auto from = bytes_from(query_value(request.query, "from"));
  if (!from) return bad_body("from: expected the byte where this piece begins");
  switch (uploads_.take(found.id, *from, request.body, session_.now())) {
    case ProgramUploads::Taken::more: return json_answer(200, upload_json(*upload));
    case ProgramUploads::Taken::gap:
      return error_answer(409, "uploads.gap",
                          fmt::format("the next piece begins at byte {}, not {}", upload->text.size(), *from));
    case ProgramUploads::Taken::too_long:
      return error_answer(409, "uploads.too-long",
                          fmt::format("{} bytes were announced, and more have come", upload->bytes));
    case ProgramUploads::Taken::whole: break;
  }
  ProgramUpload whole = uploads_.remove(found.id);
  const StoredProgram* const program = programs_.add(whole.name, whole.dialect, std::move(whole.text));
  return program != nullptr ? json_answer(201, as_json(*program, false)) : no_room();
}

}  // namespace passo
