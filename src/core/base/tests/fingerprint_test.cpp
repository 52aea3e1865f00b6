#include "passo/base/fingerprint.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace passo {
namespace {

std::uint64_t of(std::string_view text) {
  Fingerprint fingerprint;
  fingerprint.add(text);
  return fingerprint.value();
}

TEST(Fingerprint, is_the_same_of_the_same_and_another_of_each_other) {
  EXPECT_EQ(of("G1 X10"), of(std::string("G1 X10")));
  std::set<std::uint64_t> seen;
  std::string text(40, 'a');
  seen.insert(of(text));
  std::size_t all = 1;
  for (char& letter : text) {
    for (unsigned bit = 0; bit < 8; ++bit, ++all) {
      letter = static_cast<char>(static_cast<unsigned char>(letter) ^ 1U << bit);
      seen.insert(of(text));
      letter = 'a';
    }
  }
  for (std::size_t size = 0; size < text.size(); ++size, ++all) seen.insert(of(std::string_view(text).substr(0, size)));
  EXPECT_EQ(seen.size(), all);
}

TEST(Fingerprint, tells_where_one_piece_ends_and_zeros_from_nothing) {
  Fingerprint one;
  one.add(std::string_view("ab"));
  one.add(std::string_view("c"));
  Fingerprint other;
  other.add(std::string_view("a"));
  other.add(std::string_view("bc"));
  EXPECT_NE(one.value(), other.value());
  EXPECT_NE(of(std::string(8, '\0')), of(std::string(9, '\0')));
}

}  // namespace
}  // namespace passo
