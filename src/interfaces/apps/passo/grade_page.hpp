// GradePage: the results of a class as a text, as a table (CSV), as JSON and as a page that loads nothing. What
// students wrote or named becomes printable text before.
#pragma once

#include <string>
#include <vector>

#include "passo/grading/grade.hpp"

namespace passo {

struct GradePage {
  std::string title;  // what was graded
  std::vector<Grade> grades;
  bool is_class = false;
};

// Replaces control characters and bytes that are not UTF-8.
void make_printable(Grade& grade);

std::string to_text(const GradePage& page);
std::string to_csv(const GradePage& page);
std::string to_json(const GradePage& page);
std::string to_html(const GradePage& page);

}  // namespace passo
