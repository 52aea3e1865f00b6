// The programs that an earlier run of a job has written: a job neither overwrites what someone has edited, nor leaves
// programs behind that it no longer makes.
#pragma once

#include <string>
#include <vector>

#include "part_job_trial.hpp"
#include <nlohmann/json.hpp>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct EarlierProgram {
  std::string file;
  bool is_edited = false;      // it is not as the job has written it, nor as the job would write it now
  bool is_made_again = false;  // the job still makes a program of this name
};

// plate-1-T3.ngc of plate.ngc: the program of one tool.
std::string program_of_tool(const std::string& output, std::size_t number, std::int32_t tool);

// The programs of `record` that exist. Names that a job with this output cannot write are ignored.
std::vector<EarlierProgram> earlier_programs(const nlohmann::ordered_json& record, const std::string& output,
                                             const std::vector<TrialProgram>& programs);

// Edited programs: those that would be overwritten are errors, unless `overwrites`. Those that the job does not make
// any more are warnings, because they stay.
void check_edited(const std::vector<EarlierProgram>& earlier, bool overwrites, Diagnostics& findings);

// Removes the programs that are not made any more and that nobody has edited. Returns their names.
std::vector<std::string> remove_old_programs(const std::vector<EarlierProgram>& earlier);

}  // namespace passo
