// Reads a CSV with levels or steps: signals_reader.hpp.
#include <cmath>
#include <optional>
#include <vector>

#include "signals_file.hpp"

#include "passo/base/lower_case.hpp"
#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

constexpr std::int64_t longest_pulse = 1'000'000;  // ns

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

bool is_time(std::string_view name) {
  const std::string lower = lower_case(std::string(name));
  return lower == "t" || lower == "time" || lower == "time_s";
}

// A column of levels is a signal. One of steps is two, of which this is the first, and its pulse is closed later.
struct Column {
  std::size_t signal = 0;
  bool has_steps = false;
  std::optional<std::int64_t> rose_at = {};
};

class CsvFile {
 public:
  explicit CsvFile(SignalsFile& file) : file_(file) {}

  bool read() {
    if (!read_header()) return false;
    while (file_.next_line()) {
      if (trimmed(file_.line()).empty()) continue;
      if (!read_row()) return false;
      if (is_over_) break;
    }
    for (Column& column : columns_) {
      if (!close_pulse(column, now_ + 2 * longest_pulse)) return false;
    }
    return true;
  }

 private:
  bool read_header() {
    while (file_.next_line() && (file_.line().starts_with(';') || file_.line().starts_with('#'))) {
    }
    const std::vector<std::string_view> names = fields_of(file_.line());
    if (names.size() < 2 || !is_time(names[0])) {
      return file_.fail(
          fmt::format("expected the names of the columns, the time in seconds first, e.g. "
                      "t,clock_x,direction_x or t,x,y,z, got '{}'",
                      file_.line().substr(0, 60)));
    }
    for (std::size_t i = 1; i < names.size(); ++i) {
      const std::string name = lower_case(std::string(names[i]));
      const bool has_steps = name.size() == 1 && name[0] >= 'a' && name[0] <= 'z';
      columns_.push_back({file_.add(has_steps ? name + "_step" : std::string(names[i])), has_steps});
      if (has_steps) file_.add(name + "_dir");
    }
    return true;
  }

  bool read_row() {
    const std::vector<std::string_view> fields = fields_of(file_.line());
    if (fields.size() != columns_.size() + 1) {
      return file_.fail(
          fmt::format("expected {} columns, as in the first row, got {}", columns_.size() + 1, fields.size()));
    }
    double seconds = 0;
    const char* const end = fields[0].data() + fields[0].size();
    const auto [rest, error] = std::from_chars(fields[0].data(), end, seconds);
    if (error != std::errc{} || rest != end || !(seconds >= 0) || seconds > 1e6) {
      return file_.fail(fmt::format("expected a time in seconds, 0 to 1e6, got '{}'", fields[0]));
    }
    const std::int64_t at = std::llround(seconds * 1e9);
    if (at < now_)
      return file_.fail(fmt::format("expected a time that is not before the last one, got '{}'", fields[0]));
    is_over_ = !file_.pass_to(at);
    if (is_over_) return true;
    now_ = at;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!read_field(columns_[i], fields[i + 1])) return false;
    }
    return true;
  }

  bool read_field(Column& column, std::string_view text) {
    if (text != "0" && text != "1" && !(column.has_steps && text == "-1")) {
      return file_.fail(
          fmt::format("expected {} got '{}'", column.has_steps ? "a step, -1, 0 or 1," : "a level, 0 or 1,", text));
    }
    if (!column.has_steps) return file_.set(column.signal, now_, text == "1");
    if (text == "0") return true;
    if (!close_pulse(column, now_) || !file_.set(column.signal + 1, now_, text == "-1")) return false;
    column.rose_at = now_;
    return file_.set(column.signal, now_, true);
  }

  // Of the last step, when the time of the next one is known.
  bool close_pulse(Column& column, std::int64_t next) {
    if (!column.rose_at) return true;
    const std::int64_t at = *column.rose_at + std::min((next - *column.rose_at) / 2, longest_pulse);
    column.rose_at.reset();
    return file_.set(column.signal, at, false);
  }

  SignalsFile& file_;
  std::vector<Column> columns_;
  std::int64_t now_ = 0;
  bool is_over_ = false;
};

}  // namespace

bool read_csv(SignalsFile& file) {
  return CsvFile(file).read();
}

}  // namespace passo
