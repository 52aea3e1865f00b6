// JSON conversion shared by several parts of the API. Private to api/.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api_answers.hpp"

#include "passo/activity/homing_repeats.hpp"
#include "passo/api/api_job.hpp"
#include "passo/api/api_routes.hpp"
#include "passo/api/camera.hpp"
#include "passo/api/machine_control.hpp"
#include "passo/api/mdi_lines.hpp"
#include "passo/api/pendant_status.hpp"
#include "passo/api/program_store.hpp"
#include "passo/drive/host_spindle.hpp"
#include "passo/job/job_history.hpp"
#include "passo/job/kept_job.hpp"

namespace passo {

class BoardMachineSession;

// Returns the name from the query, with the user's capitalisation. It may become a file name and be displayed in a
// terminal or a web page; a name that could be harmful there is refused. `otherwise`: the default.
Result<std::string, WebAnswer> name_from(std::string_view query, std::string_view otherwise);
// Returns a user's text for display to others, without control characters, and limited to 200 bytes.
std::string words_from(std::string_view text, std::string_view otherwise);
Result<Dialect, WebAnswer> dialect_from(std::string_view query);
std::string_view dialect_name(Dialect dialect);
// Reads from_line, pass and after from a query. Empty if they do not specify a position in a program.
std::optional<LinePlace> place_from(std::string_view query);

// Returns the request's body: the object sent over the WebSocket stream, or the parsed text. The error: its type (415)
// or its structure (400) does not match the route.
Result<Json, WebAnswer> read_body(BodyKind kind, const WebRequest& request, std::optional<Json> said);

// Rounds to six decimals: a tenth of a step of a high-resolution machine.
double rounded(double value);

Json as_json(const MachineDescription& machine, const Point& place);
Json as_json(const MachineDescription& machine, const MachineStatus& status);
Json as_json(const HostSpindleStatus& spindle);
Json as_json(const MachineControl& owner);
// Null: no pendant has been connected yet.
Json as_json(const PendantStatus& pendant);
Json as_json(const ApiJob& job);
// Returns the modal state of the MDI lines, and the tool position derived from it.
Json as_json(const MachineDescription& machine, const MdiLines& mdi, const Point& at);
Json as_json(const StoredProgram& program, bool with_findings);
Json as_json(const HistoryJob& job);
// Convert a sentence for the history, and from the history for a client; null if an older version of the program has
// written plain text.
std::string kept_form(const Sentence& sentence);
Json sentence_json(const std::string& kept, const std::string& words);
// Returns the results of the last homing, and the repeatability over all homings.
Json as_json(const std::vector<HomedAxis>& homed, const HomingRepeats& repeats);
// Returns the path of a program, for viewers.
WebAnswer path_answer(const StoredProgram& program, const MachineDescription& machine, const ToolTable& tools,
                      std::string_view query);
WebAnswer text_answer(const StoredProgram& program, std::string_view query);
WebAnswer height_map_answer(const HeightMap& map, std::string_view query);

using WayBack = Result<Reentry, Sentence>;
Json as_json(const MachineDescription& machine, const WayBack& way);
Json as_json(const MachineDescription& machine, const InterruptedJob& job, const WayBack& way);
Json machine_json(const MachineDescription& machine, const MachineAbilities& abilities, std::string_view version,
                  const CameraDescription* camera = nullptr);
Json as_json(const CameraStatus& camera);

// Returns {"severity", "code", "line", …} for each finding.
Json as_json(const Diagnostics& findings);
// Returns the individual step pulses of the board in a window of its clock.
WebAnswer pulses_answer(BoardMachineSession& session, const MachineDescription& machine, std::string_view query);

}  // namespace passo
