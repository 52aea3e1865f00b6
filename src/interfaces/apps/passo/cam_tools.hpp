// Tools of a library for the operations of `passo cam`: with --tool-table, an option for a cutter takes its number
// (T3), and with --material the feeds, the spindle speed, the depth of a pass and the stepover follow from the tool.
// Options of the command line take precedence.
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/operations/cam_arguments.hpp"

namespace passo {

// Returns whether the user has given the option, e.g. "--feed".
using IsGiven = std::function<bool(const char* option)>;

// Replace tool numbers in the arguments by the tools of the library, fill in the values that follow from the material,
// and show warnings. They return an exit code, after a message.
int use_tools(CamProfileArguments& arguments, const IsGiven& is_given);
int use_tools(CamPocketArguments& arguments, const IsGiven& is_given);
int use_tools(CamEngraveArguments& arguments, const IsGiven& is_given);
int use_tools(CamThreadArguments& arguments, const IsGiven& is_given);
int use_tools(CamDrillArguments& arguments, const IsGiven& is_given);
int use_tools(CamIsolateArguments& arguments, const IsGiven& is_given);
int use_tools(CamOutlineArguments& arguments, const IsGiven& is_given);
int use_tools(CamReliefArguments& arguments, const IsGiven& is_given);

// Prints the summary of an operation as JSON. What was shown beside it is added: warnings, of tools and of files, as
// the member "warnings", and notes as "notes". Without any, the summary is printed unchanged.
void say_summary(nlohmann::ordered_json summary, const CamToolArguments& arguments = {});
// The same for the three operations of a board, which share a library. An operation that names no tool by its number
// keeps its own options. Without a drill in its options, the rack has all drills of the library.
int use_tools(const CamToolArguments& board, CamDrillArguments& drill, const IsGiven& is_given_drill,
              CamIsolateArguments& isolate, const IsGiven& is_given_isolate, CamOutlineArguments& outline,
              const IsGiven& is_given_outline);

}  // namespace passo
