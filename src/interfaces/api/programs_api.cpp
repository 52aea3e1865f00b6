#include "programs_api.hpp"

#include <charconv>
#include <utility>

#include "api_json.hpp"
#include "json_members.hpp"
#include <fmt/format.h>

#include "passo/probing/levelled_program.hpp"

namespace passo {
namespace {

constexpr double finest_tolerance = 1e-4;  // mm
constexpr double coarsest_tolerance = 10;

WebAnswer no_height_map() {
  return error_answer(404, "http.not-found", "this program has no height map");
}

WebAnswer no_upload() {
  return error_answer(404, "http.not-found", "there is no such upload");
}

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

// The error says what is wrong.
Result<LevelOptions, WebAnswer> level_options(const ApiCall& call) {
  LevelOptions wish;
  if (const std::string_view tolerance = call.query("tolerance"); !tolerance.empty()) {
    wish.tolerance = 0;
    std::from_chars(tolerance.data(), tolerance.data() + tolerance.size(), wish.tolerance);
  }
  if (!(wish.tolerance >= finest_tolerance && wish.tolerance <= coarsest_tolerance)) {
    return Failure{bad_body(fmt::format("tolerance: expected {:g} to {:g} mm", finest_tolerance, coarsest_tolerance))};
  }
  const std::string_view holes = call.query("holes");
  if (!holes.empty() && holes != "true" && holes != "false") return Failure{bad_body("holes: expected true or false")};
  wish.holes = holes == "true";
  return wish;
}

}  // namespace

WebAnswer ProgramsApi::list(const ApiCall&) {
  Json list = Json::array();
  for (const auto& [id, program] : shared_.programs.all()) list.push_back(as_json(program, false));
  return json_answer(200, {{"programs", std::move(list)}});
}

WebAnswer ProgramsApi::send(const ApiCall& call) {
  const auto dialect = dialect_from(call.request.query);
  if (!dialect) return dialect.error();
  auto name = name_from(call.request.query, "program");
  if (!name) return name.error();
  const StoredProgram* const program = shared_.programs.add(std::move(*name), *dialect, call.request.body);
  return program != nullptr ? json_answer(201, as_json(*program, false)) : no_room();
}

WebAnswer ProgramsApi::get(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  return program != nullptr ? json_answer(200, as_json(*program, true)) : refusal_answer(404);
}

WebAnswer ProgramsApi::remove(const ApiCall& call) {
  if (shared_.programs.find(call.id) == nullptr) return refusal_answer(404);
  if (jobs_.waits_with(call.id)) return error_answer(409, "programs.in-use", "the program is about to run");
  shared_.programs.remove(call.id);
  return json_answer(200, Json::object());
}

WebAnswer ProgramsApi::check(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  if (jobs_.is_checking()) return job_begins();
  shared_.programs.check(call.id, shared_.machine, shared_.session.status().position.place);
  return json_answer(202, as_json(*program, false));
}

// Only of a program that does not run: what runs was read with the choice of before.
WebAnswer ProgramsApi::set_block_delete(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  if (jobs_.is_checking()) return job_begins();
  JsonMembers members(call.body);
  const auto leaves_out = members.flag("on");
  if (!leaves_out) members.fail("on", "true or false");
  if (!members.end()) return bad_body(members.reason());
  if (*leaves_out && program->dialect == Dialect::grbl)
    return bad_body("the Grbl dialect has no block delete: such lines are executed");
  if (jobs_.runs(*program)) return error_answer(409, "programs.in-use", "the program is running");
  shared_.programs.set_block_delete(program->id, *leaves_out);
  return json_answer(200, as_json(*program, false));
}

WebAnswer ProgramsApi::path(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  return path_answer(*program, shared_.machine, shared_.programs.tools(), call.request.query);
}

WebAnswer ProgramsApi::text(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  return program != nullptr ? text_answer(*program, call.request.query) : refusal_answer(404);
}

WebAnswer ProgramsApi::height_map(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  return program->height_map ? height_map_answer(*program->height_map, call.request.query) : no_height_map();
}

WebAnswer ProgramsApi::set_height_map(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  Diagnostics findings;
  auto map = read_height_map("the body", call.request.body, findings);
  if (!map) return error_answer(400, "surface.height-map", findings.all().front().message);
  shared_.programs.set_height_map(program->id, std::move(*map));
  return height_map_answer(*program->height_map, "");
}

WebAnswer ProgramsApi::level(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  if (!program->height_map) return no_height_map();
  const MachineSession& session = shared_.session;
  if (session.state() != MachineState::idle || jobs_.is_checking()) return not_idle(session.state());
  if (program->text.size() > longest_to_level) return refusal_answer(413);
  const auto wish = level_options(call);
  if (!wish) return wish.error();
  Diagnostics findings;
  InterpreterOptions options = shared_.programs.options_of(*program);
  options.start = session.status().position.place;
  options.on_machine = true;
  std::string text;
  write_levelled_program(ProgramReader::from_text(program->name, program->text), options, *program->height_map, *wish,
                         findings, [&](std::string_view piece) { text += piece; });
  for (const Diagnostic& one : findings.all()) {
    if (one.severity != Severity::error) continue;
    return error_answer(409, one.code, fmt::format("line {}: {}", one.place.line, one.message));
  }
  const StoredProgram* const levelled =
      shared_.programs.add("level " + program->name, Dialect::linuxcnc, std::move(text));
  if (levelled == nullptr) return no_room();
  Json answer = as_json(*levelled, false);
  answer["findings"] = as_json(findings);
  return json_answer(201, std::move(answer));
}

WebAnswer ProgramsApi::list_uploads(const ApiCall&) {
  Json list = Json::array();
  for (const auto& [id, upload] : uploads_.all()) list.push_back(upload_json(upload));
  return json_answer(200, {{"uploads", std::move(list)}});
}

WebAnswer ProgramsApi::begin_upload(const ApiCall& call) {
  const auto bytes = bytes_from(call.query("bytes"));
  const auto dialect = dialect_from(call.request.query);
  if (!dialect) return dialect.error();
  if (!bytes || *bytes == 0) {
    return bad_body("bytes: expected the length of the program in bytes, 1 or more");
  }
  if (*bytes > ProgramStore::longest_program) return refusal_answer(413);
  auto name = name_from(call.request.query, "program");
  if (!name) return name.error();
  const bool has_room = shared_.programs.all().size() < ProgramStore::most_programs;
  const ProgramUpload* const upload =
      has_room ? uploads_.begin(std::move(*name), *dialect, *bytes, shared_.session.now()) : nullptr;
  return upload != nullptr ? json_answer(201, upload_json(*upload)) : no_room();
}

WebAnswer ProgramsApi::get_upload(const ApiCall& call) {
  const ProgramUpload* const upload = uploads_.find(call.id);
  return upload != nullptr ? json_answer(200, upload_json(*upload)) : no_upload();
}

WebAnswer ProgramsApi::drop_upload(const ApiCall& call) {
  if (uploads_.find(call.id) == nullptr) return no_upload();
  uploads_.remove(call.id);
  return json_answer(200, Json::object());
}

WebAnswer ProgramsApi::receive_piece(const ApiCall& call) {
  const ProgramUpload* const upload = uploads_.find(call.id);
  if (upload == nullptr) return no_upload();
  const auto from = bytes_from(call.query("from"));
  if (!from) return bad_body("from: expected the offset of this piece in bytes");
  switch (uploads_.append(call.id, *from, call.request.body, shared_.session.now())) {
    case ProgramUploads::Taken::more: return json_answer(200, upload_json(*upload));
    case ProgramUploads::Taken::gap:
      return error_answer(409, "uploads.gap",
                          fmt::format("the next piece begins at byte {}, not {}", upload->text.size(), *from));
    case ProgramUploads::Taken::too_long:
      return error_answer(409, "uploads.too-long",
                          fmt::format("{} bytes were announced, but more were received", upload->bytes));
    case ProgramUploads::Taken::whole: break;
  }
  ProgramUpload whole = uploads_.remove(call.id);
  const StoredProgram* const program =
      shared_.programs.add(std::move(whole.name), whole.dialect, std::move(whole.text));
  return program != nullptr ? json_answer(201, as_json(*program, false)) : no_room();
}

}  // namespace passo
