// Answers that several parts of the API give. Private to api/.
#pragma once

#include <string>
#include <string_view>

#include "api_call.hpp"

#include "passo/base/sentence.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

WebAnswer json_answer(unsigned status, const Json& json);
// {"code": …, "arguments": {…}}: what a client needs to say it in another language.
Json as_json(const Sentence& sentence);
// {"error": {"code": …, "message": …, "sentence": …}}. The sentence's code may be finer than the code that clients
// compare.
WebAnswer error_answer(unsigned status, std::string_view code, const Sentence& sentence);
WebAnswer error_answer(unsigned status, std::string_view code, std::string_view message);
// What HTTP's own status says.
WebAnswer refusal_answer(unsigned status);
// 400: what the body should have been.
WebAnswer bad_body(std::string_view message);
// What the session has refused.
WebAnswer refused_answer(const Refusal& refusal);
// A client tells by the change which statuses are older than its request.
WebAnswer ticket_answer(const MachineSession& session, Ticket ticket);

Sentence sentence_of_busy(MachineState state);
Sentence sentence_of_unwritten(std::string_view what, std::string_view finer, std::string why);

WebAnswer not_idle(MachineState state);
WebAnswer job_begins();
WebAnswer no_history();
WebAnswer no_maker();
WebAnswer no_place();
WebAnswer no_room();
WebAnswer no_studies();
// 507: the disk is full, or refuses for another reason.
// `what`: "the job"; `finer`: "job".
WebAnswer unwritten(std::string_view what, std::string_view finer, std::string why);

}  // namespace passo
