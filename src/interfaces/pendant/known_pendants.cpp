#include <utility>
#include <vector>

#include "known_pendant_texts.hpp"

#include "passo/pendant/pendant_table.hpp"

namespace passo {
namespace {

std::vector<PendantTable> parsed() {
  std::vector<PendantTable> all;
  for (const char* const text : known_pendant_texts) {
    Diagnostics diagnostics;
    auto table = parse_pendant_table(text, "built in", diagnostics);
    if (table) all.push_back(std::move(*table));  // a test counts them
  }
  return all;
}

}  // namespace

std::span<const PendantTable> known_pendants() {
  static const std::vector<PendantTable> all = parsed();
  return all;
}

}  // namespace passo
