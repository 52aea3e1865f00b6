// Vfd: a variable-frequency drive (VFD) of a spindle, as exchanges of one request and one reply each.
//
// Position: below SpindleController, which decides what to exchange and when. A Vfd knows only the frames.
#pragma once

#include <cstdint>
#include <string>

#include "passo/base/result.hpp"

namespace passo {

enum class VfdTask : std::uint8_t {
  set_speed,
  run_forward,
  run_reverse,
  stop,
  reset_fault,
  read_speed,
  read_current,
  read_load,
  read_fault,
};
inline constexpr int vfd_task_count = 9;

struct VfdTrouble {
  enum class Kind : std::uint8_t {
    silent,     // no reply in time, or only a part of one
    bad_reply,  // a reply with a wrong checksum, or one to another request
    refused,    // a Modbus exception
    port,       // the serial port cannot be used
  };
  Kind kind = Kind::silent;
  int exception = 0;       // the number of the exception
  std::string words = {};  // what is wrong with the port, or with the reply
};

class Vfd {
 public:
  virtual ~Vfd() = default;
  Vfd(const Vfd&) = delete;
  Vfd& operator=(const Vfd&) = delete;

  // False: this kind of drive has no such exchange.
  virtual bool can(VfdTask task) const = 0;
  // Waits for the reply. `rpm`: for set_speed. Returns what was read: rpm, A, the fraction of the rated load, or the
  // number of the fault (0: none).
  virtual Result<double, VfdTrouble> exchange(VfdTask task, double rpm) = 0;
  // What a fault of that number means; empty: unknown.
  virtual std::string fault_text(int number) const = 0;

 protected:
  Vfd() = default;
};

}  // namespace passo
