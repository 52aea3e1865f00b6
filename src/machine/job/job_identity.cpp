#include "passo/job/job_identity.hpp"

#include <filesystem>
#include <utility>

#include "pieces_of_file.hpp"

#include "passo/base/fingerprint.hpp"

namespace passo {

namespace fs = std::filesystem;

FileStamp stamp_of(std::string name, std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return {.name = std::move(name), .size = text.size(), .fingerprint = fingerprint.value()};
}

FileStamp stamp_of_text(const std::string& path, std::string_view text) {
  std::error_code none;
  return stamp_of(path.empty() ? path : fs::absolute(path, none).string(), text);
}

FileStamp stamp_of_file(const std::string& path) {
  std::error_code none;
  if (path == "-" || !fs::is_regular_file(path, none)) return {};
  FileStamp stamp;
  Fingerprint fingerprint;
  (void)read_pieces(path, [&](std::string_view piece) {
    stamp.size += piece.size();
    fingerprint.add(piece);
    return true;
  });
  stamp.name = fs::absolute(path, none).string();
  stamp.fingerprint = fingerprint.value();
  return stamp;
}

std::string_view code_of(JobChange change) {
  switch (change) {
    case JobChange::version: return "resume.other-version";
    case JobChange::program: return "resume.program-changed";
    case JobChange::machine: return "resume.machine-changed";
  }
  return "resume";
}

std::optional<JobChange> change_since(const JournalHead& then, const JobIdentity& now) {
  if (then.made_by != now.made_by) return JobChange::version;
  if (then.program != now.program) return JobChange::program;
  if (then.machine != now.machine) return JobChange::machine;
  return {};
}

}  // namespace passo
