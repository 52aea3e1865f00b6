// ProgramUploads: programs that come in pieces, so that an upload shows its progress and goes on after a broken
// connection. Each piece says where it begins; what was received stays until the upload is whole, dropped, or silent
// for too long.
//
// Bounded: so many uploads at once, and so many bytes in all. What was announced is reserved, so an upload that has
// begun does not end for want of room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "passo/interpreter/interpreter.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct ProgramUpload {
  std::uint64_t id = 0;
  std::string name;
  Dialect dialect = Dialect::linuxcnc;
  std::size_t bytes = 0;  // in all
  std::string text;       // what was received
  Seconds heard{0};       // when the last piece came
};

class ProgramUploads {
 public:
  static constexpr std::size_t most_uploads = 8;
  static constexpr std::size_t most_bytes = std::size_t{128} << 20;
  // An upload that is silent for so long makes room for another.
  static constexpr Seconds longest_silence{600};

  // Null: there is no room. `bytes`: above 0.
  const ProgramUpload* begin(std::string name, Dialect dialect, std::size_t bytes, Seconds now);
  const ProgramUpload* find(std::uint64_t id) const;
  const std::map<std::uint64_t, ProgramUpload>& all() const { return uploads_; }
  enum class Taken : std::uint8_t { more, whole, gap, too_long };
  // `from`: where the piece begins. A piece that begins elsewhere than where the last one ended changes nothing.
  Taken append(std::uint64_t id, std::size_t from, std::string_view piece, Seconds now);
  // The upload leaves. Call it for one that exists.
  ProgramUpload remove(std::uint64_t id);

 private:
  void drop_silent(Seconds now);

  std::map<std::uint64_t, ProgramUpload> uploads_;
  std::size_t bytes_ = 0;  // reserved
  std::uint64_t last_id_ = 0;
};

}  // namespace passo
