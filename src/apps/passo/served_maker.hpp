// ServedMaker: `passo cam` for the API, as a process of its own: whatever a file contains, the machine goes on.
//
// An order may take `most_time` of a processor and `most_memory`, at the lowest priority. The files lie in a folder
// that is removed at the end.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

#include "passo/api/maker.hpp"

namespace passo {

class ServedMaker final : public Maker {
 public:
  static constexpr unsigned most_time = 120;                            // s of a processor
  static constexpr std::uint64_t most_memory = std::uint64_t{3} << 30;  // bytes
  static constexpr std::size_t most_files = 32;
  static constexpr std::size_t most_bytes = std::size_t{128} << 20;

  ServedMaker() = default;
  ServedMaker(const ServedMaker&) = delete;
  ServedMaker& operator=(const ServedMaker&) = delete;
  ~ServedMaker() override;

  std::vector<std::string> files() const override;
  bool keep(const std::string& name, std::string_view bytes) override;
  void clear() override;
  bool begin(const MakeOrder& order) override;
  const MakeResult& look() override;
  std::string program() const override;
  std::string picture() const override;

 private:
  struct Kept {
    std::string name;
    std::size_t bytes = 0;
  };
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  void end_process();

  std::string folder_;  // empty until a file comes
  std::vector<Kept> kept_;
  MakeResult result_;
  pid_t process_ = 0;
};

}  // namespace passo
