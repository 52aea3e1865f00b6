// Maker: makes programs of drawings and pictures beside the machine, as `passo cam` does.
//
// Place: the API's view of a helper that the program provides. One order at a time. The files of an order are kept by
// name until they are cleared. Memory, time and files are bounded by whoever implements this.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct MakeOrder {
  std::string job;                   // "drill"
  std::vector<std::string> files;    // names that were kept
  std::vector<std::string> options;  // "--depth=-2"
  std::string profile = {};          // of a board: options of the commands that it needs, as TOML; empty: none
  std::string machine = {};          // of a board: the machine file's text, for the times; empty: unknown
};

struct MakeResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  std::string job;
  double progress = 0;                  // 0 to 1; only grows while the order runs
  std::vector<std::string> names = {};  // of the programs, in the order in which they are run
  std::string words = {};               // what was said; why it failed
  std::string picture_type = {};        // "image/svg+xml"; empty: there is no picture
  std::string report = {};              // of a board: what was read, and the steps, as JSON; also where it failed
  bool has_page = false;                // of a board: what to do when
};

class Maker {
 public:
  static constexpr std::size_t longest_file = std::size_t{48} << 20;  // bytes

  virtual ~Maker() = default;
  virtual std::vector<std::string> files() const = 0;
  // Keeps a file for orders; one of the same name is replaced. `name`: letters, digits and " ._-()". False: no room.
  virtual bool keep(const std::string& name, std::string_view bytes) = 0;
  // Forgets all files, and ends the order that runs.
  virtual void clear() = 0;
  // False: an order runs, or none can begin.
  virtual bool begin(const MakeOrder& order) = 0;
  // How it goes. Call often: it is cheap while nothing changes.
  virtual const MakeResult& result() = 0;
  // Of the last order that is done. Programs count from 0.
  virtual std::string program(std::size_t number) const = 0;
  // The whole picture, or that of one of several programs.
  virtual std::string picture(std::optional<std::size_t> number) const = 0;
  // HTML.
  virtual std::string page() const = 0;
};

}  // namespace passo
