// UnfinishedJob: the folder in which `passo cam board`, or another command that makes several programs, generates a job
// before all of it is moved to its destination. After a failure, the job's folder is unchanged.
#pragma once

#include <filesystem>
#include <string>

namespace passo {

class UnfinishedJob {
 public:
  // `folder`: the job's folder. Creates nothing yet.
  explicit UnfinishedJob(const std::string& folder) : folder_(folder), made_(folder_ / "unfinished-job") {}
  ~UnfinishedJob();
  UnfinishedJob(const UnfinishedJob&) = delete;
  UnfinishedJob& operator=(const UnfinishedJob&) = delete;

  // Returns the folder to write into.
  const std::filesystem::path& made() const { return made_; }
  // Creates the folders. Returns an exit code.
  int begin();
  // Replaces the files of an earlier job by the generated ones. Returns an exit code.
  int finish();

 private:
  std::filesystem::path folder_;
  std::filesystem::path made_;
  bool is_begun_ = false;
  bool is_new_ = false;  // the job's folder did not exist before
};

}  // namespace passo
