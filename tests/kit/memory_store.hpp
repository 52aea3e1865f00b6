// MemoryStore: keeps a journal in memory. A test can make it fail.
#pragma once

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "passo/journal/journal.hpp"

namespace passo::test {

class MemoryStore final : public JournalStore {
 public:
  bool replace(std::string_view text) override {
    if (works) bytes = text;
    return works;
  }
  bool overwrite(std::size_t offset, std::string_view text) override {
    EXPECT_LE(offset + text.size(), bytes.size()) << "the journal does not grow";
    if (works) bytes.replace(offset, text.size(), text);
    return works;
  }
  bool append(std::string_view text) override {
    if (works) bytes += text;
    return works;
  }
  std::string bytes;
  bool works = true;
};

}  // namespace passo::test
