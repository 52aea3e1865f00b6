#include "board_files_api.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/base/lower_case.hpp"
#include "passo/session/request_checks.hpp"

namespace passo {
namespace {

const char* name_of(StorageResult::State state) {
  constexpr std::array<const char*, 4> names = {"none", "running", "done", "failed"};
  return names[static_cast<std::size_t>(state)];
}

const char* name_of(StorageOrder::Kind kind) {
  constexpr std::array<const char*, 3> names = {"list", "upload", "remove"};
  return names[static_cast<std::size_t>(kind)];
}

// A board also stores settings and pages. The endings of programs, as grblHAL lists them, and other usual ones.
bool is_program(const std::string& path) {
  constexpr std::array<std::string_view, 11> endings = {"nc", "ncc", "ngc", "cnc",  "gcode", "gc",
                                                        "g",  "tap", "txt", "text", "macro"};
  const std::size_t dot = path.rfind('.');
  return dot != std::string::npos && std::ranges::find(endings, lower_case(path.substr(dot + 1))) != endings.end();
}

std::string name_in(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

// "/sd/part.nc" of "sd/part.nc". Empty: it is no path.
std::optional<std::string> path_of(const ApiCall& call) {
  const auto decoded = percent_decoded(call.rest);
  if (!decoded || decoded->empty()) return {};
  return decoded->starts_with('/') ? *decoded : "/" + *decoded;
}

WebAnswer no_path() {
  return error_answer(
      400, "http.bad-name",
      Sentence{.code = "http.bad-name.percent",
               .text = "invalid name: a % in it is not followed by two hexadecimal digits; write % as %25"});
}

}  // namespace

const StoredProgram* BoardFilesApi::text_of(const std::string& path) const {
  const auto sent = sent_.find(path);
  const BoardStorage* const storage = shared_.session.storage();
  if (sent == sent_.end() || storage == nullptr) return nullptr;
  const std::vector<StoredFile>& files = storage->result().files;
  const auto file = std::ranges::find(files, path, &StoredFile::path);
  if (file == files.end() || file->bytes != sent->second.bytes) return nullptr;
  return shared_.programs.find(sent->second.program);
}

WebAnswer BoardFilesApi::state_answer(unsigned status) const {
  const BoardStorage* const storage = shared_.session.storage();
  if (storage == nullptr) {
    return json_answer(status, {{"has_storage", false},
                                {"folder", ""},
                                {"why_no_upload", Json()},
                                {"words_no_upload", ""},
                                {"state", "none"},
                                {"order", Json()},
                                {"path", ""},
                                {"why", Json()},
                                {"words", ""},
                                {"share", 0},
                                {"left", Json()},
                                {"files", Json()}});
  }
  const StorageResult& result = storage->result();
  Json files;
  if (result.is_listed) {
    files = Json::array();
    for (const StoredFile& one : result.files) {
      const StoredProgram* const program = text_of(one.path);
      files.push_back({{"path", one.path},
                       {"bytes", one.bytes},
                       {"can_run", one.can_run},
                       {"program", program != nullptr ? Json(program->id) : Json()}});
    }
  }
  const auto why_no_upload = storage->why_no_upload();
  const bool has_order = result.state != StorageResult::State::none;
  return json_answer(status, {{"has_storage", true},
                              {"folder", storage->folder()},
                              {"why_no_upload", why_no_upload ? as_json(*why_no_upload) : Json()},
                              {"words_no_upload", why_no_upload ? why_no_upload->text : ""},
                              {"state", name_of(result.state)},
                              {"order", has_order ? Json(name_of(result.kind)) : Json()},
                              {"path", result.path},
                              {"why", result.why.code.empty() ? Json() : as_json(result.why)},
                              {"words", result.why.text},
                              {"share", rounded(result.share)},
                              {"left", result.left ? Json(rounded(result.left->value())) : Json()},
                              {"files", std::move(files)}});
}

WebAnswer BoardFilesApi::get(const ApiCall&) {
  return state_answer(200);
}

// The board must be at rest, and must have storage.
std::optional<WebAnswer> BoardFilesApi::refuse() const {
  if (shared_.session.storage() == nullptr) {
    return refused_answer(refusal_of(shared_.session.abilities(), Ability::board_files));
  }
  if (jobs_.is_checking()) return job_begins();
  if (jobs_.parked()) return jobs_.parked_refusal();
  if (shared_.session.state() != MachineState::idle) return not_idle(shared_.session.state());
  return {};
}

WebAnswer BoardFilesApi::begin(StorageOrder order) {
  if (const auto refused = shared_.session.storage()->begin(std::move(order))) return refused_answer(*refused);
  return state_answer(202);
}

WebAnswer BoardFilesApi::list(const ApiCall&) {
  auto refused = refuse();
  return refused ? std::move(*refused) : begin({});
}

void BoardFilesApi::forget(const std::string& path) {
  const auto sent = sent_.find(path);
  if (sent == sent_.end()) return;
  const StoredProgram* const program = shared_.programs.find(sent->second.program);
  if (program != nullptr && !jobs_.runs(*program) && !jobs_.waits_with(program->id))
    shared_.programs.remove(program->id);
  sent_.erase(sent);
}

WebAnswer BoardFilesApi::send(const ApiCall& call) {
  auto path = path_of(call);
  if (!path) return no_path();
  if (auto refused = refuse()) return std::move(*refused);
  const std::string& text = call.request.body;
  SentFile file{.bytes = text.size()};
  if (is_program(*path)) {
    const StoredProgram* const program = shared_.programs.add(name_in(*path), Dialect::grbl, text);
    if (program == nullptr) return no_room();
    file.program = program->id;
  }
  WebAnswer answer = begin({.kind = StorageOrder::Kind::upload, .path = *path, .content = text});
  if (answer.status != 202) {
    shared_.programs.remove(file.program);
    return answer;
  }
  forget(*path);
  arriving_ = {std::move(*path), file};
  return answer;
}

WebAnswer BoardFilesApi::remove(const ApiCall& call) {
  auto path = path_of(call);
  if (!path) return no_path();
  if (auto refused = refuse()) return std::move(*refused);
  return begin({.kind = StorageOrder::Kind::remove, .path = std::move(*path)});
}

void BoardFilesApi::poll() {
  if (!arriving_) return;
  const BoardStorage* const storage = shared_.session.storage();
  if (storage != nullptr && storage->result().uploads != uploads_) {
    uploads_ = storage->result().uploads;
    sent_[arriving_->first] = arriving_->second;
    arriving_.reset();
  } else if (storage == nullptr || storage->result().state != StorageResult::State::running) {
    arriving_.reset();  // the program stays: a person may send it again
  }
}

WebAnswer BoardFilesApi::run(const ApiCall& call) {
  const Json members = call.members();
  const Json path = members.value("path", Json());
  const Json unchecked = members.value("unchecked", Json(false));
  for (const auto& [name, value] : members.items()) {
    if (name != "path" && name != "unchecked")
      return bad_body(fmt::format("{}: there is no such member", name.substr(0, 40)));
  }
  if (!path.is_string() || !unchecked.is_boolean()) {
    return bad_body(R"(expected "path": a file of the board, and "unchecked": true if Passo does not have its text)");
  }
  if (auto refused = refuse()) return std::move(*refused);
  const auto file = path.get<std::string>();
  if (const StoredProgram* const program = text_of(file)) {
    // The board executes lines that begin with /, unless a switch of its own leaves them out.
    if (program->block_delete) shared_.programs.set_block_delete(program->id, false);
    return jobs_.begin(*program, {.board_file = file});
  }
  if (!unchecked.get<bool>()) {
    return error_answer(409, "board-files.unchecked",
                        "Passo does not have the text of this file, so it cannot check it: send the file from here, or "
                        "run it unchecked");
  }
  return jobs_.begin_unchecked(file);
}

}  // namespace passo
