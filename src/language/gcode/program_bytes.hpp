// ProgramBytes: the bytes of a program's file, wherever they are.
//
// The program reads a file (program_bytes.cpp), and in a browser the visitor's file (wasm/program_bytes.cpp). Neither
// is held in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "passo/base/result.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

class ProgramBytes {
 public:
  // "-" is standard input.
  static Result<std::shared_ptr<const ProgramBytes>, Diagnostic> open(const std::string& path);

  virtual ~ProgramBytes() = default;
  ProgramBytes(const ProgramBytes&) = delete;
  ProgramBytes& operator=(const ProgramBytes&) = delete;

  // Reads up to `size` bytes and returns their number; 0: the end. Negative: see unreadable_program().
  virtual std::int64_t read_at(char* to, std::size_t size, std::uint64_t offset) const = 0;
  virtual std::uint64_t size() const = 0;

 protected:
  ProgramBytes() = default;
};

Diagnostic about_whole_file(std::string code, const std::string& name, FindingWords message, FindingWords expected);
// After a read that has failed: why.
Diagnostic unreadable_program(const std::string& name);

}  // namespace passo
