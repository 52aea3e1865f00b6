#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "kit/seed.hpp"
#include <sys/stat.h>
#include <unistd.h>

#include "passo/gcode/program_reader.hpp"

namespace passo {
namespace {

using Lines = std::vector<std::pair<std::uint32_t, std::string>>;

Lines all_lines(ProgramReader& reader, Diagnostics& diagnostics) {
  Lines lines;
  std::string_view text;
  std::uint32_t line = 0;
  while (reader.next_line(text, line, diagnostics)) lines.emplace_back(line, text);
  return lines;
}

Lines lines_of(const std::string& text) {
  Diagnostics diagnostics;
  ProgramReader reader = ProgramReader::from_text("part.ngc", text);
  const Lines lines = all_lines(reader, diagnostics);
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  return lines;
}

// A file that is removed after the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view content) {
    std::string pattern = (std::filesystem::temp_directory_path() / "passo-XXXXXX").string();
    const int descriptor = ::mkstemp(pattern.data());
    EXPECT_GE(descriptor, 0);
    ::close(descriptor);
    path = pattern;
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path;
};

std::string refusal(const std::string& path) {
  const auto reader = ProgramReader::open(path);
  if (reader) return "opened";
  EXPECT_EQ(reader.error().file, path);
  EXPECT_EQ(reader.error().place.line, 0U);
  EXPECT_FALSE(reader.error().message.empty());
  return reader.error().code;
}

TEST(Reader, accepts_every_line_end) {
  const Lines expected = {{1, "G0"}, {2, ""}, {3, "G1"}, {4, "G2"}};
  EXPECT_EQ(lines_of("G0\n\nG1\nG2\n"), expected);
  EXPECT_EQ(lines_of("G0\r\n\r\nG1\r\nG2\r\n"), expected);
  EXPECT_EQ(lines_of("G0\r\rG1\rG2\r"), expected);
  EXPECT_EQ(lines_of("G0\n\r\nG1\rG2"), expected);
}

TEST(Reader, skips_the_byte_order_mark) {
  EXPECT_EQ(lines_of("\xEF\xBB\xBFG0\nG1"), (Lines{{1, "G0"}, {2, "G1"}}));
}

TEST(Reader, an_empty_text_has_no_lines) {
  EXPECT_EQ(lines_of(""), Lines{});
  EXPECT_EQ(lines_of("\n"), (Lines{{1, ""}}));
}

TEST(Reader, gives_the_same_lines_from_a_file_as_from_memory_wherever_its_buffer_ends) {
  std::mt19937_64 random(test::seed());
  const char* const ends[] = {"\n", "\r\n", "\r"};
  for (int round = 0; round < 4; ++round) {
    std::string text;
    while (text.size() < 1'000'000) {
      const auto longest = random() % 50 == 0 ? longest_line + 1 : 3000;
      text += std::string(random() % longest, 'x') + ends[round < 3 ? static_cast<std::size_t>(round) : random() % 3];
    }
    const TemporaryFile file(text);
    auto reader = ProgramReader::open(file.path);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->size(), text.size());
    Diagnostics diagnostics;
    EXPECT_TRUE(all_lines(*reader, diagnostics) == lines_of(text));
    EXPECT_FALSE(diagnostics.any_error());
  }
}

TEST(Reader, a_line_end_of_two_bytes_may_straddle_the_buffer) {
  // The buffer is 256 KiB. The CR is tried at every place around its end.
  for (std::size_t before = 256 * 1024 - 4; before < 256 * 1024 + 4; ++before) {
    std::string text;
    while (text.size() + 1000 < before) text += std::string(999, 'a') + "\n";
    text += std::string(before - text.size(), 'b') + "\r\nlast\r\n";
    const TemporaryFile file(text);
    auto reader = ProgramReader::open(file.path);
    ASSERT_TRUE(reader);
    Diagnostics diagnostics;
    EXPECT_TRUE(all_lines(*reader, diagnostics) == lines_of(text)) << before;
  }
}

TEST(Reader, goes_back_to_any_line_it_has_been_at) {
  std::string text;
  for (int i = 1; i <= 60'000; ++i) text += "N" + std::to_string(i) + " G0\n";
  const TemporaryFile file(text);
  auto reader = ProgramReader::open(file.path);
  ASSERT_TRUE(reader);
  Diagnostics diagnostics;
  std::vector<ReaderPosition> positions;
  std::string_view line;
  std::uint32_t number = 0;
  do positions.push_back(reader->position());
  while (reader->next_line(line, number, diagnostics));
  EXPECT_EQ(positions.back().offset, text.size());

  std::mt19937_64 random(test::seed());
  for (int i = 0; i < 2000; ++i) {
    const auto index = random() % 60'000;
    reader->seek(positions[index]);
    ASSERT_TRUE(reader->next_line(line, number, diagnostics));
    ASSERT_EQ(number, index + 1);
    ASSERT_EQ(line, "N" + std::to_string(index + 1) + " G0");
    ASSERT_EQ(reader->position().offset, positions[index + 1].offset);
  }
}

TEST(Reader, reads_on_after_its_end_was_reached_and_it_was_sent_back) {
  const TemporaryFile file("G0\nG1");
  auto reader = ProgramReader::open(file.path);
  ASSERT_TRUE(reader);
  Diagnostics diagnostics;
  const ReaderPosition start = reader->position();
  EXPECT_EQ(all_lines(*reader, diagnostics).size(), 2U);
  reader->seek(start);
  EXPECT_EQ(all_lines(*reader, diagnostics), (Lines{{1, "G0"}, {2, "G1"}}));
}

TEST(Reader, a_line_of_the_longest_length_is_good) {
  const std::string longest(longest_line, 'x');
  EXPECT_EQ(lines_of(longest + "\r\nG1"), (Lines{{1, longest}, {2, "G1"}}));
  EXPECT_EQ(lines_of(longest), (Lines{{1, longest}}));
}

TEST(Reader, a_line_that_is_too_long_is_reported_and_skipped) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    for (const std::size_t length :
         {longest_line + 1, std::size_t{262'144}, std::size_t{262'143}, std::size_t{3'000'000}}) {
      const TemporaryFile file(std::string("G0") + end + std::string(length, 'x') + end + "G1" + end);
      auto reader = ProgramReader::open(file.path);
      ASSERT_TRUE(reader);
      Diagnostics diagnostics;
      EXPECT_EQ(all_lines(*reader, diagnostics), (Lines{{1, "G0"}, {3, "G1"}}));
      ASSERT_EQ(diagnostics.all().size(), 1U);
      EXPECT_EQ(diagnostics.all()[0].code, "gcode.line-too-long");
      EXPECT_EQ(diagnostics.all()[0].place, (SourceLocation{2, longest_line + 1, 1}));
      EXPECT_THAT(diagnostics.all()[0].message, testing::HasSubstr(std::to_string(length)));
      EXPECT_LT(diagnostics.all()[0].text.size(), 1000U);
    }
  }
}

TEST(Reader, a_nul_byte_is_reported_with_its_line_and_column) {
  Diagnostics diagnostics;
  ProgramReader reader = ProgramReader::from_text("part.ngc", std::string("G0\nG1 \0X5\nG2", 12));
  EXPECT_EQ(all_lines(reader, diagnostics), (Lines{{1, "G0"}, {3, "G2"}}));
  ASSERT_EQ(diagnostics.all().size(), 1U);
  EXPECT_EQ(diagnostics.all()[0].code, "gcode.nul-byte");
  EXPECT_EQ(diagnostics.all()[0].place, (SourceLocation{2, 4, 1}));
}

TEST(Reader, refuses_what_is_not_there_or_not_a_file) {
  EXPECT_EQ(refusal("/no/such/part.ngc"), "file.not-found");
  EXPECT_EQ(refusal(""), "file.not-found");
  EXPECT_EQ(refusal("/"), "file.is-directory");
  EXPECT_EQ(refusal("/dev/zero"), "file.unreadable");
}

TEST(Reader, refuses_what_it_may_not_read) {
  const TemporaryFile file("G0\n");
  ::chmod(file.path.c_str(), 0);
  if (::access(file.path.c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read everything";
  EXPECT_EQ(refusal(file.path), "file.unreadable");
}

TEST(Reader, refuses_an_empty_file) {
  const TemporaryFile empty("");
  EXPECT_EQ(refusal(empty.path), "file.empty");
  const TemporaryFile mark("\xEF\xBB\xBF");
  EXPECT_EQ(refusal(mark.path), "file.empty");
}

TEST(Reader, refuses_binary_files_with_one_error) {
  using std::string_literals::operator""s;
  const TemporaryFile elf(
      "\x7F"
      "ELF\x02\x01\x01\0\0\0\0\0\0\0\0\0\x03\0\x3E\0"s);
  EXPECT_EQ(refusal(elf.path), "file.binary");
  const TemporaryFile png("\x89PNG\r\n\x1A\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0\x1F\x15"s);
  EXPECT_EQ(refusal(png.path), "file.binary");
  const TemporaryFile zeros(std::string(100'000, '\0'));
  EXPECT_EQ(refusal(zeros.path), "file.binary");
  const TemporaryFile wide(
      "\xFF\xFEG\0"
      "0\0"s);
  EXPECT_EQ(refusal(wide.path), "file.binary");
  std::mt19937_64 random(test::seed());
  std::string noise;
  for (int i = 0; i < 5000; ++i) noise += static_cast<char>(random());
  const TemporaryFile compressed(noise);
  EXPECT_EQ(refusal(compressed.path), "file.binary");
}

TEST(Reader, takes_text_in_an_old_encoding_for_text) {
  const TemporaryFile latin1(
      "(gr\xF6\xDF"
      "e 5\xB0)\r\nG0 X1\r\n\x1A");
  EXPECT_EQ(refusal(latin1.path), "opened");
}

TEST(Reader, spools_a_pipe_so_that_loops_can_go_back) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("passo-fifo-" + std::to_string(::getpid()))).string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&path] {
    std::ofstream out(path);
    for (int i = 0; i < 100'000; ++i) out << "G1 X" << i << '\n';
  });
  auto reader = ProgramReader::open(path);
  writer.join();
  std::filesystem::remove(path);
  ASSERT_TRUE(reader);
  Diagnostics diagnostics;
  EXPECT_EQ(all_lines(*reader, diagnostics).size(), 100'000U);
  reader->seek({0, 1});
  EXPECT_EQ(all_lines(*reader, diagnostics).size(), 100'000U);
}

}  // namespace
}  // namespace passo
