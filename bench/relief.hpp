// GeneratedProgram: a program that a benchmark writes into the temporary folder; also writes a dense relief.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace passo {

// The file is removed in the destructor.
class GeneratedProgram {
 public:
  explicit GeneratedProgram(const std::string& name)
      : folder_(std::filesystem::temp_directory_path() / ("passo-" + std::to_string(getpid()))),
        path_(folder_ / (name + ".ngc")) {
    std::filesystem::create_directory(folder_);
    file_.open(path_);
    file_ << "G21 G90 G0 Z5\nF3000\n";
  }
  ~GeneratedProgram() { std::filesystem::remove_all(folder_); }
  GeneratedProgram(const GeneratedProgram&) = delete;
  GeneratedProgram& operator=(const GeneratedProgram&) = delete;

  std::ostream& text() { return file_; }
  std::ostream& line() { return file_ << "G1"; }
  std::string finish() {
    file_ << "G0 Z5\nM2\n";
    file_.close();
    return path_.string();
  }

 private:
  std::filesystem::path folder_;
  std::filesystem::path path_;
  std::ofstream file_;
};

// Writes a surface of hills and furrows, in rows of a thousand moves of 0.2 mm, back and forth.
inline void write_relief(GeneratedProgram& program, int moves) {
  constexpr int a_row = 1000;
  const int rows = moves / a_row;
  for (int i = 0; i < moves; ++i) {
    const int row = i / a_row;
    const int column = row % 2 == 0 ? i % a_row : a_row - 1 - i % a_row;
    const double x = column * 0.2;
    const double y = row * 200.0 / rows;
    const double z = -2 + std::sin(x / 7) * std::cos(y / 11) + 0.3 * std::sin(x / 2.1 + y / 3) - 0.01 * (i % 3);
    program.line() << " X" << x << " Y" << y << " Z" << z << "\n";
  }
}

}  // namespace passo
