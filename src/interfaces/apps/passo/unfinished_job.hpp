// UnfinishedJob: where `passo cam board` makes a job before all of it is put in place. What fails leaves the job's
// folder as it was.
#pragma once

#include <filesystem>
#include <string>

namespace passo {

class UnfinishedJob {
 public:
  // `folder`: of the job. Nothing is made yet.
  explicit UnfinishedJob(const std::string& folder) : folder_(folder), made_(folder_ / "unfinished-job") {}
  ~UnfinishedJob();
  UnfinishedJob(const UnfinishedJob&) = delete;
  UnfinishedJob& operator=(const UnfinishedJob&) = delete;

  // The folder to write into.
  const std::filesystem::path& made() const { return made_; }
  // Makes the folders. Returns an exit code.
  int begin();
  // Puts what was made in the place of what is there of an earlier job. Returns an exit code.
  int finish();

 private:
  std::filesystem::path folder_;
  std::filesystem::path made_;
  bool is_begun_ = false;
  bool is_new_ = false;  // the job's folder
};

}  // namespace passo
