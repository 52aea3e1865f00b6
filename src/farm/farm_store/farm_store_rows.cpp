#include "farm_store_rows.hpp"

#include <algorithm>
#include <utility>

namespace passo {

std::string joined(const Words& words) {
  std::string column;
  for (const std::string& word : words) column += word + '\n';
  return column;
}

Words split(const std::string& column) {
  Words words;
  for (std::size_t begin = 0; begin < column.size();) {
    const std::size_t end = std::min(column.find('\n', begin), column.size());
    words.push_back(column.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

Words in_order(Words words) {
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  std::erase_if(words, [](const std::string& word) { return word.empty() || word.find('\n') != std::string::npos; });
  return words;
}

bool has_all(const Words& words, const Words& wanted) {
  return std::includes(words.begin(), words.end(), wanted.begin(), wanted.end());
}

const std::string machine_columns = "name, url, token, machine_file, labels, materials, tools, stock, heard_at, status";

FarmMachine machine_of(const Row& row) {
  return {.name = row.text(0),
          .url = row.text(1),
          .token = row.text(2),
          .machine_file = row.text(3),
          .labels = split(row.text(4)),
          .materials = split(row.text(5)),
          .tools = split(row.text(6)),
          .stock = row.text(7),
          .heard_at = row.real(8),
          .status = row.text(9)};
}

const std::string job_columns =
    "id, name, program, quantity, material, tools, stock, labels, priority, due_at, owner, state, created_at,"
    " (SELECT count(*) FROM attempts WHERE attempts.job = jobs.id AND attempts.state = 3),"
    " (SELECT count(*) FROM attempts WHERE attempts.job = jobs.id AND attempts.state < 3)";

FarmJob job_of(const Row& row) {
  return {.id = row.number(0),
          .name = row.text(1),
          .program = row.text(2),
          .quantity = row.number(3),
          .material = row.text(4),
          .tools = split(row.text(5)),
          .stock = row.text(6),
          .labels = split(row.text(7)),
          .priority = row.number(8),
          .due_at = row.real(9),
          .owner = row.text(10),
          .state = static_cast<FarmJobState>(row.number(11)),
          .created_at = row.real(12),
          .parts_done = row.number(13),
          .parts_open = row.number(14)};
}
static_assert(static_cast<int>(AttemptState::done) == 3 && !is_open(AttemptState::done), "the numbers in the columns");

const std::string attempt_columns = "id, job, machine, operator, state, why, claimed_at, started_at, ended_at";

Attempt attempt_of(const Row& row) {
  return {.id = row.text(0),
          .job = row.number(1),
          .machine = row.text(2),
          .operator_name = row.text(3),
          .state = static_cast<AttemptState>(row.number(4)),
          .why = row.text(5),
          .claimed_at = row.real(6),
          .started_at = row.real(7),
          .ended_at = row.real(8)};
}

}  // namespace passo
