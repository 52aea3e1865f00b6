// Submission: what one student handed in, a file or a folder. Each run gets a fresh copy of it in a folder of its own,
// so that a program neither changes what was handed in nor sees what others did.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

struct Submission {
  std::string student;           // the name of the file without its ending, or of the folder
  std::filesystem::path handed;  // the file or folder; empty: a program of the system is run
  // The command line. Empty: the program among what was handed in. "{}" in a word stands for that program.
  std::vector<std::string> command = {};
};

// The folders in a class's folder, and its files with this ending (".hex"; empty: all files), by name. Hidden ones are
// left out.
std::vector<Submission> submissions_in(const std::filesystem::path& folder, const std::string& ending,
                                       const std::vector<std::string>& command);

// Copies what was handed in to `folder`, which exists and is empty. Links and devices are left out. The error is a
// sentence without a full stop.
Status<std::string> copy_submission(const Submission& submission, const std::filesystem::path& folder);

// The command line for the copy. A program is an executable, or a script that begins with #!, or, with a command with
// "{}", any file; if there are several, it is the one named `name` (without its ending). The error is a sentence
// without a full stop.
Result<std::vector<std::string>, std::string> command_for(const Submission& submission,
                                                          const std::filesystem::path& copy, const std::string& name);

// The only file of the copy with this ending (".hex"), whose case does not matter. The error as above.
Result<std::filesystem::path, std::string> only_file_with(const std::filesystem::path& copy, const std::string& ending);

}  // namespace passo
