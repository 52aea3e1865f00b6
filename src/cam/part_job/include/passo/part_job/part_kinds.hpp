// What an operation of each kind may have in a job file. Forms and documents are generated from it.
#pragma once

#include <string_view>
#include <vector>

#include "passo/part_job/part_job.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {

struct PartKindKeys {
  PartKind kind = PartKind::profile;
  std::string_view command;     // whose options it has: "pocket" for face
  std::string_view first_tool;  // the key of its second tool, e.g. "rough-tool"; empty: it has one tool
  std::vector<std::string_view> options;
  std::string_view file;   // the key of what it cuts: "drawing", or "file" for a relief
  bool has_place = false;  // at = [X, Y]
};

std::vector<PartKindKeys> keys_of_part_kinds();

// The keys of a tool of a job file: those of a library, and its feed rates and speed.
std::vector<ToolKey> keys_of_part_tools();

}  // namespace passo
