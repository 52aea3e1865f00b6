// KeptOffsets: the offsets and tools of the programs, saved on disk. Private to api/.
#pragma once

#include <string>
#include <utility>

#include "passo/api/api_options.hpp"
#include "passo/api/program_store.hpp"

namespace passo {

class KeptOffsets {
 public:
  // Both must outlive this object. `options`: the initial offsets, and the function that saves them.
  KeptOffsets(ProgramStore& programs, const ApiOptions& options);

  // Adopts the values set by a program or by an MDI line.
  void adopt(const SavedParameters& parameters, const ToolTable& tools);
  // Adopts the values of a sender, which has saved them. Returns true if they differ from the previous ones.
  bool adopt(const SavedParameters& parameters);
  // Returns false, with trouble(), if the zero cannot be saved; it is then unchanged.
  bool set_work_zero(const Point& zero);
  // Retries what could not be saved. Returns true if everything is on disk.
  bool write_again();
  // Returns why the offsets are not saved on disk. Empty: they are.
  const std::string& trouble() const { return trouble_; }
  void set_trouble(std::string why) { trouble_ = std::move(why); }

 private:
  void write();

  ProgramStore& programs_;
  const ApiOptions& options_;
  std::string trouble_;
};

}  // namespace passo
