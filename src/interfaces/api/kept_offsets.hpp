// KeptOffsets: the offsets and tools of the programs, kept on the disk. Private to api/.
#pragma once

#include <string>
#include <utility>

#include "passo/api/api_options.hpp"
#include "passo/api/program_store.hpp"

namespace passo {

class KeptOffsets {
 public:
  // Both outlive this. `options`: what keeps the offsets, and those of the beginning.
  KeptOffsets(ProgramStore& programs, const ApiOptions& options);

  // What a program or a person's line has found, and set.
  void adopt(const SavedParameters& parameters, const ToolTable& tools);
  // Those of a sender, who has kept them. True: they are others than before.
  bool adopt(const SavedParameters& parameters);
  // False, with trouble(): it cannot be written, so the zero is as before.
  bool set_work_zero(const Point& zero);
  // Tries again what could not be written. True: all is on the disk.
  bool write_again();
  // Why the offsets are not on the disk. Empty: they are.
  const std::string& trouble() const { return trouble_; }
  void set_trouble(std::string why) { trouble_ = std::move(why); }

 private:
  void write();

  ProgramStore& programs_;
  const ApiOptions& options_;
  std::string trouble_;
};

}  // namespace passo
