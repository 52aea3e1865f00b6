// The record of a job: a report as JSON, next to its programs. It shows whether the programs are out of date, and what
// has changed when they are generated again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "part_job_operation.hpp"
#include "part_job_trial.hpp"
#include <nlohmann/json.hpp>

#include "passo/part_job/operation_order.hpp"

namespace passo {

// The record's name: plate.job.json of plate.ngc.
std::string record_file_of(const std::string& output);

// The fingerprint of the job file, its drawings and its other files. Empty: one of them cannot be read.
std::string fingerprint_of_inputs(const PartJob& job, const std::string& job_text);
std::string fingerprint_of_text(std::string_view text);

struct MadeJob {
  const PartJob& job;
  const std::vector<OrderedOperation>& order;
  const std::vector<MadeOperation>& made;  // as in PartJob::operations
  const Trial& trial;
  const std::vector<TrialProgram>& programs;
  std::string fingerprint;
};

nlohmann::ordered_json record_of(const MadeJob& made);
// Empty: there is none, or it cannot be read.
std::optional<nlohmann::ordered_json> read_job_record(const std::string& output);

// A program that a record lists: its name, without a folder, and the fingerprint of its text.
struct RecordedProgram {
  std::string name;
  std::string fingerprint;
};
std::vector<RecordedProgram> programs_of_record(const nlohmann::ordered_json& record);

// Why the programs on disk are out of date. Empty: they are up to date.
std::string out_of_date(const nlohmann::ordered_json& record, const std::string& fingerprint,
                        const std::string& output);

// The differences, one line for each operation. Empty: none.
std::vector<std::string> changes_of(const nlohmann::ordered_json& before, const nlohmann::ordered_json& now);

// The table of operations, the total and the changes of order.
std::string report_of(const nlohmann::ordered_json& record);

}  // namespace passo
