// Feeds each file of a fuzzer's corpus to the fuzzer's function once, so that errors found by fuzzing stay corrected.
// The function aborts if something is wrong.
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

TEST(Corpus, every_input_of_the_fuzzer_passes) {
  std::size_t inputs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PASSO_CORPUS)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(file), {}};
    SCOPED_TRACE(entry.path());
    EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size()), 0);
    ++inputs;
  }
  EXPECT_GE(inputs, 5U);
}

}  // namespace
