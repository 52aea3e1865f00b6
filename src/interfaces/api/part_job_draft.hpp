// A job file as the web interface edits it: what the text says, with the lines of its keys, and edits of the text.
// Private to api/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "api_call.hpp"

#include "passo/base/result.hpp"

namespace passo {

// Bytes; a job of 100 operations has 20 KB. The server edits it between two updates of the board's queue, which may be
// late by 60 ms.
inline constexpr std::size_t longest_job_text = std::size_t{24} << 10;
inline constexpr std::size_t most_job_edits = 10;  // of one request

struct DraftPlace {
  std::string name;                // of the job file
  std::string folder;              // where the files are that were sent; ends with '/'
  std::vector<std::string> files;  // those that were sent
};

// {"name", "stamp", "text", "editable", "good", "findings", "job", "stock", "nest", "clamps",
// "clamp_paths", "tool_tables", "tools", "operations"}.
Json draft_of_job(const std::string& text, const DraftPlace& place);

// Identifies a text, so that an edit of another one is refused.
std::string stamp_of_job(std::string_view text);

// Applies edits in their order: {"do": "set", "path": "operation.2.depth", "value": -4}, {"do": "unset", "path"},
// {"do": "insert", "number", "values": {}}, {"do": "copy", "number"}, {"do": "move", "number", "to"},
// {"do": "remove", "number"}. The last four are about operations, or about the "list" clamp or fixture.
// {"do": "remove", "path": "tool.3"} removes a table. The error: why none was applied.
Result<std::string, std::string> edited_job(const std::string& text, const Json& edits);

// The kinds of operations with the keys that each has.
Json part_kinds_json();
// The keys of a tool, for forms.
Json tool_keys_json();

}  // namespace passo
