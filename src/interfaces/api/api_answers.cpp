#include "api_answers.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace passo {

WebAnswer json_answer(unsigned status, const Json& json) {
  return {.status = status,
          .type = "application/json",
          .body = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"};
}

Json as_json(const Sentence& sentence) {
  Json arguments = Json::object();
  for (const auto& [name, value] : sentence.arguments) arguments[std::string(name)] = value;
  return {{"code", sentence.code}, {"arguments", std::move(arguments)}};
}

WebAnswer error_answer(unsigned status, std::string_view code, const Sentence& sentence) {
  return json_answer(status,
                     {{"error", {{"code", code}, {"message", sentence.text}, {"sentence", as_json(sentence)}}}});
}

WebAnswer error_answer(unsigned status, std::string_view code, std::string_view message) {
  return error_answer(status, code, Sentence{.code = std::string(code), .text = std::string(message)});
}

WebAnswer refusal_answer(unsigned status) {
  switch (status) {
    case 400: return error_answer(status, "http.bad-request", "not a valid HTTP request");
    case 401: return error_answer(status, "http.token", "a token is needed: the header Authorization: Bearer …");
    case 403: return error_answer(status, "http.foreign-page", "the name in Host or Origin is not this server's");
    case 404: return error_answer(status, "http.not-found", "this path does not exist");
    case 405: return error_answer(status, "http.method", "this path does not have this method");
    case 413: return error_answer(status, "http.too-large", "the body is too long");
    case 431: return error_answer(status, "http.too-large", "the header is too long");
    case 503: return error_answer(status, "http.busy", "other clients or large uploads use all resources: try again");
    default: return error_answer(status, "http.error", "the request failed");
  }
}

WebAnswer bad_body(std::string_view message) {
  return error_answer(400, "http.bad-body", message);
}

WebAnswer refused_answer(const Refusal& refusal) {
  return error_answer(refusal.code() == RefusalCode::bad_value ? 400 : 409, code_of(refusal.code()),
                      refusal.sentence());
}

WebAnswer ticket_answer(const MachineSession& session, Ticket ticket) {
  return json_answer(200, {{"ticket", ticket}, {"change", session.status().version}});
}

Sentence sentence_of_busy(MachineState state) {
  return {.code = "machine.busy.not-idle",
          .arguments = {{"state", std::string(name_of(state))}},
          .text = fmt::format("the machine is not idle: {}", name_of(state))};
}

Sentence sentence_of_unwritten(std::string_view what, std::string_view finer, std::string why) {
  std::string text = fmt::format("{} cannot be written: {}", what, why);
  return {
      .code = fmt::format("data.unwritten.{}", finer), .arguments = {{"why", std::move(why)}}, .text = std::move(text)};
}

WebAnswer not_idle(MachineState state) {
  return error_answer(409, "machine.busy", sentence_of_busy(state));
}

WebAnswer job_begins() {
  return error_answer(409, "machine.busy",
                      Sentence{.code = "machine.busy.job-begins", .text = "a job is about to start"});
}

WebAnswer no_camera() {
  return error_answer(404, "camera.none", "the machine file has no camera: the table [camera]");
}

WebAnswer no_history() {
  return error_answer(404, "data.none", "passo serve stores nothing: start it with --data DIR");
}

WebAnswer no_maker() {
  return error_answer(404, "make.none", "this server generates no programs");
}

WebAnswer no_place() {
  return bad_body(
      "from_line: expected the number of a line, 1 or more; pass: a number, 1 or more; after: millimetres, 0 or more");
}

WebAnswer no_ports() {
  return error_answer(404, "ports.none", "this server opens no serial ports");
}

WebAnswer no_room() {
  return error_answer(507, "programs.no-room", "there are too many programs: delete some first");
}

WebAnswer no_settings() {
  return error_answer(404, "settings.none", "this server reads no settings of boards");
}

WebAnswer no_studies() {
  return error_answer(404, "study.none", "this server runs no studies");
}

WebAnswer unwritten(std::string_view what, std::string_view finer, std::string why) {
  return error_answer(507, "data.unwritten", sentence_of_unwritten(what, finer, std::move(why)));
}

}  // namespace passo
