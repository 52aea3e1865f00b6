// What the API's parts say in JSON. Private to api/.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "passo/api/machine_api.hpp"

namespace passo {

using Json = nlohmann::ordered_json;

inline constexpr std::string_view uploads_path = "/api/v1/uploads";
inline constexpr double a_minute = 60;  // s; the API's speeds are mm/min

WebAnswer json_answer(unsigned status, const Json& json);
// {"error": {"code": …, "message": …}}
WebAnswer error_answer(unsigned status, std::string_view code, std::string_view message);
// 400: what the body should have been.
WebAnswer bad_body(std::string_view message);

// What a query says. A name keeps its own letters. It may become a file's name, and stand in a terminal or a page: one
// that could do harm there is refused. `otherwise`: where the query has none.
Result<std::string, WebAnswer> name_from(std::string_view query, std::string_view otherwise);
// A person's words for others, without control characters, and at most 200 bytes of them.
std::string words_from(std::string_view text, std::string_view otherwise);
std::optional<Dialect> dialect_from(std::string_view query);

// Why a request cannot have this body: its type (415) or its shape (400). Empty: it can.
std::optional<WebAnswer> wrong_body(BodyKind kind, const WebRequest& request);

// The refusals of more than one file.
WebAnswer no_history();
WebAnswer no_place();
WebAnswer no_room();
// 507: the disk is full, or refuses for another reason.
WebAnswer unwritten(std::string_view what, std::string_view why);

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
// What the last homing has found, and how well all homings agree.
Json as_json(const std::vector<HomedAxis>& homed, const HomingRepeats& repeats);
// What viewers ask of a program.
WebAnswer path_answer(const StoredProgram& program, const MachineDescription& machine, const ToolTable& tools,
                      std::string_view query);
WebAnswer text_answer(const StoredProgram& program, std::string_view query);
WebAnswer height_map_answer(const StoredProgram& program, std::string_view query);

// The only member of a body. Empty, with a reason: it is not there, or something else is.
std::optional<bool> read_flag(const Json& body, const std::string& key, std::string& reason);
// {"place": {…}}: some of the axes, the others as in `start`. Empty, with the reason: the body is none.
std::optional<Point> read_place(const Json& body, const MachineDescription& machine, const Point& start,
                                std::string& reason);

using WayBack = Result<Reentry, ReentryProblem>;
Json as_json(const MachineDescription& machine, const WayBack& way);
Json as_json(const MachineDescription& machine, const InterruptedJob& job, const WayBack& way);
Json machine_json(const MachineDescription& machine, std::string_view version);

// {"severity", "code", "line", …} of each.
Json as_json(const Diagnostics& findings);
// The machine file for an editor. `in_force`: the file as passo serve has read it.
WebAnswer machine_file_answer(const MachineFileAccess& file, const FileStamp& in_force);
WebAnswer try_machine_file(const MachineFileAccess& file, std::string_view body);
WebAnswer write_machine_file(const MachineFileAccess& file, const FileStamp& in_force, std::string_view body);

// from_line, pass and after of a query. Empty: they are no place of a program.
std::optional<LinePlace> place_from(std::string_view query);

// The session's request in the body of a POST. Empty, with the reason: the body is none.
std::optional<Request> read_request(std::string_view path, const Json& body, const MachineDescription& machine,
                                    std::string& reason);

}  // namespace passo
