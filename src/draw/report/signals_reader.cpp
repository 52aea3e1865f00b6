#include "passo/report/signals_reader.hpp"

#include <cstring>
#include <fstream>
#include <string_view>

#include "signals_file.hpp"

namespace passo {

Result<Signals, std::string> read_signals(const std::string& path, const SignalsToRead& what) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Failure{fmt::format("cannot read {}: {}", path, std::strerror(errno))};
  // Spreadsheets begin a file with the mark of its encoding.
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  char first[3] = {};
  in.read(first, sizeof first);
  if (in.gcount() != sizeof first || std::string_view(first, sizeof first) != mark) {
    in.clear();
    in.seekg(0);
  }
  SignalsFile file(in, path, what);
  const bool done = path.ends_with(".vcd") ? read_vcd(file) : read_csv(file);
  if (!done) return Failure{file.error()};
  if (in.bad()) return Failure{fmt::format("cannot read {} to its end", path)};
  return std::move(file.signals());
}

}  // namespace passo
