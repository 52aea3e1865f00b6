// The bytes of a program in a browser: those of the visitor's files, by their names.
#include "program_bytes.hpp"

#include <utility>

#include "passo/base/browser_host.hpp"

namespace passo {
namespace {

class VisitorsFile final : public ProgramBytes {
 public:
  VisitorsFile(std::string name, std::uint64_t size) : name_(std::move(name)), size_(size) {}
  std::int64_t read_at(char* to, std::size_t size, std::uint64_t offset) const override {
    return host_read(name_.data(), name_.size(), to, size, static_cast<double>(offset));
  }
  std::uint64_t size() const override { return size_; }

 private:
  std::string name_;
  std::uint64_t size_;
};

}  // namespace

Diagnostic unreadable_program(const std::string& name) {
  return about_whole_file("file.unreadable", name, "cannot be read: the browser refuses it", "");
}

Result<std::shared_ptr<const ProgramBytes>, Diagnostic> ProgramBytes::open(const std::string& path) {
  const double size = host_size(path.data(), path.size());
  if (size < 0) {
    return Failure{about_whole_file("file.not-found", path, "there is no such file", "the path of a G-code file")};
  }
  return std::shared_ptr<const ProgramBytes>(
      std::make_shared<const VisitorsFile>(path, static_cast<std::uint64_t>(size)));
}

}  // namespace passo
