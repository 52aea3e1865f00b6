// Option rows shared by several operations. Private to operations/.
#pragma once

#include <initializer_list>
#include <vector>

#include "passo/operations/cam_arguments.hpp"

namespace passo {

inline constexpr CamFor cli = CamFor::command_line;
inline constexpr CamFor experts = CamFor::experts;
inline const CamTraits experts_only{.matters_to = experts};
inline const CamTraits of_one_job{.is_of_job = true};
inline const CamTraits experts_of_one_job{.matters_to = experts, .is_of_job = true};
inline const CamTraits are_needed{.is_required = true};  // for the files of drawings

// The rows stand for what the arguments are before anything is said.
template <class Arguments>
std::vector<CamOption> options_with_defaults() {
  static Arguments arguments;
  return cam_options_of(arguments);
}

std::vector<CamOption> all_of(std::initializer_list<std::vector<CamOption>> parts);

// The options of every operation that mills drawings. `layer`: the users to whom --layer is shown.
std::vector<CamOption> mill_rows(CamMillArguments& arguments, CamFor layer = experts);
// The options for cutting along an edge: depths, tabs, ramps, lead-ins.
std::vector<CamOption> edge_rows(CamOutlineArguments& arguments);

// The controller that is to run the program, and the operator's own texts in it.
std::vector<CamOption> controller_rows(CamProgramArguments& arguments);
// The same, and the height of tool changes and the dwell of the spindle.
std::vector<CamOption> program_rows(CamProgramArguments& arguments);
// A tool library, and what the chosen tool cuts.
std::vector<CamOption> tool_rows(CamToolArguments& arguments);

// The unit of the program, and of lengths given without a unit.
CamOption units_row(std::string& units);
// The unit of the numbers in the files.
CamOption input_row(std::string& input, const char* help);
CamOption scale_row(std::optional<double>& scale);
CamOption zero_row(std::string& zero, const char* help);
CamOption mirror_row(std::string& mirror);
CamOption mirror_at_row(std::string& place);
CamOption park_row(std::string& park);
CamOption join_row(std::string& join);
CamOption ramp_row(double& angle);
CamOption clearance_row(std::string& clearance, const char* help);
CamOption spindle_row(std::uint32_t& spindle);
CamOption layer_row(std::vector<std::string>& layers, const char* help, CamFor matters_to = experts);
// SVG: shapes by colour and by name.
CamOption color_row(std::vector<std::string>& colors);
CamOption name_row(std::vector<std::string>& names);
CamOption output_row(std::string& output);
CamOption picture_row(std::string& picture, const char* help);

}  // namespace passo
