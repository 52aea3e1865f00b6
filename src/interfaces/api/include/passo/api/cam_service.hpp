// CamService: generates programs from drawings and pictures, as `passo cam` does, without blocking the machine.
//
// Position in the pipeline: the API's interface to a service that the program provides. It processes one order at a
// time. The files of an order are kept by name until they are cleared. The implementation must limit memory, time and
// files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

struct CamOrder {
  std::string job;                   // "drill"
  std::vector<std::string> files;    // names of kept files
  std::vector<std::string> options;  // "--depth=-2"
  std::string profile = {};          // for a board: options of the required commands, as TOML; empty: none
  std::string machine = {};          // contents of the machine file, for the time estimates of a board and for the
                                     // limits of feeds from a tool library; empty: unknown
};

struct CamResult {
  enum class State : std::uint8_t { none, running, done, failed };
  State state = State::none;
  std::string job;
  double progress = 0;                  // 0 to 1; never decreases while the order runs
  std::vector<std::string> names = {};  // names of the programs, in the order in which they are to be run
  std::string words = {};               // messages, including the reason for a failure
  std::string picture_type = {};        // "image/svg+xml"; empty: no picture
  std::string report = {};              // for a board: the files read, and the steps, as JSON; also after a failure
  bool has_page = false;                // for a board: a page with instructions
};

// The geometry of a drawing, as `passo cam show --shapes` prints it.
struct CamShapes {
  CamResult::State state = CamResult::State::none;  // none: another drawing is being read; ask again
  std::string json = {};
  std::string words = {};  // why there is none
};

class CamService {
 public:
  static constexpr std::size_t longest_file = std::size_t{48} << 20;  // bytes

  virtual ~CamService() = default;
  virtual std::vector<std::string> files() const = 0;
  // Keeps a file for orders; replaces one of the same name. `name`: letters, digits and " ._-()". Returns false if
  // there is no room.
  virtual bool keep(const std::string& name, std::string_view bytes) = 0;
  // The content of a kept file. Empty: there is none, or it has more than `most` bytes.
  virtual std::optional<std::string> content(const std::string& name, std::size_t most) const = 0;
  // Where the kept files are; ends with '/'.
  virtual std::string folder() const = 0;
  // Reads a kept drawing, in a process of its own. The first call begins, later ones tell how it goes.
  virtual CamShapes shapes(const std::string& name) = 0;
  // Deletes a kept file. Returns false if there is none.
  virtual bool remove(const std::string& name) = 0;
  // Deletes all files, and ends the running order.
  virtual void clear() = 0;
  // Starts an order. Returns false if an order is running, or if it cannot be started.
  virtual bool begin(const CamOrder& order) = 0;
  // Returns the current state. Can be called often: it is cheap if nothing has changed.
  virtual const CamResult& result() = 0;
  // Returns a program of the last completed order. Programs are numbered from 0.
  virtual std::string program(std::size_t number) const = 0;
  // Returns the picture of the whole order, or of one of several programs.
  virtual std::string picture(std::optional<std::size_t> number) const = 0;
  // Returns the instructions as HTML.
  virtual std::string page() const = 0;
};

}  // namespace passo
