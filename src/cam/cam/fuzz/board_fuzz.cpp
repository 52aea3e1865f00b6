// Any bytes as a board file: a zip archive, a layer or a drill file. They are rejected, or every layer and hole is
// within its limits.
#include <cstdint>
#include <string>

#include "drawing_checks.hpp"
#include "layer_checks.hpp"
#include <sys/mman.h>
#include <unistd.h>

#include "passo/cam/board_job.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The archive is read from a file; here it is a file in memory.
  const int file = memfd_create("board", 0);
  passo::test::require(file >= 0 && write(file, data, size) == static_cast<ssize_t>(size), "no file in memory");
  passo::Diagnostics found;
  const passo::BoardJob job = passo::read_board_job({"/proc/self/fd/" + std::to_string(file)}, found);
  close(file);
  for (const passo::BoardFile& one : job.files) {
    if (one.layer) passo::test::check_layer(*one.layer);
    if (one.drills) passo::test::check_drawing(*one.drills);
  }
  return 0;
}
