// GrblPort: the bytes to and from a machine with a Grbl controller, and the time.
#pragma once

#include <string>
#include <string_view>

#include "passo/units/units.hpp"

namespace passo {

class GrblPort {
 public:
  virtual ~GrblPort() = default;
  virtual Seconds now() const = 0;
  virtual void send(std::string_view bytes) = 0;
  // Waits for bytes, at most this long, and returns what came.
  virtual std::string receive(Seconds most) = 0;
  // The connection is lost.
  virtual bool is_broken() const = 0;
  // Whether the device of a lost connection was unplugged and is there again. Opens nothing.
  virtual bool has_returned() { return false; }
  // Opens a lost connection again, under another name if the device has one. Returns false if it is not there yet.
  virtual bool open_again() = 0;
};

}  // namespace passo
