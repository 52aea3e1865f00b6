// What the API's parts say in JSON. Private to api/.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api_answers.hpp"

#include "passo/activity/homing_repeats.hpp"
#include "passo/api/api_job.hpp"
#include "passo/api/api_routes.hpp"
#include "passo/api/mdi_lines.hpp"
#include "passo/api/motion_owner.hpp"
#include "passo/api/program_store.hpp"
#include "passo/job/job_history.hpp"
#include "passo/job/kept_job.hpp"

namespace passo {

inline constexpr double a_minute = 60;  // s; the API's speeds are mm/min

// What a query says. A name keeps its own letters. It may become a file's name, and stand in a terminal or a page: one
// that could do harm there is refused. `otherwise`: where the query has none.
Result<std::string, WebAnswer> name_from(std::string_view query, std::string_view otherwise);
// A person's words for others, without control characters, and at most 200 bytes of them.
std::string words_from(std::string_view text, std::string_view otherwise);
Result<Dialect, WebAnswer> dialect_from(std::string_view query);
std::string_view dialect_name(Dialect dialect);
// from_line, pass and after of a query. Empty: they are no place of a program.
std::optional<LinePlace> place_from(std::string_view query);

// The body of a request: what a client of the stream has said, or the text. The error: its type (415) or its shape
// (400) is another than the route's.
Result<Json, WebAnswer> read_body(BodyKind kind, const WebRequest& request, std::optional<Json> said);

// Six decimals: a tenth of a step of a fine machine.
double rounded(double value);

Json as_json(const MachineDescription& machine, const Point& place);
Json as_json(const MachineDescription& machine, const MachineStatus& status);
Json as_json(const MotionOwner& owner);
Json as_json(const ApiJob& job);
// The modes of the lines that a person types, and where the tool is by them.
Json as_json(const MachineDescription& machine, const MdiLines& mdi, const Point& at);
Json as_json(const StoredProgram& program, bool with_findings);
Json as_json(const HistoryJob& job);
// How the history keeps a sentence, and what a client gets of it: null where an older program has written the words.
std::string kept_form(const Sentence& sentence);
Json sentence_json(const std::string& kept, const std::string& words);
// What the last homing has found, and how well all homings agree.
Json as_json(const std::vector<HomedAxis>& homed, const HomingRepeats& repeats);
// What viewers ask of a program.
WebAnswer path_answer(const StoredProgram& program, const MachineDescription& machine, const ToolTable& tools,
                      std::string_view query);
WebAnswer text_answer(const StoredProgram& program, std::string_view query);
WebAnswer height_map_answer(const HeightMap& map, std::string_view query);

using WayBack = Result<Reentry, Sentence>;
Json as_json(const MachineDescription& machine, const WayBack& way);
Json as_json(const MachineDescription& machine, const InterruptedJob& job, const WayBack& way);
Json machine_json(const MachineDescription& machine, std::string_view version);

// {"severity", "code", "line", …} of each.
Json as_json(const Diagnostics& findings);
// The pulses that the board makes, one by one, for a window of its clock.
WebAnswer pulses_answer(MachineSession& session, const MachineDescription& machine, std::string_view query);

}  // namespace passo
