// Responses shared by several parts of the API. Private to api/.
#pragma once

#include <string>
#include <string_view>

#include "api_call.hpp"

#include "passo/base/sentence.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

WebAnswer json_answer(unsigned status, const Json& json);
// Returns {"code": …, "arguments": {…}}: the data from which a client can translate the sentence.
Json as_json(const Sentence& sentence);
// Returns {"error": {"code": …, "message": …, "sentence": …}}. The sentence's code may be more specific than `code`,
// which clients compare.
WebAnswer error_answer(unsigned status, std::string_view code, const Sentence& sentence);
WebAnswer error_answer(unsigned status, std::string_view code, std::string_view message);
// Returns an error response with the standard message of this HTTP status.
WebAnswer refusal_answer(unsigned status);
// 400: describes the expected body.
WebAnswer bad_body(std::string_view message);
// Returns the error response for a request refused by the session.
WebAnswer refused_answer(const Refusal& refusal);
// Includes the current version of the status, by which a client recognises statuses older than its request.
WebAnswer ticket_answer(const MachineSession& session, Ticket ticket);

Sentence sentence_of_busy(MachineState state);
Sentence sentence_of_unwritten(std::string_view what, std::string_view finer, std::string why);

WebAnswer not_idle(MachineState state);
WebAnswer job_begins();
WebAnswer no_camera();
WebAnswer no_history();
WebAnswer no_maker();
WebAnswer no_place();
WebAnswer no_ports();
WebAnswer no_room();
WebAnswer no_settings();
WebAnswer no_studies();
// 507: writing failed because the disk is full, or for another reason. `what`: "the job"; `finer`: "job".
WebAnswer unwritten(std::string_view what, std::string_view finer, std::string why);

}  // namespace passo
