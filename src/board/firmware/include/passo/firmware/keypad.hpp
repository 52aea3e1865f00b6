// Keypad: finds the key of a 4x3 keypad that the operator holds down.
//
//   1 2 3
//   4 5 6
//   7 8 9
//   * 0 #
//
// A key connects its row to its column. The rows are read with a pull-up. One column at a time is driven low and the
// others float, so that two keys in a row cause no short circuit. A column is driven long before its rows are read,
// because a long cable needs time to settle.
//
// Two keys at once count as no key: a jog stops when a second key is pressed. Portable.
#pragma once

#include <stdint.h>

namespace passo {

using Key = uint8_t;
inline constexpr uint8_t keypad_rows = 4;
inline constexpr uint8_t keypad_columns = 3;
inline constexpr Key no_key = keypad_rows * keypad_columns;

constexpr Key key_at(uint8_t row, uint8_t column) {
  return static_cast<Key>(row * keypad_columns + column);
}
// Returns the key with this character, or no_key.
constexpr Key key_named(char name) {
  constexpr char names[] = "123456789*0#";
  Key key = 0;
  while (key < no_key && names[key] != name) ++key;
  return key;
}

// A debounced value: it becomes valid after it has been equal in `looks` scans after the first.
template <uint8_t looks>
class Settled {
 public:
  constexpr explicit Settled(uint8_t value) : value_(value), seen_(value) {}

  void update(uint8_t now) {
    if (now != seen_) {
      seen_ = now;
      left_ = looks;
    } else if (left_ != 0 && --left_ == 0) {
      value_ = seen_;
    }
  }
  uint8_t value() const { return value_; }
  // Whether the last scan read the same value.
  bool steady() const { return seen_ == value_; }

 private:
  uint8_t value_;
  uint8_t seen_;
  uint8_t left_ = 0;
};

// Collects the result of one scan of all columns. The caller drives the columns.
class KeypadScan {
 public:
  // `rows` has a bit for each row that is connected to this column.
  void add(uint8_t column, uint8_t rows) {
    if (rows == 0) return;
    const uint8_t row = only_row(rows);
    key_ = key_ == no_key && row < keypad_rows ? key_at(row, column) : several;
  }
  Key take() {
    const Key key = key_ < no_key ? key_ : no_key;
    key_ = no_key;
    return key;
  }

 private:
  static constexpr Key several = 0xff;

  static constexpr uint8_t only_row(uint8_t rows) {
    switch (rows) {
      case 1: return 0;
      case 2: return 1;
      case 4: return 2;
      case 8: return 3;
      default: return keypad_rows;
    }
  }

  Key key_ = no_key;
};

}  // namespace passo
