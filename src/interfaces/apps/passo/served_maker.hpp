// ServedMaker: runs `passo cam` for the API in a separate process (background_process.hpp). The files are in a
// temporary folder.
#pragma once

#include <string>
#include <vector>

#include "background_process.hpp"

#include "passo/api/cam_service.hpp"

namespace passo {

class ServedMaker final : public CamService {
 public:
  static constexpr std::size_t most_files = 32;
  static constexpr std::size_t most_bytes = std::size_t{128} << 20;

  std::vector<std::string> files() const override;
  bool keep(const std::string& name, std::string_view bytes) override;
  std::optional<std::string> content(const std::string& name, std::size_t most) const override;
  std::string folder() const override;
  CamShapes shapes(const std::string& name) override;
  bool remove(const std::string& name) override;
  void clear() override;
  bool begin(const CamOrder& order) override;
  const CamResult& result() override;
  std::string program(std::size_t number) const override;
  std::string picture(std::optional<std::size_t> number) const override;
  std::string page() const override;

 private:
  void poll_folder();

  struct Kept {
    std::string name;
    std::size_t bytes = 0;
    CamShapes shapes = {};
  };
  std::vector<Kept>::const_iterator find(const std::string& name) const;
  void poll_shapes();
  void forget_reading(const std::string& name);  // its shapes are read no longer

  TemporaryFolder folder_;
  std::vector<Kept> kept_;
  std::string stem_;           // base name of the programs
  bool makes_folder_ = false;  // a board, or both sides of a model: several programs, and a page
  CamResult result_;
  std::vector<std::string> made_;  // the program files in the folder
  BackgroundProcess process_;
  BackgroundProcess reader_;  // of the shapes of one drawing
  std::string read_name_;     // that drawing
};

}  // namespace passo
