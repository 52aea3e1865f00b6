#include "passo/gcode/program_reader.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "gcode_sentences.hpp"
#include "program_bytes.hpp"
#include <fmt/format.h>

#include "passo/gcode/foreign_file.hpp"

namespace passo {
namespace {

constexpr std::size_t buffer_size = std::size_t{256} * 1024;
static_assert(buffer_size >= 2 * (longest_line + 2), "a line and its end fit wherever they start");

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
constexpr std::size_t inspected_bytes = 1024;  // enough to tell text from other data

FindingWords kind_in_words(const ForeignFile& foreign) {
  if (foreign.expected.code == gcode_says::from_cam.code) return gcode_says::for_a_printer;
  return gcode_says::not_gcode.with({{"what", std::string(foreign.kind)}});
}

// The kind of content that the first bytes of a file show.
enum class Content : std::uint8_t { text, wide_text, binary };

Content inspect(std::string_view first) {
  if (first.starts_with("\xFF\xFE") || first.starts_with("\xFE\xFF")) return Content::wide_text;
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && (byte < '\t' || byte > '\r') && byte != 0x1A;  // old editors end a file with 0x1A
  };
  const auto controls = static_cast<std::size_t>(std::ranges::count_if(first, is_control));
  // One stray NUL is reported at its place. Many control characters mean that the file is no program.
  return controls >= 8 && controls * 32 >= first.size() ? Content::binary : Content::text;
}

}  // namespace

Diagnostic about_whole_file(std::string code, const std::string& name, FindingWords message, FindingWords expected) {
  Diagnostic diagnostic;
  diagnostic.code = std::move(code);
  diagnostic.file = name;
  diagnostic.message = std::move(message);
  diagnostic.expected = std::move(expected);
  return diagnostic;
}

// The buffer holds the bytes [offset, offset + filled) of the program. In it `cursor` is the first byte of the next
// line.
struct ProgramReader::State {
  std::string name;
  std::shared_ptr<const ProgramBytes> file;  // null: the whole program is in `buffer`. Readers of one program share it
  std::vector<char> buffer;
  std::uint64_t size = 0;
  std::uint64_t start = 0;  // the first byte of the first line, after a byte order mark
  std::uint64_t offset = 0;
  std::size_t filled = 0;
  std::size_t cursor = 0;
  std::size_t line_feed = 0;  // the first LF at or after `cursor`, or `filled`; a value below `cursor` means not known
  std::uint32_t line = 1;
  std::optional<ReaderPosition> sought;  // where to go before the next line is read
  bool at_file_end = false;              // no bytes come after `filled`
  bool failed = false;

  enum class Find : std::uint8_t { line, too_long, end };

  bool fill(Diagnostics& diagnostics);
  void go_to(ReaderPosition position);
  Find find_line(std::size_t& end, std::size_t& next, Diagnostics& diagnostics);
  void skip_long_line(Diagnostics& diagnostics);
  std::size_t find_line_feed();
  void report(Diagnostics& diagnostics, std::string code, std::size_t column, FindingWords message,
              FindingWords expected, std::string_view text) const;
};

// Moves the unread bytes to the front and reads more after them. Returns false after an error.
bool ProgramReader::State::fill(Diagnostics& diagnostics) {
  const std::size_t kept = filled - cursor;
  if (cursor > 0) {
    std::memmove(buffer.data(), buffer.data() + cursor, kept);
    offset += cursor;
    cursor = 0;
  }
  filled = kept;
  line_feed = 0;
  while (filled < buffer.size()) {
    const std::int64_t count = file->read_at(buffer.data() + filled, buffer.size() - filled, offset + filled);
    if (count < 0) {
      diagnostics.add(unreadable_program(name));
      failed = true;
      return false;
    }
    if (count == 0) {
      at_file_end = true;
      break;
    }
    filled += static_cast<std::size_t>(count);
  }
  line_feed = find_line_feed();
  return true;
}

// Keeps the content of the buffer if the place is in it.
void ProgramReader::State::go_to(ReaderPosition position) {
  sought.reset();
  line = position.line;
  if (position.offset >= offset && position.offset <= offset + filled) {
    cursor = static_cast<std::size_t>(position.offset - offset);
    line_feed = find_line_feed();
    return;
  }
  offset = position.offset;
  cursor = filled = line_feed = 0;
  at_file_end = false;
}

std::size_t ProgramReader::State::find_line_feed() {
  if (cursor == filled) return filled;  // an empty buffer has no address for memchr
  const void* const found = std::memchr(buffer.data() + cursor, '\n', filled - cursor);
  return found == nullptr ? filled : static_cast<std::size_t>(static_cast<const char*>(found) - buffer.data());
}

// The line at the cursor is [cursor, end). The next line starts at `next`.
ProgramReader::State::Find ProgramReader::State::find_line(std::size_t& end, std::size_t& next,
                                                           Diagnostics& diagnostics) {
  for (;;) {
    if (cursor < filled) {
      if (line_feed < cursor) line_feed = find_line_feed();
      const std::size_t limit = std::min(line_feed, cursor + longest_line + 1);
      const void* const carriage_return = std::memchr(buffer.data() + cursor, '\r', limit - cursor);
      end = carriage_return == nullptr
                ? limit
                : static_cast<std::size_t>(static_cast<const char*>(carriage_return) - buffer.data());
      if (end - cursor > longest_line) return Find::too_long;
      const bool is_return = end < filled && buffer[end] == '\r';
      // A line that reaches the end of the buffer may be longer, and a CR there may have its LF after it.
      const bool is_complete = end + (is_return ? 1 : 0) < filled;
      if (is_complete || at_file_end) {
        next = std::min(end + 1, filled);
        if (is_return && next < filled && buffer[next] == '\n') ++next;
        return Find::line;
      }
    } else if (at_file_end) {
      return Find::end;
    }
    if (!fill(diagnostics)) return Find::end;
  }
}

// Counts the bytes of a line that is too long, without keeping them.
void ProgramReader::State::skip_long_line(Diagnostics& diagnostics) {
  std::uint64_t length = 0;
  for (;;) {
    const char* const first = buffer.data() + cursor;
    const char* const last = buffer.data() + filled;
    const char* const end = std::find_if(first, last, [](char c) { return c == '\n' || c == '\r'; });
    length += static_cast<std::uint64_t>(end - first);
    cursor += static_cast<std::size_t>(end - first);
    if (cursor < filled || at_file_end) break;
    if (!fill(diagnostics)) return;
  }
  report(diagnostics, "gcode.line-too-long", longest_line + 1, fmt::format("the line is {} bytes long", length),
         fmt::format("at most {} bytes", longest_line), {});
  if (filled - cursor < 2 && !at_file_end && !fill(diagnostics)) return;
  const std::string_view rest(buffer.data() + cursor, filled - cursor);
  cursor += rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1;
  ++line;
}

void ProgramReader::State::report(Diagnostics& diagnostics, std::string code, std::size_t column, FindingWords message,
                                  FindingWords expected, std::string_view text) const {
  Diagnostic diagnostic = about_whole_file(std::move(code), name, std::move(message), std::move(expected));
  diagnostic.place = {line, static_cast<std::uint32_t>(column), 1};
  diagnostic.text = text;
  diagnostics.add(std::move(diagnostic));
}

ProgramReader::ProgramReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
ProgramReader::ProgramReader(ProgramReader&&) noexcept = default;
ProgramReader& ProgramReader::operator=(ProgramReader&&) noexcept = default;
ProgramReader::~ProgramReader() = default;

Result<ProgramReader, Diagnostic> ProgramReader::open(const std::string& path) {
  auto opened = ProgramBytes::open(path);
  if (!opened) return Failure{opened.error()};
  const std::string name = path == "-" ? "standard input" : path;

  auto state = std::make_unique<State>();
  state->name = name;
  state->file = std::move(*opened);
  state->size = state->file->size();
  state->buffer.resize(buffer_size);

  Diagnostics diagnostics;
  if (!state->fill(diagnostics)) return Failure{diagnostics.all().front()};
  const std::string_view first(state->buffer.data(), std::min(state->filled, inspected_bytes));
  if (first.empty() || (first == utf8_mark && state->at_file_end)) {
    return Failure{about_whole_file("file.empty", name, gcode_says::empty_file, gcode_says::gcode_file)};
  }
  if (const ForeignFile foreign = foreign_file(name, first); !foreign.kind.empty()) {
    return Failure{about_whole_file(inspect(first) == Content::text ? "file.not-gcode" : "file.binary", name,
                                    kind_in_words(foreign), foreign.expected)};
  }
  switch (inspect(first)) {
    case Content::text: break;
    case Content::wide_text:
      return Failure{
          about_whole_file("file.binary", name, "the file is UTF-16 text", "the file saved as UTF-8 or ASCII")};
    case Content::binary:
      return Failure{about_whole_file("file.binary", name, gcode_says::not_text, gcode_says::plain_text)};
  }
  if (first.starts_with(utf8_mark)) state->start = state->cursor = utf8_mark.size();
  return ProgramReader(std::move(state));
}

ProgramReader ProgramReader::from_text(std::string name, std::string text) {
  auto state = std::make_unique<State>();
  state->name = std::move(name);
  state->buffer.assign(text.begin(), text.end());
  state->size = state->filled = text.size();
  state->at_file_end = true;
  state->line_feed = state->find_line_feed();
  if (text.starts_with(utf8_mark)) state->start = state->cursor = utf8_mark.size();
  return ProgramReader(std::move(state));
}

ProgramReader ProgramReader::from_lines(std::string name) {
  return from_text(std::move(name), {});
}

void ProgramReader::push_line(std::string_view text) {
  State& state = *state_;
  state.offset += state.filled;
  state.buffer.assign(text.begin(), text.end());
  state.buffer.push_back('\n');
  state.filled = state.buffer.size();
  state.cursor = 0;
  state.line_feed = state.find_line_feed();
}

bool ProgramReader::next_line(std::string_view& text, std::uint32_t& line, Diagnostics& diagnostics) {
  State& state = *state_;
  if (state.sought) state.go_to(*state.sought);
  while (!state.failed) {
    std::size_t end = 0;
    std::size_t next = 0;
    const State::Find found = state.find_line(end, next, diagnostics);
    if (found == State::Find::end) return false;
    if (found == State::Find::too_long) {
      state.skip_long_line(diagnostics);
      continue;
    }
    text = std::string_view(state.buffer.data() + state.cursor, end - state.cursor);
    line = state.line;
    const std::size_t nul = text.find('\0');
    if (nul != std::string_view::npos) {
      state.report(diagnostics, "gcode.nul-byte", nul + 1, "a NUL byte in the line",
                   "plain text; the file may be damaged, or not G-code", text);
    }
    state.cursor = next;
    ++state.line;
    if (nul == std::string_view::npos) return true;
  }
  return false;
}

ReaderPosition ProgramReader::position() const {
  return state_->sought.value_or(ReaderPosition{state_->offset + state_->cursor, state_->line});
}

void ProgramReader::seek(ReaderPosition position) {
  state_->sought = position;
}

ProgramReader ProgramReader::again() const {
  auto state = std::make_unique<State>(*state_);
  state->failed = false;
  ProgramReader reader(std::move(state));
  reader.seek({.offset = state_->start, .line = 1});
  return reader;
}

const std::string& ProgramReader::name() const {
  return state_->name;
}

std::uint64_t ProgramReader::size() const {
  return state_->size;
}

}  // namespace passo
